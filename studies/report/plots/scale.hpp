#pragma once

#include <limits>

#include "studies/report/plots/plot.hpp"
#include "studies/report/plots/ticks.hpp"

namespace dovetail::report {

/// The least and the largest of values; empty before the first.
struct Bounds {
  double lower = std::numeric_limits<double>::infinity(), upper = -std::numeric_limits<double>::infinity();
  void add(double value);
  [[nodiscard]] bool empty() const { return !(lower <= upper); }
};

/// The value has a place on the axis.
[[nodiscard]] bool drawable(double value, const PlotAxis& axis);

/// One axis: range, ticks and the map to pixels.
class Scale {
 public:
  /// About `count` ticks; `tight` keeps the range of a linear axis as it is.
  Scale(const PlotAxis& axis, Bounds range, int count, bool tight);

  void place(double from, double to) {
    from_ = from;
    to_ = to;
  }
  [[nodiscard]] double operator()(double value) const;
  [[nodiscard]] const Ticks& ticks() const { return ticks_; }

 private:
  void keep_whole_ticks();
  void end_at_ticks(const Bounds& range);

  bool logarithmic_;
  Ticks ticks_;
  double from_ = 0, to_ = 1;
};

}  // namespace dovetail::report
