#include "stability/stability.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "numerics/dense_general.hpp"
#include "stability/contact_timeline.hpp"
#include "stability/perturbation.hpp"

namespace dovetail {

using stability::StabilityOptions;

template <>
std::span<const Field<StabilityOptions>> option_table<StabilityOptions>() {
  using O = StabilityOptions;
  static const std::vector<Field<O>> fields{
      {.key = "samples", .member = &O::samples, .range = {.lower = 16}},
      {.key = "tolerance", .member = &O::tolerance, .range = kNonNegative},
  };
  return fields;
}

}  // namespace dovetail

namespace dovetail::stability {
namespace {

std::vector<ContactTimeline> timelines(const steady::Tangent& tangent, const numerics::FourierBasis& basis) {
  const steady::Problem& problem = tangent.problem();
  const Eigen::Index d = problem.model().directions();
  std::vector<ContactTimeline> result;
  for (Eigen::Index i = 0; i < problem.model().nodes(); ++i)
    result.emplace_back(tangent.point().prediction.middleRows(i * d, d), problem.law(i), problem.march_options(), basis,
                        problem.released(i));
  return result;
}

// One pass: the multipliers, or why there are none.
struct Pass {
  bool meaningful = true;
  std::string failure;
  Eigen::VectorXcd multipliers;
  double norm = 0;  // of the map
  int neutral = 0, events = 0;
  [[nodiscard]] double largest() const { return multipliers.size() > 0 ? std::abs(multipliers(0)) : 0; }
};

Pass pass(const reduction::ReducedModel& model, const steady::Tangent& tangent, int samples) {
  Pass result;
  const int harmonics = tangent.problem().basis().harmonics();
  const numerics::FourierBasis basis(harmonics, std::max(samples, 4 * harmonics));
  const std::vector<ContactTimeline> nodes = timelines(tangent, basis);
  for (const ContactTimeline& node : nodes) {
    result.events += static_cast<int>(node.events().size());
    if (node.status() != Status::converged) result.failure = "the slip of a node does not repeat";
  }
  if (!result.failure.empty()) return result;
  const PerturbedStructure structure = perturbed_structure(model, tangent.problem().system().omega, nodes);
  result.neutral = structure.neutral;
  result.meaningful = structure.meaningful;
  result.failure = structure.reason;
  if (!result.failure.empty()) return result;
  Monodromy period = monodromy(structure, basis.samples());
  result.failure = std::move(period.failure);
  if (result.failure.empty() && !period.map.allFinite()) result.failure = "the perturbation overflows within a period";
  if (!result.failure.empty()) return result;
  result.norm = period.map.norm();
  numerics::Eigenvalues multipliers = numerics::eigenvalues(period.map);
  if (multipliers.status != Status::converged) {
    result.failure = "the eigenvalues of the monodromy matrix did not converge";
    return result;
  }
  result.multipliers = std::move(multipliers.values);
  std::stable_sort(
      result.multipliers.begin(), result.multipliers.end(),
      [](const std::complex<double>& a, const std::complex<double>& b) { return std::abs(a) > std::abs(b); });
  return result;
}

}  // namespace

Stability local_stability(const reduction::ReducedModel& model, const steady::State& state,
                          const StabilityOptions& options) {
  if (std::vector<Violation> found = violations(options); !found.empty()) throw InputError(std::move(found));
  Stability result;
  if (state.status != Status::converged) {
    result.reason = "the periodic solution did not converge (" + std::string(to_string(state.status)) + ")";
    return result;
  }
  if (!state.tangent) {
    result.reason = "the steady state keeps no tangent: solve it with the option linearise";
    return result;
  }
  const steady::Tangent& tangent = *state.tangent;
  if (model.size() != tangent.problem().model().size() || model.contact.count() != tangent.problem().model().nodes())
    throw InputError({.file = {},
                      .key = "model",
                      .value = std::to_string(model.size()) + " dofs",
                      .allowed = "must be the model of the steady state"});
  const Pass coarse = pass(model, tangent, options.samples);
  result.events = coarse.events;
  result.neutral = coarse.neutral;
  if (!coarse.failure.empty()) {
    result.verdict = coarse.meaningful ? StabilityVerdict::undetermined : StabilityVerdict::not_meaningful;
    result.reason = coarse.failure;
    return result;
  }
  const Pass fine = pass(model, tangent, 2 * options.samples);
  if (!fine.failure.empty()) {
    result.reason = fine.failure;
    return result;
  }
  result.events = fine.events;
  result.neutral = fine.neutral;
  result.multipliers = fine.multipliers;
  result.largest_modulus = fine.largest();
  // Exponentials of long phases lose some digits beyond those of the eigenvalues themselves.
  const double rounding = 100 * std::numeric_limits<double>::epsilon() * fine.norm;
  result.error = std::abs(fine.largest() - coarse.largest()) + rounding;
  const double distance = result.largest_modulus - 1;
  if (std::abs(distance) <= std::max(result.error, options.tolerance)) {
    result.verdict = StabilityVerdict::marginal;
    result.reason = "the largest multiplier lies on the unit circle within its error";
  } else if (distance < 0) {
    result.verdict = StabilityVerdict::stable;
    result.reason = "all non-trivial multipliers lie inside the unit circle";
  } else {
    result.verdict = StabilityVerdict::unstable;
    result.reason = "a multiplier lies outside the unit circle";
  }
  if (result.neutral > 0)
    result.reason += "; the slip memory of nodes that stay stuck is neutral (a family of solutions)";
  return result;
}

}  // namespace dovetail::stability
