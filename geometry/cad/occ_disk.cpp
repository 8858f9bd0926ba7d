// The sector of the disk: straight it is its section swept, skewed a ring's part between helicoids less the slot.
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepLib.hxx>
#include <BRep_Builder.hxx>
#include <GCE2d_MakeSegment.hxx>
#include <Geom2d_Line.hxx>
#include <Geom2d_TrimmedCurve.hxx>
#include <Geom_Circle.hxx>
#include <Geom_CylindricalSurface.hxx>
#include <Precision.hxx>
#include <TopoDS_Edge.hxx>
#include <algorithm>
#include <numbers>

#include "geometry/cad/occ_sector.hpp"
#include "geometry/exports/millimetres.hpp"
#include "geometry/profile/chain.hpp"
#include "geometry/solid/slot_sweep.hpp"

namespace dovetail::geometry::occ {
namespace {

using Eigen::Vector3d;

/// The part of the ring between bore and rim whose cuts turn with z.
class Ring {
 public:
  Ring(const SolidDesign& design) : design_(design) {}

  [[nodiscard]] TopoDS_Shape shape() const {
    const double bore = design_.profile.bore_radius, rim = design_.profile.rim_radius;
    std::vector<TopoDS_Shape> faces{cylinder(bore), cylinder(rim), cut(-1), cut(1)};
    for (const double end : {-0.5, 0.5}) faces.push_back(cap(end * design_.profile.slot_length));
    return sewn(faces);
  }

 private:
  /// Direction, counter-clockwise from x, of the left (side -1) or right cut.
  [[nodiscard]] double direction(int side, double z) const {
    return std::numbers::pi / 2 - side * std::numbers::pi / design_.profile.sectors -
           turn_at(design_.profile, design_.solid, z);
  }
  [[nodiscard]] Vector3d corner(double radius, int side, double z) const {
    const double angle = direction(side, z);
    return {radius * std::cos(angle), radius * std::sin(angle), z};
  }
  /// Bore or rim: a rhomboid in the angle and the height of the cylinder.
  [[nodiscard]] TopoDS_Shape cylinder(double radius) const {
    const Handle(Geom_Surface) surface = new Geom_CylindricalSurface(gp_Ax3(), kPerMillimetre * radius);
    const double half = design_.profile.slot_length / 2;
    const auto arc = [&](double z) {
      const double height = kPerMillimetre * z;
      const Handle(Geom2d_Line) across = new Geom2d_Line(gp_Pnt2d(0, height), gp_Dir2d(1, 0));
      TopoDS_Edge edge = BRepBuilderAPI_MakeEdge(across, surface, direction(1, z), direction(-1, z));
      const gp_Ax2 axes(gp_Pnt(0, 0, height), gp_Dir(0, 0, 1), gp_Dir(1, 0, 0));
      BRep_Builder().UpdateEdge(edge, new Geom_Circle(axes, kPerMillimetre * radius), Precision::Confusion());
      return edge;
    };
    const auto helix = [&](int side) -> TopoDS_Edge {
      const auto at = [&](double z) { return gp_Pnt2d(direction(side, z), kPerMillimetre * z); };
      const Handle(Geom2d_TrimmedCurve) along = GCE2d_MakeSegment(at(-half), at(half)).Value();
      return BRepBuilderAPI_MakeEdge(along, surface);
    };
    BRepBuilderAPI_MakeWire wire;
    for (const TopoDS_Edge& edge : {arc(-half), helix(-1), arc(half), helix(1)}) wire.Add(edge);
    TopoDS_Face face = BRepBuilderAPI_MakeFace(surface, wire);
    BRepLib::BuildCurves3d(face, 1e-7);
    return face;
  }
  /// The helicoid that a radial line makes.
  [[nodiscard]] TopoDS_Shape cut(int side) const {
    const ProfileParameters& p = design_.profile;
    const double half = p.slot_length / 2, turn = -turn_at(p, design_.solid, 1);
    const std::vector<double> heights = equal_knots(-half, half, parts_of_turn(turn * p.slot_length));
    return face(spline_net({p.bore_radius, p.rim_radius}, heights, [&](double radius, double z) {
      const Vector3d at = corner(radius, side, z), outward(at.x() / radius, at.y() / radius, 0);
      const Vector3d around(-outward.y(), outward.x(), 0);
      return SurfaceJet{
          .at = at, .by_a = outward, .by_b = turn * radius * around + Vector3d::UnitZ(), .by_ab = turn * around};
    }));
  }
  [[nodiscard]] TopoDS_Shape cap(double z) const {
    const double rim = design_.profile.rim_radius, bore = design_.profile.bore_radius;
    const double sector = 2 * std::numbers::pi / design_.profile.sectors;
    const auto at = [&](double radius, int side) -> Eigen::Vector2d { return corner(radius, side, z).head<2>(); };
    const Chain ends{line("cut_right", at(bore, 1), at(rim, 1)),
                     arc("rim", at(rim, 1), at(rim, -1), Eigen::Vector2d(0, 0), sector),
                     line("cut_left", at(rim, -1), at(bore, -1)),
                     arc("bore", at(bore, -1), at(bore, 1), Eigen::Vector2d(0, 0), -sector)};
    return planar_face(section_wire(swept(ends), {0, 0, z}));
  }

  const SolidDesign& design_;
};

/// The slot from mouth to mouth, closed beyond the rim: what is swept out of the ring.
Chain slot(const Profile& profile, double beyond_rim) {
  const auto named = [&](const char* name) { return std::ranges::find(profile.disk, name, &Edge::name); };
  Chain chain(named("mouth_right"), std::next(named("mouth_left")));
  chain.front().start.y() = chain.back().end.y() = beyond_rim;
  chain.push_back(line("above", chain.back().end, chain.front().start));
  // In the disk's chain the slot lies to the right.
  std::ranges::reverse(chain);
  for (Edge& e : chain) e = reversed(e);
  return chain;
}

}  // namespace

TopoDS_Shape disk_shape(const SolidDesign& design, const Profile& profile) {
  const Vector3d along = design.profile.slot_length * slot_direction(design.solid);
  if (design.solid.skew_angle == 0) return sweep(swept(profile.disk), -along / 2, along);
  // Longer and higher than the ring, so that no two faces coincide.
  const Chain tool = slot(profile, 1.1 * design.profile.rim_radius);
  return without(Ring(design).shape(), sweep(swept(tool), -0.6 * along, 1.2 * along));
}

}  // namespace dovetail::geometry::occ
