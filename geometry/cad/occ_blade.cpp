// The blade: its section with worn flanks, swept along the slot, and the aerofoil on it.
#include <algorithm>
#include <cmath>

#include "geometry/cad/flank_depth.hpp"
#include "geometry/cad/occ_sector.hpp"
#include "geometry/profile/chain.hpp"
#include "geometry/profile/flank_form.hpp"
#include "geometry/profile/measures.hpp"
#include "geometry/solid/aerofoil_form.hpp"
#include "geometry/solid/slot_sweep.hpp"

namespace dovetail::geometry::occ {
namespace {

using Eigen::Vector2d, Eigen::Vector3d;

/// A flank of the blade that lies behind the nominal one.
class MovedFlank {
 public:
  MovedFlank(const SolidDesign& design, std::size_t f, const Edge& edge)
      : edge_(edge),
        depth_(SolidFlankForm(design.profile.flanks[f], design.profile, design.solid), design.worn[f]),
        from_root_(!kFlanks[f].left),
        normal_(in_space(outward(edge, 0))),
        along_(design.profile.slot_length * slot_direction(design.solid)) {
    const Vector2d neck_to_root = edge.tangent(0) * (from_root_ ? -1 : 1);
    // In the section's plane it is farther to a plane that is inclined to it than along the plane's normal.
    across_ = 1 / normal_.dot(flank_frame(neck_to_root, kFlanks[f].left, design.solid.skew_angle).normal);
  }

  [[nodiscard]] bool moves() const {
    return std::ranges::any_of(with_middles(depth_.across()), [this](double s) {
      return std::ranges::any_of(with_middles(depth_.along()), [&](double u) { return depth_.at(s, u).depth > 0; });
    });
  }

  [[nodiscard]] SplineNet net() const {
    std::vector<double> travelled = depth_.across();
    if (from_root_) {
      std::ranges::reverse(travelled);
      for (double& a : travelled) a = 1 - a;
    }
    return spline_net(travelled, depth_.along(), [this](double a, double u) {
      const FlankDepth::Value d = depth_.at(from_root_ ? 1 - a : a, u);
      const Vector3d back = across_ * normal_, by_s = back * (from_root_ ? -1 : 1);
      return SurfaceJet{.at = in_space(edge_.point(a)) + (u - 0.5) * along_ - d.depth * back,
                        .by_a = in_space(edge_.end - edge_.start) - d.by_s * by_s,
                        .by_b = along_ - d.by_u * back,
                        .by_ab = -d.by_su * by_s};
    });
  }

  /// The arc beside it, at the start of its travel or at the end.
  [[nodiscard]] SweptEdge beside(const Edge& arc, bool at_start) const {
    const double s = at_start == from_root_ ? 1 : 0;
    const auto lost = [&](double u) { return across_ * depth_.at(s, u).depth; };
    if (std::ranges::all_of(with_middles(depth_.along()), [&](double u) { return lost(u) == 0; })) return {arc};
    if (depth_.same_along_slot()) {
      const Vector2d end = edge_.point(at_start ? 0 : 1) - lost(0.5) * normal_.head<2>();
      return {redrawn(arc, !at_start, end, lost(0.5))};
    }
    // On the arc before the flank the flank is at the end.
    return {arc, spline_net(equal_knots(0, 1, parts_of_turn(arc.sweep)), depth_.along(), [&](double a, double u) {
              const FlankDepth::Value d = depth_.at(s, u);
              const double t = at_start ? 1 - a : a, weight = 1 - t * t * (3 - 2 * t);
              const double rate = -6 * t * (1 - t) * (at_start ? -1 : 1);
              const Vector3d back = across_ * normal_;
              return SurfaceJet{.at = in_space(arc.point(a)) + (u - 0.5) * along_ - d.depth * weight * back,
                                .by_a = in_space(arc.tangent(a)) * arc.length() - d.depth * rate * back,
                                .by_b = along_ - d.by_u * weight * back,
                                .by_ab = -d.by_u * rate * back};
            })};
  }

 private:
  static std::vector<double> with_middles(const std::vector<double>& knots) {
    std::vector<double> places{knots.front()};
    for (std::size_t i = 1; i < knots.size(); ++i) {
      places.push_back((knots[i - 1] + knots[i]) / 2);
      places.push_back(knots[i]);
    }
    return places;
  }

  const Edge& edge_;
  FlankDepth depth_;
  bool from_root_;
  Vector3d normal_, along_;
  double across_ = 1;
};

/// The blade's chain with the form and the wear of its flanks.
SweptChain finished(const SolidDesign& design, const Profile& profile) {
  const bool nominal_along = design.solid.axial_crown == 0 && design.solid.axial_relief_depth == 0;
  const bool unworn = std::ranges::all_of(design.worn, [](const WornFlank& flank) { return flank.empty(); });
  if (unworn && nominal_along && design.solid.skew_angle == 0) return swept(finished_blade(design.profile));
  SweptChain blade = swept(profile.blade);
  const std::size_t count = blade.size();
  for (std::size_t f = 0; f < kFlanks.size(); ++f) {
    const std::string name = "flank_" + std::string(kFlanks[f].name);
    const auto at =
        static_cast<std::size_t>(std::ranges::find(profile.blade, name, &Edge::name) - profile.blade.begin());
    const MovedFlank flank(design, f, profile.blade[at]);
    if (!flank.moves()) continue;
    const std::size_t before = (at + count - 1) % count, after = (at + 1) % count;
    blade[at].net = flank.net();
    blade[before] = flank.beside(profile.blade[before], true);
    blade[after] = flank.beside(profile.blade[after], false);
  }
  return blade;
}

/// What is as long as the slot: all but what stands on the platform's top, which is flat there.
SweptChain below_aerofoil(const SweptChain& blade) {
  SweptChain below;
  bool above = false;
  for (const SweptEdge& e : blade) {
    if (e.edge.name == "platform_top_right") {
      above = true;
      below.push_back({line("platform_top", e.edge.start, {})});
    }
    if (!above) below.push_back(e);
    if (e.edge.name == "platform_top_left") {
      below.back().edge.end = e.edge.end;
      above = false;
    }
  }
  return below;
}

bool is_straight(const SolidDesign& design) {
  const SolidParameters& s = design.solid;
  return s.skew_angle == 0 && s.stagger == 0 && s.twist == 0 && s.lean == 0 && s.edge_thickness_fraction == 1 &&
         tip_chord(design.profile, s) == design.profile.chord;
}

/// The form of aerofoil_form.hpp from the platform's top to the tip.
class Aerofoil {
 public:
  Aerofoil(const SolidDesign& design, const Profile& profile)
      : form_(profile, design.profile, design.solid),
        solid_(design.solid),
        chord_(design.profile.chord),
        taper_(tip_chord(design.profile, design.solid) - chord_) {
    const Edge& side = geometry::edge(profile.blade, "aerofoil_right");
    bottom_ = side.start.y();
    span_ = side.end.y() - bottom_;
    half_root_ = side.start.x();
    half_change_ = side.end.x() - half_root_;
    const double foot = form_.span_fraction(geometry::edge(profile.blade, "platform_top_right").start.y());
    knots_ = equal_knots(foot, 1, std::max(8, 2 * parts_of_turn(solid_.twist)));
  }

  [[nodiscard]] TopoDS_Shape shape() const {
    std::vector<TopoDS_Shape> faces;
    const SplineNet right = side(1), left = side(-1);
    for (const SplineNet& net : {right, left, edge(-1), edge(1)}) faces.push_back(face(net));
    // The sections at foot and tip are plane: ruled from one side to the other.
    for (const double s : {knots_.front(), knots_.back()})
      faces.push_back(face(spline_net({-1, 1}, {-1, 1}, [&](double xi, double eta) {
        const SurfaceJet one = at(s, eta, 1), other = at(s, eta, -1);
        return SurfaceJet{.at = (one.at + other.at) / 2 + xi * (one.at - other.at) / 2,
                          .by_a = (one.at - other.at) / 2,
                          .by_b = (one.by_b + other.by_b) / 2 + xi * (one.by_b - other.by_b) / 2,
                          .by_ab = (one.by_b - other.by_b) / 2};
      })));
    return sewn(faces);
  }

 private:
  /// Point and derivatives by s and eta, xi a fraction of the half thickness.
  [[nodiscard]] SurfaceJet at(double s, double eta, double xi) const {
    const double e = solid_.edge_thickness_fraction;
    const double f = form_.fullness(eta), f_eta = -2 * (1 - e) * eta;
    const double half = xi * (half_root_ + s * half_change_), half_s = xi * half_change_;
    const double chord = (chord_ + s * taper_) / 2, chord_s = taper_ / 2;
    const double beta = solid_.stagger + s * solid_.twist, turn = solid_.twist;
    // (x, y, z) = across half f + chordwise chord eta + lean; both directions turn with s.
    const Vector3d across(std::cos(beta), 0, -std::sin(beta)), chordwise(std::sin(beta), 0, std::cos(beta));
    const Vector3d across_s = -turn * chordwise, chordwise_s = turn * across;
    return {.at = across * half * f + chordwise * chord * eta + Vector3d(solid_.lean * s * s, bottom_ + s * span_, 0),
            .by_a = (across_s * half + across * half_s) * f + (chordwise_s * chord + chordwise * chord_s) * eta +
                    Vector3d(2 * solid_.lean * s, span_, 0),
            .by_b = across * half * f_eta + chordwise * chord,
            .by_ab = (across_s * half + across * half_s) * f_eta + chordwise_s * chord + chordwise * chord_s};
  }
  [[nodiscard]] SplineNet side(double xi) const {
    return spline_net(knots_, {-1, 1}, [&](double s, double eta) { return at(s, eta, xi); });
  }
  /// Leading or trailing edge: flat across the thickness.
  [[nodiscard]] SplineNet edge(double eta) const {
    return spline_net(knots_, {-1, 1}, [&](double s, double xi) {
      const SurfaceJet one = at(s, eta, 1), other = at(s, eta, -1);
      return SurfaceJet{.at = (one.at + other.at) / 2 + xi * (one.at - other.at) / 2,
                        .by_a = (one.by_a + other.by_a) / 2 + xi * (one.by_a - other.by_a) / 2,
                        .by_b = (one.at - other.at) / 2,
                        .by_ab = (one.by_a - other.by_a) / 2};
    });
  }

  AerofoilForm form_;
  SolidParameters solid_;
  double chord_, taper_, bottom_ = 0, span_ = 0, half_root_ = 0, half_change_ = 0;
  std::vector<double> knots_;
};

}  // namespace

TopoDS_Shape blade_shape(const SolidDesign& design, const Profile& profile) {
  const SweptChain blade = finished(design, profile);
  const Vector3d along = design.profile.slot_length * slot_direction(design.solid);
  const double chord = design.profile.chord;
  if (is_straight(design) && chord == design.profile.slot_length) return sweep(blade, -along / 2, along);
  const TopoDS_Shape root = sweep(below_aerofoil(blade), -along / 2, along);
  if (is_straight(design)) return joined(root, sweep(swept(aerofoil(profile)), {0, 0, -chord / 2}, {0, 0, chord}));
  return joined(root, Aerofoil(design, profile).shape());
}

}  // namespace dovetail::geometry::occ
