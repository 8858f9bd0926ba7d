#pragma once

namespace dovetail::paths {

struct Reach {
  bool there = false;    ///< the end was reached
  int intermediate = 0;  ///< places reached before it
};

/// From a solution at `from` to one at `end`. `go(target)` tries a place from the last one reached and says whether it
/// got there; where it fails the way is halved, at most `halvings` times in all, and where it succeeds the rest is
/// tried at once.
template <class Go>
Reach reach(double from, double end, int halvings, const Go& go) {
  Reach reached;
  for (double target = end;;) {
    if (go(target)) {
      reached.there = target == end;
      if (reached.there) return reached;
      ++reached.intermediate;
      from = target;
      target = end;
    } else if (halvings-- > 0) {
      target = (target + from) / 2;
    } else {
      return reached;
    }
  }
}

}  // namespace dovetail::paths
