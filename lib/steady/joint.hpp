#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "dynamics/condensed_model.hpp"
#include "steady/options.hpp"

namespace dovetail::steady {

/// What the contact is like, besides the model: empty members mean no wear, nothing released, the model's origin.
struct Condition {
  Eigen::VectorXd wear_depth = {};   ///< W [Nc], m, both surfaces together; or empty
  std::vector<char> released = {};   ///< [Nc] nonzero: the node carries no contact force; or empty
  Eigen::MatrixXd slip_origin = {};  ///< X_T at which the march starts [Nc, d-1], m; or empty
};

/// A joint of which steady states are asked: its model, what its contact has behind it, and how it is solved.
struct Joint {
  std::shared_ptr<const dynamics::CondensedModel> model;
  Condition condition = {};
  Options options = {};

  /// The same joint worn to depths W [Nc], m.
  [[nodiscard]] Joint worn(const Eigen::VectorXd& depth) const {
    Joint joint = *this;
    joint.condition.wear_depth = depth;
    return joint;
  }
  /// The same joint solved otherwise.
  [[nodiscard]] Joint with(Options other) const {
    return {.model = model, .condition = condition, .options = std::move(other)};
  }
};

}  // namespace dovetail::steady
