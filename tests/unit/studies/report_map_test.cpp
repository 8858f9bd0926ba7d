#include "studies/report/plots/report_plots.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

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

/// Cells of all panels: place along the slot and from the neck side, ends along the slot, ends from the neck side in
/// mm, value.
std::vector<nlohmann::json> cells_of(const std::string& chart) {
  const std::string open = "<script type=\"application/json\">";
  const std::size_t from = chart.find(open) + open.size();
  std::vector<nlohmann::json> cells;
  const auto data = nlohmann::json::parse(chart.substr(from, chart.find("</script>", from) - from));
  for (const nlohmann::json& panel : data["panels"])
    cells.insert(cells.end(), panel["cells"].begin(), panel["cells"].end());
  return cells;
}

/// Areas of all cells together, mm2.
double area_of(const std::vector<nlohmann::json>& cells) {
  double area = 0;
  for (const nlohmann::json& c : cells)
    area += (c[3].get<double>() - c[2].get<double>()) * (c[5].get<double>() - c[4].get<double>());
  return area;
}

constexpr double kWritten = 1e-5;  // seven digits

TEST(FlankMap, CellsTileEachFlank) {
  EXPECT_EQ(markup_error(chart_html(sample())), "");
  const std::vector<nlohmann::json> cells = cells_of(chart_html(sample()));
  ASSERT_EQ(cells.size(), 24U);
  // Strips end half-way between their places at -20, -15, 3 and 20 mm: from -22.5 to 28.5. Along, places at 0, 1 and
  // 5.5 mm end at 0.5 and 3.25: from -0.5 to 7.75.
  EXPECT_NEAR(area_of(cells), 2 * 51 * 8.25, kWritten * 842);
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
  const std::vector<nlohmann::json> cells = cells_of(chart_html(map));
  ASSERT_EQ(cells.size(), 8U);
  EXPECT_NEAR(area_of(cells), 30 * 5, kWritten * 150);
}

TEST(FlankMap, ShowsNumbersInTheUnit) {
  const std::string figure = figure_html(sample());
  EXPECT_EQ(markup_error(figure), "");
  const nlohmann::json last = cells_of(figure).back();
  EXPECT_EQ(last[0], 20.0);
  EXPECT_EQ(last[1], 5.5);
  EXPECT_EQ(last[6], 23.0);
  EXPECT_THAT(figure, HasSubstr("<td>right flank</td><td>20</td><td>5.5</td><td>23.000</td>"));
  EXPECT_THAT(figure, HasSubstr("Pressure &lt;&amp;&gt;"));
  FlankMap map = sample();
  map.panels[0].values[0] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(cells_of(chart_html(map)).front()[6].is_null());
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
  const std::vector<Figure> maps = contact_maps({.before = nullptr, .after = &design});
  ASSERT_EQ(maps.size(), 2U);
  const FlankMap& depth = std::get<FlankMap>(maps[0]);
  EXPECT_EQ(depth.unit.symbol, "\u00b5m");
  ASSERT_EQ(depth.panels.size(), 2U);
  EXPECT_EQ(depth.panels[1].values[3], 3e-6);
  // Beside the start both have the scale of the larger values.
  DesignRecord start = design;
  for (double& worn : start.contact.depth_m) worn *= 5;
  const std::vector<Figure> both = contact_maps({.before = &start, .after = &design});
  ASSERT_EQ(both.size(), 4U);
  EXPECT_EQ(std::get<FlankMap>(both[1]).title, "Wear depth over the flanks, after");
  EXPECT_EQ(std::get<FlankMap>(both[1]).full_scale, 15e-6);
  design.contact.across_m.assign(design.contact.flank.size(), 0.0);
  EXPECT_TRUE(contact_maps({.before = nullptr, .after = &design}).empty());
  design.contact.across_m.clear();
  EXPECT_TRUE(contact_maps({.before = nullptr, .after = &design}).empty());
}

TEST(WorstLine, IsTheLineAlongTheFlankWithTheLargestValue) {
  const ContactRecord c = design_in_space().contact;
  EXPECT_THAT(worst_line(c.flank, c.across_m, c.depth_m, 1), testing::ElementsAre(9, 10, 11));
  EXPECT_THAT(worst_line(c.flank, {}, c.depth_m, 0), testing::ElementsAre(0, 1, 2, 3, 4, 5));
  EXPECT_TRUE(worst_line(c.flank, c.across_m, c.depth_m, 2).empty());
}

}  // namespace
}  // namespace dovetail::report
