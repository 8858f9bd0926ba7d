#include "fem/stress.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <string>
#include <vector>

#include "core/errors.hpp"
#include "fem/element.hpp"

namespace dovetail::fem {

namespace {

template <class Element>
std::vector<Elasticity<Element>> elasticities_of(const Mesh& mesh, std::span<const Material> materials) {
  std::vector<Elasticity<Element>> result;
  for (const Region& region : mesh.regions) {
    assert(region.body >= 0 && static_cast<std::size_t>(region.body) < materials.size());
    result.push_back(elasticity<Element>(materials[static_cast<std::size_t>(region.body)], region.plane_stress));
  }
  return result;
}

/// Strain of a displacement gradient du_i/dx_j.
template <class Element>
Eigen::Matrix<double, Element::kStresses, 1> strain_of(
    const Eigen::Matrix<double, Element::kDimensions, Element::kDimensions>& g) {
  Eigen::Matrix<double, Element::kStresses, 1> strain;
  if constexpr (Element::kDimensions == 2)
    strain << g(0, 0), g(1, 1), g(0, 1) + g(1, 0);
  else
    strain << g(0, 0), g(1, 1), g(2, 2), g(0, 1) + g(1, 0), g(1, 2) + g(2, 1), g(2, 0) + g(0, 2);
  return strain;
}

/// (xx, yy, zz, xy, yz, zx) of a plane state too.
Eigen::Matrix<double, 6, 1> in_space(const StressVector& s, double poisson_ratio) {
  assert(s.size() == 3 || s.size() == 6);
  if (s.size() == 6) return s;
  Eigen::Matrix<double, 6, 1> result;
  result << s[0], s[1], poisson_ratio * (s[0] + s[1]), s[2], 0, 0;
  return result;
}

double von_mises_in_space(const Eigen::Matrix<double, 6, 1>& s) {
  const double a = s[0] - s[1], b = s[1] - s[2], c = s[2] - s[0];
  return std::sqrt(0.5 * (a * a + b * b + c * c) + 3 * (s[3] * s[3] + s[4] * s[4] + s[5] * s[5]));
}

}  // namespace

StressField quadrature_stress(const Mesh& mesh, std::span<const Material> materials,
                              const Eigen::Ref<const Eigen::VectorXd>& displacement) {
  assert(displacement.size() == mesh.dimensions() * mesh.node_count());
  StressField stress(stress_components(mesh.kind), quadrature_points(mesh.kind) * mesh.element_count());
  with_element(mesh.kind, [&]<class Element>(Element) {
    constexpr int d = Element::kDimensions;
    const std::vector<Elasticity<Element>> elasticities = elasticities_of<Element>(mesh, materials);
    Eigen::Index column = 0;
    ElementNodes<Element> u;
    for (int e = 0; e < mesh.element_count(); ++e) {
      const ElementNodes<Element> nodes = element_nodes<Element>(mesh, e);
      const std::span<const int> indices = mesh.element(e);
      for (int a = 0; a < Element::kNodes; ++a)
        u.col(a) = displacement.segment<d>(d * indices[static_cast<std::size_t>(a)]);
      const Elasticity<Element>& elastic =
          elasticities[static_cast<std::size_t>(mesh.region[static_cast<std::size_t>(e)])];
      for (const QuadraturePoint<d>& point : Element::quadrature()) {
        const Eigen::Matrix<double, d, d> gradient = u * spatial_gradients<Element>(nodes, point.local).gradients;
        stress.col(column++) = elastic * strain_of<Element>(gradient);
      }
    }
  });
  return stress;
}

Eigen::SparseMatrix<double> nodal_stress_operator(const Mesh& mesh, std::span<const Material> materials,
                                                  std::span<const int> nodes) {
  struct Incidence {
    int element, local;
  };
  std::vector<int> slot(static_cast<std::size_t>(mesh.node_count()), -1);
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    if (nodes[k] < 0 || nodes[k] >= mesh.node_count())
      throw InputError(
          {.file = {}, .key = "nodes", .value = std::to_string(nodes[k]), .allowed = "must be an index of a node"});
    slot[static_cast<std::size_t>(nodes[k])] = static_cast<int>(k);
  }
  std::vector<std::vector<Incidence>> touching(nodes.size());
  for (int e = 0; e < mesh.element_count(); ++e)
    for (int a = 0; a < mesh.nodes_per_element(); ++a) {
      const int k = slot[static_cast<std::size_t>(mesh.element(e)[static_cast<std::size_t>(a)])];
      if (k >= 0) touching[static_cast<std::size_t>(k)].push_back({e, a});
    }

  std::vector<Eigen::Triplet<double>> entries;
  with_element(mesh.kind, [&]<class Element>(Element) {
    constexpr int d = Element::kDimensions, s = Element::kStresses;
    const std::vector<Elasticity<Element>> elasticities = elasticities_of<Element>(mesh, materials);
    using Strain = Eigen::Matrix<double, s, kElementDofs<Element>>;
    Strain strain = Strain::Zero();
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      const std::vector<Incidence>& incidences =
          touching[static_cast<std::size_t>(slot[static_cast<std::size_t>(nodes[k])])];
      const double share = 1.0 / static_cast<double>(std::max<std::size_t>(incidences.size(), 1));
      for (const Incidence& incidence : incidences) {
        const std::span<const int> indices = mesh.element(incidence.element);
        fill_strain<Element>(
            spatial_gradients<Element>(element_nodes<Element>(mesh, incidence.element), Element::node(incidence.local))
                .gradients,
            strain);
        const Elasticity<Element>& elastic =
            elasticities[static_cast<std::size_t>(mesh.region[static_cast<std::size_t>(incidence.element)])];
        const Strain stress = elastic * strain;
        for (int a = 0; a < Element::kNodes; ++a)
          for (int r = 0; r < s; ++r)
            for (int c = 0; c < d; ++c)
              entries.emplace_back(s * static_cast<int>(k) + r, d * indices[static_cast<std::size_t>(a)] + c,
                                   share * stress(r, d * a + c));
      }
    }
  });
  Eigen::SparseMatrix<double> result(stress_components(mesh.kind) * static_cast<Eigen::Index>(nodes.size()),
                                     mesh.dimensions() * mesh.nodes.cols());
  result.setFromTriplets(entries.begin(), entries.end());
  return result;
}

Eigen::VectorXd on_free_surface(const Eigen::Ref<const Eigen::VectorXd>& stress,
                                const Eigen::Ref<const Eigen::VectorXd>& normal, double poisson_ratio) {
  const auto relieved = [&]<class Element>(Element) -> Eigen::VectorXd {
    constexpr int d = Element::kDimensions;
    using Tensor = Eigen::Matrix<double, d, d>;
    const Eigen::Matrix<double, d, 1> n = normal;
    const Tensor tensor = stress_tensor<Element>(stress);
    const Tensor along = Tensor::Identity() - n * n.transpose();
    // Hooke's law with the same strains along the surface and no stress across it.
    const double across = n.dot(tensor * n) * poisson_ratio / (1 - poisson_ratio);
    const Tensor result = along * (tensor - across * Tensor::Identity()) * along;
    Eigen::Matrix<double, Element::kStresses, 1> vector;
    if constexpr (d == 2)
      vector << result(0, 0), result(1, 1), result(0, 1);
    else
      vector << result(0, 0), result(1, 1), result(2, 2), result(0, 1), result(1, 2), result(2, 0);
    return vector;
  };
  return stress.size() == 3 ? relieved(Triangle6{}) : relieved(Wedge18{});
}

double von_mises(const StressVector& stress, double poisson_ratio) {
  return von_mises_in_space(in_space(stress, poisson_ratio));
}

}  // namespace dovetail::fem
