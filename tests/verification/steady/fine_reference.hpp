#pragma once

#include <memory>

#include "paths/steady_state.hpp"

namespace dovetail::verification {

/// The state `near` with many harmonics and samples, second-order slip and the local contact stiffness as
/// pseudo-penalty.
inline steady::State fine_reference(const std::shared_ptr<const dynamics::CondensedModel>& model,
                                    const steady::State& near, int harmonics, int samples) {
  const steady::Options options{.harmonics = harmonics,
                                .samples = samples,
                                .penalty_scale = 1 / near.penalty_ratio,
                                .slip_return = contact::SlipReturn::second_order,
                                .linearise = false};
  return paths::refined_state({model, {}, options}, near);
}

}  // namespace dovetail::verification
