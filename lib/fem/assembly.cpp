#include "fem/assembly.hpp"

#include <algorithm>
#include <cassert>
#include <string>

#include "core/errors.hpp"
#include "fem/element.hpp"

namespace dovetail::fem {

namespace {

void check(const Mesh& mesh) {
  std::vector<Violation> found;
  const auto report = [&](const std::string& key, const std::string& value, const std::string& allowed) {
    found.push_back({.file = {}, .key = key, .value = value, .allowed = allowed});
  };
  if (mesh.region.size() != mesh.elements.size())
    report("mesh.region", std::to_string(mesh.region.size()), "must have one entry per element");
  for (std::size_t e = 0; e < mesh.elements.size() && found.size() < 10; ++e) {
    for (int node : mesh.elements[e])
      if (node < 0 || node >= mesh.node_count())
        report("mesh.elements[" + std::to_string(e) + "]", std::to_string(node), "must be an index of a node");
    if (e < mesh.region.size() &&
        (mesh.region[e] < 0 || static_cast<std::size_t>(mesh.region[e]) >= mesh.regions.size()))
      report("mesh.region[" + std::to_string(e) + "]", std::to_string(mesh.region[e]), "must be an index of a region");
  }
  for (const Region& region : mesh.regions)
    if (!(region.thickness > 0))
      report("mesh.regions." + region.name + ".thickness", std::to_string(region.thickness), "must be > 0");
  if (!found.empty()) throw InputError(found);
}

void check(const Mesh& mesh, std::span<const Material> materials) {
  std::vector<Violation> found;
  for (const Region& region : mesh.regions) {
    if (region.body < 0 || static_cast<std::size_t>(region.body) >= materials.size()) {
      found.push_back({.file = {},
                       .key = "mesh.regions." + region.name + ".body",
                       .value = std::to_string(region.body),
                       .allowed = "must be an index of a material"});
      continue;
    }
    const Material& m = materials[static_cast<std::size_t>(region.body)];
    if (!(m.youngs_modulus > 0) || !(m.density > 0) || !(m.poisson_ratio >= 0 && m.poisson_ratio < 0.5))
      found.push_back({.file = {},
                       .key = "material[" + std::to_string(region.body) + "]",
                       .value = std::to_string(m.youngs_modulus) + ", " + std::to_string(m.poisson_ratio) + ", " +
                                std::to_string(m.density),
                       .allowed = "must have E > 0, 0 <= nu < 0.5 and density > 0"});
  }
  if (!found.empty()) throw InputError(found);
}

const Region& region_of(const Mesh& mesh, std::size_t element) {
  return mesh.regions[static_cast<std::size_t>(mesh.region[element])];
}

}  // namespace

Assembler::Assembler(const Mesh& mesh) : elements_(mesh.elements.size()) {
  check(mesh);
  const std::size_t n = static_cast<std::size_t>(mesh.node_count());
  std::vector<std::vector<int>> neighbours(n);
  for (const std::array<int, 6>& element : mesh.elements)
    for (int a : element)
      for (int b : element) neighbours[static_cast<std::size_t>(a)].push_back(b);
  std::size_t blocks = 0;
  for (std::vector<int>& list : neighbours) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
    blocks += list.size();
  }

  const Eigen::Index dofs = 2 * static_cast<Eigen::Index>(n);
  pattern_.resize(dofs, dofs);
  pattern_.resizeNonZeros(static_cast<Eigen::Index>(4 * blocks));
  int* outer = pattern_.outerIndexPtr();
  int* inner = pattern_.innerIndexPtr();
  column_length_.resize(n);
  int next = 0;
  for (std::size_t node = 0; node < n; ++node) {
    column_length_[node] = static_cast<int>(2 * neighbours[node].size());
    for (std::size_t c = 0; c < 2; ++c) {
      outer[2 * node + c] = next;
      for (int neighbour : neighbours[node]) {
        inner[next++] = 2 * neighbour;
        inner[next++] = 2 * neighbour + 1;
      }
    }
  }
  outer[2 * n] = next;
  std::fill(pattern_.valuePtr(), pattern_.valuePtr() + next, 0.0);

  position_.resize(36 * elements_);
  std::size_t k = 0;
  for (const std::array<int, 6>& element : mesh.elements)
    for (int b : element) {
      const std::vector<int>& list = neighbours[static_cast<std::size_t>(b)];
      for (int a : element)
        position_[k++] =
            outer[2 * b] + 2 * static_cast<int>(std::lower_bound(list.begin(), list.end(), a) - list.begin());
    }
}

void Assembler::scatter(const Mesh& mesh, std::size_t element, const double* values, double* target) const {
  const int* position = position_.data() + 36 * element;
  for (std::size_t b = 0; b < 6; ++b) {
    const int second = column_length_[static_cast<std::size_t>(mesh.elements[element][b])];
    for (std::size_t a = 0; a < 6; ++a) {
      double* first_column = target + position[6 * b + a];
      const double* source = values + 24 * b + 2 * a;  // column-major 12 x 12
      first_column[0] += source[0];
      first_column[1] += source[1];
      first_column[second] += source[12];
      first_column[second + 1] += source[13];
    }
  }
}

FullMatrices Assembler::stiffness_and_mass(const Mesh& mesh, std::span<const Material> materials) const {
  assert(mesh.elements.size() == elements_ && 2 * mesh.node_count() == pattern_.rows());
  check(mesh, materials);
  FullMatrices full{pattern_, pattern_};
  std::vector<Eigen::Matrix3d> elasticities;
  for (const Region& region : mesh.regions)
    elasticities.push_back(elasticity(materials[static_cast<std::size_t>(region.body)], region.plane_stress));
  ElementMatrix stiffness, mass;
  for (std::size_t e = 0; e < elements_; ++e) {
    const Region& region = region_of(mesh, e);
    const double density = materials[static_cast<std::size_t>(region.body)].density;
    const double determinant =
        fem::stiffness_and_mass(element_nodes(mesh, e), elasticities[static_cast<std::size_t>(mesh.region[e])], density,
                                region.thickness, stiffness, mass);
    if (!(determinant > 0))
      throw InputError({.file = {},
                        .key = "mesh.elements[" + std::to_string(e) + "]",
                        .value = std::to_string(determinant),
                        .allowed = "must have a positive Jacobian determinant (the element is inverted)"});
    scatter(mesh, e, stiffness.data(), full.stiffness.valuePtr());
    scatter(mesh, e, mass.data(), full.mass.valuePtr());
  }
  return full;
}

Eigen::SparseMatrix<double> Assembler::geometric_stiffness(const Mesh& mesh, const StressField& stress) const {
  assert(mesh.elements.size() == elements_);
  assert(stress.cols() == static_cast<Eigen::Index>(kQuadraturePoints * elements_));
  Eigen::SparseMatrix<double> full = pattern_;
  ElementMatrix stiffness;
  for (std::size_t e = 0; e < elements_; ++e) {
    fem::geometric_stiffness(element_nodes(mesh, e),
                             stress.middleCols<kQuadraturePoints>(static_cast<Eigen::Index>(kQuadraturePoints * e)),
                             region_of(mesh, e).thickness, stiffness);
    scatter(mesh, e, stiffness.data(), full.valuePtr());
  }
  return full;
}

Eigen::VectorXd centrifugal_load(const Eigen::SparseMatrix<double>& mass, const Mesh& mesh) {
  return mass * mesh.nodes.reshaped();
}

double body_mass(const Mesh& mesh, std::span<const Material> materials, int body) {
  double total = 0;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    const Region& region = region_of(mesh, e);
    if (region.body != body) continue;
    const ElementNodes nodes = element_nodes(mesh, e);
    double area = 0;
    for (const QuadraturePoint& point : quadrature())
      area += point.weight * plane_gradients(nodes, point.xi, point.eta).determinant;
    total += materials[static_cast<std::size_t>(body)].density * region.thickness * area;
  }
  return total;
}

}  // namespace dovetail::fem
