#include "fem/element.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <limits>

namespace dovetail::fem {

namespace {

// Values at the quadrature points never change: tabulated once.
template <class Element>
struct Table {
  std::array<typename Element::Shape, Element::kPoints> shape;
  std::array<typename Element::Gradients, Element::kPoints> gradients;

  Table() {
    for (std::size_t q = 0; q < Element::kPoints; ++q) {
      shape[q] = Element::shape(Element::quadrature()[q].local);
      gradients[q] = Element::gradients(Element::quadrature()[q].local);
    }
  }
};

template <class Element>
const Table<Element>& table() {
  static const Table<Element> values;
  return values;
}

template <class Element>
SpatialGradients<Element> to_space(const ElementNodes<Element>& nodes, const typename Element::Gradients& local) {
  // d x / d local
  const Eigen::Matrix<double, Element::kDimensions, Element::kDimensions> jacobian = nodes * local;
  SpatialGradients<Element> result;
  result.determinant = jacobian.determinant();
  result.gradients.noalias() = local * jacobian.inverse();
  return result;
}

}  // namespace

template <class Element>
SpatialGradients<Element> spatial_gradients(const ElementNodes<Element>& nodes, const typename Element::Point& local) {
  return to_space<Element>(nodes, Element::gradients(local));
}

template <class Element>
Lame lame(const Material& material, bool plane_stress) {
  const double e = material.youngs_modulus, nu = material.poisson_ratio;
  const bool stress_free_across = Element::kDimensions == 2 && plane_stress;
  return {.lambda = nu * e / ((1 + nu) * (stress_free_across ? 1 - nu : 1 - 2 * nu)), .mu = e / (2 * (1 + nu))};
}

template <class Element>
Elasticity<Element> elasticity(const Material& material, bool plane_stress) {
  constexpr int d = Element::kDimensions;
  const auto [lambda, mu] = lame<Element>(material, plane_stress);
  Elasticity<Element> result = Elasticity<Element>::Zero();
  result.template topLeftCorner<d, d>().setConstant(lambda);
  for (int i = 0; i < Element::kStresses; ++i) result(i, i) = i < d ? lambda + 2 * mu : mu;
  return result;
}

// With T_ab = integral of g_a g_b^T, g the gradients of the shape functions of nodes a and b, an isotropic material has
// K_ab = lambda T_ab + mu T_ab^T + mu tr(T_ab) I: a sixth of the operations of B^T D B in space, a third in the plane.
template <class Element>
double stiffness_and_mass(const ElementNodes<Element>& nodes, const Lame& lame, double density, double thickness,
                          ElementMatrix<Element>& stiffness, ScalarMatrix<Element>& mass) {
  constexpr int d = Element::kDimensions, dofs = kElementDofs<Element>;
  mass.setZero();
  double smallest = std::numeric_limits<double>::infinity();
  Eigen::Matrix<double, dofs, Element::kPoints> gradients, weighted;
  for (std::size_t q = 0; q < Element::kPoints; ++q) {
    const SpatialGradients<Element> space = to_space<Element>(nodes, table<Element>().gradients[q]);
    smallest = std::min(smallest, space.determinant);
    const double volume = Element::quadrature()[q].weight * space.determinant * thickness;
    const auto column = static_cast<Eigen::Index>(q);
    gradients.col(column) = space.gradients.transpose().reshaped();
    weighted.col(column) = volume * gradients.col(column);
    const typename Element::Shape& shape = table<Element>().shape[q];
    mass.noalias() += (density * volume * shape) * shape.transpose();
  }
  ElementMatrix<Element> product;
  product.noalias() = gradients * weighted.transpose();
  for (int b = 0; b < Element::kNodes; ++b)
    for (int a = b; a < Element::kNodes; ++a) {
      const Eigen::Matrix<double, d, d> pair = product.template block<d, d>(d * a, d * b);
      auto block = stiffness.template block<d, d>(d * a, d * b);
      block = lame.lambda * pair + lame.mu * pair.transpose();
      block.diagonal().array() += lame.mu * pair.trace();
    }
  // Rounding breaks symmetry in the last digit; eigensolvers and tests want it exact.
  stiffness.template triangularView<Eigen::StrictlyUpper>() = stiffness.transpose();
  mass.template triangularView<Eigen::StrictlyUpper>() = mass.transpose();
  return smallest;
}

template <class Element>
void geometric_stiffness(const ElementNodes<Element>& nodes, const PointStressView<Element>& stress, double thickness,
                         ScalarMatrix<Element>& stiffness) {
  stiffness.setZero();
  for (std::size_t q = 0; q < Element::kPoints; ++q) {
    const SpatialGradients<Element> space = to_space<Element>(nodes, table<Element>().gradients[q]);
    const double volume = Element::quadrature()[q].weight * space.determinant * thickness;
    const Eigen::Matrix<double, Element::kStresses, 1> s = volume * stress.col(static_cast<Eigen::Index>(q));
    const typename Element::Gradients traction = space.gradients * stress_tensor<Element>(s);
    stiffness.noalias() += traction * space.gradients.transpose();
  }
  stiffness.template triangularView<Eigen::StrictlyUpper>() = stiffness.transpose();
}

template <class Element>
ElementMoments<Element> element_moments(const ElementNodes<Element>& nodes) {
  ElementMoments<Element> moments;
  for (std::size_t q = 0; q < Element::kPoints; ++q) {
    const double volume =
        Element::quadrature()[q].weight * to_space<Element>(nodes, table<Element>().gradients[q]).determinant;
    moments.volume += volume;
    moments.first += volume * (nodes * table<Element>().shape[q]);
  }
  return moments;
}

#define DOVETAIL_INSTANTIATE(Element)                                                                                 \
  template SpatialGradients<Element> spatial_gradients<Element>(const ElementNodes<Element>&, const Element::Point&); \
  template Lame lame<Element>(const Material&, bool);                                                                 \
  template Elasticity<Element> elasticity<Element>(const Material&, bool);                                            \
  template double stiffness_and_mass<Element>(const ElementNodes<Element>&, const Lame&, double, double,              \
                                              ElementMatrix<Element>&, ScalarMatrix<Element>&);                       \
  template void geometric_stiffness<Element>(const ElementNodes<Element>&, const PointStressView<Element>&, double,   \
                                             ScalarMatrix<Element>&);                                                 \
  template ElementMoments<Element> element_moments<Element>(const ElementNodes<Element>&);
DOVETAIL_INSTANTIATE(Triangle6)
DOVETAIL_INSTANTIATE(Wedge18)
#undef DOVETAIL_INSTANTIATE

}  // namespace dovetail::fem
