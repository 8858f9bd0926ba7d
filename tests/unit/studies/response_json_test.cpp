#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "studies/program/engine/response_curve.hpp"

namespace dovetail::studies {
namespace {

using Json = nlohmann::json;
using testing::HasSubstr;

/// A state with one output, H = 2, two contact nodes.
steady::State state(Status status) {
  steady::State s;
  s.status = status;
  s.iterations = 4;
  s.outputs.resize(1, 5);
  s.outputs << 10, 11, 12, 13, 14;
  s.amplitudes = Eigen::VectorXd::Constant(1, 20);
  s.wear_rate = Eigen::Vector2d(1e-12, 2e-12);
  s.friction_energy = 0.5;
  return s;
}

/// Points from 480 Hz on in steps of 1 Hz.
ResponseCurve curve(std::vector<steady::State> states) {
  ResponseCurve c;
  c.output_names = {"tip_x"};
  c.settings.harmonics = 2;
  c.penalty = {Eigen::Vector2d(1e6, 2e6), Eigen::Vector2d(3e6, 4e6)};
  for (std::size_t i = 0; i < states.size(); ++i) c.frequency_hz.push_back(480 + static_cast<double>(i));
  c.states = std::move(states);
  return c;
}

TEST(ResponseJson, CosinesStartWithTheMeanAndSinesWithZero) {
  const Json json = Json::parse(response_json(curve({state(Status::converged)})));
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
  const Json json = Json::parse(response_json(curve({state(Status::converged), state(Status::stalled)})));
  EXPECT_EQ(json["status"][1], "stalled");
  EXPECT_EQ(json["frequency_hz"][1], 481);
  EXPECT_TRUE(json["outputs"]["tip_x"]["amplitude"][1].is_null());
  EXPECT_EQ(json["outputs"]["tip_x"]["cosine"][1], Json({nullptr, nullptr, nullptr}));
  EXPECT_EQ(json["wear_rate_m_per_cycle"][1], Json({nullptr, nullptr}));
  EXPECT_TRUE(json["dissipated_energy_j"][1].is_null());
}

TEST(ResponseJson, SaysWithWhichSettingsItWasComputed) {
  ResponseCurve c = curve({state(Status::converged)});
  EXPECT_FALSE(Json::parse(response_json(c))["settings"].contains("automatic"));
  c.automatic = Status::iteration_limit;
  c.accuracy = 1e-4;
  const Json settings = Json::parse(response_json(c))["settings"];
  EXPECT_EQ(settings["harmonics"], 2);
  EXPECT_EQ(settings["samples"], 128);
  EXPECT_EQ(settings["pseudo_penalty_n_per_m"]["tangential"], Json({3e6, 4e6}));
  EXPECT_EQ(settings["automatic"], Json({{"status", "iteration_limit"}, {"accuracy", 1e-4}}));
}

TEST(ResponseJson, AnAnalysisHasOneEntryPerPointAndNullWhereThereIsNone) {
  ResponseCurve c = curve({state(Status::converged), state(Status::stalled)});
  c.choice = {.error_bars = true, .penalty_sensitivity = true, .stability = true};
  c.analyses.resize(2);
  PointAnalysis& first = c.analyses[0];
  first.bars.emplace();
  first.bars->status = Status::converged;
  first.bars->total = first.bars->harmonics = first.bars->samples = quality::constant_quantities(1, 0.25);
  first.bars->penalty = quality::constant_quantities(1, std::numeric_limits<double>::infinity());
  first.sensitivity.emplace();
  first.sensitivity->ratios = {1, 2};
  first.sensitivity->statuses = {Status::converged, Status::stalled};
  first.sensitivity->values = {quality::constant_quantities(1, 7),
                               quality::constant_quantities(1, std::numeric_limits<double>::quiet_NaN())};
  first.sensitivity->slope = quality::constant_quantities(1, 0.5);
  first.stability.emplace();
  first.stability->verdict = stability::StabilityVerdict::stable;
  first.stability->reason = "all inside";
  first.stability->largest_modulus = 0.9;
  first.stability->multipliers = Eigen::VectorXcd::Constant(1, std::complex<double>(0.9, 0.1));
  const Json json = Json::parse(response_json(c));
  EXPECT_EQ(json["error_bars"]["status"], Json({"converged", nullptr}));
  EXPECT_EQ(json["error_bars"]["total"]["outputs"]["tip_x"], Json({0.25, nullptr}));
  EXPECT_EQ(json["error_bars"]["penalty"]["dissipated_energy_j"], Json({nullptr, nullptr}));
  EXPECT_EQ(json["penalty_sensitivity"]["ratios"], Json({1.0, 2.0}));
  EXPECT_EQ(json["penalty_sensitivity"]["values"]["outputs"]["tip_x"][0], Json({7.0, nullptr}));
  EXPECT_EQ(json["penalty_sensitivity"]["slope"]["outputs"]["tip_x"], Json({0.5, nullptr}));
  EXPECT_EQ(json["stability"]["verdict"], Json({"stable", nullptr}));
  EXPECT_EQ(json["stability"]["multipliers"][0][0], Json({0.9, 0.1}));
  EXPECT_THAT(response_table(c), HasSubstr("+-"));
}

TEST(ResponseJson, ABranchSaysWhereItTurns) {
  ResponseCurve c = curve({state(Status::converged), state(Status::converged)});
  c.branch.emplace();
  c.branch->status = Status::converged;
  c.branch->points.resize(2);
  c.branch->points[1].turns = 1;
  c.branch->points[1].is_turn = true;
  const Json json = Json::parse(response_json(c));
  EXPECT_EQ(json["arclength"]["status"], "converged");
  EXPECT_EQ(json["arclength"]["turns"], 1);
  EXPECT_EQ(json["arclength"]["is_turn"], Json({false, true}));
  EXPECT_THAT(response_table(c), HasSubstr("turning point"));
}

}  // namespace
}  // namespace dovetail::studies
