#include "quality/error_bars.hpp"

#include <array>

#include "quality/truncation.hpp"

namespace dovetail {
template <>
std::span<const Field<quality::ErrorBarOptions>> option_table<quality::ErrorBarOptions>() {
  using O = quality::ErrorBarOptions;
  static const std::vector<Field<O>> fields{
      {.key = "safety", .member = &O::safety, .range = kPositive},
  };
  return fields;
}
}  // namespace dovetail

namespace dovetail::quality {
namespace {

void check(const ErrorBarOptions& options) {
  std::vector<Violation> found = violations(options);
  if (!found.empty()) throw InputError(std::move(found));
}

ErrorBars unknown(const dynamics::CondensedModel& model, const steady::State& state) {
  const Quantities infinite = constant_quantities(static_cast<Eigen::Index>(model.output_names().size()), kInfinity);
  return {.status = state.status,
          .value = quantities(model, state),
          .harmonics = infinite,
          .samples = infinite,
          .penalty = infinite,
          .total = infinite};
}

}  // namespace

ErrorBars error_bars(const steady::Joint& joint, const steady::State& state, const ErrorBarOptions& bar_options) {
  steady::validate(joint.options);
  check(bar_options);
  if (state.status != Status::converged) return unknown(*joint.model, state);
  return bars_from(joint, state, refine(joint, state), bar_options);
}

}  // namespace dovetail::quality
