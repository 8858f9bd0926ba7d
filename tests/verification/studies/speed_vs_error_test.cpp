// The quick form of studies/speed_vs_error: its diagrams hold what they show, and its files say the same.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "studies/work_precision/diagrams.hpp"
#include "studies/work_precision/results.hpp"
#include "tests/verification/studies/page_charts.hpp"

namespace dovetail::work_precision {
namespace {

const Results& quick_results() {
  static const Results results = [] {
    const DiagramOptions options{.study_file = QUICKSTART, .quick = true};
    Results made;
    made.made = circumstances();
    made.made.commit = "0123abc";
    made.made.quick = true;
    made.diagrams = {patch_diagram(options), scene_diagram(options)};
    made.growth = measure_growth(true, {});
    return made;
  }();
  return results;
}

const Sweep& sweep(const Diagram& diagram, SweepKey key) {
  return *std::ranges::find(diagram.sweeps, key, &Sweep::key);
}

std::size_t failed_runs() {
  std::size_t failed = 0;
  for (const Diagram& diagram : quick_results().diagrams)
    for (const Sweep& one : diagram.sweeps)
      for (const Line& line : one.lines)
        failed += static_cast<std::size_t>(
            std::ranges::count_if(line.points, [](const Point& point) { return !point.run.converged(); }));
  return failed;
}

std::size_t occurrences(const std::string& text, const std::string& of) {
  std::size_t count = 0;
  for (std::size_t at = text.find(of); at != std::string::npos; at = text.find(of, at + of.size())) ++count;
  return count;
}

TEST(SpeedVsError, ReferencesAgreeBetterThanFewHarmonicsErr) {
  for (const Diagram& diagram : quick_results().diagrams) {
    ASSERT_TRUE(diagram.reference.run.converged() && diagram.reference.check.converged()) << diagram.key;
    const Point& at = sweep(diagram, SweepKey::harmonics).lines[0].points.front();
    // Energy, the quantity that converges slowest.
    EXPECT_LT(diagram.reference.agreement[1], at.error[1]) << diagram.key;
  }
}

TEST(SpeedVsError, ErrorsFallWithHarmonicsAndMesh) {
  const std::vector<Point>& harmonics = sweep(quick_results().diagrams[0], SweepKey::harmonics).lines[0].points;
  for (std::size_t q = 0; q < 3; ++q) EXPECT_LT(harmonics.back().error[q], harmonics.front().error[q]) << q;
  const std::vector<Point>& mesh = sweep(quick_results().diagrams[1], SweepKey::mesh).lines[0].points;
  EXPECT_LT(mesh.back().error[0], mesh.front().error[0]);
}

TEST(SpeedVsError, EverySweepOverItsSettingHoldsTheDefault) {
  for (const Diagram& diagram : quick_results().diagrams)
    for (const Sweep& one : diagram.sweeps) {
      bool found = false;
      for (const Line& line : one.lines) found = found || std::ranges::any_of(line.points, &Point::is_default);
      EXPECT_TRUE(found) << diagram.key << " " << to_string(one.key);
      EXPECT_NE(verdict(one, kGoal).find("Default"), std::string::npos) << verdict(one, kGoal);
    }
}

TEST(SpeedVsError, DrawsEveryRunAlsoTheFailedOnes) {
  const std::string page = page_html(quick_results());
  ASSERT_GT(failed_runs(), 0U);
  EXPECT_EQ(failures_drawn(page), 3 * failed_runs());  // a cross for each quantity
  EXPECT_EQ(occurrences(page, "http-equiv") + occurrences(page, "<script src") + occurrences(page, "<link"), 0U);
  EXPECT_EQ(occurrences(page, "\"nan") + occurrences(page, " nan ") + occurrences(page, ">nan<"), 0U);
  EXPECT_EQ(occurrences(page, "<figure"), occurrences(page, "</figure>"));
}

TEST(SpeedVsError, WritesTablesThatAgree) {
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / "dovetail_speed_vs_error";
  write(folder, quick_results());
  std::ifstream csv(folder / "table.csv");
  std::string line;
  std::getline(csv, line);
  const auto columns = std::ranges::count(line, ',');
  std::size_t rows = 0;
  while (std::getline(csv, line)) {
    ++rows;
    EXPECT_GE(std::ranges::count(line, ','), columns) << line;
  }
  std::stringstream text;
  text << std::ifstream(folder / "table.json").rdbuf();
  const nlohmann::json json = nlohmann::json::parse(text.str());
  std::size_t points = 0;
  for (const auto& model : json.at("models"))
    for (const auto& one : model.at("sweeps"))
      for (const auto& drawn : one.at("lines")) points += drawn.at("points").size();
  EXPECT_EQ(rows, points);
  EXPECT_EQ(json.at("commit"), "0123abc");
  EXPECT_FALSE(json.at("machine").get<std::string>().empty());
  EXPECT_EQ(json.at("newton_step").size(), 3U);
  EXPECT_GT(std::filesystem::file_size(folder / "index.html"), 10000U);
  EXPECT_GT(std::filesystem::file_size(folder / "growth.csv"), 100U);
  std::filesystem::remove_all(folder);
}

TEST(SpeedVsError, MeasuresEveryPartOfANewtonStep) {
  for (const Growth& growth : quick_results().growth)
    for (const StepTimes& times : growth.times) {
      ASSERT_EQ(times.status, Status::converged) << growth.key;
      EXPECT_GT(times.residual, 0);
      EXPECT_GT(times.derivative, 0);
      // No comparison of times: the machine may be busy.
      EXPECT_GT(times.step, 0);
      EXPECT_LT(times.factorised, times.unknowns);
    }
}

}  // namespace
}  // namespace dovetail::work_precision
