#include "studies/report/plots/figure.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "studies/report/words/units.hpp"
#include "tests/unit/studies/report_markup.hpp"

namespace dovetail::report {
namespace {

using testing::HasSubstr;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

TEST(Units, AreThoseEngineersRead) {
  EXPECT_EQ(readable_unit("m", 4.9e-6).symbol, "\u00b5m");
  EXPECT_EQ(readable_unit("m", 7.9e-3).symbol, "mm");
  EXPECT_EQ(readable_unit("m^3", 7.8e-10).symbol, "mm\u00b3");
  EXPECT_EQ(readable_unit("Pa", 1.9e8).symbol, "MPa");
  EXPECT_EQ(readable_unit("Hz", 490).symbol, "Hz");
  EXPECT_EQ(readable_unit("kg", 0.118).symbol, "g");
  EXPECT_EQ(words("asymptotic_wear_volume_m3"), "asymptotic wear volume");
  EXPECT_EQ(words("initial_wear_rate_m3_per_cycle"), "initial wear rate");
  EXPECT_EQ(words("contact_pressure_max_pa"), "largest contact pressure");
  EXPECT_EQ(key_words("geometry.left.flank_angle_deg"), "flank angle, left");
  EXPECT_EQ(key_unit("geometry.flank_mismatch_um"), "\u00b5m");
}

TEST(Numbers, AreRoundedToTheirError) {
  const Unit millimetre{.symbol = "mm", .si = 1e-3};
  EXPECT_EQ(with_error(6.695e-3, 3.6e-5, millimetre), "6.695 \u00b1 0.036\u00a0mm");
  EXPECT_EQ(with_error(6.695e-3, 1.2e-3, millimetre), "6.7 \u00b1 1.2\u00a0mm");
  EXPECT_EQ(with_error(0.25, 0.0123, millimetre), "250 \u00b1 12\u00a0mm");
  EXPECT_EQ(with_error(1e-3, std::numeric_limits<double>::infinity(), millimetre), "1.000 \u00b1 \u221e\u00a0mm");
  EXPECT_EQ(with_error(1e-3, kNaN, millimetre), "1.000\u00a0mm");
  EXPECT_EQ(with_error(490.123456789, 0.01, {.symbol = "Hz", .si = 1}), "490.123 \u00b1 0.010\u00a0Hz");
  EXPECT_EQ(with_error(490.123456789, 1e-3, {.symbol = "Hz", .si = 1}), "490.12\u00a0Hz");  // nobody would see it
}

TEST(Numbers, AreShortAndExact) {
  EXPECT_EQ(significant(0.00012345, 3), "0.000123");
  EXPECT_EQ(significant(-1.5e-7, 2), "\u22121.5\u00d710\u207b\u2077");
  EXPECT_EQ(significant(160354, 2), "160000");
  EXPECT_EQ(significant(999.96, 4), "1000");
  EXPECT_EQ(significant(kNaN), "\u2013");
  EXPECT_EQ(plain(9.0), "9");
  EXPECT_EQ(plain(-0.25), "\u22120.25");
  EXPECT_EQ(plain(100), "100");
}

TEST(Numbers, DifferInPerCentOrInTheirUnit) {
  EXPECT_EQ(difference(2e-3, 3e-3, {.symbol = "mm", .si = 1e-3}), "+50.0\u00a0%");
  EXPECT_EQ(difference(-1e-3, 1e-3, {.symbol = "mm", .si = 1e-3}), "+2.00\u00a0mm");
  EXPECT_EQ(difference(1e-3, 1e-3 + 1e-12, {.symbol = "mm", .si = 1e-3}), "none");
  // Of what is in per cent a part would be read as per cent of it.
  EXPECT_EQ(difference(1e-3, 1.833e-3, {.symbol = "%", .si = 0.01}), "+0.0833 percentage points");
}

Plot sample_plot() {
  Plot plot{.title = "A \"title\" with <marks> & more",
            .description = "x < y",
            .x = {.label = "position", .unit = "mm"},
            .y = {.label = "depth & width", .unit = "\u00b5m"}};
  plot.series = {{.name = "one <line>", .x = {0, 1, 2, 3}, .y = {1, kNaN, 2, 3}, .mark = Mark::dot},
                 {.name = "two", .x = {0, 1, 2, 3}, .y = {0, 1, 2, 5}, .stroke = Stroke::dashed, .steps = true},
                 {.name = "best", .x = {1}, .y = {2}, .stroke = Stroke::none, .mark = Mark::star, .titles = {"<b>"}},
                 {.name = "cross", .x = {2}, .y = {2}, .stroke = Stroke::none, .mark = Mark::cross},
                 {.name = "triangle", .x = {3}, .y = {kNaN}, .stroke = Stroke::none, .mark = Mark::triangle}};
  plot.levels = {{.name = "at most 4 & so", .y = 4}};
  return plot;
}

/// What the script of the page gets to draw.
nlohmann::json data_of(const std::string& chart) {
  const std::string open = "<script type=\"application/json\">";
  const std::size_t from = chart.find(open) + open.size();
  return nlohmann::json::parse(chart.substr(from, chart.find("</script>", from) - from));
}

TEST(Plot, IsWellFormedAndNamed) {
  const std::string figure = figure_html(sample_plot());
  EXPECT_EQ(markup_error(figure), "");
  EXPECT_THAT(figure, HasSubstr("data-title=\"A &quot;title&quot; with &lt;marks&gt; &amp; more\""));
  EXPECT_THAT(figure, HasSubstr("<table>"));
  EXPECT_THAT(figure, HasSubstr("one &lt;line&gt; (\u00b5m)"));
}

TEST(Plot, HandsItsDataToTheScript) {
  const std::string chart = chart_html(sample_plot());
  const nlohmann::json data = data_of(chart);
  EXPECT_EQ(data["x"]["label"], "position");
  EXPECT_EQ(data["y"]["unit"], "\u00b5m");
  ASSERT_EQ(data["series"].size(), 5U);
  EXPECT_EQ(data["series"][0]["name"], "one <line>");
  EXPECT_EQ(data["series"][1]["stroke"], "dashed");
  EXPECT_EQ(data["series"][2]["mark"], "star");
  EXPECT_EQ(data["series"][2]["titles"][0], "<b>");
  EXPECT_EQ(data["levels"][0]["name"], "at most 4 & so");
  // No name may end the element.
  EXPECT_EQ(chart.find("<line>"), std::string::npos);
}

TEST(Plot, LeavesOutWhatHasNoPlace) {
  Plot plot = sample_plot();
  plot.x.logarithmic = true;
  const nlohmann::json data = data_of(chart_html(plot));
  EXPECT_TRUE(data["series"][0]["points"][0].is_null());  // x is 0
  EXPECT_TRUE(data["series"][0]["points"][1].is_null());  // y is not known
  EXPECT_EQ(data["series"][0]["points"][3], (nlohmann::json{3.0, 3.0}));
}

TEST(Plot, GivesItsNumbersAsATable) {
  const std::string csv = figure_csv(sample_plot());
  EXPECT_THAT(csv, testing::StartsWith("\"line\",\"position (mm)\",\"depth & width (\u00b5m)\"\n\"one <line>\",0,1\n"));
  EXPECT_THAT(csv, HasSubstr("\"one <line>\",1,\n"));  // what is not known is empty
  EXPECT_THAT(csv, HasSubstr("\"best\",1,2\n"));
}

TEST(Plot, WithoutNumbersIsASentence) {
  Plot plot = sample_plot();
  plot.series.resize(1);
  plot.series[0].y.assign(4, kNaN);
  EXPECT_TRUE(is_empty(plot));
  EXPECT_THAT(figure_html(plot), HasSubstr("Nothing to show"));
  EXPECT_FALSE(is_empty(sample_plot()));
}

TEST(Plot, OfNothingButZerosIsItsSentence) {
  Plot plot = sample_plot();
  plot.at_zero = "Nothing wears.";
  EXPECT_FALSE(is_empty(plot));
  for (Series& series : plot.series) series.y.assign(series.y.size(), 0.0);
  EXPECT_TRUE(is_empty(plot));
  EXPECT_THAT(figure_html(plot), HasSubstr("<p>Nothing wears.</p>"));
  plot.at_zero.clear();
  EXPECT_FALSE(is_empty(plot));
}

}  // namespace
}  // namespace dovetail::report
