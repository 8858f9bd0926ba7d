#include "fem/elements/triangle6.hpp"

namespace dovetail::fem {

const std::array<QuadraturePoint<2>, Triangle6::kPoints>& Triangle6::quadrature() {
  // Dunavant 1985, degree 4.
  constexpr double a = 0.445948490915964886, b = 0.108103018168070227, wa = 0.223381589678011466 / 2;
  constexpr double c = 0.091576213509770743, d = 0.816847572980458513, wc = 0.109951743655321868 / 2;
  static const std::array<QuadraturePoint<2>, kPoints> points{
      {{{a, a}, wa}, {{a, b}, wa}, {{b, a}, wa}, {{c, c}, wc}, {{c, d}, wc}, {{d, c}, wc}}};
  return points;
}

Triangle6::Point Triangle6::node(int index) {
  static const std::array<std::array<double, 2>, 6> points{{{0, 0}, {1, 0}, {0, 1}, {0.5, 0}, {0.5, 0.5}, {0, 0.5}}};
  const std::array<double, 2>& p = points[static_cast<std::size_t>(index)];
  return {p[0], p[1]};
}

Triangle6::Shape Triangle6::shape(const Point& local) {
  const double xi = local[0], eta = local[1], l0 = 1 - xi - eta;
  Shape n;
  n << l0 * (2 * l0 - 1), xi * (2 * xi - 1), eta * (2 * eta - 1), 4 * l0 * xi, 4 * xi * eta, 4 * eta * l0;
  return n;
}

Triangle6::Gradients Triangle6::gradients(const Point& local) {
  const double xi = local[0], eta = local[1], l0 = 1 - xi - eta;
  Gradients g;
  g << 1 - 4 * l0, 1 - 4 * l0,  //
      4 * xi - 1, 0,            //
      0, 4 * eta - 1,           //
      4 * (l0 - xi), -4 * xi,   //
      4 * eta, 4 * xi,          //
      -4 * eta, 4 * (l0 - eta);
  return g;
}

const std::array<std::array<int, 3>, 4>& Triangle6::simplices() {
  static const std::array<std::array<int, 3>, 4> list{{{0, 3, 5}, {3, 1, 4}, {5, 4, 2}, {3, 4, 5}}};
  return list;
}

const std::array<std::array<int, 3>, 3>& Triangle6::sides() {
  static const std::array<std::array<int, 3>, 3> list{{{0, 3, 1}, {1, 4, 2}, {2, 5, 0}}};
  return list;
}

}  // namespace dovetail::fem
