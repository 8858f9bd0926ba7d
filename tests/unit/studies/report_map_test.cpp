#include "studies/report/plots/report_plots.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <regex>

#include "tests/unit/studies/report_markup.hpp"

namespace dovetail::report {
namespace {

using testing::HasSubstr;

/// Two flanks of 3 nodes along and 4 across, unevenly spaced; values 0, 1, 2, ... MPa.
FlankMap sample() {
  FlankMap map{.title = "Pressure <&>", .quantity = "pressure", .unit = {.symbol = "MPa", .si = 1e6}};
  double value = 0;
  for (const char* name : {"left flank", "right flank"}) {
    FlankPanel panel{.name = name};
    for (const double z : {-20e-3, -15e-3, 3e-3, 20e-3})
      for (const double s : {0.0, 1e-3, 5.5e-3}) {
        panel.across.push_back(z);
        panel.along.push_back(s);
        panel.values.push_back(1e6 * value++);
      }
    map.panels.push_back(panel);
  }
  return map;
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

/// Areas of the cells of a drawing and of the frames around them, in pixels.
std::pair<double, double> areas(const std::string& svg) {
  const std::regex sizes("width=\"([0-9.]+)\" height=\"([0-9.]+)\" fill=\"(#[0-9a-f]{6}|none)\"[^>]*>(<title>)?");
  double cells = 0, frames = 0;
  for (std::sregex_iterator it(svg.begin(), svg.end(), sizes), end; it != end; ++it) {
    const double area = std::stod((*it)[1]) * std::stod((*it)[2]);
    if ((*it)[4].matched)
      cells += area;
    else if ((*it)[3] == "none")
      frames += area;
  }
  return {cells, frames};
}

constexpr double kWritten = 1e-3;  // coordinates are written to 0.01

TEST(FlankMap, CellsTileEachFlank) {
  const std::string svg = flank_map_svg(sample());
  EXPECT_EQ(markup_error(svg), "");
  EXPECT_EQ(count(svg, "</title></rect>"), 24U);
  const auto [cells, frames] = areas(svg);
  EXPECT_NEAR(cells, frames, kWritten * frames);
}

TEST(FlankMap, CellsOfStripsThatAreDividedDifferentlyTileEachFlank) {
  FlankMap map{.title = "Depth", .quantity = "depth", .unit = {.symbol = "um", .si = 1e-6}};
  FlankPanel panel{.name = "left flank"};
  const auto add = [&panel](double z, const std::vector<double>& ends) {
    for (std::size_t k = 0; k + 1 < ends.size(); ++k) {
      panel.across.push_back(z);
      panel.along.push_back((ends[k] + ends[k + 1]) / 2);
      panel.values.push_back(1e-6 * static_cast<double>(panel.values.size()));
    }
  };
  add(-1e-2, {0, 1e-3, 1.3e-3, 5e-3});
  add(0, {0, 0.2e-3, 2e-3, 3e-3, 5e-3});
  add(1e-2, {0, 5e-3});
  map.panels.push_back(panel);
  const std::string svg = flank_map_svg(map);
  EXPECT_EQ(count(svg, "</title></rect>"), 8U);
  const auto [cells, frames] = areas(svg);
  EXPECT_NEAR(cells, frames, kWritten * frames);
}

TEST(FlankMap, ShowsNumbersInTheUnit) {
  const std::string figure = figure_html(sample());
  EXPECT_EQ(markup_error(figure), "");
  EXPECT_THAT(figure, HasSubstr("<title>20.0 mm, 5.50 mm: 23.00 MPa</title>"));
  EXPECT_THAT(figure, HasSubstr("<td>right flank</td><td>20</td><td>5.5</td><td>23.000</td>"));
  EXPECT_THAT(figure, HasSubstr("Pressure &lt;&amp;&gt;"));
}

TEST(FlankMap, LargestValueIsDarkestAndUnknownOnesStayPaper) {
  FlankMap map = sample();
  map.panels[0].values[0] = std::numeric_limits<double>::quiet_NaN();
  const std::string svg = flank_map_svg(map);
  EXPECT_EQ(count(svg, "fill=\"#3e134b\"><title>"), 1U);
  EXPECT_EQ(count(svg, "fill=\"var(--hair)\"><title>"), 1U);
}

TEST(FlankMap, WithoutValuesIsASentence) {
  FlankMap map = sample();
  for (FlankPanel& panel : map.panels) panel.values.assign(panel.values.size(), 0.0);
  EXPECT_TRUE(is_empty(map));
  EXPECT_THAT(figure_html(map), HasSubstr("Nothing to show"));
}

/// A joint in space: two flanks of 3 nodes along and 2 lines, deepest on the second line of the right flank.
DesignRecord design_in_space() {
  DesignRecord design;
  ContactRecord& c = design.contact;
  c.flank_names = {"left", "right"};
  for (int flank = 0; flank < 2; ++flank)
    for (const double z : {-1e-2, 1e-2})
      for (const double s : {0.0, 2e-3, 5e-3}) {
        c.flank.push_back(flank);
        c.along_m.push_back(s);
        c.across_m.push_back(z);
        c.depth_m.push_back(flank == 1 && z > 0 && s == 0 ? 3e-6 : 1e-6);
        c.preload_pressure_pa.push_back(1e8);
      }
  return design;
}

TEST(FlankMap, ShowsTheContactOfADesignInSpaceOnly) {
  DesignRecord design = design_in_space();
  const std::vector<Figure> maps = contact_maps(design);
  ASSERT_EQ(maps.size(), 2U);
  const FlankMap& depth = std::get<FlankMap>(maps[0]);
  EXPECT_EQ(depth.unit.symbol, "\u00b5m");
  ASSERT_EQ(depth.panels.size(), 2U);
  EXPECT_EQ(depth.panels[1].values[3], 3e-6);
  design.contact.across_m.assign(design.contact.flank.size(), 0.0);
  EXPECT_TRUE(contact_maps(design).empty());
  design.contact.across_m.clear();
  EXPECT_TRUE(contact_maps(design).empty());
}

TEST(WorstLine, IsTheLineAlongTheFlankWithTheLargestValue) {
  const ContactRecord c = design_in_space().contact;
  EXPECT_THAT(worst_line(c.flank, c.across_m, c.depth_m, 1), testing::ElementsAre(9, 10, 11));
  EXPECT_THAT(worst_line(c.flank, {}, c.depth_m, 0), testing::ElementsAre(0, 1, 2, 3, 4, 5));
  EXPECT_TRUE(worst_line(c.flank, c.across_m, c.depth_m, 2).empty());
}

}  // namespace
}  // namespace dovetail::report
