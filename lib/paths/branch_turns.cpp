#include "paths/branch_turns.hpp"

namespace dovetail::paths {

void TurnCounter::observe(std::vector<ContinuationPoint>& points) {
  const std::size_t last = points.size() - 1;
  points[last].turns = turns_;
  const double gone = sign_ * (points[last].state.omega - points[extreme_].state.omega);
  if (gone >= 0) {
    extreme_ = last;
    return;
  }
  if (gone > -smallest_) return;
  ++turns_;
  sign_ = -sign_;
  points[extreme_].is_turn = true;
  for (std::size_t i = extreme_; i <= last; ++i) points[i].turns = turns_;
  extreme_ = last;
}

}  // namespace dovetail::paths
