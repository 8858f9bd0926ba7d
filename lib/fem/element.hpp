#pragma once

#include <Eigen/Core>
#include <utility>

#include "fem/elements/triangle6.hpp"
#include "fem/elements/wedge18.hpp"
#include "fem/material.hpp"
#include "fem/mesh.hpp"

/// @file
/// Kernels over one element, templates over its kind (Triangle6, Wedge18). Dofs are interleaved: all of node 0, of node
/// 1, ... Stresses are (xx, yy, xy) in the plane, (xx, yy, zz, xy, yz, zx) in space, with engineering shear strains.
namespace dovetail::fem {

/// Calls visit(Triangle6{}) or visit(Wedge18{}): the one place where the kind of a mesh is looked at.
template <class Visitor>
decltype(auto) with_element(ElementKind kind, Visitor&& visit) {
  if (kind == ElementKind::triangle6) return std::forward<Visitor>(visit)(Triangle6{});
  return std::forward<Visitor>(visit)(Wedge18{});
}

/// Number of stress components and of quadrature points of a kind.
[[nodiscard]] constexpr int stress_components(ElementKind kind) {
  return kind == ElementKind::triangle6 ? Triangle6::kStresses : Wedge18::kStresses;
}
[[nodiscard]] constexpr int quadrature_points(ElementKind kind) {
  return kind == ElementKind::triangle6 ? Triangle6::kPoints : Wedge18::kPoints;
}

template <class Element>
inline constexpr int kElementDofs = Element::kDimensions* Element::kNodes;
template <class Element>
using ElementNodes = Eigen::Matrix<double, Element::kDimensions, Element::kNodes>;  ///< positions, m
template <class Element>
using ElementMatrix = Eigen::Matrix<double, kElementDofs<Element>, kElementDofs<Element>>;
template <class Element>
using ScalarMatrix = Eigen::Matrix<double, Element::kNodes, Element::kNodes>;
template <class Element>
using Elasticity = Eigen::Matrix<double, Element::kStresses, Element::kStresses>;
template <class Element>
using PointStress = Eigen::Matrix<double, Element::kStresses, Element::kPoints>;
template <class Element>
using PointStressView = Eigen::Ref<const PointStress<Element>>;

/// Positions of an element's nodes.
template <class Element>
[[nodiscard]] ElementNodes<Element> element_nodes(const Mesh& mesh, int element) {
  const std::span<const int> indices = mesh.element(element);
  ElementNodes<Element> nodes;
  for (int a = 0; a < Element::kNodes; ++a) nodes.col(a) = mesh.nodes.col(indices[static_cast<std::size_t>(a)]);
  return nodes;
}

/// Gradients d N_a / d x (1/m) and determinant of the Jacobian (m^d) at a local point.
template <class Element>
struct SpatialGradients {
  typename Element::Gradients gradients;
  double determinant = 0;
};
template <class Element>
[[nodiscard]] SpatialGradients<Element> spatial_gradients(const ElementNodes<Element>& nodes,
                                                          const typename Element::Point& local);

/// B of eps = B u: the strains of unit displacements of a node with gradient g are columns of
/// (g_x, 0 | 0, g_y | g_y, g_x) in the plane and likewise in space.
template <class Element>
void fill_strain(const typename Element::Gradients& gradients,
                 Eigen::Matrix<double, Element::kStresses, kElementDofs<Element>>& strain) {
  constexpr int d = Element::kDimensions;
  for (int a = 0; a < Element::kNodes; ++a) {
    for (int c = 0; c < d; ++c) strain(c, d * a + c) = gradients(a, c);
    if constexpr (d == 2) {
      strain(2, d * a) = gradients(a, 1);
      strain(2, d * a + 1) = gradients(a, 0);
    } else {
      for (int shear = 0; shear < 3; ++shear) {  // xy, yz, zx
        const int i = shear, j = (shear + 1) % 3;
        strain(3 + shear, d * a + i) = gradients(a, j);
        strain(3 + shear, d * a + j) = gradients(a, i);
      }
    }
  }
}

/// The stress tensor of its components.
template <class Element, class Components>
[[nodiscard]] Eigen::Matrix<double, Element::kDimensions, Element::kDimensions> stress_tensor(const Components& s) {
  Eigen::Matrix<double, Element::kDimensions, Element::kDimensions> sigma;
  if constexpr (Element::kDimensions == 2)
    sigma << s[0], s[2], s[2], s[1];
  else
    sigma << s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2];
  return sigma;
}

/// sigma = lambda tr(eps) I + 2 mu eps, Pa.
struct Lame {
  double lambda = 0, mu = 0;
};

/// `plane_stress` counts in the plane only: lambda is then what makes this hold there.
template <class Element>
[[nodiscard]] Lame lame(const Material& material, bool plane_stress = false);

/// The same as sigma = D eps.
template <class Element>
[[nodiscard]] Elasticity<Element> elasticity(const Material& material, bool plane_stress = false);

/// Stiffness (N/m) and, for one component, consistent mass (kg) of one element; `thickness` multiplies both (1 in
/// space). Returns the smallest Jacobian determinant over the quadrature points; when it is not positive the element is
/// inverted and the matrices are meaningless.
template <class Element>
double stiffness_and_mass(const ElementNodes<Element>& nodes, const Lame& lame, double density, double thickness,
                          ElementMatrix<Element>& stiffness, ScalarMatrix<Element>& mass);

/// K_g = integral of grad N_a . sigma . grad N_b for one component (N/m), the same for all of them.
/// `stress` at the quadrature points, Pa.
template <class Element>
void geometric_stiffness(const ElementNodes<Element>& nodes, const PointStressView<Element>& stress, double thickness,
                         ScalarMatrix<Element>& stiffness);

/// Volume (in the plane: area) and first moment of one element.
template <class Element>
struct ElementMoments {
  double volume = 0;
  typename Element::Point first = Element::Point::Zero();
};
template <class Element>
[[nodiscard]] ElementMoments<Element> element_moments(const ElementNodes<Element>& nodes);

}  // namespace dovetail::fem
