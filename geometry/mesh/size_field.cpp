#include "geometry/mesh/size_field.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/mesh/params.hpp"

namespace dovetail::geometry {
namespace {

constexpr SizeParams kSize = {};

struct Segment {
  Eigen::Vector2d start, end;
  const Edge* part_of;
};

std::vector<Segment> polyline(const Chain& chain) {
  std::vector<Segment> segments;
  for (const Edge& e : chain) {
    const int parts = e.is_arc() ? kSize.arc_parts : 1;
    for (int i = 0; i < parts; ++i)
      segments.push_back({e.point(static_cast<double>(i) / parts), e.point(static_cast<double>(i + 1) / parts), &e});
  }
  return segments;
}

/// Distance along the unit direction d from x on `from` to the first crossing with another edge; infinite without one.
double wall_behind(const Eigen::Vector2d& x, const Eigen::Vector2d& d, const Edge& from,
                   const std::vector<Segment>& boundary) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Segment& s : boundary) {
    if (s.part_of == &from) continue;
    const Eigen::Vector2d along = s.end - s.start;
    const Eigen::Vector2d to_start = s.start - x;
    const double determinant = along.x() * d.y() - along.y() * d.x();
    if (std::abs(determinant) <= kSize.parallel * along.norm()) continue;
    const double distance = (along.x() * to_start.y() - along.y() * to_start.x()) / determinant;
    const double position = (d.x() * to_start.y() - d.y() * to_start.x()) / determinant;
    if (distance > 0 && position >= 0 && position <= 1) nearest = std::min(nearest, distance);
  }
  return nearest;
}

double wanted_on(const Edge& e, const MeshSizes& sizes) {
  if (!e.is_arc()) return sizes.bulk_size;
  const auto named = [&e](const char* part) { return e.name.find(part) != std::string::npos; };
  if (named("blend")) return sizes.blend_fraction * e.radius;
  return (named("fillet") ? 1 : kSize.other_arcs) * sizes.fillet_fraction * e.radius;
}

}  // namespace

void SizeField::add_source(const Eigen::Vector2d& x, double h) {
  if (h < bulk_) sources_.push_back({x.x(), x.y(), h});
}

double SizeField::operator()(const Eigen::Vector2d& x) const {
  double size = bulk_;
  for (const Source& s : sources_) {
    const double room = size - s.size;
    if (room <= 0) continue;
    const double dx = x.x() - s.x, dy = x.y() - s.y;
    const double squared = growth_ * growth_ * (dx * dx + dy * dy);
    if (squared < room * room) size = s.size + std::sqrt(squared);
  }
  return size;
}

SizeField element_sizes(const Chain& chain, const MeshSizes& sizes, const std::vector<double>& flank) {
  SizeField field(sizes.bulk_size, sizes.growth);
  const std::vector<Segment> boundary = polyline(chain);
  for (const Edge& e : chain) {
    const bool bearing = e.name.starts_with("flank");
    const double wanted = bearing ? e.length() / static_cast<double>(flank.size() - 1) : wanted_on(e, sizes);
    const int samples = std::max(2, static_cast<int>(std::ceil(e.length() / std::min(wanted, sizes.bulk_size / 2))));
    if (bearing)
      for (std::size_t k = 1; k < flank.size(); ++k)
        field.add_source(e.point((flank[k - 1] + flank[k]) / 2), (flank[k] - flank[k - 1]) * e.length());
    else
      for (int i = 0; i <= samples; ++i) field.add_source(e.point(static_cast<double>(i) / samples), wanted);
    for (int i = 0; i < samples; ++i) {
      const double fraction = (i + 0.5) / samples;
      const Eigen::Vector2d t = e.tangent(fraction);
      const Eigen::Vector2d x = e.point(fraction);
      field.add_source(x, kSize.wall * wall_behind(x, {-t.y(), t.x()}, e, boundary));
    }
  }
  return field;
}

}  // namespace dovetail::geometry
