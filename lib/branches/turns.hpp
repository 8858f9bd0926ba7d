#pragma once

#include <vector>

#include "branches/follow.hpp"

namespace dovetail::branches {

/// Counts the turns of the parameter along a branch that is being followed: a reversal counts once the parameter has
/// come back by `smallest` from its extreme, which then is marked.
class TurnCounter {
 public:
  TurnCounter(double smallest, double sign) : smallest_(smallest), sign_(sign) {}

  /// Takes the last point into account; corrects `turns` of those since the extreme.
  void observe(std::vector<BranchPoint>& points);

 private:
  double smallest_, sign_;
  std::size_t extreme_ = 0;
  int turns_ = 0;
};

}  // namespace dovetail::branches
