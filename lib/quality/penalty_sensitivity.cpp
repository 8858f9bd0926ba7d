#include "quality/penalty_sensitivity.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "paths/steady_state.hpp"

namespace dovetail::quality {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

void check(const PenaltySensitivityOptions& options) {
  std::vector<Violation> found;
  const auto require = [&](double value, const char* key) {
    if (!kPositive.contains(value))
      found.push_back({.file = {}, .key = key, .value = shortest(value), .allowed = kPositive.phrase()});
  };
  for (const double ratio : options.ratios) require(ratio, "ratios");
  require(options.step, "step");
  if (!found.empty()) throw InputError(std::move(found));
}

// Visits the ratios outwards from 1, so that each has a neighbour to start from: `visit(index, neighbour)` with
// -1 for the state at ratio 1.
template <class Visit>
void outwards(const std::vector<double>& ratios, const Visit& visit) {
  std::vector<std::size_t> order(ratios.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return std::abs(std::log(ratios[i])); });
  std::ptrdiff_t below = -1, above = -1;
  for (const std::size_t i : order) {
    std::ptrdiff_t& side = ratios[i] < 1 ? below : above;
    if (visit(i, side)) side = static_cast<std::ptrdiff_t>(i);
  }
}

double logarithmic_slope(double lower, double upper, double step) {
  return lower == upper ? 0 : std::log(upper / lower) / (2 * step);
}

// The first status that is not converged.
void worsen(Status& all, Status one) {
  if (all == Status::converged) all = one;
}

}  // namespace

PenaltySensitivity penalty_sensitivity(const steady::Joint& joint, const steady::State& state,
                                       const PenaltySensitivityOptions& sensitivity) {
  check(sensitivity);
  const auto outputs = static_cast<Eigen::Index>(joint.model->output_names().size());
  const std::size_t count = sensitivity.ratios.size();
  PenaltySensitivity result{.status = state.status,
                            .ratios = sensitivity.ratios,
                            .statuses = std::vector<Status>(count, state.status),
                            .values = std::vector<Quantities>(count, constant_quantities(outputs, kNan)),
                            .slope = constant_quantities(outputs, kNan)};
  if (state.status != Status::converged) return result;
  steady::Joint base = joint;
  base.options.linearise = false;
  const auto at_ratio = [&](double ratio, const steady::State& from) {
    steady::Joint scaled = base;
    scaled.options.penalty_scale *= ratio;
    steady::State found = paths::refined_state(scaled, from);
    result.jacobians += found.iterations;
    return found;
  };
  std::vector<steady::State> states(count);
  outwards(sensitivity.ratios, [&](std::size_t i, std::ptrdiff_t neighbour) {
    states[i] = at_ratio(sensitivity.ratios[i], neighbour < 0 ? state : states[static_cast<std::size_t>(neighbour)]);
    result.statuses[i] = states[i].status;
    worsen(result.status, states[i].status);
    if (states[i].status != Status::converged) return false;
    result.values[i] = quantities(*joint.model, states[i]);
    return true;
  });
  const steady::State lower = at_ratio(std::exp(-sensitivity.step), state);
  const steady::State upper = at_ratio(std::exp(sensitivity.step), state);
  worsen(result.status, lower.status);
  worsen(result.status, upper.status);
  if (lower.status == Status::converged && upper.status == Status::converged)
    result.slope = combine(quantities(*joint.model, lower), quantities(*joint.model, upper),
                           [&](double low, double high) { return logarithmic_slope(low, high, sensitivity.step); });
  return result;
}

}  // namespace dovetail::quality
