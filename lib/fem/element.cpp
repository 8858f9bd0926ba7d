#include "fem/element.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <limits>

namespace dovetail::fem {

namespace {

// Values at the quadrature points never change: tabulated once.
struct Table {
  std::array<Eigen::Matrix<double, 6, 1>, kQuadraturePoints> shape;
  std::array<ElementGradients, kQuadraturePoints> gradients;

  Table() {
    for (std::size_t q = 0; q < kQuadraturePoints; ++q) {
      const QuadraturePoint& point = quadrature()[q];
      shape[q] = shape_functions(point.xi, point.eta);
      gradients[q] = local_gradients(point.xi, point.eta);
    }
  }
};

const Table& table() {
  static const Table values;
  return values;
}

PlaneGradients to_plane(const ElementNodes& nodes, const ElementGradients& local) {
  const Eigen::Matrix2d jacobian = nodes * local;  // d(x, y) / d(xi, eta)
  PlaneGradients result;
  result.determinant = jacobian.determinant();
  result.gradients.noalias() = local * jacobian.inverse();
  return result;
}

}  // namespace

const std::array<QuadraturePoint, kQuadraturePoints>& quadrature() {
  // Dunavant 1985, degree 4.
  constexpr double a = 0.445948490915964886, b = 0.108103018168070227, wa = 0.223381589678011466 / 2;
  constexpr double c = 0.091576213509770743, d = 0.816847572980458513, wc = 0.109951743655321868 / 2;
  static const std::array<QuadraturePoint, kQuadraturePoints> points{
      {{a, a, wa}, {a, b, wa}, {b, a, wa}, {c, c, wc}, {c, d, wc}, {d, c, wc}}};
  return points;
}

ElementNodes element_nodes(const Mesh& mesh, std::size_t element) {
  ElementNodes nodes;
  for (std::size_t a = 0; a < 6; ++a)
    nodes.col(static_cast<Eigen::Index>(a)) = mesh.nodes.col(mesh.elements[element][a]);
  return nodes;
}

Eigen::Vector2d node_coordinates(int node) {
  static const std::array<std::array<double, 2>, 6> points{{{0, 0}, {1, 0}, {0, 1}, {0.5, 0}, {0.5, 0.5}, {0, 0.5}}};
  const std::array<double, 2>& p = points[static_cast<std::size_t>(node)];
  return {p[0], p[1]};
}

Eigen::Matrix<double, 6, 1> shape_functions(double xi, double eta) {
  const double l0 = 1 - xi - eta;
  Eigen::Matrix<double, 6, 1> n;
  n << l0 * (2 * l0 - 1), xi * (2 * xi - 1), eta * (2 * eta - 1), 4 * l0 * xi, 4 * xi * eta, 4 * eta * l0;
  return n;
}

ElementGradients local_gradients(double xi, double eta) {
  const double l0 = 1 - xi - eta;
  ElementGradients g;
  g << 1 - 4 * l0, 1 - 4 * l0,  //
      4 * xi - 1, 0,            //
      0, 4 * eta - 1,           //
      4 * (l0 - xi), -4 * xi,   //
      4 * eta, 4 * xi,          //
      -4 * eta, 4 * (l0 - eta);
  return g;
}

PlaneGradients plane_gradients(const ElementNodes& nodes, double xi, double eta) {
  return to_plane(nodes, local_gradients(xi, eta));
}

Eigen::Matrix3d elasticity(const Material& material, bool plane_stress) {
  const double e = material.youngs_modulus, nu = material.poisson_ratio;
  const double shear = e / (2 * (1 + nu));
  const double normal = plane_stress ? e / (1 - nu * nu) : e * (1 - nu) / ((1 + nu) * (1 - 2 * nu));
  const double cross = plane_stress ? nu * normal : normal - 2 * shear;
  Eigen::Matrix3d d;
  d << normal, cross, 0, cross, normal, 0, 0, 0, shear;
  return d;
}

double stiffness_and_mass(const ElementNodes& nodes, const Eigen::Matrix3d& elasticity, double density,
                          double thickness, ElementMatrix& stiffness, ElementMatrix& mass) {
  stiffness.setZero();
  Eigen::Matrix<double, 6, 6> scalar_mass = Eigen::Matrix<double, 6, 6>::Zero();
  double smallest = std::numeric_limits<double>::infinity();
  Eigen::Matrix<double, 3, 12> strain = Eigen::Matrix<double, 3, 12>::Zero();  // B of eps = B u
  for (std::size_t q = 0; q < kQuadraturePoints; ++q) {
    const PlaneGradients plane = to_plane(nodes, table().gradients[q]);
    smallest = std::min(smallest, plane.determinant);
    const double volume = quadrature()[q].weight * plane.determinant * thickness;
    for (int a = 0; a < 6; ++a) {
      strain(0, 2 * a) = plane.gradients(a, 0);
      strain(1, 2 * a + 1) = plane.gradients(a, 1);
      strain(2, 2 * a) = plane.gradients(a, 1);
      strain(2, 2 * a + 1) = plane.gradients(a, 0);
    }
    const Eigen::Matrix<double, 3, 12> weighted = (volume * elasticity) * strain;
    stiffness.noalias() += strain.transpose().lazyProduct(weighted);
    scalar_mass.noalias() += (density * volume * table().shape[q]) * table().shape[q].transpose();
  }
  // Rounding breaks symmetry in the last digit; eigensolvers and tests want it exact.
  stiffness.triangularView<Eigen::StrictlyUpper>() = stiffness.transpose();
  scalar_mass.triangularView<Eigen::StrictlyUpper>() = scalar_mass.transpose();
  mass.setZero();
  for (int a = 0; a < 6; ++a)
    for (int b = 0; b < 6; ++b) mass(2 * a, 2 * b) = mass(2 * a + 1, 2 * b + 1) = scalar_mass(a, b);
  return smallest;
}

void geometric_stiffness(const ElementNodes& nodes, const Eigen::Ref<const Eigen::Matrix<double, 3, 6>>& stress,
                         double thickness, ElementMatrix& stiffness) {
  Eigen::Matrix<double, 6, 6> scalar = Eigen::Matrix<double, 6, 6>::Zero();
  for (std::size_t q = 0; q < kQuadraturePoints; ++q) {
    const PlaneGradients plane = to_plane(nodes, table().gradients[q]);
    const double volume = quadrature()[q].weight * plane.determinant * thickness;
    const Eigen::Vector3d s = volume * stress.col(static_cast<Eigen::Index>(q));
    Eigen::Matrix2d sigma;
    sigma << s[0], s[2], s[2], s[1];
    const ElementGradients traction = plane.gradients * sigma;
    scalar.noalias() += traction * plane.gradients.transpose();
  }
  scalar.triangularView<Eigen::StrictlyUpper>() = scalar.transpose();
  stiffness.setZero();
  for (int a = 0; a < 6; ++a)
    for (int b = 0; b < 6; ++b) stiffness(2 * a, 2 * b) = stiffness(2 * a + 1, 2 * b + 1) = scalar(a, b);
}

}  // namespace dovetail::fem
