#include "response/error_bars.hpp"

#include <array>

#include "response/truncation.hpp"

namespace dovetail {
template <>
std::span<const Field<response::ErrorBarOptions>> option_table<response::ErrorBarOptions>() {
  using Options = response::ErrorBarOptions;
  static const std::array fields{Field<Options>{
      .key = "safety", .member = &Options::safety, .range = kPositive, .help = "factor on all error bars"}};
  return fields;
}
}  // namespace dovetail

namespace dovetail::response {
namespace {

void check(const ErrorBarOptions& options) {
  std::vector<Violation> found = violations(options);
  if (!found.empty()) throw InputError(std::move(found));
}

ErrorBars unknown(const CondensedModel& model, const SteadyState& state) {
  const Quantities infinite = constant_quantities(static_cast<Eigen::Index>(model.output_names().size()), kInfinity);
  return {.status = state.status,
          .value = quantities(model, state),
          .harmonics = infinite,
          .samples = infinite,
          .penalty = infinite,
          .total = infinite};
}

}  // namespace

ErrorBars error_bars(const std::shared_ptr<const CondensedModel>& model, const SteadyState& state,
                     const ContactCondition& condition, const SteadyOptions& options,
                     const ErrorBarOptions& bar_options) {
  validate(options);
  check(bar_options);
  if (state.status != Status::converged) return unknown(*model, state);
  return bars_from(*model, state, refine(model, state, condition, options), options, bar_options);
}

}  // namespace dovetail::response
