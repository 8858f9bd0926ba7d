#include "studies/report/pages/report_html.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <regex>
#include <stdexcept>

#include "studies/report/pages/answers.hpp"
#include "studies/report/pages/page.hpp"
#include "studies/report/plots/report_plots.hpp"
#include "studies/report/record/influence.hpp"
#include "studies/report/words/headline.hpp"
#include "studies/report/words/html.hpp"
#include "studies/report/words/report_words.hpp"
#include "studies/report/words/table.hpp"
#include "studies/report/words/unmet_words.hpp"
#include "tests/unit/studies/report_markup.hpp"
#include "tests/unit/studies/report_sample.hpp"

namespace dovetail::report {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

/// A number that is none, not the middle of a word.
bool has_nan(const std::string& page) {
  return std::regex_search(page, std::regex("(^|[^a-zA-Z])-?nan([^a-zA-Z]|$)"));
}

/// What the page says itself; the names that scripts give their variables are not words.
std::string without_scripts(std::string page) {
  for (std::size_t at = page.find("<script>"); at != std::string::npos; at = page.find("<script>"))
    page.erase(at, page.find("</script>", at) + 9 - at);
  return page;
}

std::vector<std::string> holders(const RunRecord& record) {
  std::vector<std::string> all;
  for (const Holder& by : holding(record)) all.push_back(by.words());
  return all;
}

TEST(ReportWords, SayWhyASearchEnded) {
  RunRecord record = sample_record();
  EXPECT_THAT(ending(record), StartsWith("The search ended: the budget of evaluations is used up. It looked at"));
  record.status = "stalled";
  record.message = "";
  EXPECT_THAT(ending(record), StartsWith("The search stopped early: stalled. It looked at"));
  EXPECT_THAT(ending(record), Not(HasSubstr("finer meshes")));
  record.evaluations[1].constraints = {-0.02};
  record.evaluations[1].rules.clear();
  record.evaluations[1].feasible = false;
  EXPECT_THAT(ending(record), HasSubstr(", of them 1 on finer meshes alone or by what these change, "));
  record.finer.clear();  // refused by a closer look at the start
  EXPECT_THAT(ending(record), Not(HasSubstr("finer meshes")));
}

TEST(Escape, LeavesNothingThatMarkupUnderstands) {
  EXPECT_EQ(escape("a<b>&\"c'"), "a&lt;b&gt;&amp;&quot;c&#39;");
}

TEST(Escape, KeepsTextAndReplacesWhatIsNone) {
  EXPECT_EQ(escape("\u00b5m \u2212 \U0001F600\n\t"), "\u00b5m \u2212 \U0001F600\n\t");
  EXPECT_EQ(escape(std::string("a\0b", 3)), "a\uFFFDb");
  EXPECT_EQ(escape("\xC3"), "\uFFFD");                      // cut short
  EXPECT_EQ(escape("\xC0\xAF"), "\uFFFD\uFFFD");            // overlong '/'
  EXPECT_EQ(escape("\xED\xA0\x80"), "\uFFFD\uFFFD\uFFFD");  // surrogate
}

TEST(MarkupCheck, SeesWhatIsBroken) {
  EXPECT_EQ(markup_error("<!doctype html><a b=\"c\"><d/>x &lt; y</a>"), "");
  EXPECT_NE(markup_error("<a><b></a></b>"), "");
  EXPECT_NE(markup_error("<a b=c></a>"), "");
  EXPECT_NE(markup_error("<a b=\"1\" b=\"2\"></a>"), "");
  EXPECT_NE(markup_error("<a>x & y</a>"), "");
  EXPECT_NE(markup_error("<a>x < y</a>"), "");
  EXPECT_NE(markup_error("<a>"), "");
}

TEST(Template, FillsInTextsAndMarkup) {
  const Blanks blanks{{"a", "1 < 2"}, {"none", ""}};
  EXPECT_EQ(fill("x {{a}} {{{a}}} {y}", blanks), "x 1 &lt; 2 1 < 2 {y}");
  EXPECT_EQ(fill("{{#a}}is {{a}}{{/a}}{{^a}}is not{{/a}}{{#none}}{{a}}{{/none}}{{^none}}, no{{/none}}", blanks),
            "is 1 &lt; 2, no");
  // What is filled in is not read again.
  EXPECT_EQ(fill("{{a}}", {{"a", "{{b}}"}}), "{{b}}");
  EXPECT_THROW(static_cast<void>(fill("{{b}}", blanks)), std::out_of_range);
}

TEST(Table, EscapesAllButMarkup) {
  const std::string html = table_html({.columns = {{"a & b"}, {"c", true}},
                                       .rows = {{.cells = {"x < y", Html{"<b>1</b>"}}, .style = "aim"}, {{"z", "w"}}},
                                       .style = "pair"});
  EXPECT_EQ(markup_error(html), "");
  EXPECT_THAT(html, HasSubstr("<th scope=\"col\">a &amp; b</th><th scope=\"col\" class=\"text\">c</th>"));
  EXPECT_THAT(html,
              HasSubstr("<tr class=\"aim\"><th scope=\"row\">x &lt; y</th><td class=\"text\"><b>1</b></td></tr>"));
  EXPECT_THAT(html, HasSubstr("<tr><th scope=\"row\">z</th>"));
}

TEST(Report, IsWellFormedAndNeedsNoOtherFile) {
  const std::string page = report_html(sample_record());
  EXPECT_EQ(markup_error(page), "");
  EXPECT_FALSE(std::regex_search(without_scripts(page), std::regex("<(link|img)\\b|<script[^>]* src|href=\"http")));
  EXPECT_LT(page.size(), 3'000'000U);
  EXPECT_FALSE(has_nan(without_scripts(page)));
}

TEST(Report, EscapesWhatTheStudySays) {
  const std::string page = report_html(sample_record());
  EXPECT_THAT(page, HasSubstr("A sample &amp; its &lt;limits&gt;"));
  EXPECT_THAT(page, HasSubstr("&lt;script&gt;alert(&#39;x&#39;)&lt;/script&gt;"));
  EXPECT_THAT(page, HasSubstr("The post is too thin &amp; &lt;breaks&gt;."));
}

TEST(Report, ListsTheSettingsThatAnAccuracyChose) {
  RunRecord record = sample_record();
  EXPECT_THAT(report_html(record),
              HasSubstr("<code>solver.modes</code></th><td class=\"text\">8, handed over with 12"));
  record.provenance.settings.clear();
  EXPECT_THAT(report_html(record), Not(HasSubstr("chosen for the accuracy")));
}

TEST(Report, NamesTheWearLawAmongTheLimitsOfTheModel) {
  RunRecord record = sample_record();
  record.wear_law = "";
  EXPECT_THAT(report_html(record), HasSubstr("Coulomb friction and Archard wear have constant coefficients"));
  record.wear_law = "energy";
  EXPECT_THAT(report_html(record), HasSubstr("Coulomb friction and wear by dissipated energy have constant"));
  record.wear_law = "of a later <version>";
  EXPECT_THAT(report_html(record), HasSubstr("friction and wear by the law of a later &lt;version&gt; have constant"));
}

TEST(Report, SaysWhatChangedAndWhatHoldsTheBest) {
  const RunRecord record = sample_record();
  // 0.8 to 0.1 mm3, error bars 2 % of each: 0.7 / 0.018 = 39 times their sum.
  EXPECT_EQ(headline(record),
            "The asymptotic wear volume fell from 0.800 to 0.100\u00a0mm\u00b3 (\u221288\u00a0%). The change is far "
            "beyond the "
            "error bars of the two values (39 times their sum).");
  EXPECT_THAT(holders(record), testing::ElementsAre("the upper limit of the peak amplitude (8\u00a0mm)",
                                                    "the upper bound of the neck width"));
}

TEST(Report, SaysWhatHoldsTheBestOnAFinerMesh) {
  RunRecord record = sample_record();
  record.evaluations[*record.best].constraints = {-0.02};
  const FinerRecord there{.evaluation = static_cast<std::int64_t>(*record.best),
                          .flank_elements = 96,
                          .status = "converged",
                          .constraints = {-0.0045}};
  record.finer = {there};
  const char *limit = "the upper limit of the peak amplitude (8\u00a0mm) with 96 edges along each flank",
             *bound = "the upper bound of the neck width";
  EXPECT_THAT(holders(record), testing::ElementsAre(limit, bound));
  EXPECT_THAT(what_next(record), testing::Contains(HasSubstr("peak amplitude (8\u00a0mm) if more is wanted")));
  EXPECT_THAT(how_sure(record), testing::Contains("With 96 edges along each flank it keeps every limit; nearest is the "
                                                  "upper limit of the peak amplitude (8\u00a0mm) with 0.45\u00a0% "
                                                  "room."));
  // Of what another design changed there, a fifth more was kept away from.
  record.finer.front().constraints = {-0.01};
  record.evaluations[*record.best].constraints = {-0.06};
  EXPECT_THAT(holders(record), testing::ElementsAre(limit, bound));
  record.evaluations[*record.best].constraints = {-0.02};
  EXPECT_THAT(holders(record), testing::ElementsAre(bound));
  record.finer = {there};
  record.finer.front().evaluation += 1;  // another design's
  EXPECT_THAT(holders(record), testing::ElementsAre(bound));
  record.finer = {there};
  record.finer.front().constraints = {0.01};  // it breaks it
  EXPECT_THAT(holders(record), testing::ElementsAre(bound));
  record.finer = {there};
  record.evaluations[*record.best].error_estimates["peak_amplitude_m"] = 1e-4;
  EXPECT_THAT(how_sure(record), testing::Contains(HasSubstr("room, less than its error bar.")));
}

TEST(Report, DoesNotCallAChangeWithinTheErrorAnImprovement) {
  RunRecord record = sample_record();
  for (EvaluationRecord& e : record.evaluations) e.error_estimates["asymptotic_wear_volume_m3"] = 5e-10;
  EXPECT_THAT(headline(record), HasSubstr("may be no improvement"));
  // A verification that speaks against the best design comes first; that of another design does not count.
  VerificationRecord verification;
  verification.evaluation = static_cast<std::int64_t>(*record.best) + 1;
  verification.status = "disagrees: search 1e-10 m^3, finer mesh 2e-10 m^3, bars 1e-11 m^3";
  record.verifications = {verification};
  EXPECT_THAT(headline(record), testing::Not(HasSubstr("does not confirm")));
  record.verifications.front().evaluation = static_cast<std::int64_t>(*record.best);
  EXPECT_THAT(headline(record),
              testing::StartsWith("The verification does not confirm the best design: it disagrees: search"));
  record.verifications.front().status = "history: budget_spent";
  EXPECT_THAT(headline(record), testing::StartsWith("The best design could not be verified (history: budget_spent). "));
  record.verifications.clear();
  for (EvaluationRecord& e : record.evaluations) e.error_estimates.clear();
  EXPECT_THAT(headline(record), HasSubstr("No error bar is known"));
}

TEST(Report, NamesWhatTheBestDesignRestsOnWithoutAnErrorBar) {
  RunRecord record = sample_record();
  EXPECT_THAT(without_bar(record), testing::ElementsAre("the peak amplitude"));
  EXPECT_THAT(report_html(record), HasSubstr("No error is known of the peak amplitude: the mesh does not settle it"));
  EvaluationRecord& best = record.evaluations[*record.best];
  best.error_estimates["peak_amplitude_m"] = 1e-5;
  EXPECT_THAT(without_bar(record), testing::IsEmpty());
  EXPECT_THAT(report_html(record), testing::Not(HasSubstr("No error is known of")));
  best.error_estimates.clear();  // a run without bars
  EXPECT_THAT(without_bar(record), testing::IsEmpty());
}

TEST(Report, ShowsTheHistoryBesideTheDirectMethod) {
  RunRecord record = sample_record();
  const std::string page = report_html(record);
  EXPECT_THAT(page, HasSubstr("Verification by the full history"));
  EXPECT_THAT(page, HasSubstr("11 harmonics, 256 samples"));
  EXPECT_THAT(page, HasSubstr("+9.6\u00a0%"));  // 1.206 over 1.1
  EXPECT_THAT(page, HasSubstr("Worn profile of evaluation 2"));
  // Within a bar as large as the value anything lies.
  record.verifications.front().search_volume_m3 = 8e-11;
  record.verifications.front().search_bar_m3 = 1e-11;
  EXPECT_THAT(report_html(record), HasSubstr("agree within their bars"));
  record.verifications.front().search_bar_m3 = 9e-11;
  EXPECT_THAT(report_html(record), HasSubstr("cannot tell: the bar is larger than the value"));
  record.verifications.front().status = "history: stalled";
  record.verifications.front().history_profile_m.clear();
  EXPECT_THAT(report_html(record), HasSubstr("history: stalled"));
  EXPECT_THAT(report_html(record), HasSubstr("<td>not known</td>"));
  EXPECT_THAT(report_html(record), testing::Not(HasSubstr("+9.6\u00a0%")));
  VerificationRecord nothing_wears;
  nothing_wears.status = "converged";
  record.verifications = {nothing_wears};
  EXPECT_THAT(report_html(record), HasSubstr("agree within their bars"));
  EXPECT_THAT(report_html(record), testing::Not(HasSubstr("Worn profile of evaluation")));
  record.verifications.clear();
  EXPECT_THAT(report_html(record), testing::Not(HasSubstr("Verification by")));
}

TEST(Report, SaysThatNoFeasibleDesignWasFound) {
  RunRecord record = sample_record();
  record.best.reset();
  record.best_design.reset();
  record.least_broken = 1;
  for (EvaluationRecord& e : record.evaluations) e.feasible = false;
  const std::string page = report_html(record);
  EXPECT_EQ(markup_error(page), "");
  EXPECT_THAT(page, HasSubstr("No feasible design was found"));
  EXPECT_THAT(page, HasSubstr("The nearest is candidate 2."));
  EXPECT_FALSE(has_nan(without_scripts(page)));
}

/// A run without a best design, whose candidates keep their limit on the mesh of the search.
RunRecord kept_there_alone() {
  RunRecord record = sample_record();
  record.best.reset();
  record.finer.clear();
  for (EvaluationRecord& e : record.evaluations) {
    e.feasible = false;
    if (e.status == "converged") e.constraints = {-0.02};
  }
  return record;
}

TEST(Answers, NameWhatIsKeptOnTheMeshOfTheSearchAlone) {
  RunRecord record = kept_there_alone();
  record.finer = {{.evaluation = 1, .flank_elements = 32, .status = "converged", .constraints = {0.03}},
                  {.evaluation = 0, .flank_elements = 32, .status = "converged", .constraints = {0.05}}};
  EXPECT_THAT(words_of(never_kept(record)),
              testing::ElementsAre("the upper limit of the peak amplitude (8\u00a0mm) with 32 edges along each flank "
                                   "(candidate 2 comes nearest and misses it by 3.0\u00a0%)"));
  EXPECT_THAT(what_next(record),
              testing::Contains(HasSubstr("Loosen the upper limit of the peak amplitude (8\u00a0mm), "
                                          "or")));
  record.finer.resize(1);
  record.finer.front().status = "steady_state: iteration_limit";
  record.finer.front().constraints = {std::nan("")};
  EXPECT_THAT(words_of(never_kept(record)), testing::ElementsAre(HasSubstr("where candidate 2 has no answer")));
  EXPECT_THAT(what_next(record), testing::Not(testing::Contains(HasSubstr("Loosen"))));
}

// A candidate keeps on a finer mesh what it breaks on the search's: who keeps all is refused by what that look adds to
// the other limit.
TEST(Answers, NameWhatIsRefusedByCorrectionsAlone) {
  RunRecord record = kept_there_alone();
  record.problem.constraints.push_back({.response = "post_width_m", .lower = 8e-3, .upper = {}});
  for (EvaluationRecord& e : record.evaluations) e.constraints.push_back(e.constraints.front());
  record.evaluations[1].constraints = {0.2, -0.10};
  record.finer = {{.evaluation = 1, .flank_elements = 32, .status = "converged", .constraints = {-0.1, -0.04}}};
  EXPECT_THAT(words_of(never_kept(record)),
              testing::ElementsAre("the lower limit of the post width (8\u00a0mm) with what a finer mesh adds to it "
                                   "(candidate 1 comes nearest and misses it by 4.0\u00a0%)"));
}

TEST(Answers, DoNotBlameFinerMeshesWhereNoneKeepsAllLimits) {
  RunRecord record = kept_there_alone();
  record.finer = {{.evaluation = 1, .flank_elements = 32, .status = "converged", .constraints = {0.03}}};
  // Whoever keeps the limit breaks a rule, and the other way round.
  for (EvaluationRecord& e : record.evaluations) e.rules = {{"post_width_m", 0.1}};
  record.evaluations[0].constraints = {0.2};
  record.evaluations[0].rules = {{"post_width_m", -0.4}};
  EXPECT_THAT(never_kept(record), testing::IsEmpty());
}

TEST(Report, SurvivesWhateverIsMissing) {
  RunRecord record = sample_record();
  record.status = "interrupted";
  record.best_design->history.reset();
  std::string page = report_html(record);
  EXPECT_EQ(markup_error(page), "");
  EXPECT_THAT(page, HasSubstr("The run was interrupted"));
  EXPECT_THAT(page, HasSubstr("No wear history was computed"));

  // Nor are there headings of what was not asked for.
  record.best_design->unworn = {};
  record.best_design->nodal_diameters = {};
  record.best_design->contact = {};
  record.baseline_design.reset();
  page = report_html(record);
  EXPECT_EQ(markup_error(page), "");
  EXPECT_THAT(page, Not(HasSubstr("<h2>Wear history")));
  EXPECT_THAT(page, Not(HasSubstr("<h2>Vibration")));
  EXPECT_THAT(page, Not(HasSubstr("Nothing to show: these values")));
  record.best_design->status = "asymptote: stalled";
  EXPECT_THAT(report_html(record), HasSubstr("Nothing to show: these values"));
  record.best_design->status = "converged";

  record.best_design = DesignRecord{};
  page = report_html(record);
  EXPECT_EQ(markup_error(page), "");
  EXPECT_THAT(page, HasSubstr("the section was not built"));

  record.best_design.reset();
  record.baseline_design.reset();
  page = report_html(record);
  EXPECT_EQ(markup_error(page), "");
  EXPECT_THAT(page, HasSubstr("No design could be computed in full"));

  page = report_html({});
  EXPECT_EQ(markup_error(page), "");
  EXPECT_THAT(page, HasSubstr("No candidate was evaluated."));
}

TEST(Report, SaysWhenTheStartStaysTheBest) {
  RunRecord record = sample_record();
  record.best = record.baseline;
  EXPECT_THAT(headline(record), testing::StartsWith("No candidate was better than the start"));
  // What speaks against it comes first here, too.
  record.verifications.assign(1, {});
  record.verifications[0].status = "disagrees: finer mesh 2, history on it 1, bars 0.5";
  EXPECT_THAT(headline(record), testing::StartsWith("The verification does not confirm the best design"));
  EXPECT_THAT(headline(record), HasSubstr("No candidate was better than the start"));
  record.verifications.clear();
  record.best_design->status = "asymptote: gross_sliding";
  EXPECT_THAT(headline(record), testing::StartsWith("Looked at with bars and its wear history"));
  record.best_design->status = "converged";
  record.best = 3;
  record.evaluations[0].objective = std::numeric_limits<double>::quiet_NaN();
  record.evaluations[0].status = "preload: stalled";
  EXPECT_THAT(headline(record), HasSubstr("The start could not be evaluated (preload: stalled)"));
}

TEST(Report, ShowsAFront) {
  const RunRecord record = sample_front();
  const std::string page = report_html(record);
  EXPECT_EQ(markup_error(page), "");
  EXPECT_FALSE(has_nan(without_scripts(page)));
  EXPECT_EQ(
      headline(record),
      "2 designs that no other beats, from an asymptotic wear volume of 0.100\u00a0mm\u00b3 and a peak amplitude of "
      "7.99\u00a0mm to 0.800\u00a0mm\u00b3 and 7.00\u00a0mm. The start has 0.800\u00a0mm\u00b3 and 7.00\u00a0mm.");
  EXPECT_THAT(page, HasSubstr("<h2>Front</h2>"));
  EXPECT_THAT(page, HasSubstr("after (compromise)"));
  EXPECT_THAT(page, HasSubstr("beyond 0.9\u00a0mm\u00b3 a design counts nothing"));
  // What a point says when it is pointed at.
  EXPECT_THAT(page,
              HasSubstr("\"compromise, point 1, candidate 4\\nasymptotic wear volume 0.1000 \u00b1 "
                        "0.0020\u00a0mm\u00b3\\npeak amplitude 7.990 \u00b1 0.010\u00a0mm\\nflank mismatch 11.25"));
  // The point without bars is in the list of all.
  EXPECT_THAT(page, HasSubstr("All 2 points"));
  EXPECT_THAT(report_html(sample_record()), Not(HasSubstr("<h2>Front</h2>")));
}

TEST(ReportPlots, ShowAFrontAndWhatItBeats) {
  const RunRecord record = sample_front();
  const std::vector<Figure> plots = front_plots(record);
  ASSERT_EQ(plots.size(), 1U);
  const Plot& plot = std::get<Plot>(plots[0]);
  std::vector<std::string> names;
  for (const Series& series : plot.series) names.push_back(series.name);
  // The second candidate breaks its limit and lies beyond the reference, the third has no value.
  EXPECT_THAT(names, testing::ElementsAre("", "front", "compromise"));
  // Of the start, at (0.8, 7.0) of (0.9, 8.0), then of the last, at (0.1, 7.99): 0.1 x 1 and 0.7 x 0.01.
  EXPECT_THAT(hypervolume_plot(record).series[0].y,
              testing::Pointwise(testing::DoubleNear(1e-9), {100 / 1.07, 100 / 1.07, 100 / 1.07, 100.0}));
}

TEST(ReportPlots, MergeFlanksOnlyWhenTheyAreAlike) {
  DesignRecord design = sample_design(2);
  // Depths are the same on both sides, pressures differ by 10 %.
  const std::vector<Figure> plots = contact_plots({.before = nullptr, .after = &design});
  EXPECT_EQ(std::get<Plot>(plots[0]).series.size(), 1U);
  EXPECT_EQ(std::get<Plot>(plots[1]).series.size(), 2U);
}

TEST(ReportPlots, ShowTheObjectiveInItsUnit) {
  const Plot plot = objective_plot(sample_record());
  EXPECT_EQ(plot.y.unit, "mm\u00b3");
  ASSERT_EQ(plot.series.size(), 5U);
  EXPECT_THAT(plot.series[4].candidates, testing::ElementsAre(3));  // the best
  // Best so far: the second candidate breaks the limit, the third has no value.
  EXPECT_THAT(plot.series[0].y, testing::Pointwise(testing::DoubleEq(), {0.8, 0.8, 0.8, 0.1}));
}

TEST(ReportPlots, ShowEngineOrdersWhereTheyMeetTheMode) {
  DesignRecord design = sample_design(1);
  EXPECT_TRUE(engine_order_plot(design).series.empty());
  design.parameters["scene.speed_rpm"] = 10000;
  design.parameters["geometry.sectors"] = 47;
  const Plot plot = engine_order_plot(design);
  // The other mode is at 2000 Hz. Of multiples of 166.7 Hz, 3 lies next to 490 Hz, the others far from it.
  ASSERT_EQ(plot.series.size(), 3U);
  EXPECT_THAT(plot.series[1].x, testing::ElementsAre(3));
  EXPECT_NEAR(plot.series[1].y[0], 500, 1e-9);
  EXPECT_EQ(plot.series[1].labels[0], "EO 3");
  // Both are well inside of what is shown, and the mode takes a tenth of it or more.
  EXPECT_LT(plot.y.range.lower, 480);
  EXPECT_GT(plot.y.range.upper, 502);
  EXPECT_LT(plot.y.range.upper - plot.y.range.lower, 60);
}

TEST(Answers, TellWhatBecameBetterAndWorse) {
  const RunRecord record = sample_record();
  const std::string table = outcome_table(record);
  EXPECT_EQ(markup_error(table), "");
  EXPECT_THAT(table, HasSubstr("asymptotic wear volume"));
  EXPECT_THAT(table, HasSubstr("<span class=\"verdict good\">better</span>"));
  EXPECT_THAT(table, HasSubstr("at most\u00a0"
                               "8\u00a0mm"));
  // 7.99 and 7 of 8 mm
  EXPECT_THAT(table, HasSubstr("verdict soft\">kept, 0.12\u00a0% room, but its response has no error bar (start: 12"));
  RunRecord worse = record;
  worse.evaluations[3].error_estimates["peak_amplitude_m"] = 1e-6;
  EXPECT_THAT(outcome_table(worse), HasSubstr("verdict good\">kept, 0.12\u00a0% room (start: 12\u00a0%)"));
  worse.evaluations[3].responses["asymptotic_wear_volume_m3"] = 9e-10;
  EXPECT_THAT(outcome_table(worse), HasSubstr("<span class=\"verdict bad\">worse</span>"));
  worse.evaluations[3].error_estimates["asymptotic_wear_volume_m3"] = 5e-10;
  EXPECT_THAT(outcome_table(worse), HasSubstr("worse, but within the bars"));
  worse.evaluations[3].error_estimates["peak_amplitude_m"] = 1e-4;
  EXPECT_THAT(outcome_table(worse), HasSubstr("undecided: nearer than its bar"));
}

TEST(Answers, TellHowSureAndHowFar) {
  RunRecord record = sample_record();
  EXPECT_THAT(how_sure(record), testing::Contains("Error bar: asymptotic wear volume \u00b12.0\u00a0%."));
  EXPECT_THAT(how_sure(record), testing::Contains("The best design was not held against a wear history."));
  EXPECT_THAT(how_sure(record),
              testing::Contains("With 32 edges along each flank it keeps every limit; nearest is the upper limit of "
                                "the peak amplitude (8\u00a0mm) with 1.0\u00a0% room."));
  record.verifications.front().evaluation = 3;
  EXPECT_THAT(how_sure(record), testing::Contains(HasSubstr("(cruise): agree within their bars")));
  EXPECT_THAT(
      how_far(record),
      testing::ElementsAre(HasSubstr("in 0 of 1 cases"),
                           "With friction \u221240 % it breaks the upper limit of the peak amplitude by 2.0\u00a0%.",
                           "There its asymptotic wear volume is 0.130\u00a0mm\u00b3; as the study says it is "
                           "0.100\u00a0mm\u00b3."));
}

TEST(Answers, TellWhatToDoWhereDesignsAreNotToldApart) {
  RunRecord record = sample_record();
  EXPECT_THAT(what_next(record), testing::Not(testing::Contains(HasSubstr("error bars"))));
  record.evaluations[*record.best].error_estimates["asymptotic_wear_volume_m3"] = 1e-9;
  EXPECT_THAT(what_next(record), testing::Contains(HasSubstr("not told apart by their error bars")));
  for (EvaluationRecord& e : record.evaluations) e.objective = 0;
  EXPECT_THAT(what_next(record), testing::Contains(HasSubstr("the same for all candidates")));
}

TEST(Answers, TellWhatToDoNext) {
  RunRecord record = sample_record();
  EXPECT_THAT(what_next(record), testing::Contains(HasSubstr("1 of the 2 variables stands at a bound")));
  EXPECT_THAT(what_next(record), testing::Contains(HasSubstr("neck width (above 9\u00a0mm)")));
  EXPECT_THAT(what_next(record), testing::Contains(HasSubstr("Loosen the upper limit of the peak amplitude")));
  EXPECT_THAT(what_next(record), testing::Contains(HasSubstr("Go on: the search ended")));
  EXPECT_THAT(what_next(record), testing::Contains(HasSubstr("Verify:")));
  record.best.reset();
  record.least_broken = 1;
  EXPECT_THAT(what_next(record), testing::Contains(HasSubstr("Start from candidate 2")));
  // More evaluations are no advice where going on brought nothing.
  record.message =
      "going on from the best design brought nothing better that keeps its limits; 4 evaluations of the budget are "
      "left";
  EXPECT_THAT(what_next(record), testing::Not(testing::Contains(HasSubstr("Go on"))));
}

/// Candidates with y = 3 a + (b - 0.5)^2 over a grid of a and b; c does nothing.
TEST(Influence, FindsWhatRisesAndWhatHasAValley) {
  RunRecord record;
  record.problem.space = optimizer::DesignSpace({{.key = "geometry.a_mm", .lower = 0, .upper = 1, .start = 0},
                                                 {.key = "geometry.b_mm", .lower = 0, .upper = 1, .start = 0},
                                                 {.key = "geometry.c_mm", .lower = 0, .upper = 1, .start = 0}});
  Numbers values;
  for (int i = 0; i < 125; ++i) {
    const double a = 0.25 * (i % 5), b = 0.25 * (i / 5 % 5), c = 0.25 * (i / 25 % 5);
    EvaluationRecord e;
    e.x = {a, b, c};
    record.evaluations.push_back(e);
    values.push_back(a + 3 * (b - 0.5) * (b - 0.5));
  }
  const Influence found = influence(record, values);
  ASSERT_EQ(found.variables.size(), 3U);
  EXPECT_EQ(found.variables[0].trend, Trend::rises);
  EXPECT_EQ(found.variables[1].trend, Trend::valley);
  EXPECT_GT(found.variables[0].share, 0.3);
  EXPECT_GT(found.variables[1].share, 0.3);
  EXPECT_LT(found.variables[2].share, 0.01);
  EXPECT_LE(found.explained, 1 + 1e-9);
  // Variables that go together, as in a search: b pulls against a, and no share is larger than all together.
  for (std::size_t i = 0; i < values.size(); ++i) {
    std::vector<double>& x = record.evaluations[i].x;
    x[1] = x[0] + 0.01 * static_cast<double>(i % 7);
    values[i] = 3 * x[0] - 2 * x[1];
  }
  const Influence together = influence(record, values);
  double sum = 0;
  for (const VariableInfluence& variable : together.variables) sum += variable.share;
  EXPECT_NEAR(sum, together.explained, 1e-12);
  // Too few tell nothing.
  record.evaluations.resize(13);
  values.resize(13);
  EXPECT_TRUE(influence(record, values).variables.empty());
}

}  // namespace
}  // namespace dovetail::report
