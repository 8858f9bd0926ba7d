// The quick form of whole evaluations in studies/speed_vs_error: fronts, choices, failures, tables and page.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

#include "studies/work_precision/evaluations/figures.hpp"
#include "studies/work_precision/evaluations/measured_scenes.hpp"
#include "studies/work_precision/evaluations/page.hpp"
#include "studies/work_precision/evaluations/paper.hpp"
#include "studies/work_precision/evaluations/tables.hpp"
#include "studies/work_precision/evaluations/verdicts.hpp"
#include "tests/verification/studies/page_charts.hpp"

namespace dovetail::work_precision {
namespace {

int told = 0;  // times that what there is so far was handed over

const std::vector<WholeDiagram>& quick_designs() {
  static const std::vector<WholeDiagram> designs =
      measure_section(QUICKSTART, true, {}, [](const std::vector<WholeDiagram>&) { ++told; });
  return designs;
}

std::size_t count_of(const std::string& text, const std::string& of) {
  std::size_t count = 0;
  for (std::size_t at = text.find(of); at != std::string::npos; at = text.find(of, at + of.size())) ++count;
  return count;
}

std::vector<std::string> responses_and_worst(const WholeDiagram& diagram) {
  std::vector<std::string> names{kWorst};
  for (const auto& [name, error] : diagram.reference.check.error) names.push_back(name);
  return names;
}

/// A setting as it might have been measured.
WholePoint made_up(double mesh, int harmonics, double seconds, double worst) {
  WholePoint point{.label = "made up", .run = {.setting = {}, .status = "converged"}};
  point.run.setting.mesh = mesh;
  point.run.setting.harmonics = harmonics;
  point.run.seconds = seconds;
  point.worst = worst;
  return point;
}

void reference_has_no_error_against_itself() {
  for (const WholeDiagram& diagram : quick_designs()) {
    ASSERT_TRUE(diagram.reference.finest.run.converged() && diagram.reference.check.run.converged()) << diagram.key;
    for (const auto& [name, error] : diagram.reference.finest.error) EXPECT_EQ(error, 0) << name;
    EXPECT_EQ(diagram.reference.finest.worst, 0);
    EXPECT_GT(diagram.agreement(), 0) << diagram.key;
  }
}

void front_falls_and_nothing_beats_it() {
  for (const WholeDiagram& diagram : quick_designs())
    for (const std::string& response : responses_and_worst(diagram)) {
      const std::vector<const WholePoint*> best = front(diagram, response);
      ASSERT_FALSE(best.empty()) << response;
      for (std::size_t i = 1; i < best.size(); ++i) {
        EXPECT_GE(best[i]->run.seconds, best[i - 1]->run.seconds);
        EXPECT_LT(error_of(*best[i], response), error_of(*best[i - 1], response));
      }
      for (const WholePoint* point : diagram.points()) {
        const double error = error_of(*point, response);
        if (std::isnan(error)) continue;
        EXPECT_TRUE(std::ranges::any_of(best, [&](const WholePoint* on) {
          return on->run.seconds <= point->run.seconds && error_of(*on, response) <= error;
        })) << point->label;
      }
    }
}

void automatic_choice_stands_beside_the_front() {
  for (const WholeDiagram& diagram : quick_designs()) {
    ASSERT_EQ(diagram.automatic.size(), 1U);
    const AutomaticChoice& choice = diagram.automatic.front();
    EXPECT_FALSE(choice.rounds.empty());
    EXPECT_GT(choice.seconds, 0);
    ASSERT_TRUE(choice.point.run.converged()) << choice.point.run.status;
    const Comparison comparison = compare(diagram, choice);
    ASSERT_NE(comparison.for_error, nullptr);
    // It is a point like any other, so nothing on the front that errs as little takes longer.
    EXPECT_GE(comparison.factor_error, 1);
    if (choice.point.worst <= choice.asked) {
      EXPECT_GE(comparison.factor_asked, 1);
    }
    EXPECT_NE(choice_verdict(diagram, choice).find("factor"), std::string::npos);
    for (const WholePoint* point : diagram.points())
      if (point->run.converged()) {
        EXPECT_GE(steady_error(diagram, *point), point->worst);
      }
  }
}

TEST(WholeEvaluations, CheapestSettingsAreThoseThatErrByNoMore) {
  WholeDiagram diagram;
  // The first errs little by chance: with more harmonics it errs more.
  diagram.lines.push_back(
      {.key = WholeSweep::combinations,
       .points = {made_up(1, 3, 1, 0.01), made_up(1, 5, 2, 0.04), made_up(2, 5, 4, 0.015), made_up(2, 7, 6, 0.012)}});
  EXPECT_EQ(cheapest(diagram, kWorst, 0.02)->run.seconds, 1);
  EXPECT_EQ(cheapest_steady(diagram, 0.02)->run.seconds, 4);
  EXPECT_EQ(cheapest(diagram, kWorst, 0.001), nullptr);
  EXPECT_EQ(front(diagram, kWorst).size(), 1U);
  AutomaticChoice choice{.asked = 0.02, .point = made_up(2, 7, 6, 0.012)};
  const Comparison comparison = compare(diagram, choice);
  EXPECT_EQ(comparison.factor_asked, 6);
  EXPECT_EQ(comparison.factor_steady, 1.5);
}

void the_papers_settings_are_among_the_points() {
  for (const WholeDiagram& diagram : quick_designs()) {
    const WholePoint* paper = diagram.paper();
    ASSERT_NE(paper, nullptr);
    EXPECT_EQ(paper->run.setting.harmonics, 3);
    EXPECT_EQ(paper->run.setting.samples, 128);
    EXPECT_EQ(paper->run.setting.solver, steady::Solver::powell);
    EXPECT_NE(paper_verdict(diagram).find("paper's settings"), std::string::npos);
  }
}

void failures_are_drawn_and_kept() {
  WholeDiagram diagram = quick_designs().front();
  const std::size_t failed_before = count_of(evaluations_csv({diagram}), "preload: iteration_limit");
  WholePoint& point = diagram.lines.front().points.front();
  point.run.status = "preload: iteration_limit";
  judge(diagram);
  EXPECT_TRUE(std::isnan(point.worst));
  for (const WholePoint* on : front(diagram, kWorst)) EXPECT_NE(on, &point);
  EXPECT_EQ(count_of(evaluations_csv({diagram}), "preload: iteration_limit"), failed_before + 1);
  std::size_t drawings = 1;  // of the worst
  for (const auto& [name, error] : diagram.reference.check.error) drawings += errs(diagram, name);
  const std::string page = evaluations_html({diagram});
  EXPECT_GE(failures_drawn(page), drawings);  // a cross in each
  EXPECT_NE(page.find("preload: iteration_limit"), std::string::npos);
}

void page_shows_every_response_that_errs() {
  const std::string page = evaluations_html(quick_designs());
  EXPECT_EQ(count_of(page, "<section"), quick_designs().size());
  EXPECT_EQ(count_of(page, "<figure"), count_of(page, "</figure>"));
  EXPECT_GT(count_of(page, "\"shaded_below\":"), 3U);
  EXPECT_EQ(count_of(page, "\"nan") + count_of(page, " nan ") + count_of(page, ">nan<"), 0U);
}

void tables_hold_every_point() {
  const std::vector<WholeDiagram>& designs = quick_designs();
  std::size_t points = 0;
  for (const WholeDiagram& diagram : designs) points += diagram.points().size() + 2;
  std::stringstream csv(evaluations_csv(designs));
  std::string line;
  std::getline(csv, line);
  EXPECT_NE(line.find("error_asymptotic_wear_volume_m3"), std::string::npos);
  EXPECT_NE(line.find("asymptote_s"), std::string::npos);
  std::size_t rows = 0;
  while (std::getline(csv, line)) ++rows;
  EXPECT_EQ(rows, points);
  const nlohmann::ordered_json json = evaluations_json(designs);
  std::size_t kept = 0;
  for (const auto& design : json) {
    kept += 2 + design.at("automatic").size();
    for (const auto& swept : design.at("lines")) kept += swept.at("points").size();
    EXPECT_TRUE(design.at("fronts").contains("worst"));
    EXPECT_TRUE(design.at("automatic")[0].at("factor_for_asked").is_number());
  }
  EXPECT_EQ(kept, points);
}

void drawn_designs_are_others() {
  ASSERT_EQ(quick_designs().size(), 3U);
  EXPECT_TRUE(quick_designs()[0].variables.empty());
  EXPECT_FALSE(quick_designs()[1].variables.empty());
  EXPECT_NE(quick_designs()[1].variables, quick_designs()[2].variables);
  EXPECT_GT(told, 15);
}

// In one test, as each test is a process of its own, and the quick form takes half a minute.
TEST(WholeEvaluations, QuickFormHoldsWhatItShows) {
  reference_has_no_error_against_itself();
  front_falls_and_nothing_beats_it();
  automatic_choice_stands_beside_the_front();
  the_papers_settings_are_among_the_points();
  failures_are_drawn_and_kept();
  page_shows_every_response_that_errs();
  tables_hold_every_point();
  drawn_designs_are_others();
}

}  // namespace
}  // namespace dovetail::work_precision
