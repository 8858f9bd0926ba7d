#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "fem/stress_aggregate.hpp"
#include "geometry/mesh/contact_grid.hpp"
#include "geometry/mesh/flank_fractions.hpp"
#include "geometry/profile/flank_form.hpp"
#include "reduction/static_condensation.hpp"
#include "steady/preload.hpp"
#include "tests/unit/fem/structured_mesh.hpp"
#include "tests/verification/fem/sector_model.hpp"

// A flank with rounded ends, pressed without friction on a straight one: two large elastic blocks that touch along the
// flank only. Against the flat punch with rounded edges on a half-plane [Ciavarella, Hills & Monno 1998].

namespace dovetail::geometry {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kLoad = 421e3;        // P, N/m: a flank of the quickstart at 10 000 rpm
constexpr double kHalfFlat = 2.75e-3;  // a, m
const fem::Material kTitanium;

/// Contact from -b to b, flat from -a to a, two bodies of the same material: with sin p0 = a/b and x = b sin p
///   4 (1 - nu^2) P R / (E a^2) = (pi - 2 p0)/(2 sin^2 p0) - cot p0,
///   b p(x)/P = (2/pi)/(pi - 2 p0 - sin 2 p0) { (pi - 2 p0) cos p
///              + ln[ |sin(p + p0)/sin(p - p0)|^(sin p) |tan((p + p0)/2) tan((p - p0)/2)|^(sin p0) ] }.
/// a -> 0 is Hertz's b^2 = 8 (1 - nu^2) P R/(pi E).
class RoundedPunch {
 public:
  explicit RoundedPunch(double radius) {
    const double compliance = 4 * (1 - kTitanium.poisson_ratio * kTitanium.poisson_ratio) / kTitanium.youngs_modulus;
    const double wanted = compliance * kLoad * radius / (kHalfFlat * kHalfFlat);
    double low = 1e-6, high = kPi / 2;  // the left side falls from infinity to 0
    for (int i = 0; i < 100; ++i) {
      p0_ = (low + high) / 2;
      ((kPi - 2 * p0_) / (2 * std::pow(std::sin(p0_), 2)) - 1 / std::tan(p0_) > wanted ? low : high) = p0_;
    }
    b_ = kHalfFlat / std::sin(p0_);
  }

  [[nodiscard]] double half_width() const { return b_; }
  [[nodiscard]] double pressure(double x) const {
    if (std::abs(x) >= b_) return 0;
    const double p = std::asin(std::abs(x) / b_);
    const double logarithms = std::sin(p) * std::log(std::abs(std::sin(p + p0_) / std::sin(p - p0_))) +
                              std::sin(p0_) * std::log(std::abs(std::tan((p + p0_) / 2) * std::tan((p - p0_) / 2)));
    return kLoad / b_ * 2 / kPi / (kPi - 2 * p0_ - std::sin(2 * p0_)) * ((kPi - 2 * p0_) * std::cos(p) + logarithms);
  }
  [[nodiscard]] double largest() const {
    double found = 0;
    constexpr int kSteps = 20000;
    for (int i = 0; i < kSteps; ++i)
      found = std::max(found, pressure(kHalfFlat + (b_ - kHalfFlat) * (i + 0.5) / kSteps));
    return found;
  }

 private:
  double p0_ = 0, b_ = 0;
};

/// The flank of the study: straight over 2 a, rounded beyond.
ProfileParameters flank_of(double radius) {
  ProfileParameters p;
  p.flank("left").edge_radius = p.flank("right").edge_radius = radius;
  p.flank("left").length = p.flank("right").length = 2 * (kHalfFlat + rounded_length(radius));
  return p;
}

/// 0 = first < ... up to `end`, the parts growing by the factor `growth` from `first` on.
std::vector<double> growing(double first, double end, double growth) {
  const int parts = static_cast<int>(std::ceil(std::log(1 + end * (growth - 1) / first) / std::log(growth)));
  std::vector<double> places{0};
  double part = first;
  for (int k = 0; k < parts; ++k, part *= growth) places.push_back(places.back() + part);
  for (double& place : places) place *= end / places.back();
  return places;
}

double interpolated(const std::vector<double>& places, double fraction) {
  const double at = fraction * static_cast<double>(places.size() - 1);
  const std::size_t i = std::min(static_cast<std::size_t>(at), places.size() - 2);
  return places[i] + (at - static_cast<double>(i)) * (places[i + 1] - places[i]);
}

/// Two blocks, 2 `size` wide and `size` high, with matched nodes along the flank; the lower one is held at its bottom,
/// the upper one lies on it.
class Blocks {
 public:
  Blocks(double radius, int flank_elements, double size)
      : flank_(flank_of(radius)), fractions_(flank_fractions(flank_, {.flank_elements = flank_elements})) {
    const double length = flank_.flank("left").length;
    const double end_edge = fractions_[1] * length, shortest = shortest_edge() * length;
    const std::vector<double> beyond = growing(end_edge, size - length / 2, 1.4);
    for (std::size_t k = beyond.size() - 1; k > 0; --k) across_.push_back(-length / 2 - beyond[k]);
    before_ = static_cast<int>(across_.size());
    for (const double f : fractions_) across_.push_back((f - 0.5) * length);
    for (std::size_t k = 1; k < beyond.size(); ++k) across_.push_back(length / 2 + beyond[k]);
    depth_ = growing(shortest, size, 1.3);
    build();
  }

  [[nodiscard]] const fem::SectorMesh& sector() const { return sector_; }
  [[nodiscard]] const std::vector<int>& top() const { return top_; }

 private:
  [[nodiscard]] double shortest_edge() const {
    double shortest = 1;
    for (std::size_t k = 1; k < fractions_.size(); ++k)
      shortest = std::min(shortest, fractions_[k] - fractions_[k - 1]);
    return shortest;
  }

  void build() {
    const int columns = static_cast<int>(across_.size()) - 1, rows = static_cast<int>(depth_.size()) - 1;
    const auto map = [&](double sign) {
      return [this, sign](double s, double t) {
        // Downwards the depth is counted backwards, which keeps the orientation.
        return Eigen::Vector2d(interpolated(across_, s), sign * interpolated(depth_, sign > 0 ? t : 1 - t));
      };
    };
    const fem::testing::Grid upper = fem::testing::make_grid(columns, rows, map(1));
    const fem::testing::Grid lower = fem::testing::make_grid(columns, rows, map(-1));
    const int first = upper.mesh.node_count();
    fem::Mesh& mesh = sector_.mesh;
    mesh = upper.mesh;
    mesh.nodes.conservativeResize(2, first + lower.mesh.node_count());
    mesh.nodes.rightCols(lower.mesh.node_count()) = lower.mesh.nodes;
    for (const int node : lower.mesh.connectivity) mesh.connectivity.push_back(node + first);
    mesh.region.resize(static_cast<std::size_t>(mesh.element_count()), 1);
    mesh.regions = {{.name = "blade", .body = 0, .thickness = 1.0}, {.name = "disk", .body = 1, .thickness = 1.0}};
    for (int i = 0; i <= 2 * columns; ++i) {
      sector_.bore_nodes.push_back(first + lower.node(i, 0));
      top_.push_back(upper.node(i, 2 * rows));
    }
    fem::Flank flank;
    flank.name = "right";
    const int parts = static_cast<int>(fractions_.size()) - 1;
    for (int i = 2 * before_; i <= 2 * (before_ + parts); ++i)
      flank.pairs.push_back({upper.node(i, 0), first + lower.node(i, 2 * rows)});
    flank.grid = {parts + 1, 1};
    flank.normal = Eigen::Vector2d(0, -1);
    flank.tangents = Eigen::Vector2d(1, 0);
    flank.interpolation = bilinear_interpolation(fractions_, {0}, with_middles(fractions_), {0});
    flank.position.resize(2, parts + 1);
    flank.gap.resize(parts + 1);
    const FlankForm form(flank_.flank("right"));
    for (int k = 0; k <= parts; ++k) {
      flank.position.col(k) = mesh.nodes.col(upper.node(2 * (before_ + k), 0));
      flank.gap[k] = form.gap(fractions_[static_cast<std::size_t>(k)]);
    }
    sector_.flanks.push_back(std::move(flank));
  }

  ProfileParameters flank_;
  std::vector<double> fractions_;
  std::vector<double> across_, depth_;
  int before_ = 0;
  std::vector<int> top_;
  fem::SectorMesh sector_;
};

/// Nodal pressures under the load, spread over the top.
steady::Preload pressed(const Blocks& blocks) {
  const fem::SectorMesh& sector = blocks.sector();
  const std::vector<fem::Material> bodies{kTitanium, kTitanium};
  const fem::Assembler assembler(sector.mesh);
  const fem::SectorSystem system = fem::build_sector_system(sector, bodies, assembler, fem::BoreSupport::fixed);
  reduction::FullModel full = fem::testing::sector_model(system, 0, 0);
  Eigen::VectorXd load = Eigen::VectorXd::Zero(2 * sector.mesh.node_count());
  const Eigen::VectorXd weights = fem::boundary_weights(sector.mesh, blocks.top());
  for (std::size_t k = 0; k < blocks.top().size(); ++k)
    load[2 * blocks.top()[k] + 1] = -kLoad * weights[static_cast<Eigen::Index>(k)] / weights.sum();
  full.static_force = system.constraints.transformation.transpose() * load;
  // Without friction nothing else keeps the upper block from floating along the lower one.
  Eigen::SparseMatrix<double> spring(system.size(), system.size());
  const Eigen::SparseMatrix<double> t = system.constraints.transformation;
  Eigen::SparseMatrix<double> held(t.rows(), t.rows());
  held.insert(2 * blocks.top().front(), 2 * blocks.top().front()) = 1e-3 * kTitanium.youngs_modulus;
  full.stiffness += Eigen::SparseMatrix<double>(t.transpose() * held * t);
  const reduction::StaticCondensation condensed = reduction::condense_statically(full);
  EXPECT_EQ(condensed.status, Status::converged);
  return steady::quasi_static(std::make_shared<const dynamics::CondensedModel>(condensed.model));
}

struct Rounding {
  double radius_mm;
  int edges;
  double tolerance;  ///< of the largest pressure
};

class RoundedFlank : public testing::TestWithParam<Rounding> {};

TEST_P(RoundedFlank, HasThePressureOfThePunchWithRoundedEdges) {
  const double radius = GetParam().radius_mm * 1e-3;
  const RoundedPunch exact(radius);
  const Blocks blocks(radius, GetParam().edges, 40 * kHalfFlat);
  const steady::Preload preload = pressed(blocks);
  ASSERT_EQ(preload.status, Status::converged);
  const Eigen::MatrixXd& at = blocks.sector().flanks[0].position;
  double difference = 0, width = 0;
  for (Eigen::Index k = 0; k < preload.pressure.size(); ++k) {
    difference = std::max(difference, std::abs(preload.pressure[k] - exact.pressure(at(0, k))));
    if (preload.pressure[k] > 0) width = std::max(width, at(0, k));
  }
  RecordProperty("largest_ratio", std::to_string(preload.pressure.maxCoeff() / exact.largest()));
  RecordProperty("largest_over_mean", std::to_string(preload.pressure.maxCoeff() / (kLoad / (2 * kHalfFlat))));
  RecordProperty("largest_difference", std::to_string(difference / exact.largest()));
  RecordProperty("half_width_um", std::to_string((width - kHalfFlat) * 1e6));
  RecordProperty("exact_half_width_um", std::to_string((exact.half_width() - kHalfFlat) * 1e6));
  // Blocks of 40 half-widths bend the half-plane's pressures by (1/40)^2. The rest is the edges at the peak, a tenth (R
  // = 1 mm) to a twentieth of the rounded strip that bears: 0.1 to 0.9 % on 128 edges; as many equal ones miss the peak
  // of R = 1 mm by 37 %.
  EXPECT_NEAR(preload.pressure.maxCoeff(), exact.largest(), GetParam().tolerance * exact.largest());
  // The last node that bears is within one edge of the end of the contact.
  EXPECT_NEAR(width, exact.half_width(), rounded_length(radius) / 35 * 128 / GetParam().edges);
}

INSTANTIATE_TEST_SUITE_P(Radii, RoundedFlank,
                         testing::Values(Rounding{1, 128, 0.02}, Rounding{5, 128, 0.02}, Rounding{20, 128, 0.02},
                                         Rounding{50, 128, 0.02}, Rounding{1, 64, 0.05}, Rounding{5, 64, 0.04},
                                         Rounding{20, 64, 0.01}, Rounding{50, 64, 0.01}),
                         [](const auto& given) {
                           return "R" + std::to_string(static_cast<int>(given.param.radius_mm)) + "mm" +
                                  std::to_string(given.param.edges) + "edges";
                         });

}  // namespace
}  // namespace dovetail::geometry
