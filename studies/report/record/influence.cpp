#include "studies/report/record/influence.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numeric>

namespace dovetail::report {

namespace {

/// Ranks from -1 to 1; equal values have the mean of theirs.
Eigen::VectorXd ranks(const Numbers& values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::sort(order, {}, [&](std::size_t i) { return values[i]; });
  Eigen::VectorXd rank(static_cast<Eigen::Index>(values.size()));
  for (std::size_t first = 0; first < order.size();) {
    std::size_t last = first;
    while (last + 1 < order.size() && values[order[last + 1]] == values[order[first]]) ++last;
    for (std::size_t k = first; k <= last; ++k)
      rank(static_cast<Eigen::Index>(order[k])) =
          static_cast<double>(first + last) / static_cast<double>(order.size() - 1) - 1;
    first = last + 1;
  }
  return rank;
}

/// Of slope and curvature of a parabola over -1 to 1. It has a valley or a hill where its vertex is well inside and
/// both arms count.
Trend trend_of(double slope, double curvature) {
  if (std::abs(slope) < 1.2 * std::abs(curvature)) return curvature > 0 ? Trend::valley : Trend::hill;
  return slope > 0 ? Trend::rises : Trend::falls;
}

}  // namespace

Influence influence(const RunRecord& record, const Numbers& values) {
  const std::size_t variables = record.problem.space.variables().size();
  std::vector<std::size_t> known;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (std::isfinite(values[i]) && record.evaluations[i].x.size() == variables) known.push_back(i);
  Influence result{.candidates = known.size()};
  if (variables == 0 || known.size() < 4 * variables + 2) return result;
  const auto column = [&](auto&& value) {
    Numbers of;
    for (const std::size_t i : known) of.push_back(value(i));
    return ranks(of);
  };
  const Eigen::VectorXd y = column([&](std::size_t i) { return values[i]; });
  const double variance = y.squaredNorm();  // ranks have the mean 0
  if (!(variance > 0)) return result;
  const auto count = static_cast<Eigen::Index>(variables);
  Eigen::MatrixXd basis(y.size(), 2 * count);
  for (Eigen::Index v = 0; v < count; ++v) {
    const Eigen::VectorXd x =
        column([&](std::size_t i) { return record.evaluations[i].x[static_cast<std::size_t>(v)]; });
    basis.col(2 * v) = x;
    basis.col(2 * v + 1) = x.cwiseAbs2().array() - x.squaredNorm() / static_cast<double>(x.size());
  }
  const Eigen::VectorXd weights = basis.completeOrthogonalDecomposition().solve(y);
  const Eigen::VectorXd fit = basis * weights;
  // Less what as many terms explain of noise: candidates are few.
  const auto freedom = static_cast<double>(y.size() - 1), left = freedom - static_cast<double>(2 * count);
  result.explained = std::max(0.0, 1 - (1 - fit.squaredNorm() / variance) * freedom / left);
  double sum = 0;
  for (Eigen::Index v = 0; v < count; ++v) {
    const Eigen::VectorXd part = basis.middleCols(2 * v, 2) * weights.segment(2 * v, 2);
    result.variables.push_back(
        {.share = std::max(0.0, part.dot(fit)), .trend = trend_of(weights(2 * v), 2 * weights(2 * v + 1))});
    sum += result.variables.back().share;
  }
  for (VariableInfluence& variable : result.variables) variable.share *= sum > 0 ? result.explained / sum : 0;
  return result;
}

}  // namespace dovetail::report
