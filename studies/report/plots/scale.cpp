#include "studies/report/plots/scale.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "studies/report/words/units.hpp"

namespace dovetail::report {

void Bounds::add(double value) {
  lower = std::min(lower, value);
  upper = std::max(upper, value);
}

bool drawable(double value, const PlotAxis& axis) {
  return std::isfinite(value) && (!axis.logarithmic || value > 0);
}

Scale::Scale(const PlotAxis& axis, Bounds range, int count, bool tight) : logarithmic_(axis.logarithmic) {
  if (axis.from_zero && !logarithmic_) range.add(0);
  ticks_ =
      logarithmic_ ? logarithmic_ticks(range.lower, range.upper) : linear_ticks(range.lower, range.upper, count, tight);
  if (axis.whole && !logarithmic_) keep_whole_ticks();
  if (axis.tight && logarithmic_) end_at_ticks(range);
}

double Scale::operator()(double value) const {
  const auto position = [&](double v) { return logarithmic_ ? std::log10(v) : v; };
  return from_ +
         (to_ - from_) * (position(value) - position(ticks_.lower)) / (position(ticks_.upper) - position(ticks_.lower));
}

void Scale::keep_whole_ticks() {
  Ticks kept{.lower = ticks_.lower, .upper = ticks_.upper, .at = {}, .labels = {}};
  for (const double at : ticks_.at) {
    if (std::abs(at - std::round(at)) > 1e-9) continue;
    kept.at.push_back(at);
    kept.labels.push_back(plain(at, 12));
  }
  ticks_ = std::move(kept);
}

void Scale::end_at_ticks(const Bounds& range) {
  std::size_t first = 0, last = ticks_.at.size();
  while (first + 2 < last && ticks_.at[first + 1] <= range.lower) ++first;
  while (first + 2 < last && ticks_.at[last - 2] >= range.upper) --last;
  if (last == 0) return;
  const auto keep = [&](auto& list) {
    list = {list.begin() + static_cast<std::ptrdiff_t>(first), list.begin() + static_cast<std::ptrdiff_t>(last)};
  };
  keep(ticks_.at);
  keep(ticks_.labels);
  ticks_.lower = ticks_.at.front();
  ticks_.upper = ticks_.at.back();
}

}  // namespace dovetail::report
