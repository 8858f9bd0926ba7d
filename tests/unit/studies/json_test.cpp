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

/// A state with one output, H = 2, two contact nodes.
response::SteadyState state(Status status) {
  response::SteadyState s;
  s.status = status;
  s.iterations = 4;
  s.outputs.resize(1, 5);
  s.outputs << 10, 11, 12, 13, 14;
  s.amplitudes = Eigen::VectorXd::Constant(1, 20);
  s.wear_rate = Eigen::Vector2d(1e-12, 2e-12);
  s.friction_energy = 0.5;
  return s;
}

TEST(ResponseJson, CosinesStartWithTheMeanAndSinesWithZero) {
  const Json json = Json::parse(response_json({480}, {state(Status::converged)}, {"tip_x"}));
  EXPECT_EQ(json["frequency_hz"], Json({480.0}));
  EXPECT_EQ(json["status"], Json({"converged"}));
  EXPECT_EQ(json["iterations"], Json({4}));
  EXPECT_EQ(json["outputs"]["tip_x"]["amplitude"], Json({20.0}));
  EXPECT_EQ(json["outputs"]["tip_x"]["cosine"][0], Json({10.0, 11.0, 13.0}));
  EXPECT_EQ(json["outputs"]["tip_x"]["sine"][0], Json({0.0, 12.0, 14.0}));
  EXPECT_EQ(json["wear_rate_m_per_cycle"][0], Json({1e-12, 2e-12}));
  EXPECT_EQ(json["dissipated_energy_j"], Json({0.5}));
}

TEST(ResponseJson, PointsThatDidNotConvergeAreNullInTheSameShape) {
  const Json json =
      Json::parse(response_json({480, 481}, {state(Status::converged), state(Status::stalled)}, {"tip_x"}));
  EXPECT_EQ(json["status"][1], "stalled");
  EXPECT_EQ(json["frequency_hz"][1], 481);
  EXPECT_TRUE(json["outputs"]["tip_x"]["amplitude"][1].is_null());
  EXPECT_EQ(json["outputs"]["tip_x"]["cosine"][1], Json({nullptr, nullptr, nullptr}));
  EXPECT_EQ(json["wear_rate_m_per_cycle"][1], Json({nullptr, nullptr}));
  EXPECT_TRUE(json["dissipated_energy_j"][1].is_null());
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
