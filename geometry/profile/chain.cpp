#include "geometry/profile/chain.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace dovetail::geometry {

using Eigen::Vector2d;

double Edge::length() const {
  return is_arc() ? radius * std::abs(sweep) : (end - start).norm();
}

Vector2d Edge::point(double fraction) const {
  if (fraction == 0) return start;
  if (fraction == 1) return end;
  if (!is_arc()) return start + fraction * (end - start);
  return center + Eigen::Rotation2D<double>(fraction * sweep) * (start - center);
}

Vector2d Edge::tangent(double fraction) const {
  if (!is_arc()) return (end - start).normalized();
  const Vector2d outward = Eigen::Rotation2D<double>(fraction * sweep) * (start - center) / radius;
  return std::copysign(1.0, sweep) * Vector2d(-outward.y(), outward.x());
}

const Edge& edge(const Chain& chain, const std::string& name) {
  const auto found = std::find_if(chain.begin(), chain.end(), [&](const Edge& e) { return e.name == name; });
  assert(found != chain.end());
  return *found;
}

Edge line(std::string name, const Vector2d& start, const Vector2d& end) {
  Edge straight;
  straight.name = std::move(name);
  straight.start = start;
  straight.end = end;
  return straight;
}

Edge arc(std::string name, const Vector2d& start, const Vector2d& end, const Vector2d& center, double sweep) {
  Edge curved = line(std::move(name), start, end);
  curved.center = center;
  curved.radius = (start - center).norm();
  curved.sweep = sweep;
  return curved;
}

Edge arc_through(std::string name, const Vector2d& start, const Vector2d& middle, const Vector2d& end) {
  const Vector2d first = middle - start;
  const Vector2d second = end - middle;
  // The chords of two neighbouring arcs of one circle enclose half the sum of their angles.
  const double half = std::atan2(first.x() * second.y() - first.y() * second.x(), first.dot(second));
  assert(half != 0);
  const Vector2d chord = end - start;
  const Vector2d left(-chord.y(), chord.x());
  return arc(std::move(name), start, end, (start + end) / 2 + left / (2 * std::tan(half)), 2 * half);
}

Edge reversed(const Edge& edge) {
  Edge back = edge;
  std::swap(back.start, back.end);
  back.sweep = -edge.sweep;
  return back;
}

Chain mirrored(const Chain& chain) {
  Chain image;
  image.reserve(chain.size());
  for (auto from = chain.rbegin(); from != chain.rend(); ++from) {
    Edge back = reversed(*from);
    for (Vector2d* at : {&back.start, &back.end, &back.center}) at->x() = -at->x();
    back.sweep = -back.sweep;
    image.push_back(std::move(back));
  }
  return image;
}

void ChainBuilder::line_to(std::string name, const Vector2d& end) {
  chain_.push_back(line(std::move(name), at_, end));
  at_ = end;
}

void ChainBuilder::arc_to(std::string name, const Vector2d& end, const Vector2d& center, double sweep) {
  chain_.push_back(arc(std::move(name), at_, end, center, sweep));
  at_ = end;
}

}  // namespace dovetail::geometry
