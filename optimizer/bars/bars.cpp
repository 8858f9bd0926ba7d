#include "optimizer/bars/bars.hpp"

#include <algorithm>
#include <cmath>

namespace dovetail::optimizer {

Factor same_for_all(double factor) {
  return [factor](const Response&) { return factor; };
}

double left_over(double order, double ratio) {
  return 1 / std::abs(std::pow(ratio, order) - 1);
}

void Bars::add(const char* source, const std::vector<Companion>& companions, const Evaluation& reference) {
  for (const Companion& companion : companions)
    if (!companion.evaluation->converged())
      result_.evaluation.messages.push_back(std::string("A design computed for the error by ") + source +
                                            " ended with \"" + companion.evaluation->status + "\".");
  for (const Response& response : responses()) {
    if (!asked(response)) continue;
    const std::string name(response.name);
    bool known = false;
    double bar = 0;
    for (const Companion& companion : companions) {
      const auto other = companion.evaluation->responses.find(name);
      if (other == companion.evaluation->responses.end()) continue;
      known = true;
      bar = std::max(bar, companion.factor(response) * std::abs(other->second - reference.responses.at(name)));
    }
    if (known) {
      add(source, response, bar);
    } else if (companions.empty()) {
      open_.insert(name);
    } else if (!companions.back().evaluation->converged()) {  // else it was not asked
      open_.insert(name);
      missing_ = companions.back().evaluation->status;
    }
  }
}

void Bars::add(const char* source, const LeftOpen& open) {
  for (const Response& response : responses())
    if (response.off != nullptr)
      if (asked(response))
        if (const std::optional<double> bar = response.off(result_, open)) add(source, response, *bar);
}

void Bars::add_own_errors() {
  for (const Response& response : responses())
    if (const OwnError& own = response.own_error; own.of != nullptr && asked(response) && response.has_limit(scene_))
      add(own.source, response, own.of(scene_, result_));
}

void Bars::leave_open(Stage stage) {
  for (const Response& response : responses())
    if (response.stage == stage && asked(response)) open_.emplace(response.name);
}

void Bars::match_unworn() {
  if (result_.asymptote->worn_volume != 0) return;
  for (const Response& response : responses()) {
    if (response.unworn == nullptr || !asked(response)) continue;
    for (const auto& [source, bar] : sources(*response.unworn)) {
      double& of_worn = sources(response)[source];
      of_worn = std::max(of_worn, bar);
    }
  }
}

double Bars::sum(const Response& response) const {
  double sum = 0;
  const auto of = result_.evaluation.error_sources.find(std::string(response.name));
  if (of != result_.evaluation.error_sources.end())
    for (const auto& [source, bar] : of->second) sum += bar;
  return sum;
}

void Bars::leave_unresolved_open() {
  Evaluation& evaluation = result_.evaluation;
  for (const Response& response : responses()) {
    if (!asked(response)) continue;
    const std::string name(response.name);
    if (!response.has_limit(scene_)) {
      open_.insert(name);
    } else if (response.largest_bar && sum(response) > *response.largest_bar * evaluation.responses.at(name)) {
      open_.insert(name);
      evaluation.messages.emplace_back(response.unresolved);
    }
  }
}

void Bars::total() {
  Evaluation& evaluation = result_.evaluation;
  leave_unresolved_open();
  for (const Response& response : responses()) {
    const std::string name(response.name);
    if (open_.contains(name) || !evaluation.error_sources.contains(name)) continue;
    const double bar = sum(response);
    evaluation.error_estimates[name] = bar;
    if (const double value = evaluation.responses.at(name); response.amount && value > 0 && bar > value)
      evaluation.messages.push_back(
          "The error bar of " + name +
          " is larger than its value: there may be next to nothing, or more than twice as much.");
  }
  evaluation.unbounded.assign(open_.begin(), open_.end());
  if (!missing_.empty()) evaluation.status = failed_at("error_estimates", missing_.substr(missing_.rfind(' ') + 1));
}

}  // namespace dovetail::optimizer
