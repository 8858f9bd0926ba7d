#include "geometry/cad/spline_net.hpp"

#include <cmath>
#include <utility>

namespace dovetail::geometry {
namespace {

/// A pole lies at a knot, or a third of the way to a neighbouring knot along the slope there.
struct PolePlace {
  double knot, step;
};

std::vector<PolePlace> pole_places(const std::vector<double>& knots) {
  std::vector<PolePlace> places;
  for (std::size_t i = 0; i < knots.size(); ++i) {
    places.push_back({knots[i], i == 0 ? 0 : (knots[i - 1] - knots[i]) / 3});
    places.push_back({knots[i], i + 1 == knots.size() ? 0 : (knots[i + 1] - knots[i]) / 3});
  }
  return places;
}

}  // namespace

SplineNet spline_net(std::vector<double> a, std::vector<double> b,
                     const std::function<SurfaceJet(double a, double b)>& surface) {
  SplineNet net{.a = std::move(a), .b = std::move(b), .poles = {}};
  const std::vector<PolePlace> columns = pole_places(net.b);
  for (const PolePlace& row : pole_places(net.a)) {
    std::vector<Eigen::Vector3d>& poles = net.poles.emplace_back();
    for (const PolePlace& column : columns) {
      const SurfaceJet jet = surface(row.knot, column.knot);
      poles.emplace_back(jet.at + row.step * jet.by_a + column.step * (jet.by_b + row.step * jet.by_ab));
    }
  }
  return net;
}

std::vector<double> equal_knots(double from, double to, int parts) {
  std::vector<double> knots;
  for (int i = 0; i <= parts; ++i) knots.push_back(i == parts ? to : from + (to - from) * i / parts);
  return knots;
}

int parts_of_turn(double angle) {
  // A cubic through values and slopes errs by h^4/384 of the fourth derivative, of which a circle has its radius.
  const double part = std::pow(384 * 1e-9, 0.25);
  return std::max(1, static_cast<int>(std::ceil(std::abs(angle) / part)));
}

}  // namespace dovetail::geometry
