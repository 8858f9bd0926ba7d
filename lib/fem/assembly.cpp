#include "fem/assembly.hpp"

#include <algorithm>
#include <array>
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
  if (mesh.nodes.rows() != mesh.dimensions())
    report("mesh.nodes", std::to_string(mesh.nodes.rows()),
           "must have " + std::to_string(mesh.dimensions()) + " coordinates for this kind of element");
  const std::size_t elements = static_cast<std::size_t>(mesh.element_count());
  if (mesh.connectivity.size() != elements * static_cast<std::size_t>(mesh.nodes_per_element()))
    report("mesh.connectivity", std::to_string(mesh.connectivity.size()), "must be a multiple of the element's nodes");
  if (mesh.region.size() != elements)
    report("mesh.region", std::to_string(mesh.region.size()), "must have one entry per element");
  for (std::size_t e = 0; e < elements && found.size() < 10; ++e) {
    for (int node : mesh.element(static_cast<int>(e)))
      if (node < 0 || node >= mesh.node_count())
        report("mesh.elements[" + std::to_string(e) + "]", std::to_string(node), "must be an index of a node");
    if (e < mesh.region.size() &&
        (mesh.region[e] < 0 || static_cast<std::size_t>(mesh.region[e]) >= mesh.regions.size()))
      report("mesh.region[" + std::to_string(e) + "]", std::to_string(mesh.region[e]), "must be an index of a region");
  }
  for (const Region& region : mesh.regions)
    if (mesh.dimensions() == 2 && !(region.thickness > 0))
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

/// Thickness that multiplies the integrals over an element.
double thickness_of(const Mesh& mesh, int element) {
  return mesh.dimensions() == 2 ? mesh.region_of(element).thickness : 1.0;
}

/// Where the values of one element go.
template <class Element>
class Scatter {
 public:
  Scatter(const Mesh& mesh, int element, const std::vector<int>& position, const std::vector<int>& column_length)
      : position_(position.data() + static_cast<std::ptrdiff_t>(kBlocks) * element) {
    const std::span<const int> nodes = mesh.element(element);
    for (std::size_t b = 0; b < kNodes; ++b) column_[b] = column_length[static_cast<std::size_t>(nodes[b])];
  }

  void add(const ElementMatrix<Element>& values, double* target) const {
    for (std::size_t b = 0; b < kNodes; ++b)
      for (std::size_t a = 0; a < kNodes; ++a) {
        double* first = target + position_[kNodes * b + a];
        const double* source = values.data() + kDofs * (d * b) + d * a;
        for (std::size_t j = 0; j < d; ++j)
          for (std::size_t i = 0; i < d; ++i)
            first[j * static_cast<std::size_t>(column_[b]) + i] += source[kDofs * j + i];
      }
  }

  /// A matrix of one component, the same for all of them.
  void add(const ScalarMatrix<Element>& values, double* target) const {
    for (std::size_t b = 0; b < kNodes; ++b)
      for (std::size_t a = 0; a < kNodes; ++a) {
        double* first = target + position_[kNodes * b + a];
        const double value = values.data()[kNodes * b + a];
        for (std::size_t j = 0; j < d; ++j) first[j * static_cast<std::size_t>(column_[b]) + j] += value;
      }
  }

 private:
  static constexpr std::size_t d = Element::kDimensions, kNodes = Element::kNodes, kDofs = kElementDofs<Element>;
  static constexpr std::size_t kBlocks = kNodes * kNodes;
  const int* position_;
  std::array<int, kNodes> column_{};
};

}  // namespace

Assembler::Assembler(const Mesh& mesh) : connectivity_(mesh.connectivity), elements_(mesh.element_count()) {
  check(mesh);
  const std::size_t n = static_cast<std::size_t>(mesh.node_count());
  const std::size_t d = static_cast<std::size_t>(mesh.dimensions());
  std::vector<std::vector<int>> neighbours(n);
  for (int e = 0; e < elements_; ++e)
    for (int a : mesh.element(e))
      for (int b : mesh.element(e)) neighbours[static_cast<std::size_t>(a)].push_back(b);
  std::size_t blocks = 0;
  for (std::vector<int>& list : neighbours) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
    blocks += list.size();
  }

  const Eigen::Index dofs = static_cast<Eigen::Index>(d * n);
  pattern_.resize(dofs, dofs);
  pattern_.resizeNonZeros(static_cast<Eigen::Index>(d * d * blocks));
  int* outer = pattern_.outerIndexPtr();
  int* inner = pattern_.innerIndexPtr();
  column_length_.resize(n);
  int next = 0;
  for (std::size_t node = 0; node < n; ++node) {
    column_length_[node] = static_cast<int>(d * neighbours[node].size());
    for (std::size_t c = 0; c < d; ++c) {
      outer[d * node + c] = next;
      for (int neighbour : neighbours[node])
        for (int i = 0; i < static_cast<int>(d); ++i) inner[next++] = static_cast<int>(d) * neighbour + i;
    }
  }
  outer[d * n] = next;
  std::fill(pattern_.valuePtr(), pattern_.valuePtr() + next, static_cast<signed char>(0));

  position_.reserve(mesh.connectivity.size() * static_cast<std::size_t>(mesh.nodes_per_element()));
  for (int e = 0; e < elements_; ++e)
    for (int b : mesh.element(e)) {
      const std::vector<int>& list = neighbours[static_cast<std::size_t>(b)];
      const int start = outer[d * static_cast<std::size_t>(b)];
      for (int a : mesh.element(e))
        position_.push_back(start + static_cast<int>(d) *
                                        static_cast<int>(std::lower_bound(list.begin(), list.end(), a) - list.begin()));
    }
}

bool Assembler::serves(const Mesh& mesh) const {
  return mesh.dimensions() * mesh.node_count() == pattern_.rows() && mesh.element_count() == elements_ &&
         mesh.connectivity == connectivity_;
}

Eigen::SparseMatrix<double> Assembler::zeros() const {
  Eigen::SparseMatrix<double> result(pattern_.rows(), pattern_.cols());
  result.resizeNonZeros(pattern_.nonZeros());
  std::copy_n(pattern_.outerIndexPtr(), pattern_.cols() + 1, result.outerIndexPtr());
  std::copy_n(pattern_.innerIndexPtr(), pattern_.nonZeros(), result.innerIndexPtr());
  result.coeffs().setZero();
  return result;
}

FullMatrices Assembler::stiffness_and_mass(const Mesh& mesh, std::span<const Material> materials) const {
  assert(mesh.element_count() == elements_ && mesh.dimensions() * mesh.node_count() == pattern_.rows());
  check(mesh, materials);
  FullMatrices full{mesh.dimensions(), zeros(), {}};
  Eigen::SparseMatrix<double> on_pattern = zeros();  // the mass
  with_element(mesh.kind, [&]<class Element>(Element) {
    std::vector<Lame> elasticities;
    for (const Region& region : mesh.regions)
      elasticities.push_back(lame<Element>(materials[static_cast<std::size_t>(region.body)], region.plane_stress));
    ElementMatrix<Element> stiffness;
    ScalarMatrix<Element> mass;
    for (int e = 0; e < elements_; ++e) {
      const std::size_t region = static_cast<std::size_t>(mesh.region[static_cast<std::size_t>(e)]);
      const double density = materials[static_cast<std::size_t>(mesh.regions[region].body)].density;
      const double determinant = fem::stiffness_and_mass<Element>(element_nodes<Element>(mesh, e), elasticities[region],
                                                                  density, thickness_of(mesh, e), stiffness, mass);
      if (!(determinant > 0))
        throw InputError({.file = {},
                          .key = "mesh.elements[" + std::to_string(e) + "]",
                          .value = std::to_string(determinant),
                          .allowed = "must have a positive Jacobian determinant (the element is inverted)"});
      const Scatter<Element> scatter(mesh, e, position_, column_length_);
      scatter.add(stiffness, full.stiffness.valuePtr());
      scatter.add(mass, on_pattern.valuePtr());
    }
  });
  Eigen::SparseMatrix<double>(on_pattern.pruned()).swap(full.mass);
  return full;
}

Eigen::SparseMatrix<double> Assembler::geometric_stiffness(const Mesh& mesh, const StressField& stress) const {
  assert(mesh.element_count() == elements_);
  assert(stress.rows() == stress_components(mesh.kind) && stress.cols() == quadrature_points(mesh.kind) * elements_);
  Eigen::SparseMatrix<double> full = zeros();
  with_element(mesh.kind, [&]<class Element>(Element) {
    ScalarMatrix<Element> stiffness;
    for (int e = 0; e < elements_; ++e) {
      const PointStress<Element> of_element = stress.middleCols<Element::kPoints>(Element::kPoints * e);
      fem::geometric_stiffness<Element>(element_nodes<Element>(mesh, e), of_element, thickness_of(mesh, e), stiffness);
      Scatter<Element>(mesh, e, position_, column_length_).add(stiffness, full.valuePtr());
    }
  });
  return full;
}

Eigen::VectorXd centrifugal_load(const Eigen::SparseMatrix<double>& mass, const Mesh& mesh) {
  Eigen::MatrixXd from_axis = mesh.nodes;
  if (mesh.dimensions() == 3) from_axis.row(2).setZero();
  return mass * from_axis.reshaped();
}

double body_mass(const Mesh& mesh, std::span<const Material> materials, int body) {
  double total = 0;
  with_element(mesh.kind, [&]<class Element>(Element) {
    for (int e = 0; e < mesh.element_count(); ++e)
      if (mesh.region_of(e).body == body)
        total += materials[static_cast<std::size_t>(body)].density * thickness_of(mesh, e) *
                 element_moments<Element>(element_nodes<Element>(mesh, e)).volume;
  });
  return total;
}

}  // namespace dovetail::fem
