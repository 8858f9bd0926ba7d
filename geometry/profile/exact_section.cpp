#include "geometry/profile/exact_section.hpp"

#include <CGAL/Arr_circle_segment_traits_2.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/General_polygon_set_2.h>
#include <CGAL/Gps_circle_segment_traits_2.h>
#include <CGAL/Surface_sweep_2_algorithms.h>

#include <cmath>
#include <iterator>
#include <list>
#include <vector>

#include "geometry/profile/chain.hpp"
#include "geometry/profile/measures.hpp"

namespace dovetail::geometry {

namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Traits = CGAL::Gps_circle_segment_traits_2<Kernel>;
using Curve = Traits::Curve_2;
using MonotoneCurve = Traits::X_monotone_curve_2;
using Polygon = Traits::General_polygon_2;
using PolygonSet = CGAL::General_polygon_set_2<Traits>;
using Eigen::Vector2d;
constexpr double kGrid = ExactParams{}.snap;

/// Whole picometres: a double holds them exactly up to 9 km.
Kernel::Point_2 snapped(const Vector2d& at) {
  return {std::nearbyint(at.x() / kGrid), std::nearbyint(at.y() / kGrid)};
}

std::vector<Curve> exact_curves(const Chain& chain) {
  std::vector<Curve> curves;
  curves.reserve(chain.size());
  for (const Edge& e : chain) {
    const Kernel::Point_2 start = snapped(e.start);
    const Kernel::Point_2 end = snapped(e.end);
    if (start == end) continue;
    const Kernel::Point_2 middle = snapped(e.point(0.5));
    if (e.is_arc() && !CGAL::collinear(start, middle, end))
      curves.emplace_back(start, middle, end);
    else
      curves.emplace_back(Kernel::Segment_2(start, end));
  }
  return curves;
}

Polygon exact_polygon(const Chain& chain) {
  const Traits traits;
  std::list<CGAL::Object> parts;
  for (const Curve& curve : exact_curves(chain)) traits.make_x_monotone_2_object()(curve, std::back_inserter(parts));
  Polygon polygon;
  for (const CGAL::Object& part : parts) {
    MonotoneCurve curve;
    if (CGAL::assign(curve, part)) polygon.push_back(curve);
  }
  return polygon;
}

Vector2d rounded(const MonotoneCurve::Point_2& at) {
  return kGrid * Vector2d(CGAL::to_double(at.x()), CGAL::to_double(at.y()));
}

/// Back to doubles, for measuring only.
double rounded_area(const Polygon& polygon) {
  Chain chain;
  for (auto curve = polygon.curves_begin(); curve != polygon.curves_end(); ++curve) {
    const Vector2d start = rounded(curve->source());
    const Vector2d end = rounded(curve->target());
    if (!curve->is_circular()) {
      chain.push_back(line({}, start, end));
      continue;
    }
    const auto& circle = curve->supporting_circle();
    const Vector2d center =
        kGrid * Vector2d(CGAL::to_double(circle.center().x()), CGAL::to_double(circle.center().y()));
    const Vector2d from = start - center;
    const Vector2d to = end - center;
    // An x-monotone arc turns by at most pi; atan2 may give its angle the wrong sign there.
    const double turn = std::atan2(from.x() * to.y() - from.y() * to.x(), from.dot(to));
    chain.push_back(
        arc({}, start, end, center, curve->orientation() == CGAL::COUNTERCLOCKWISE ? std::abs(turn) : -std::abs(turn)));
  }
  return chain.empty() ? 0 : area(chain);
}

}  // namespace

bool is_simple(const Chain& chain) {
  const std::vector<Curve> curves = exact_curves(chain);
  return !CGAL::do_curves_intersect(curves.begin(), curves.end());
}

double overlap_area(const Chain& first, const Chain& second) {
  PolygonSet common(exact_polygon(first));
  common.intersection(exact_polygon(second));
  std::vector<Traits::General_polygon_with_holes_2> parts;
  common.polygons_with_holes(std::back_inserter(parts));
  double sum = 0;
  for (const auto& part : parts) {
    if (!part.is_unbounded()) sum += std::abs(rounded_area(part.outer_boundary()));
    for (auto hole = part.holes_begin(); hole != part.holes_end(); ++hole) sum -= std::abs(rounded_area(*hole));
  }
  return sum;
}

}  // namespace dovetail::geometry
