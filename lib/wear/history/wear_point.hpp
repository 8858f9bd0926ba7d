#pragma once

#include <Eigen/Core>

namespace dovetail::wear {

/// A point (U, W) of a history and its rate.
struct WearPoint {
  Eigen::MatrixXd displacement;  ///< U [nc, 2H+1], m
  Eigen::VectorXd depth;         ///< W [Nc], m
  Eigen::VectorXd rate;          ///< r(U, W) [Nc], m per cycle
};

}  // namespace dovetail::wear
