#include "optimizer/bars/bars.hpp"

#include <algorithm>
#include <cmath>

namespace dovetail::optimizer {

Factor same_for_all(double factor) {
  return [factor](const std::string&) { return factor; };
}

double left_over(double order, double ratio) {
  return 1 / std::abs(std::pow(ratio, order) - 1);
}

void Bars::add(const char* source, const std::vector<Companion>& companions, const Evaluation& reference) {
  for (const Companion& companion : companions)
    if (!companion.evaluation->converged())
      evaluation_.messages.push_back(std::string("A design computed for the error by ") + source + " ended with \"" +
                                     companion.evaluation->status + "\".");
  for (const auto& [name, value] : evaluation_.responses) {
    bool known = false;
    double bar = 0;
    for (const Companion& companion : companions) {
      const auto other = companion.evaluation->responses.find(name);
      if (other == companion.evaluation->responses.end()) continue;
      known = true;
      bar = std::max(bar, companion.factor(name) * std::abs(other->second - reference.responses.at(name)));
    }
    if (known) {
      add(source, name, bar);
    } else if (!companions.back().evaluation->converged()) {  // else it was not asked
      leave_open(name);
      missing_ = companions.back().evaluation->status;
    }
  }
}

void Bars::add(const char* source, const std::string& response, double bar) {
  evaluation_.error_sources[response][source] += bar;
}

double Bars::sum(const std::string& response) const {
  double sum = 0;
  for (const auto& [source, bar] : evaluation_.error_sources.at(response)) sum += bar;
  return sum;
}

void Bars::total() {
  for (const auto& [response, sources] : evaluation_.error_sources)
    if (!open_.contains(response)) evaluation_.error_estimates[response] = sum(response);
  for (const char* amount : {"asymptotic_wear_volume_m3", "initial_wear_rate_m3_per_cycle", "dissipated_energy_j"}) {
    const auto bar = evaluation_.error_estimates.find(amount);
    if (bar == evaluation_.error_estimates.end()) continue;
    if (const double value = evaluation_.responses.at(amount); value > 0 && bar->second > value)
      evaluation_.messages.push_back(
          std::string("The error bar of ") + amount +
          " is larger than its value: there may be next to nothing, or more than twice as much.");
  }
  evaluation_.unbounded.assign(open_.begin(), open_.end());
  if (!missing_.empty()) evaluation_.status = "error_estimates: " + missing_.substr(missing_.rfind(' ') + 1);
}

}  // namespace dovetail::optimizer
