#pragma once

namespace dovetail::optimizer {

/// What the computation of a candidate comes through, in this order.
enum class Stage {
  model,           ///< mesh, matrices, contact nodes, preload
  unworn,          ///< resonance of the unworn joint, and the stresses at it
  worn_state,      ///< where wear comes to rest
  worn_resonance,  ///< of the worn joint
};

}  // namespace dovetail::optimizer
