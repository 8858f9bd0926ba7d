#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>
#include <BRepBuilderAPI_MakeVertex.hxx>
#include <BRepExtrema_DistShapeShape.hxx>
#include <BRepGProp.hxx>
#include <GProp_GProps.hxx>
#include <IGESControl_Reader.hxx>
#include <STEPControl_Reader.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS_Shape.hxx>
#include <TopoDS_Vertex.hxx>

#include <Eigen/LU>
#include <cmath>
#include <cstring>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include "core/errors.hpp"
#include "geometry/cad/flank_depth.hpp"
#include "geometry/cad/sector_solids.hpp"
#include "geometry/profile/chain.hpp"
#include "geometry/profile/flank_form.hpp"
#include "geometry/profile/measures.hpp"
#include "geometry/solid/aerofoil_form.hpp"
#include "geometry/solid/slot_sweep.hpp"
#include "geometry/solid/solid_measures.hpp"
#include "tests/unit/geometry/random_design.hpp"
#include "tests/unit/geometry/solid_checks.hpp"

namespace dovetail::geometry {
namespace {

using Eigen::Vector2d, Eigen::Vector3d;

/// A file of its own, removed at the end.
class Cad : public testing::Test {
 protected:
  void TearDown() override { std::filesystem::remove(file_); }
  const std::filesystem::path file_ =
      std::filesystem::temp_directory_path() /
      ("dovetail_cad_" + std::to_string(getpid()) + testing::UnitTest::GetInstance()->current_test_info()->name());

  /// The solids of a file, read by the modeller's own reader.
  template <class Reader>
  [[nodiscard]] std::vector<TopoDS_Shape> read() const {
    Reader reader;
    EXPECT_EQ(reader.ReadFile(file_.c_str()), IFSelect_RetDone);
    reader.TransferRoots();
    std::vector<TopoDS_Shape> solids;
    const TopoDS_Shape all = reader.OneShape();
    for (TopExp_Explorer e(all, TopAbs_SOLID); e.More(); e.Next()) solids.push_back(e.Current());
    return solids;
  }
  [[nodiscard]] std::string text() const {
    std::ifstream stream(file_);
    std::ostringstream content;
    content << stream.rdbuf();
    return content.str();
  }
};
using Step = Cad;
using Iges = Cad;

/// m3.
double volume(const TopoDS_Shape& solid) {
  GProp_GProps properties;
  BRepGProp::VolumeProperties(solid, properties, 1e-12);
  return properties.Mass() * 1e-9;
}

/// Area within the lines and arcs of a chain, by Green's theorem with Simpson's rule on many parts of each: written
/// anew so that it shares no formula with what is tested.
double area_by_parts(const Chain& chain) {
  double twice = 0;
  for (const Edge& e : chain) {
    constexpr int kParts = 2000;
    const auto integrand = [&](double t) {
      const Vector2d at = e.point(t), rate = e.tangent(t) * e.length();
      return at.x() * rate.y() - at.y() * rate.x();
    };
    for (int i = 0; i < kParts; ++i)
      twice += (integrand(i * 1.0 / kParts) + 4 * integrand((i + 0.5) / kParts) + integrand((i + 1.0) / kParts)) /
               (6 * kParts);
  }
  return twice / 2;
}

/// Radii of all circles of a STEP file, mm.
std::set<double> radii(const std::string& step) {
  std::set<double> found;
  const std::regex circle(R"(CIRCLE\('[^']*',#\d+,([-+0-9.E]+)\))");
  for (std::sregex_iterator at(step.begin(), step.end(), circle); at != std::sregex_iterator(); ++at)
    found.insert(std::stod((*at)[1]));
  return found;
}

std::size_t count(const std::string& text, const std::string& word) {
  std::size_t times = 0;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++times;
  return times;
}

/// How far, m, a point is from the nearest face.
double distance(const TopoDS_Shape& solid, const Vector3d& at) {
  const TopoDS_Vertex vertex = BRepBuilderAPI_MakeVertex(gp_Pnt(1e3 * at.x(), 1e3 * at.y(), 1e3 * at.z()));
  double nearest = 1;
  for (TopExp_Explorer faces(solid, TopAbs_FACE); faces.More(); faces.Next())
    nearest = std::min(nearest, 1e-3 * BRepExtrema_DistShapeShape(vertex, faces.Current()).Value());
  return nearest;
}

TEST_F(Step, HasTheVolumesOfTheSectionAndItsRadii) {
  std::mt19937 generator(5);
  for (int trial = 0; trial < 4; ++trial) {
    ProfileParameters p = random_design(generator);
    if (trial < 2) p.chord = p.slot_length;
    const Profile profile = build_profile(p);
    SectorSolids({.profile = p}).write_step(file_);
    const std::vector<TopoDS_Shape> solids = read<STEPControl_Reader>();
    ASSERT_EQ(solids.size(), 2u);
    const double above = area_by_parts(aerofoil(profile));
    const double blade = (area_by_parts(profile.blade) - above) * p.slot_length + above * p.chord;
    const double disk = area_by_parts(profile.disk) * p.slot_length;
    // A file has 13 digits; the modeller's sums lose some.
    EXPECT_NEAR(volume(solids[0]) / blade, 1, 1e-9) << trial;
    EXPECT_NEAR(volume(solids[1]) / disk, 1, 1e-9) << trial;

    std::vector<double> expected;
    for (const Chain& chain : {profile.blade, profile.disk})
      for (const Edge& e : chain)
        if (e.is_arc()) expected.push_back(1e3 * e.radius);
    const std::set<double> found = radii(text());
    for (const double radius : expected)
      EXPECT_TRUE(std::ranges::any_of(found, [&](double r) { return std::abs(r / radius - 1) < 1e-12; })) << radius;
    for (const double r : found)
      EXPECT_TRUE(std::ranges::any_of(expected, [&](double radius) { return std::abs(r / radius - 1) < 1e-12; })) << r;
    EXPECT_EQ(count(text(), "B_SPLINE"), 0u) << "lines and arcs stay what they are";
  }
}

TEST_F(Step, KeepsTheFormOfFlanksAsArcs) {
  ProfileParameters p;
  p.flank("right").mismatch = 15e-6;
  p.flank("right").crown = 8e-6;
  p.flank("left").edge_radius = 20e-3;
  SectorSolids({.profile = p}).write_step(file_);
  const std::vector<TopoDS_Shape> solids = read<STEPControl_Reader>();
  ASSERT_EQ(solids.size(), 2u);
  EXPECT_NEAR(volume(solids[0]) / (area_by_parts(finished_blade(p)) * p.slot_length), 1, 1e-9);
  EXPECT_EQ(count(text(), "B_SPLINE"), 0u);
}

TEST_F(Step, SweepsASkewedSlot) {
  ProfileParameters p;
  const SolidParameters solid{.skew_angle = 15 * kRadian};
  SectorSolids({.profile = p, .solid = solid}).write_step(file_);
  const std::vector<TopoDS_Shape> solids = read<STEPControl_Reader>();
  ASSERT_EQ(solids.size(), 2u);
  const SolidVolumes exact = solid_volumes(p, solid);
  EXPECT_NEAR(volume(solids[1]) / exact.disk, 1, 1e-9);
  // The plate on the platform begins there, at the same thickness.
  const Profile profile = build_profile(p);
  const double below = (area_by_parts(profile.blade) - area_by_parts(aerofoil(profile))) * p.slot_length;
  const double plate = (p.aerofoil_root_thickness + p.aerofoil_tip_thickness) / 2 * p.aerofoil_span * p.chord;
  EXPECT_NEAR(volume(solids[0]) / (below + plate), 1, 1e-9);
  for (const double z : {-0.5 * p.slot_length, 0.3 * p.slot_length}) {
    const Profile section = section_at(profile, p, solid, z);
    for (const Edge& e : section.disk)
      EXPECT_LT(distance(solids[1], {e.point(0.4).x(), e.point(0.4).y(), z}), 1e-10) << e.name;
    for (const Edge& e : section.blade)
      if (!e.name.starts_with("aerofoil") && e.name != "tip" && !e.name.starts_with("platform_top")) {
        EXPECT_LT(distance(solids[0], {e.point(0.4).x(), e.point(0.4).y(), z}), 1e-10) << e.name;
      }
  }
  const std::set<double> found = radii(text());
  for (const Chain& chain : {profile.blade, profile.disk})
    for (const Edge& e : chain)
      if (e.is_arc() && !e.name.starts_with("aerofoil")) {
        EXPECT_TRUE(std::ranges::any_of(found, [&](double r) { return std::abs(r / (1e3 * e.radius) - 1) < 1e-12; }))
            << e.name;
      }
}

TEST_F(Step, LoftsATwistedAerofoil) {
  ProfileParameters p;
  SolidParameters solid = everything();
  solid.skew_angle = 10 * kRadian;
  solid.axial_crown = solid.axial_relief_depth = 0;
  SectorSolids({.profile = p, .solid = solid}).write_step(file_);
  const std::vector<TopoDS_Shape> solids = read<STEPControl_Reader>();
  ASSERT_EQ(solids.size(), 2u);
  const Profile profile = build_profile(p);
  const double below = (area_by_parts(profile.blade) - area_by_parts(aerofoil(profile))) * p.slot_length;
  // Chord and thickness are linear along the span, Simpson's rule exact: from the aerofoil's root, where the chord
  // begins to change, down to the platform and up to the tip.
  const Edge& side = edge(profile.blade, "aerofoil_right");
  const double foot = edge(profile.blade, "platform_top_right").start.y(), tip = side.end.y();
  const auto area = [&](double y) {
    const double s = (y - side.start.y()) / (side.end.y() - side.start.y());
    const double thickness = 2 * (side.start.x() + s * (side.end.x() - side.start.x()));
    return (p.chord + s * (solid.tip_chord - p.chord)) * thickness * (2 + solid.edge_thickness_fraction) / 3;
  };
  const double above = (tip - foot) / 6 * (area(foot) + 4 * area((foot + tip) / 2) + area(tip));
  EXPECT_NEAR(volume(solids[0]) / (below + above), 1, 1e-9);
  const AerofoilForm form(profile, p, solid);
  for (const double s : {0.05, 0.37, 0.8, 1.0})
    for (const double eta : {-0.6, 0.25, 1.0})
      for (const double side_sign : {-1.0, 1.0}) {
        const Vector2d at =
            form.chord_point(s, eta) + side_sign * side.point(s).x() * form.fullness(eta) * form.across(s);
        EXPECT_LT(distance(solids[0], {at.x(), side.point(s).y(), at.y()}), 1e-10) << s << " " << eta;
      }
  EXPECT_NEAR(volume(solids[1]) / solid_volumes(p, solid).disk, 1, 1e-9);
}

/// Wear that ends inside the flank, and on a line deeper than on the next.
SolidDesign worn_design(bool in_space) {
  SolidDesign design{.profile = {}};
  design.profile.flank("right").crown = 3e-6;
  const std::vector<double> places{0.03, 0.1, 0.3, 0.5, 0.7, 0.9, 0.97};
  const WornLine line{.along = 0.5, .places = places, .depth = {4e-6, 3e-6, 0, 0, 0, 5e-6, 6e-6}};
  design.worn[flank_index("right")] = {line};
  if (!in_space) return design;
  design.solid.skew_angle = 15 * kRadian;
  design.solid.axial_crown = 2e-6;
  WornLine other = line;
  for (double& depth : other.depth) depth *= 0.6;
  design.worn[flank_index("right")] = {line, other};
  design.worn[flank_index("right")].front().along = 0.2;
  design.worn[flank_index("right")].back().along = 0.8;
  design.worn[flank_index("left")] = {other, line};
  design.worn[flank_index("left")].back().along = 0.9;
  return design;
}

TEST_F(Step, DrawsWornFlanksAsSplinesThroughTheDepths) {
  for (const bool in_space : {false, true}) {
    const SolidDesign design = worn_design(in_space);
    SectorSolids(design).write_step(file_);
    const std::vector<TopoDS_Shape> solids = read<STEPControl_Reader>();
    ASSERT_EQ(solids.size(), 2u);
    EXPECT_GT(count(text(), "B_SPLINE"), 0u);
    const Profile profile = build_profile(design.profile);
    const double skew = std::tan(design.solid.skew_angle);
    for (std::size_t f = 0; f < kFlanks.size(); ++f) {
      const FlankDepth depth(SolidFlankForm(design.profile.flanks[f], design.profile, design.solid), design.worn[f]);
      const Edge& flank = edge(profile.blade, "flank_" + std::string(kFlanks[f].name));
      const double to_root = kFlanks[f].left ? 1 : -1;
      const Vector2d in_plane = outward(flank, 0);
      const Vector3d normal = flank_frame(to_root * flank.tangent(0), kFlanks[f].left, design.solid.skew_angle).normal;
      for (const double u : {0.0, 0.2, 0.37, 0.5, 0.8, 1.0})
        for (const double s : {0.0, 0.03, 0.1, 0.2, 0.5, 0.83, 0.97, 1.0}) {
          const Vector2d nominal = flank.point(kFlanks[f].left ? s : 1 - s);
          const double z = (u - 0.5) * design.profile.slot_length;
          // Points are moved within the section's plane by what is `depth` along the normal.
          const Vector2d at = nominal - depth.at(s, u).depth / normal.head<2>().dot(in_plane) * in_plane;
          EXPECT_LT(distance(solids[0], {at.x() + z * skew, at.y(), z}), 1e-10) << kFlanks[f].name << s << " " << u;
        }
    }
  }
}

TEST_F(Step, LosesWhatIsWornAndWhatFilletAndCornerLoseBesideIt) {
  const SolidDesign design = worn_design(false);
  SectorSolids(design).write_step(file_);
  const std::vector<TopoDS_Shape> solids = read<STEPControl_Reader>();
  ASSERT_EQ(solids.size(), 2u);
  const std::size_t f = flank_index("right");
  const FlankDepth depth(SolidFlankForm(design.profile.flanks[f], design.profile, {}), design.worn[f]);
  Chain chain;
  const Chain nominal = build_profile(design.profile).blade;
  const Edge& flank = edge(nominal, "flank_right");  // from root to neck side
  const auto worn = [&](double s) -> Vector2d {
    return flank.point(1 - s) - depth.at(s, 0.5).depth * outward(flank, 0);
  };
  for (const Edge& e : nominal)
    if (e.name == "flank_right") {
      constexpr int kLines = 4000;  // a chord of a micrometre is 1e-11 m off these cubics
      for (int i = kLines; i > 0; --i)
        chain.push_back(line("worn", worn(i / double{kLines}), worn((i - 1) / double{kLines})));
    } else if (e.name == "root_corner_right") {
      chain.push_back(redrawn(e, false, worn(1), depth.at(1, 0.5).depth));
    } else if (e.name == "neck_fillet_right") {
      chain.push_back(redrawn(e, true, worn(0), depth.at(0, 0.5).depth));
    } else {
      chain.push_back(e);
    }
  EXPECT_NEAR(volume(solids[0]) / (area(chain) * design.profile.slot_length), 1, 1e-9);
  EXPECT_LT(area(chain), area(nominal) * (1 - 1e-5)) << "that is seen";
}

TEST_F(Iges, HoldsTheSameSolids) {
  for (const SolidDesign& design : {SolidDesign{.profile = {}}, worn_design(false), worn_design(true),
                                    SolidDesign{.profile = {}, .solid = {.skew_angle = 15 * kRadian}}}) {
    const SectorSolids made(design);
    made.write_iges(file_);
    const std::vector<TopoDS_Shape> iges = read<IGESControl_Reader>();
    EXPECT_THAT(text(), testing::HasSubstr("2HMM")) << "millimetres";
    made.write_step(file_);
    const std::vector<TopoDS_Shape> step = read<STEPControl_Reader>();
    ASSERT_EQ(iges.size(), 2u);
    for (std::size_t body = 0; body < 2; ++body) EXPECT_NEAR(volume(iges[body]) / volume(step[body]), 1, 1e-9) << body;
  }
}

/// Volume within the triangles of a binary STL file, by the divergence theorem; every edge belongs to two of them, in
/// either direction once.
double closed_volume(const std::string& bytes) {
  const auto number = [&]<class T>(std::size_t at, T value) {
    std::memcpy(&value, bytes.data() + at, sizeof(T));
    return value;
  };
  const std::uint32_t triangles = number(80, std::uint32_t{});
  EXPECT_EQ(bytes.size(), 84 + 50 * static_cast<std::size_t>(triangles));
  using Corner = std::array<float, 3>;
  std::map<std::pair<Corner, Corner>, int> edges;
  double volume = 0;
  for (std::size_t t = 0; t < triangles; ++t) {
    std::array<Corner, 3> corners;
    Eigen::Matrix3d columns;
    for (std::size_t i = 0; i < 9; ++i) {
      corners[i / 3][i % 3] = number(84 + 50 * t + 12 + 4 * i, 0.0F);
      columns(static_cast<Eigen::Index>(i % 3), static_cast<Eigen::Index>(i / 3)) = corners[i / 3][i % 3];
    }
    volume += columns.determinant() / 6;
    for (std::size_t i = 0; i < 3; ++i) ++edges[{corners[i], corners[(i + 1) % 3]}];
  }
  for (const auto& [edge, uses] : edges) {
    EXPECT_EQ(uses, 1);
    EXPECT_TRUE(edges.contains({edge.second, edge.first}));
  }
  return volume * 1e-9;
}

TEST(Stl, IsTheClosedSurfaceOfASolidSeenFromOutside) {
  for (const SolidDesign& design :
       {SolidDesign{.profile = {}}, worn_design(true), SolidDesign{.profile = {}, .solid = everything()}}) {
    const auto bodies = SectorSolids(design).triangles();
    const double disk = closed_volume(stl(bodies[1])), blade = closed_volume(stl(bodies[0]));
    // Chords 2 um off arcs whose surfaces make up a tenth of the whole, sizes of some 10 mm.
    EXPECT_NEAR(disk / solid_volumes(design.profile, design.solid).disk, 1, 1e-4);
    EXPECT_GT(blade, 0);
    if (design.solid.skew_angle == 0) {
      EXPECT_NEAR(blade / (area_by_parts(build_profile(design.profile).blade) * design.profile.slot_length), 1, 1e-4);
    }
  }
}

TEST(SectorSolids, RefusesWhatCannotBeWrittenOrDrawn) {
  const SectorSolids solids({.profile = {}});
  EXPECT_THROW(solids.write_step("/nowhere/at.step"), InputError);
  EXPECT_THROW(solids.write_iges("/nowhere/at.iges"), InputError);
  ProfileParameters crossed;
  crossed.neck_width = 1e-3;
  crossed.flank("left").length = 30e-3;
  EXPECT_THROW(SectorSolids({.profile = crossed}), InputError);
}

TEST(FlankDepth, GoesThroughTheDepthsAndNeverBeyondThem) {
  const SolidDesign design = worn_design(true);
  const std::size_t f = flank_index("right");
  const FlankDepth depth(SolidFlankForm(design.profile.flanks[f], design.profile, design.solid), design.worn[f]);
  const SolidFlankForm form(design.profile.flanks[f], design.profile, design.solid);
  for (const WornLine& line : design.worn[f])
    for (std::size_t i = 0; i < line.places.size(); ++i)
      EXPECT_NEAR(depth.at(line.places[i], line.along).depth, form.gap(line.places[i], line.along) + line.depth[i],
                  1e-20);
  for (double s = 0; s <= 1; s += 0.01)
    for (double u = 0; u <= 1; u += 0.05) {
      const double worn = depth.at(s, u).depth - form.gap(s, u);
      EXPECT_GE(worn, -1e-20);
      EXPECT_LE(worn, 6e-6 + 1e-20);
      // Derivatives, away from the ends.
      const double h = 1e-6;
      if (s < h || u < h || s > 1 - h || u > 1 - h) continue;
      EXPECT_NEAR(depth.at(s, u).by_s, (depth.at(s + h, u).depth - depth.at(s - h, u).depth) / (2 * h), 1e-9);
      EXPECT_NEAR(depth.at(s, u).by_u, (depth.at(s, u + h).depth - depth.at(s, u - h).depth) / (2 * h), 1e-9);
      EXPECT_NEAR(depth.at(s, u).by_su, (depth.at(s, u + h).by_s - depth.at(s, u - h).by_s) / (2 * h), 1e-8);
    }
}

}  // namespace
}  // namespace dovetail::geometry
