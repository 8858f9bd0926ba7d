#include "fem/neck.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <limits>
#include <string>
#include <vector>

#include "core/errors.hpp"
#include "fem/element.hpp"

namespace dovetail::fem {

namespace {

/// Volume (in the plane area) and first moment of a part of the blade.
template <int D>
struct Part {
  double volume = 0;
  Eigen::Matrix<double, D, 1> first = Eigen::Matrix<double, D, 1>::Zero();
};

template <int D>
struct Corner {
  Eigen::Matrix<double, D, 1> place;
  double height;
};

template <int D>
void add_simplex(Part<D>& part, const std::array<Corner<D>, D + 1>& corners) {
  Eigen::Matrix<double, D, D> edges;
  Eigen::Matrix<double, D, 1> sum = corners[0].place;
  for (int k = 0; k < D; ++k) {
    edges.col(k) = corners[static_cast<std::size_t>(k + 1)].place - corners[0].place;
    sum += corners[static_cast<std::size_t>(k + 1)].place;
  }
  const double volume = std::abs(edges.determinant()) / (D == 2 ? 2 : 6);
  part.volume += volume;
  part.first += volume / (D + 1) * sum;
}

template <int D>
Corner<D> cut(const Corner<D>& above, const Corner<D>& below) {
  return {above.place + (below.place - above.place) * (above.height / (above.height - below.height)), 0};
}

/// The part of a simplex with height > 0, as simplices: every corner above is a fan over the cuts.
template <int D>
void add_clipped(Part<D>& part, std::array<Corner<D>, D + 1> c) {
  std::sort(c.begin(), c.end(), [](const Corner<D>& a, const Corner<D>& b) { return a.height > b.height; });
  const std::ptrdiff_t above = std::count_if(c.begin(), c.end(), [](const Corner<D>& x) { return x.height > 0; });
  if (above == 0) return;
  if (above == D + 1) return add_simplex<D>(part, c);
  if constexpr (D == 2) {
    if (above == 1) return add_simplex<2>(part, {c[0], cut(c[0], c[1]), cut(c[0], c[2])});
    const Corner<2> p = cut(c[0], c[2]), q = cut(c[1], c[2]);
    add_simplex<2>(part, {c[0], c[1], p});
    add_simplex<2>(part, {c[1], p, q});
  } else {
    // Prism over the triangles (a0, a1, a2) and (b0, b1, b2).
    const auto prism = [&](const Corner<3>& a0, const Corner<3>& a1, const Corner<3>& a2, const Corner<3>& b0,
                           const Corner<3>& b1, const Corner<3>& b2) {
      add_simplex<3>(part, {a0, a1, a2, b0});
      add_simplex<3>(part, {a1, a2, b0, b1});
      add_simplex<3>(part, {a2, b0, b1, b2});
    };
    if (above == 1) {
      add_simplex<3>(part, {c[0], cut(c[0], c[1]), cut(c[0], c[2]), cut(c[0], c[3])});
    } else if (above == 2) {
      const Corner<3> p2 = cut(c[0], c[2]), p3 = cut(c[0], c[3]), q2 = cut(c[1], c[2]), q3 = cut(c[1], c[3]);
      prism(c[0], p2, p3, c[1], q2, q3);
    } else {
      prism(c[0], c[1], c[2], cut(c[0], c[3]), cut(c[1], c[3]), cut(c[2], c[3]));
    }
  }
}

/// The section: a point on it, the unit normal away from the axis, its width and, in space, its length per height
/// along z when it ends at planes across z.
struct Section {
  Eigen::VectorXd origin, normal;
  double width = 0, length_per_height = 0;
};

Section section_of(const SectorMesh& sector) {
  const Mesh& mesh = sector.mesh;
  Section section{.origin = mesh.nodes.col(sector.neck_nodes[2]), .normal = {}};
  const Eigen::VectorXd second = mesh.nodes.col(sector.neck_nodes[3]), across = second - section.origin;
  section.width = across.norm();
  if (mesh.dimensions() == 2) {
    section.normal = Eigen::Vector2d(-across.y(), across.x());
  } else {
    Eigen::Vector3d along = Eigen::Vector3d::UnitZ();
    if (!sector.flanks.empty()) along = sector.flanks.front().tangents.col(1);
    section.normal = Eigen::Vector3d(along.cross(Eigen::Vector3d(across)));
    section.length_per_height = section.normal.norm() / (section.width * std::abs(along.z()));
  }
  section.normal.normalize();
  if (section.normal.head<2>().dot((section.origin + second).head<2>()) < 0) section.normal = -section.normal;
  return section;
}

}  // namespace

NeckTension neck_tension(const SectorMesh& sector, std::span<const Material> materials) {
  const Mesh& mesh = sector.mesh;
  if (sector.neck_nodes.size() != 4)
    throw InputError({.file = {},
                      .key = "sector.neck_nodes",
                      .value = std::to_string(sector.neck_nodes.size()),
                      .allowed = "must be four nodes, the lower two first"});
  const Section section = section_of(sector);
  const auto on_neck = [&](int node) { return node == sector.neck_nodes[2] || node == sector.neck_nodes[3]; };

  NeckTension neck;
  neck.width = section.width;
  neck.force = Eigen::VectorXd::Zero(mesh.dimensions());
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  double thickness = kInfinity, lowest = kInfinity, highest = -kInfinity;
  with_element(mesh.kind, [&]<class Element>(Element) {
    constexpr int d = Element::kDimensions;
    for (int e = 0; e < mesh.element_count(); ++e) {
      const Region& region = mesh.region_of(e);
      if (region.body != 0) continue;
      const std::span<const int> indices = mesh.element(e);
      if (std::any_of(indices.begin(), indices.end(), on_neck)) thickness = std::min(thickness, region.thickness);
      const ElementNodes<Element> nodes = element_nodes<Element>(mesh, e);
      const typename Element::Shape height =
          (nodes.colwise() - section.origin.head<d>()).transpose() * section.normal.head<d>();
      if (height.maxCoeff() <= 0) continue;
      if constexpr (d == 3) {
        if (height.minCoeff() <= 0) {
          lowest = std::min(lowest, nodes.row(2).minCoeff());
          highest = std::max(highest, nodes.row(2).maxCoeff());
        }
      }
      Part<d> part;
      if (height.minCoeff() >= 0) {
        const ElementMoments<Element> moments = element_moments<Element>(nodes);
        part.volume = moments.volume;
        part.first = moments.first;
      } else {
        for (const auto& simplex : Element::simplices()) {
          std::array<Corner<d>, d + 1> corners;
          for (std::size_t k = 0; k < corners.size(); ++k) corners[k] = {nodes.col(simplex[k]), height[simplex[k]]};
          add_clipped<d>(part, corners);
        }
      }
      const double density =
          materials[static_cast<std::size_t>(region.body)].density * (d == 2 ? region.thickness : 1.0);
      neck.mass += density * part.volume;
      neck.force.head<2>() += density * part.first.template head<2>();
    }
  });
  if (!(thickness < kInfinity))
    throw InputError({.file = {},
                      .key = "sector.neck_nodes",
                      .value = std::to_string(sector.neck_nodes[2]) + ", " + std::to_string(sector.neck_nodes[3]),
                      .allowed = "must be nodes of the blade"});
  neck.thickness = mesh.dimensions() == 2 ? thickness : (highest - lowest) * section.length_per_height;
  neck.tension = neck.force.dot(section.normal);
  neck.mean_stress = neck.tension / (neck.width * neck.thickness);
  return neck;
}

}  // namespace dovetail::fem
