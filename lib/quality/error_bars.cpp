#include "quality/error_bars.hpp"

#include "quality/truncation.hpp"

namespace dovetail::quality {
namespace {

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

ErrorBars error_bars(const steady::Joint& joint, const steady::State& state) {
  steady::validate(joint.options);
  if (state.status != Status::converged) return unknown(*joint.model, state);
  return bars_from(joint, state, refine(joint, state));
}

}  // namespace dovetail::quality
