#include "geometry/mesh/triangulation.hpp"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Constrained_triangulation_face_base_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "core/errors.hpp"
#include "core/options.hpp"
#include "geometry/mesh/index.hpp"
#include "geometry/mesh/params.hpp"

namespace dovetail::geometry {
namespace {

using Eigen::Vector2d;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<int, Kernel>;
using FaceBase =
    CGAL::Triangulation_face_base_with_info_2<bool, Kernel, CGAL::Constrained_triangulation_face_base_2<Kernel>>;
using Delaunay =
    CGAL::Constrained_Delaunay_triangulation_2<Kernel, CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>,
                                               CGAL::No_constraint_intersection_tag>;

constexpr FillingParams kFilling = {};

double cross(const Vector2d& a, const Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

class Filling {
 public:
  Filling(const std::vector<Vector2d>& boundary, const SizeField& size)
      : size_(size), walls_(static_cast<int>(boundary.size())), points_(boundary) {
    reject_crossings();
  }

  Triangulation run() {
    for (int round = 0; round < kFilling.rounds; ++round) {
      while (insert_circumcentres()) {
      }
      for (int i = 0; i < kFilling.relaxations; ++i) relax();
      thin_out();
    }
    for (int i = 0; i < kFilling.relaxations; ++i) relax();
    std::vector<std::array<int, 3>> elements = triangles();
    reject_lost_walls(elements);
    improve_worst(elements);
    return {std::move(points_), std::move(elements)};
  }

 private:
  [[noreturn]] void reject(int wall) const {
    throw InputError(
        {.file = {},
         .key = "profile",
         .value = "boundary near x = " + shortest(at(wall).x()) + " m, y = " + shortest(at(wall).y()) + " m",
         .allowed = "must not cross or touch itself: the dimensions do not fit together"});
  }

  void reject_crossings() const {
    for (int i = 0; i < walls_; ++i)
      if (!at(i).allFinite() || at(i) == at((i + 1) % walls_)) reject(i);
    const auto segment = [this](int i) {
      const Vector2d &a = at(i), &b = at((i + 1) % walls_);
      return Kernel::Segment_2({a.x(), a.y()}, {b.x(), b.y()});
    };
    for (int i = 0; i < walls_; ++i)
      for (int j = i + 2; j < walls_; ++j)
        if ((j + 1) % walls_ != i && CGAL::do_intersect(segment(i), segment(j))) reject(i);
  }

  /// A boundary that folds back on itself leaves sides without a triangle.
  void reject_lost_walls(const std::vector<std::array<int, 3>>& elements) const {
    std::vector<int> uses(index(walls_), 0);
    for (const auto& t : elements)
      for (std::size_t i = 0; i < 3; ++i)
        if (t[i] < walls_ && t[(i + 1) % 3] == (t[i] + 1) % walls_) ++uses[index(t[i])];
    for (int i = 0; i < walls_; ++i)
      if (uses[index(i)] != 1) reject(i);
  }

  const Vector2d& at(int i) const { return points_[static_cast<std::size_t>(i)]; }
  int count() const { return static_cast<int>(points_.size()); }

  std::vector<std::array<int, 3>> triangles() const {
    Delaunay mesh;
    std::vector<Delaunay::Vertex_handle> vertices;
    vertices.reserve(points_.size());
    Delaunay::Face_handle hint;
    for (int i = 0; i < count(); ++i) {
      vertices.push_back(mesh.insert(Kernel::Point_2(at(i).x(), at(i).y()), hint));
      vertices.back()->info() = i;
      hint = vertices.back()->face();
      if (i + 1 == walls_)
        for (int w = 0; w < walls_; ++w)
          mesh.insert_constraint(vertices[static_cast<std::size_t>(w)],
                                 vertices[static_cast<std::size_t>((w + 1) % walls_)]);
    }
    mark_outside(mesh);
    std::vector<std::array<int, 3>> inside;
    for (auto face = mesh.finite_faces_begin(); face != mesh.finite_faces_end(); ++face)
      if (!face->info()) inside.push_back({face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info()});
    return inside;
  }

  static void mark_outside(Delaunay& mesh) {
    for (auto face = mesh.all_faces_begin(); face != mesh.all_faces_end(); ++face) face->info() = false;
    std::vector<Delaunay::Face_handle> queue{mesh.infinite_face()};
    queue.front()->info() = true;
    while (!queue.empty()) {
      const Delaunay::Face_handle face = queue.back();
      queue.pop_back();
      for (int i = 0; i < 3; ++i) {
        const Delaunay::Face_handle neighbour = face->neighbor(i);
        if (neighbour->info() || face->is_constrained(i)) continue;
        neighbour->info() = true;
        queue.push_back(neighbour);
      }
    }
  }

  bool inside(const Vector2d& x) const {
    bool odd = false;
    for (int i = 0; i < walls_; ++i) {
      const Vector2d &a = at(i), &b = at((i + 1) % walls_);
      if ((a.y() > x.y()) == (b.y() > x.y())) continue;
      if (x.x() < a.x() + (x.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x())) odd = !odd;
    }
    return odd;
  }

  double wall_distance(const Vector2d& x) const {
    double squared = std::numeric_limits<double>::infinity();
    for (int i = 0; i < walls_; ++i) {
      const Vector2d& a = at(i);
      const Vector2d along = at((i + 1) % walls_) - a;
      const double t = std::clamp((x - a).dot(along) / along.squaredNorm(), 0.0, 1.0);
      squared = std::min(squared, (x - a - t * along).squaredNorm());
    }
    return std::sqrt(squared);
  }

  bool crowded(const Vector2d& x, double clearance) const {
    const double squared = clearance * clearance;
    return std::any_of(points_.begin(), points_.end(),
                       [&](const Vector2d& p) { return (p - x).squaredNorm() < squared; });
  }

  bool insert_circumcentres() {
    struct Candidate {
      double excess;
      Vector2d center;
      double size;
    };
    std::vector<Candidate> candidates;
    for (const auto& [i, j, k] : triangles()) {
      const Vector2d u = at(j) - at(i), v = at(k) - at(i);
      const double twice_area = cross(u, v);
      const Vector2d offset = Vector2d(v.y() * u.squaredNorm() - u.y() * v.squaredNorm(),
                                       u.x() * v.squaredNorm() - v.x() * u.squaredNorm()) /
                              (2 * twice_area);
      const Vector2d center = at(i) + offset;
      const double size = size_(center);
      const double excess = std::sqrt(3.0) * offset.norm() / size;
      if (excess > kFilling.too_large) candidates.push_back({excess, center, size});
    }
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const Candidate& a, const Candidate& b) { return a.excess > b.excess; });
    const int before = count();
    for (const Candidate& c : candidates)
      if (!crowded(c.center, kFilling.clearance * c.size) && inside(c.center) &&
          wall_distance(c.center) > kFilling.wall_clearance * c.size)
        points_.push_back(c.center);
    return count() > before;
  }

  /// Moves every interior point to the weighted mean of the centroids around it. Weights area/h^3: of
  /// the weights that leave a uniform mesh alone this one keeps the grading of the size field.
  void relax() {
    std::vector<Vector2d> sum(points_.size(), Vector2d::Zero());
    std::vector<double> weight(points_.size(), 0.0);
    for (const auto& triangle : triangles()) {
      const Vector2d &a = at(triangle[0]), &b = at(triangle[1]), &c = at(triangle[2]);
      const Vector2d centroid = (a + b + c) / 3;
      const double h = size_(centroid);
      const double w = cross(b - a, c - a) / (h * h * h);
      for (int i : triangle) {
        sum[static_cast<std::size_t>(i)] += w * centroid;
        weight[static_cast<std::size_t>(i)] += w;
      }
    }
    for (std::size_t i = static_cast<std::size_t>(walls_); i < points_.size(); ++i)
      if (weight[i] > 0) points_[i] = sum[i] / weight[i];
  }

  void thin_out() {
    std::vector<Vector2d> kept(points_.begin(), points_.begin() + walls_);
    for (int i = walls_; i < count(); ++i) {
      const double size = size_(at(i));
      const double squared = kFilling.crowded * kFilling.crowded * size * size;
      const bool free = std::none_of(kept.begin(), kept.end(),
                                     [&](const Vector2d& p) { return (p - at(i)).squaredNorm() < squared; });
      if (free && inside(at(i)) && wall_distance(at(i)) > kFilling.wall_crowded * size) kept.push_back(at(i));
    }
    points_ = std::move(kept);
  }

  double shape(const std::array<int, 3>& t) const {
    const Vector2d &a = at(t[0]), &b = at(t[1]), &c = at(t[2]);
    std::array<double, 3> lengths{(b - a).norm(), (c - b).norm(), (a - c).norm()};
    std::sort(lengths.begin(), lengths.end());
    return cross(b - a, c - a) / (lengths[1] * lengths[2]);
  }

  /// Moves interior points, one at a time, wherever that raises the shape of the worst triangle around them.
  void improve_worst(const std::vector<std::array<int, 3>>& elements) {
    std::vector<std::vector<int>> around(points_.size());
    for (std::size_t e = 0; e < elements.size(); ++e)
      for (int i : elements[e]) around[static_cast<std::size_t>(i)].push_back(static_cast<int>(e));
    for (int sweep = 0; sweep < kFilling.sweeps; ++sweep)
      for (std::size_t i = static_cast<std::size_t>(walls_); i < points_.size(); ++i) {
        const auto worst = [&] {
          double value = 1;
          for (int e : around[i]) value = std::min(value, shape(elements[static_cast<std::size_t>(e)]));
          return value;
        };
        double best = worst();
        if (best > kFilling.good) continue;
        Vector2d place = points_[i];
        const double step = kFilling.step * size_(place) / (1 + sweep);
        for (int direction = 0; direction < kFilling.directions; ++direction) {
          const double angle = 2 * direction * std::numbers::pi / kFilling.directions;
          const Vector2d origin = place;
          points_[i] = origin + step * Vector2d(std::cos(angle), std::sin(angle));
          if (const double value = worst(); value > best) {
            best = value;
            place = points_[i];
          }
          points_[i] = place;
        }
      }
  }

  const SizeField& size_;
  int walls_;
  std::vector<Vector2d> points_;
};

}  // namespace

Triangulation triangulate(const std::vector<Eigen::Vector2d>& boundary, const SizeField& size) {
  return Filling(boundary, size).run();
}

}  // namespace dovetail::geometry
