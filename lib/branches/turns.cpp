#include "branches/turns.hpp"

namespace dovetail::branches {

void TurnCounter::observe(std::vector<BranchPoint>& points) {
  const std::size_t last = points.size() - 1;
  points[last].turns = turns_;
  const double gone = sign_ * (points[last].parameter - points[extreme_].parameter);
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

}  // namespace dovetail::branches
