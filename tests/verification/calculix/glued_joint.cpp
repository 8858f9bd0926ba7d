#include "tests/verification/calculix/glued_joint.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "fem/element.hpp"
#include "fem/stress.hpp"
#include "numerics/sparse_factor.hpp"
#include "tests/unit/fem/internal_block.hpp"

namespace dovetail::calculix {

namespace {

fem::SectorSystem system_of(const fem::SectorMesh& sector, std::span<const fem::Material> materials) {
  return fem::build_sector_system(sector, materials, fem::Assembler(sector.mesh));
}

/// Local coordinates of a point in an element, by Newton's method.
template <class Element>
typename Element::Point local_point(const fem::ElementNodes<Element>& nodes, const typename Element::Point& position) {
  typename Element::Point local = Element::Point::Constant(0.25);
  for (int k = 0; k < 30; ++k) {
    const typename Element::Point miss = position - nodes * Element::shape(local);
    const Eigen::Matrix<double, Element::kDimensions, Element::kDimensions> jacobian =
        nodes * Element::gradients(local);
    local += jacobian.inverse() * miss;
  }
  return local;
}

/// Stress (xx, yy, zz, xy, xz, yz) in an element; plane strain in the plane.
template <class Element>
Eigen::Matrix<double, 6, 1> stress_at(const GluedJoint& joint, int e, const Eigen::Vector3d& position) {
  constexpr int d = Element::kDimensions;
  const fem::Mesh& mesh = joint.sector.mesh;
  const fem::ElementNodes<Element> nodes = fem::element_nodes<Element>(mesh, e);
  fem::ElementNodes<Element> u;
  for (int a = 0; a < Element::kNodes; ++a)
    u.col(a) = joint.displacement.segment<d>(d * mesh.element(e)[static_cast<std::size_t>(a)]);
  const typename Element::Point local = local_point<Element>(nodes, position.head<d>());
  Eigen::Matrix3d gradient = Eigen::Matrix3d::Zero();
  gradient.topLeftCorner<d, d>() = u * fem::spatial_gradients<Element>(nodes, local).gradients;
  const fem::Material& material = joint.materials[static_cast<std::size_t>(mesh.region_of(e).body)];
  const double shear = material.youngs_modulus / (2 * (1 + material.poisson_ratio));
  const double lame = 2 * shear * material.poisson_ratio / (1 - 2 * material.poisson_ratio);
  const Eigen::Matrix3d strain = 0.5 * (gradient + gradient.transpose());
  const Eigen::Matrix3d s = 2 * shear * strain + lame * strain.trace() * Eigen::Matrix3d::Identity();
  Eigen::Matrix<double, 6, 1> result;
  result << s(0, 0), s(1, 1), s(2, 2), s(0, 1), s(0, 2), s(1, 2);
  return result;
}

double von_mises(const Eigen::Matrix<double, 6, 1>& s) {
  return std::sqrt(0.5 * (std::pow(s[0] - s[1], 2) + std::pow(s[1] - s[2], 2) + std::pow(s[2] - s[0], 2)) +
                   3 * s.tail<3>().squaredNorm());
}

}  // namespace

GluedJoint::GluedJoint(const fem::SectorMesh& mesh, double omega)
    : sector(mesh), materials(2), system(system_of(mesh, materials)), speed(omega) {
  numerics::SparseCholesky<double> cholesky;
  const Eigen::SparseMatrix<double> inside = fem::internal_block(system.stiffness, system.constraints);
  cholesky.analyse(inside);
  if (cholesky.factorise(inside) != Status::converged) throw std::runtime_error("glued sector is singular");
  Eigen::VectorXd independent = Eigen::VectorXd::Zero(system.size());
  const Eigen::VectorXd load = speed * speed * system.centrifugal.head(system.internal_size());
  independent.head(system.internal_size()) = cholesky.solve(load);
  displacement = system.constraints.transformation * independent;
}

Eigen::MatrixXd GluedJoint::frequencies(std::span<const int> nodal_diameters, int modes, bool at_speed) const {
  Eigen::SparseMatrix<double> stiffness = system.full.stiffness;
  if (at_speed) {
    const fem::Assembler assembler(sector.mesh);
    const Eigen::SparseMatrix<double> geometric =
        assembler.geometric_stiffness(sector.mesh, fem::quadrature_stress(sector.mesh, materials, displacement));
    stiffness = fem::stiffness_at_speed(system.full, geometric, speed);
  }
  return fem::nodal_diameter_frequencies(sector, stiffness, system.full.mass, fem::BoreSupport::tangential,
                                         {.modes = {.count = modes}}, nodal_diameters)
      .frequency;
}

double GluedJoint::displacement_error(const Answer& answer) const {
  const int d = sector.mesh.dimensions();
  double largest = 0, error = 0;
  for (const auto& [node, theirs] : answer.displacement) {
    if (node >= sector.mesh.node_count()) continue;
    const Eigen::VectorXd ours = displacement.segment(d * node, d);
    largest = std::max(largest, ours.norm());
    error = std::max(error, (theirs.head(d) - ours).norm());
  }
  return largest > 0 ? error / largest : INFINITY;
}

GluedJoint::StressErrors GluedJoint::stress_errors(const Answer& answer) const {
  StressErrors errors;
  double largest = 0, squares = 0, difference_squares = 0;
  for (const PointStress& point : answer.stress) {
    const Eigen::Matrix<double, 6, 1> ours = fem::with_element(sector.mesh.kind, [&](auto element) {
      return stress_at<decltype(element)>(*this, point.element, point.position);
    });
    const Eigen::Matrix<double, 6, 1> difference = point.stress - ours;
    largest = std::max(largest, von_mises(ours));
    errors.largest = std::max(errors.largest, difference.cwiseAbs().maxCoeff());
    squares += ours.squaredNorm();
    difference_squares += difference.squaredNorm();
  }
  errors.largest = largest > 0 ? errors.largest / largest : INFINITY;
  errors.mean = std::sqrt(difference_squares / squares);
  return errors;
}

double frequency_error(const Eigen::MatrixXd& ours, std::span<const int> nodal_diameters, const Answer& answer) {
  double error = 0;
  for (std::size_t k = 0; k < nodal_diameters.size(); ++k) {
    const std::vector<double>& theirs = answer.frequencies.at(nodal_diameters[k]);
    for (Eigen::Index m = 0; m < ours.cols(); ++m)
      error =
          std::max(error, std::abs(ours(static_cast<Eigen::Index>(k), m) / theirs.at(static_cast<std::size_t>(m)) - 1));
  }
  return error;
}

}  // namespace dovetail::calculix
