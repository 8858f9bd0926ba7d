#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>

#include "fem/material.hpp"
#include "fem/mesh.hpp"

namespace dovetail::fem {

/// Six-node isoparametric triangle, plane strain or plane stress. Node order: corners 0,1,2
/// counter-clockwise, mid-sides of 01, 12, 20. Element dofs are interleaved: (u_x, u_y) of each node.
///
/// One quadrature for everything: the six-point rule of degree 4 [Dunavant 1985], positive weights,
/// interior points. Exact for stiffness and mass of straight-sided elements (integrands of degree 2 and
/// 4); on curved elements exact for area, first moments and the linear patch test, and of higher order than the
/// interpolation for the rest.
inline constexpr int kQuadraturePoints = 6;

using ElementNodes = Eigen::Matrix<double, 2, 6>;  ///< positions, m
using ElementMatrix = Eigen::Matrix<double, 12, 12>;
using ElementGradients = Eigen::Matrix<double, 6, 2>;  ///< d N_a / d(x, y), 1/m

struct QuadraturePoint {
  double xi, eta;  ///< local coordinates; node 0 at (0,0), node 1 at (1,0), node 2 at (0,1)
  double weight;   ///< all weights sum to 1/2
};
[[nodiscard]] const std::array<QuadraturePoint, kQuadraturePoints>& quadrature();

/// Positions of an element's nodes.
[[nodiscard]] ElementNodes element_nodes(const Mesh& mesh, std::size_t element);

/// Local coordinates of the six nodes.
[[nodiscard]] Eigen::Vector2d node_coordinates(int node);

[[nodiscard]] Eigen::Matrix<double, 6, 1> shape_functions(double xi, double eta);
[[nodiscard]] ElementGradients local_gradients(double xi, double eta);

/// Gradients in the plane and determinant of the Jacobian (m^2) at a local point.
struct PlaneGradients {
  ElementGradients gradients;
  double determinant;
};
[[nodiscard]] PlaneGradients plane_gradients(const ElementNodes& nodes, double xi, double eta);

/// sigma = D eps for (xx, yy, xy) with engineering shear strain, Pa.
[[nodiscard]] Eigen::Matrix3d elasticity(const Material& material, bool plane_stress);

/// Stiffness (N/m) and consistent mass (kg) of one element. Returns the smallest Jacobian determinant over the
/// quadrature points; when it is not positive the element is inverted and the matrices are meaningless.
double stiffness_and_mass(const ElementNodes& nodes, const Eigen::Matrix3d& elasticity, double density,
                          double thickness, ElementMatrix& stiffness, ElementMatrix& mass);

/// K_g = integral of grad N_a . sigma . grad N_b, times the identity of the two components (N/m).
/// `stress` [3, 6]: (xx, yy, xy) at the quadrature points, Pa.
void geometric_stiffness(const ElementNodes& nodes, const Eigen::Ref<const Eigen::Matrix<double, 3, 6>>& stress,
                         double thickness, ElementMatrix& stiffness);

}  // namespace dovetail::fem
