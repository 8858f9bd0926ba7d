#include "studies/program/json.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

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
  h.solves = 7;
  return h;
}

TEST(WearJson, AHistoryEndsWithItsLastState) {
  const WearQuestion question{.frequency_hz = 490, .follow = "resonance"};
  const Json json = Json::parse(history_json(question, history(wear::HistoryEnd::worn_out)));
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
  EXPECT_EQ(wear_status(history(wear::HistoryEnd::cycles)), "no_asymptote");
  for (const wear::HistoryEnd end : {wear::HistoryEnd::steps, wear::HistoryEnd::failed, wear::HistoryEnd::interrupted})
    EXPECT_EQ(wear_status(history(end)), "not_converged");
}

TEST(WearJson, AnAsymptoteHasOneStateAndNoNumberOfCycles) {
  wear::Asymptote asymptote;
  asymptote.verdict = wear::Verdict::asymptote;
  asymptote.depth = Eigen::Vector2d(1e-6, 0);
  asymptote.rate = Eigen::Vector2d(0, 0);
  asymptote.worn_volume = 3e-10;
  const Json json = Json::parse(asymptote_json({.frequency_hz = 490}, asymptote, {490}, 9));
  EXPECT_EQ(json["status"], "asymptote");
  EXPECT_EQ(json["cycles"], Json({nullptr}));
  EXPECT_EQ(json["worn_volume_m3"], Json({3e-10}));
  EXPECT_EQ(json["depth_m"], Json({1e-6, 0.0}));
  EXPECT_EQ(json["solves"], 9);
}

}  // namespace
}  // namespace dovetail::studies
