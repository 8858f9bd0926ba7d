#include "studies/report/plots/figure.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <set>

#include "studies/report/plots/ticks.hpp"
#include "studies/report/words/units.hpp"
#include "tests/unit/studies/report_markup.hpp"

namespace dovetail::report {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

TEST(Ticks, AreRoundAndCoverTheRange) {
  const Ticks ticks = linear_ticks(0.03, 0.97, 5);
  EXPECT_THAT(ticks.labels, ElementsAre("0.0", "0.2", "0.4", "0.6", "0.8", "1.0"));
  EXPECT_EQ(ticks.lower, 0);
  EXPECT_EQ(ticks.upper, 1);
  EXPECT_THAT(linear_ticks(-3, 4, 4).labels, ElementsAre("\u22124", "\u22122", "0", "2", "4"));
  EXPECT_THAT(linear_ticks(490.18, 490.22, 4).labels, ElementsAre("490.18", "490.19", "490.20", "490.21", "490.22"));
}

TEST(Ticks, KeepTheRangeWhenTight) {
  const Ticks ticks = linear_ticks(0.3, 5.5, 6, true);
  EXPECT_EQ(ticks.lower, 0.3);
  EXPECT_EQ(ticks.upper, 5.5);
  EXPECT_THAT(ticks.labels, ElementsAre("1", "2", "3", "4", "5"));
}

TEST(Ticks, WidenASinglePoint) {
  for (const double value : {0.0, 1.0, -7e-9, 3e12}) {
    const Ticks ticks = linear_ticks(value, value, 5);
    EXPECT_LT(ticks.lower, value);
    EXPECT_GT(ticks.upper, value);
    EXPECT_GE(ticks.at.size(), 2U);
  }
}

TEST(Ticks, HoldForAnyRange) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> exponent(-12, 12), sign(-1, 1);
  for (int i = 0; i < 2000; ++i) {
    const double a = sign(random) * std::pow(10, exponent(random)), b = sign(random) * std::pow(10, exponent(random));
    const bool tight = i % 2 == 0;
    const Ticks ticks = linear_ticks(std::min(a, b), std::max(a, b), 5, tight);
    EXPECT_LE(ticks.lower, std::min(a, b));
    EXPECT_GE(ticks.upper, std::max(a, b));
    // A step of a nice number is at most 2.5 times the rough one and at least it.
    EXPECT_GE(ticks.at.size(), 2U) << a << " " << b;
    EXPECT_LE(ticks.at.size(), 8U) << a << " " << b;
    EXPECT_EQ(std::set<std::string>(ticks.labels.begin(), ticks.labels.end()).size(), ticks.labels.size());
    for (std::size_t k = 0; k < ticks.at.size(); ++k) {
      EXPECT_GE(ticks.at[k], ticks.lower);
      EXPECT_LE(ticks.at[k], ticks.upper);
      if (k > 0) {
        EXPECT_GT(ticks.at[k], ticks.at[k - 1]);
      }
    }
  }
}

TEST(Ticks, OfALogarithmicAxisArePowers) {
  EXPECT_THAT(logarithmic_ticks(2e-3, 3e2).labels, ElementsAre("0.001", "0.01", "0.1", "1", "10", "100", "1000"));
  EXPECT_THAT(logarithmic_ticks(3, 30).labels, ElementsAre("1", "2", "5", "10", "20", "50", "100"));
  EXPECT_THAT(logarithmic_ticks(1e3, 1e6).labels, ElementsAre("1000", "10\u2074", "10\u2075", "10\u2076"));
  EXPECT_THAT(logarithmic_ticks(1, 1).labels.size(), testing::Ge(2U));
}

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
  EXPECT_EQ(with_error(490.123456789, 1e-9, {.symbol = "Hz", .si = 1}),
            "490.1235 \u00b1 1.0\u00d710\u207b\u2079\u00a0Hz");
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

TEST(Plot, IsWellFormedAndNamed) {
  const std::string svg = plot_svg(sample_plot());
  EXPECT_EQ(markup_error(svg), "");
  EXPECT_THAT(svg, HasSubstr("role=\"img\""));
  EXPECT_THAT(svg, HasSubstr("aria-label=\"A &quot;title&quot; with &lt;marks&gt; &amp; more\""));
  EXPECT_THAT(svg, HasSubstr("<title>&lt;b&gt;</title>"));
  const std::string figure = figure_html(sample_plot());
  EXPECT_EQ(markup_error(figure), "");
  EXPECT_THAT(figure, HasSubstr("<table>"));
  EXPECT_THAT(figure, HasSubstr("one &lt;line&gt; (\u00b5m)"));
}

TEST(Plot, BreaksLinesWhereNothingIsKnown) {
  const std::string svg = plot_svg(sample_plot());
  const std::size_t path = svg.find("<path class=\"line after solid\"");
  const std::string data = svg.substr(path, svg.find("/>", path) - path);
  EXPECT_EQ(std::count(data.begin(), data.end(), 'M'), 2);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
}

TEST(Plot, StaysWithinItsAxes) {
  Plot plot = sample_plot();
  plot.x.logarithmic = true;  // drops the point at 0
  plot.y.from_zero = true;
  const std::string svg = plot_svg(plot);
  EXPECT_EQ(markup_error(svg), "");
  EXPECT_EQ(svg.find("inf"), std::string::npos);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
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
  EXPECT_EQ(plot_svg(plot), "");
  EXPECT_THAT(figure_html(plot), HasSubstr("Nothing to show"));
  EXPECT_FALSE(is_empty(sample_plot()));
}

}  // namespace
}  // namespace dovetail::report
