#pragma once

#include <memory>

#include "response/steady_state.hpp"

namespace dovetail::response {

/// Coefficients [rows, 2H+1] cut or filled with zeros to [rows, 2 harmonics + 1].
[[nodiscard]] Eigen::MatrixXd padded(const Eigen::MatrixXd& coefficients, int harmonics);

/// The steady state at the frequency of `state` with other harmonics, samples or pseudo-penalty than those it was
/// computed with, started from it. `finer` are the options of the new state; its pseudo-penalty is multiplied by the
/// ratio the cascade left `state` at, no other is tried and there is no rescue: an answer with another eps would not
/// measure what was asked. `reuse`: see steady_state. Without `linearise` the regularity of the Jacobian is trusted,
/// since that of `state` was shown. `penalty_ratio` of the result is relative to `finer`, as that of `state` is to its
/// options.
[[nodiscard]] SteadyState refined_state(const std::shared_ptr<const CondensedModel>& model, const SteadyState& state,
                                        const ContactCondition& condition, SteadyOptions finer,
                                        const std::shared_ptr<const Linearisation>& reuse = {});

}  // namespace dovetail::response
