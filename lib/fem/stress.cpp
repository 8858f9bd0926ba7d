#include "fem/stress.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <string>
#include <vector>

#include "core/errors.hpp"
#include "fem/element.hpp"

namespace dovetail::fem {

namespace {

std::vector<Eigen::Matrix3d> elasticities_of(const Mesh& mesh, std::span<const Material> materials) {
  std::vector<Eigen::Matrix3d> result;
  for (const Region& region : mesh.regions) {
    assert(region.body >= 0 && static_cast<std::size_t>(region.body) < materials.size());
    result.push_back(elasticity(materials[static_cast<std::size_t>(region.body)], region.plane_stress));
  }
  return result;
}

}  // namespace

StressField quadrature_stress(const Mesh& mesh, std::span<const Material> materials,
                              const Eigen::Ref<const Eigen::VectorXd>& displacement) {
  assert(displacement.size() == 2 * mesh.node_count());
  const std::vector<Eigen::Matrix3d> elasticities = elasticities_of(mesh, materials);
  StressField stress(3, static_cast<Eigen::Index>(kQuadraturePoints) * mesh.element_count());
  Eigen::Index column = 0;
  ElementNodes u;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    const ElementNodes nodes = element_nodes(mesh, e);
    for (std::size_t a = 0; a < 6; ++a)
      u.col(static_cast<Eigen::Index>(a)) = displacement.segment<2>(2 * mesh.elements[e][a]);
    const Eigen::Matrix3d& d = elasticities[static_cast<std::size_t>(mesh.region[e])];
    for (const QuadraturePoint& point : quadrature()) {
      const Eigen::Matrix2d gradient = u * plane_gradients(nodes, point.xi, point.eta).gradients;
      stress.col(column++) = d * Eigen::Vector3d(gradient(0, 0), gradient(1, 1), gradient(0, 1) + gradient(1, 0));
    }
  }
  return stress;
}

Eigen::SparseMatrix<double> nodal_stress_operator(const Mesh& mesh, std::span<const Material> materials,
                                                  std::span<const int> nodes) {
  const std::vector<Eigen::Matrix3d> elasticities = elasticities_of(mesh, materials);
  struct Incidence {
    std::size_t element;
    int local;
  };
  std::vector<int> slot(static_cast<std::size_t>(mesh.node_count()), -1);
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    if (nodes[k] < 0 || nodes[k] >= mesh.node_count())
      throw InputError(
          {.file = {}, .key = "nodes", .value = std::to_string(nodes[k]), .allowed = "must be an index of a node"});
    slot[static_cast<std::size_t>(nodes[k])] = static_cast<int>(k);
  }
  std::vector<std::vector<Incidence>> touching(nodes.size());
  for (std::size_t e = 0; e < mesh.elements.size(); ++e)
    for (int a = 0; a < 6; ++a) {
      const int k = slot[static_cast<std::size_t>(mesh.elements[e][static_cast<std::size_t>(a)])];
      if (k >= 0) touching[static_cast<std::size_t>(k)].push_back({e, a});
    }

  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    const std::vector<Incidence>& incidences =
        touching[static_cast<std::size_t>(slot[static_cast<std::size_t>(nodes[k])])];
    const double share = 1.0 / static_cast<double>(std::max<std::size_t>(incidences.size(), 1));
    for (const Incidence& incidence : incidences) {
      const Eigen::Vector2d local = node_coordinates(incidence.local);
      const ElementGradients g =
          plane_gradients(element_nodes(mesh, incidence.element), local.x(), local.y()).gradients;
      const Eigen::Matrix3d& d = elasticities[static_cast<std::size_t>(mesh.region[incidence.element])];
      for (int a = 0; a < 6; ++a) {
        const int column = 2 * mesh.elements[incidence.element][static_cast<std::size_t>(a)];
        for (int r = 0; r < 3; ++r) {
          const int row = 3 * static_cast<int>(k) + r;
          entries.emplace_back(row, column, share * (d(r, 0) * g(a, 0) + d(r, 2) * g(a, 1)));
          entries.emplace_back(row, column + 1, share * (d(r, 1) * g(a, 1) + d(r, 2) * g(a, 0)));
        }
      }
    }
  }
  Eigen::SparseMatrix<double> result(3 * static_cast<Eigen::Index>(nodes.size()), 2 * mesh.nodes.cols());
  result.setFromTriplets(entries.begin(), entries.end());
  return result;
}

double von_mises(double sxx, double syy, double sxy, double poisson_ratio) {
  const double szz = poisson_ratio * (sxx + syy);
  const double a = sxx - syy, b = syy - szz, c = szz - sxx;
  return std::sqrt(0.5 * (a * a + b * b + c * c) + 3 * sxy * sxy);
}

double max_principal(double sxx, double syy, double sxy) {
  return 0.5 * (sxx + syy) + std::hypot(0.5 * (sxx - syy), sxy);
}

Eigen::Vector3d von_mises_gradient(double sxx, double syy, double sxy, double poisson_ratio) {
  const double value = von_mises(sxx, syy, sxy, poisson_ratio);
  if (value == 0) return Eigen::Vector3d::Zero();
  const double szz = poisson_ratio * (sxx + syy);
  const double mean = (sxx + syy + szz) / 3;
  const double out_of_plane = poisson_ratio * (szz - mean);
  // d/ds of sqrt(3/2 dev:dev) is 3/2 dev / value, with sigma_zz following sxx and syy.
  return Eigen::Vector3d(sxx - mean + out_of_plane, syy - mean + out_of_plane, 2 * sxy) * (1.5 / value);
}

}  // namespace dovetail::fem
