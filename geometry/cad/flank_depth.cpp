#include "geometry/cad/flank_depth.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace dovetail::geometry {
namespace {

/// Knots closer than this are one: picometres on a flank.
constexpr double kSamePlace = 1e-9;

std::vector<double> knots(std::vector<double> places) {
  std::sort(places.begin(), places.end());
  std::vector<double> result{0};
  for (const double place : places)
    if (place - result.back() > kSamePlace && 1 - place > kSamePlace) result.push_back(place);
  result.push_back(1);
  return result;
}

/// Slopes of cubics that are as monotone as the values: the harmonic mean of the neighbouring secants where these have
/// one sign, 0 where they do not and at both ends.
std::vector<double> monotone_slopes(const std::vector<double>& x, const std::vector<double>& y) {
  std::vector<double> slopes(x.size(), 0.0);
  for (std::size_t i = 1; i + 1 < x.size(); ++i) {
    const double before = x[i] - x[i - 1], after = x[i + 1] - x[i];
    const double first = (y[i] - y[i - 1]) / before, second = (y[i + 1] - y[i]) / after;
    if (first * second > 0)
      slopes[i] = 3 * (before + after) / ((2 * after + before) / first + (after + 2 * before) / second);
  }
  return slopes;
}

}  // namespace

FlankDepth::FlankDepth(const SolidFlankForm& form, WornFlank worn) : form_(form), worn_(std::move(worn)) {
  std::vector<double> across(form.across().pieces().begin(), form.across().pieces().end());
  std::vector<double> along;
  for (const WornLine& line : worn_) {
    assert(line.places.size() == line.depth.size() && !line.places.empty());
    slopes_.push_back(monotone_slopes(line.places, line.depth));
    across.insert(across.end(), line.places.begin(), line.places.end());
    if (worn_.size() > 1) along.push_back(line.along);
  }
  if (form.along().gap(0) != form.along().gap(0.5) || form.along().gap(1) != form.along().gap(0.5))
    along.insert(along.end(), form.along().pieces().begin(), form.along().pieces().end());
  across_ = knots(std::move(across));
  along_ = knots(std::move(along));
  // A form along the slot may be one parabola: with a knot in the middle it does not pass for none.
  if (along_.size() == 2 && form.along().gap(0) != form.along().gap(0.5)) along_ = {0, 0.5, 1};
}

FlankDepth::Value FlankDepth::on_line(const WornLine& line, const std::vector<double>& slopes, double s) {
  const auto after = std::upper_bound(line.places.begin(), line.places.end(), s);
  if (after == line.places.begin()) return {.depth = line.depth.front()};
  if (after == line.places.end()) return {.depth = line.depth.back()};
  const auto k = static_cast<std::size_t>(after - line.places.begin()) - 1;
  const double h = line.places[k + 1] - line.places[k], t = (s - line.places[k]) / h;
  const double from = line.depth[k], rise = line.depth[k + 1] - from;
  const double first = h * slopes[k], last = h * slopes[k + 1];
  const double square = 3 * rise - 2 * first - last, cube = first + last - 2 * rise;
  return {.depth = from + t * (first + t * (square + t * cube)), .by_s = (first + t * (2 * square + 3 * t * cube)) / h};
}

FlankDepth::Value FlankDepth::at(double s, double u) const {
  Value value{.depth = form_.gap(s, u), .by_s = form_.across().slope(s), .by_u = form_.along().slope(u)};
  if (worn_.empty()) return value;
  const auto after = std::upper_bound(worn_.begin(), worn_.end(), u,
                                      [](double place, const WornLine& line) { return place < line.along; });
  const auto next =
      static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(after - worn_.begin(), 0, std::ssize(worn_) - 1));
  const std::size_t last = after == worn_.end() || next == 0 ? next : next - 1;
  const Value here = on_line(worn_[last], slopes_[last], s);
  value.depth += here.depth;
  value.by_s += here.by_s;
  if (next == last) return value;
  const Value there = on_line(worn_[next], slopes_[next], s);
  const double h = worn_[next].along - worn_[last].along, t = (u - worn_[last].along) / h;
  const double weight = t * t * (3 - 2 * t), rate = 6 * t * (1 - t) / h;
  value.depth += weight * (there.depth - here.depth);
  value.by_s += weight * (there.by_s - here.by_s);
  value.by_u += rate * (there.depth - here.depth);
  value.by_su += rate * (there.by_s - here.by_s);
  return value;
}

}  // namespace dovetail::geometry
