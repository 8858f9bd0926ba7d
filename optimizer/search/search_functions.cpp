#include "optimizer/search/search_functions.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "optimizer/search/params.hpp"

namespace dovetail::optimizer {

namespace {
constexpr SubstituteParams kSubstitute;
}  // namespace

double penalised(const SearchValue& value, double weight) {
  double sum = 0;
  for (const double c : value.constraints) sum += std::max(0.0, c);
  return value.objective + weight * sum;
}

SearchFunctions::SearchFunctions(EvaluationSession& session, std::string phase)
    : session_(session), phase_(std::move(phase)) {
  if (const auto best = session_.best())
    reference_ = *best;
  else if (const auto least = session_.least_broken())
    reference_ = *least;
  std::vector<double> magnitudes;
  double worst = -std::numeric_limits<double>::infinity();
  double least = std::numeric_limits<double>::infinity();
  for (const Candidate& candidate : session_.candidates()) {
    if (!candidate.judgement.computed) continue;
    magnitudes.push_back(std::abs(candidate.judgement.objective));
    worst = std::max(worst, candidate.judgement.objective);
    least = std::min(least, candidate.judgement.objective);
  }
  const Judgement& judgement = session_[reference_].judgement;
  if (!magnitudes.empty()) {
    const auto middle = magnitudes.begin() + static_cast<std::ptrdiff_t>(magnitudes.size() / 2);
    std::nth_element(magnitudes.begin(), middle, magnitudes.end());
    const double typical = *middle > 0 ? *middle : *std::max_element(magnitudes.begin(), magnitudes.end());
    if (std::isnormal(typical)) scale_ = typical;
    const double from = judgement.computed ? judgement.objective : least;
    level_ = std::min(worst / scale_, from / scale_ + 1.0);
  }
  reference_constraints_.assign(constraint_count() - 1, 0.0);
  if (judgement.computed)
    for (std::size_t j = 0; j < reference_constraints_.size(); ++j) reference_constraints_[j] = aimed(judgement, j);
}

double SearchFunctions::aimed(const Judgement& judgement, std::size_t j) const {
  const std::vector<double>& shifts = session_.shifts();  // the limits of a focus have none
  return judgement.constraints[j] + (j < shifts.size() ? shifts[j] : 0) + options().constraint_margin;
}

std::size_t SearchFunctions::size() const {
  return session_.problem().space.size();
}

std::size_t SearchFunctions::constraint_count() const {
  return session_[0].judgement.constraints.size() + 1;
}

SearchValue SearchFunctions::seen(const Candidate& candidate) const {
  const Judgement& judgement = candidate.judgement;
  SearchValue value{.constraints = reference_constraints_, .computed = judgement.computed};
  if (judgement.computed) {
    value.objective = judgement.objective / scale_;
    for (std::size_t j = 0; j < value.constraints.size(); ++j) value.constraints[j] = aimed(judgement, j);
    value.constraints.push_back(
        std::min(judgement.rules.value_or(kSubstitute.unknown_rules), kSubstitute.most_violation));
  } else if (candidate.evaluation.infeasible()) {
    value.objective = level_ + std::min(judgement.violation, kSubstitute.most_violation);
    value.constraints.push_back(std::min(judgement.rules.value_or(1.0), kSubstitute.most_violation));
  } else {
    value.objective = level_ + kSubstitute.failed;
    value.constraints.push_back(1.0);
  }
  return value;
}

SearchValue SearchFunctions::value(std::span<const double> unit) {
  return seen(session_[session_.evaluate(unit, phase_)]);
}

std::vector<SearchValue> SearchFunctions::values(const std::vector<std::vector<double>>& units) {
  std::vector<SearchValue> all;
  for (const std::size_t index : session_.evaluate_all(units, phase_)) all.push_back(seen(session_[index]));
  return all;
}

SearchGradient SearchFunctions::gradient(std::span<const double> unit) {
  const std::size_t base = session_.evaluate(unit, phase_);
  ++session_.statistics().gradients;
  return differences(base);
}

SearchGradient SearchFunctions::differences(std::size_t base) {
  const std::size_t n = size();
  const std::vector<double> u = session_.unit(base);
  const SearchValue here = seen(session_[base]);
  const double h = difference_step(options());
  const auto neighbour = [&](std::size_t i, double side) {
    std::vector<double> moved = u;
    moved[i] += side * h;
    return moved;
  };
  const auto inside = [&](std::size_t i, double side) { return u[i] + side * h >= 0 && u[i] + side * h <= 1; };

  // Usable neighbours of each variable: one, or upper and lower.
  std::vector<std::vector<std::size_t>> found(n);
  const auto ask = [&](const std::vector<std::pair<std::size_t, double>>& wanted) {
    std::vector<std::vector<double>> points;
    for (const auto& [i, side] : wanted) points.push_back(neighbour(i, side));
    const std::vector<std::size_t> indices = session_.evaluate_all(points, phase_);
    for (std::size_t k = 0; k < wanted.size(); ++k)
      if (seen(session_[indices[k]]).computed == here.computed) found[wanted[k].first].push_back(indices[k]);
  };
  const bool central = options().difference == Difference::central;
  std::vector<std::pair<std::size_t, double>> first, second;
  for (std::size_t i = 0; i < n; ++i) {
    const double side = inside(i, 1) ? 1 : -1;
    first.emplace_back(i, side);
    if (central && side > 0 && inside(i, -1)) first.emplace_back(i, -1.0);
  }
  ask(first);
  for (std::size_t i = 0; i < n; ++i)
    if (found[i].empty() && !central && inside(i, 1) && inside(i, -1)) second.emplace_back(i, -1.0);
  if (!second.empty()) ask(second);

  SearchGradient result{.objective = std::vector<double>(n, 0.0),
                        .constraints = std::vector(constraint_count(), std::vector<double>(n, 0.0))};
  for (std::size_t i = 0; i < n; ++i) {
    if (found[i].empty()) {
      ++session_.statistics().gradient_fallbacks;
      continue;
    }
    const bool both = found[i].size() == 2;
    const SearchValue from = both ? seen(session_[found[i][1]]) : here;
    const SearchValue to = seen(session_[found[i][0]]);
    const double step = session_.unit(found[i][0])[i] - (both ? session_.unit(found[i][1])[i] : u[i]);
    result.objective[i] = (to.objective - from.objective) / step;
    for (std::size_t j = 0; j < result.constraints.size(); ++j)
      result.constraints[j][i] = (to.constraints[j] - from.constraints[j]) / step;
  }
  return result;
}

}  // namespace dovetail::optimizer
