// The stress in a section and in a cut of a joint in space.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "geometry/profile/profile.hpp"
#include "studies/report/plots/section_drawing.hpp"
#include "studies/report/plots/stress_contours.hpp"
#include "studies/report/plots/stress_cut.hpp"
#include "tests/unit/studies/report_markup.hpp"
#include "tests/unit/studies/report_sample.hpp"

namespace dovetail::report {
namespace {

using testing::HasSubstr;

constexpr int kHeights = 5, kNodes = 6;

/// Two layers of one wedge at the blade's neck fillet, 5 mm apart in height, of a slot at 45 degrees: its first node is
/// on the fillet, the second one stands for the flank.
DesignRecord wedges(int worst_height) {
  DesignRecord design = sample_design(1);
  const Eigen::Vector2d fillet = geometry::edge(design.profile.blade, "neck_fillet_right").point(0.5);
  FieldRecord& fields = design.fields;
  fields = {};
  fields.mesh.kind = fem::ElementKind::wedge18;
  fields.mesh.regions = {{.name = "blade_root"}};
  fields.mesh.nodes.resize(3, kHeights * kNodes);
  const double size = 1e-3;
  const Eigen::Matrix<double, 2, kNodes> triangle{{0, -size, 0, -size / 2, -size / 2, 0},
                                                  {0, 0, -size, 0, -size / 2, -size / 2}};
  for (int h = 0; h < kHeights; ++h) {
    const double z = 5e-3 * (h - kHeights / 2);
    for (int i = 0; i < kNodes; ++i)
      fields.mesh.nodes.col(h * kNodes + i) << fillet + triangle.col(i) + Eigen::Vector2d(z, 0), z;
    fields.flank_nodes.push_back(h * kNodes + 1);
    fields.flank_cells.push_back(0);
  }
  for (int layer = 0; layer < 2; ++layer) {
    for (int i = 0; i < 18; ++i) fields.mesh.connectivity.push_back(2 * layer * kNodes + i);
    fields.mesh.region.push_back(0);
  }
  fields.von_mises_pa.assign(kHeights * kNodes, 1e8);
  fields.von_mises_pa[static_cast<std::size_t>(worst_height * kNodes)] = 3e8;
  fields.von_mises_pa[1] = 9e8;  // on the flank: not bounded
  return design;
}

TEST(StressCut, IsWhereAFilletIsLoadedMost) {
  for (int h = 0; h < kHeights; ++h) {
    const DesignRecord design = wedges(h);
    const std::optional<StressCut> cut = worst_cut(design, joint_window(design));
    ASSERT_TRUE(cut && cut->peak && cut->height) << h;
    EXPECT_NEAR(*cut->height, 5e-3 * (h - kHeights / 2), 1e-12);
    EXPECT_EQ(cut->peak->value, 3e8);
    // Where it would be in the middle section; the face of two elements is there once, in quarters.
    const Eigen::Vector2d fillet = geometry::edge(design.profile.blade, "neck_fillet_right").point(0.5);
    EXPECT_LT((cut->peak->at - fillet).norm(), 1e-12);
    EXPECT_EQ(cut->triangles.size(), 4U);
    EXPECT_EQ(cut->peak_place(design.profile), "blade, neck fillet right");
  }
}

TEST(StressCut, IsDrawnWithItsPlaceAndPeak) {
  const DesignRecord start = wedges(1), best = wedges(3);
  const std::string figures = stress_figures({.before = &start, .after = &best});
  EXPECT_EQ(markup_error(figures), "");
  EXPECT_THAT(figures, HasSubstr("Stress after spin-up, before"));
  EXPECT_THAT(figures, HasSubstr("Cut across the slot \u22125\u00a0mm along the axis"));
  EXPECT_THAT(figures, HasSubstr("Cut across the slot 5\u00a0mm along the axis"));
  EXPECT_THAT(figures, HasSubstr(">300\u00a0MPa</text>"));
  EXPECT_THAT(figures, HasSubstr("class=\"ring\""));
}

TEST(StressCut, OfNoStressIsNothing) {
  DesignRecord design = wedges(2);
  design.fields = {};
  EXPECT_FALSE(worst_cut(design, joint_window(design)));
  EXPECT_EQ(stress_figures({.before = nullptr, .after = &design}), "");
  // A record without nodes on flanks has no heights to cut at.
  design = wedges(2);
  design.fields.flank_nodes.clear();
  EXPECT_FALSE(worst_cut(design, joint_window(design)));
}

}  // namespace
}  // namespace dovetail::report
