#pragma once

#include <memory>

#include "response/refined_state.hpp"

namespace dovetail::verification {

/// The state `near` with many harmonics and samples, second-order slip and the local contact stiffness as
/// pseudo-penalty.
inline response::SteadyState fine_reference(const std::shared_ptr<const response::CondensedModel>& model,
                                            const response::SteadyState& near, int harmonics, int samples) {
  const response::SteadyOptions options{.harmonics = harmonics,
                                        .samples = samples,
                                        .penalty_scale = 1 / near.penalty_ratio,
                                        .slip_return = "second_order",
                                        .linearise = false};
  return refined_state(model, near, {}, options);
}

}  // namespace dovetail::verification
