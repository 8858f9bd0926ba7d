#include "studies/program/answers/json.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "studies/program/engine/wear_methods.hpp"

namespace dovetail::studies {
namespace {

using Json = nlohmann::json;

TEST(EvaluationJson, HasEveryKeyAndReadsBackBitByBit) {
  optimizer::Evaluation evaluation;
  evaluation.status = "worn_resonance: stalled";
  evaluation.feasible = false;
  evaluation.parameters = {{"geometry.neck_width_mm", 0.1 + 0.2}};
  evaluation.responses = {{"mass_kg", 1.0 / 3.0}, {"resonance_hz", std::numeric_limits<double>::quiet_NaN()}};
  evaluation.messages = {"a \"quoted\" rule"};
  const std::string text = evaluation_json(evaluation);
  const Json json = Json::parse(text);
  for (const char* key : {"status", "feasible", "parameters", "responses", "constraints", "error_estimates", "model",
                          "timings_s", "messages"})
    EXPECT_TRUE(json.contains(key)) << key;
  EXPECT_EQ(json["parameters"]["geometry.neck_width_mm"].get<double>(), 0.1 + 0.2);
  EXPECT_EQ(json["responses"]["mass_kg"].get<double>(), 1.0 / 3.0);
  EXPECT_TRUE(json["responses"]["resonance_hz"].is_null());
  EXPECT_TRUE(json["constraints"].is_object());
  EXPECT_EQ(text.back(), '\n');
}

wear::History history(wear::HistoryEnd end) {
  wear::History h;
  h.end = end;
  h.cycles = Eigen::Vector3d(0, 10, 30);
  h.worn_volume = Eigen::Vector3d(0, 1e-12, 2e-12);
  h.depth = (Eigen::MatrixXd(3, 2) << 0, 0, 1e-7, 2e-7, 2e-7, 3e-7).finished();
  h.rate = (Eigen::MatrixXd(3, 2) << 5, 6, 3, 4, 1, 2).finished();
  h.frequency = Eigen::Vector3d::Constant(6.283185307179586);
  h.final_depth = Eigen::Vector2d(2e-7, 3e-7);
  h.final_rate = Eigen::Vector2d(1, 2);
  h.final_volume = 2e-12;
  h.solves = 7;
  return h;
}

TEST(WearJson, AHistoryEndsWithItsLastState) {
  const WearQuestion question{.frequency_hz = 490, .follow = Drive::resonance};
  WearAnswer answer;
  answer.history = history(wear::HistoryEnd::worn_out);
  answer.status = wear_status(*answer.history);
  answer.solves = answer.history->solves;
  const Json json = Json::parse(wear_json(question, answer));
  EXPECT_EQ(json["method"], "history");
  EXPECT_EQ(json["status"], "asymptote");
  EXPECT_EQ(json["follow"], "resonance");
  EXPECT_EQ(json["frequency_hz"], 490);
  EXPECT_EQ(json["cycles"], Json({0.0, 10.0, 30.0}));
  EXPECT_EQ(json["worn_volume_m3"].size(), 3U);
  EXPECT_EQ(json["depth_m"], Json({2e-7, 3e-7}));
  EXPECT_EQ(json["final_wear_rate_m_per_cycle"], Json({1.0, 2.0}));
  EXPECT_EQ(json["solves"], 7);
}

TEST(WearJson, OnlyRestIsAnAsymptote) {
  EXPECT_EQ(wear_status(history(wear::HistoryEnd::steady_rate)), wear::Verdict::no_asymptote);
  for (const wear::HistoryEnd end :
       {wear::HistoryEnd::cycles, wear::HistoryEnd::steps, wear::HistoryEnd::failed, wear::HistoryEnd::interrupted})
    EXPECT_EQ(wear_status(history(end)), wear::Verdict::not_converged);
}

TEST(WearJson, AnAsymptoteHasOneStateAndNoNumberOfCycles) {
  wear::Asymptote asymptote;
  asymptote.verdict = wear::Verdict::asymptote;
  asymptote.depth = Eigen::Vector2d(1e-6, 0);
  asymptote.rate = Eigen::Vector2d(0, 0);
  asymptote.worn_volume = 3e-10;
  asymptote.other_states = {
      {.found_by = wear::FoundBy::release, .depth = Eigen::Vector2d(5e-7, 0), .worn_volume = 2e-10}};
  WearAnswer answer;
  answer.status = wear::Verdict::asymptote;
  answer.asymptote = asymptote;
  answer.solves = 9;
  const Json json = Json::parse(wear_json({.frequency_hz = 490}, answer));
  EXPECT_EQ(json["status"], "asymptote");
  EXPECT_EQ(json["cycles"], Json({nullptr}));
  EXPECT_EQ(json["worn_volume_m3"], Json({3e-10}));
  EXPECT_EQ(json["depth_m"], Json({1e-6, 0.0}));
  EXPECT_EQ(json["solves"], 9);
  EXPECT_EQ(json["other_states"][0]["worn_volume_m3"], 2e-10);
  EXPECT_EQ(json["other_states"][0]["depth_m"], Json({5e-7, 0.0}));
  EXPECT_FALSE(json.contains("spread"));
  EXPECT_FALSE(json.contains("band"));
}

TEST(WearJson, WearWithoutEndHasRatesAndNoVolume) {
  WearAnswer answer;
  answer.status = wear::Verdict::no_asymptote;
  wear::Asymptote& asymptote = answer.asymptote.emplace();
  asymptote.verdict = wear::Verdict::no_asymptote;
  asymptote.depth = Eigen::Vector2d(1e-3, 1e-3);  // where the history was left
  asymptote.rate = Eigen::Vector2d(2e-12, 2e-12);
  asymptote.worn_volume = 3e-10;
  const Json json = Json::parse(wear_json({.frequency_hz = 490}, answer));
  EXPECT_EQ(json["status"], "no_asymptote");
  EXPECT_EQ(json["worn_volume_m3"], Json({nullptr}));
  EXPECT_EQ(json["depth_m"], Json({nullptr, nullptr}));
  EXPECT_EQ(json["final_wear_rate_m_per_cycle"], Json({2e-12, 2e-12}));
  EXPECT_FALSE(answer.known());
}

TEST(WearJson, ASpreadNamesEveryMemberEvenTheFailedOnes) {
  wear::Spread spread;
  spread.nominal = {.verdict = wear::Verdict::asymptote, .volume = 2, .depth = Eigen::Vector2d(1, 0)};
  wear::SpreadMember lost{.source = "friction", .change = "x 0.8", .end = {}};
  lost.end.status = Status::stalled;
  const wear::SpreadMember known{
      .source = "friction",
      .change = "x 1.2",
      .end = {.verdict = wear::Verdict::asymptote, .volume = 3, .depth = Eigen::Vector2d(2, 0)}};
  spread.members = {lost, known};
  spread.ranges = {{.source = "friction",
                    .verdict = wear::Verdict::not_converged,
                    .lowest_volume = 2,
                    .highest_volume = 3,
                    .lowest_depth = 1,
                    .highest_depth = 2,
                    .members = 2,
                    .failed = 1}};
  WearAnswer answer;
  answer.status = wear::Verdict::asymptote;
  WearQuestion question{.frequency_hz = 490};
  question.spread = spread;
  const Json json = Json::parse(wear_json(question, answer))["spread"]["friction"];
  EXPECT_EQ(json["status"], "not_converged");
  EXPECT_EQ(json["low"]["worn_volume_m3"], 2.0);
  EXPECT_EQ(json["high"]["largest_depth_m"], 2.0);
  ASSERT_EQ(json["members"].size(), 2U);
  EXPECT_EQ(json["members"][0]["reason"], "stalled");
  EXPECT_TRUE(json["members"][0]["worn_volume_m3"].is_null());
  EXPECT_EQ(json["members"][1]["worn_volume_m3"], 3.0);
}

TEST(WearJson, ABandSaysWhichFrequencyIsTheWorst) {
  WearBand band;
  band.frequencies_hz = {480, 490};
  band.status = {wear::Verdict::asymptote, wear::Verdict::asymptote};
  band.volume = {1, 2};
  band.largest_depth = {1, 2};
  band.worst = 1;
  band.envelope = Eigen::Vector2d(2, 1);
  WearAnswer answer;
  answer.status = wear::Verdict::asymptote;
  WearQuestion question{.frequency_hz = 490, .follow = Drive::band};
  question.band = &band;
  const Json json = Json::parse(wear_json(question, answer));
  EXPECT_EQ(json["follow"], "band");
  EXPECT_EQ(json["band"]["worst_frequency_hz"], 490.0);
  EXPECT_EQ(json["band"]["worn_volume_m3"], Json({1.0, 2.0}));
  EXPECT_EQ(json["band"]["envelope_depth_m"], Json({2.0, 1.0}));
}

}  // namespace
}  // namespace dovetail::studies
