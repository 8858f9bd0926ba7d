// What every response keeps to. A new one joins the table, and needs no test of its own for this.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "optimizer/evaluator.hpp"
#include "optimizer/responses/computed.hpp"
#include "optimizer/responses/response_table.hpp"
#include "tests/verification/optimizer/coarse_scene.hpp"

namespace dovetail::optimizer {
namespace {

TEST(Responses, HaveANameAUnitASentenceAndOrders) {
  std::set<std::string_view> names;
  for (const Response& response : responses()) {
    SCOPED_TRACE(response.name);
    EXPECT_EQ(find_response(response.name), &response);
    EXPECT_TRUE(names.insert(response.name).second);
    EXPECT_TRUE(response.help.ends_with("."));
    // The name ends with the unit, as "m3_per_cycle" of a volume per cycle.
    if (!response.unit.empty()) {
      std::string unit(response.unit);
      std::erase(unit, '^');
      std::ranges::replace(unit, ' ', '_');
      std::ranges::transform(unit, unit.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
      EXPECT_NE(response.name.find("_" + unit), std::string_view::npos);
    }
    ASSERT_NE(response.value, nullptr);
    EXPECT_GE(response.mesh_order.in_plane, 1);
    EXPECT_GE(response.mesh_order.in_space, 1);
    EXPECT_GE(response.grid_order, 1);
    EXPECT_EQ(response.own_error.of == nullptr, response.own_error.source == nullptr);
    EXPECT_EQ(response.largest_bar.has_value(), !response.unresolved.empty());
    if (response.unworn != nullptr) {
      EXPECT_LT(response.unworn->stage, response.stage);
      EXPECT_EQ(response.unworn->unit, response.unit);
    }
  }
  EXPECT_EQ(find_response("resonance"), nullptr);
}

TEST(Responses, AreFiniteAndHaveABarOrAreUnbounded) {
  const Scene scene = coarse_scene();
  const CandidateResult result = SceneEvaluator(scene).evaluate(scene);
  const Evaluation& evaluation = result.evaluation;
  ASSERT_TRUE(evaluation.converged()) << evaluation.status;
  EXPECT_EQ(evaluation.responses.size(), kResponses.size());
  for (const Response& response : responses()) {
    SCOPED_TRACE(response.name);
    const std::string name(response.name);
    ASSERT_TRUE(evaluation.responses.contains(name));
    EXPECT_TRUE(std::isfinite(evaluation.responses.at(name)));
    EXPECT_EQ(evaluation.responses.at(name), response.value(scene, result));
    const bool open = std::ranges::find(evaluation.unbounded, name) != evaluation.unbounded.end();
    EXPECT_NE(open, evaluation.error_estimates.contains(name));
    EXPECT_TRUE(open || std::isfinite(evaluation.error_estimates.at(name)));
    EXPECT_TRUE(open || response.has_limit(scene));
  }
}

TEST(Responses, OfAJointThatIsNotToWearAreThoseOfTheStagesBefore) {
  const Scene scene = coarse_scene();
  Computation unworn;
  unworn.until = Stage::unworn;
  const CandidateResult result = computed(scene, ModelBuilder(scene).build(scene), unworn);
  ASSERT_EQ(result.stage, Stage::unworn);
  for (const Response& response : responses())
    EXPECT_EQ(result.evaluation.responses.contains(std::string(response.name)), response.stage <= Stage::unworn)
        << response.name;
}

TEST(Responses, AreOffByWhatTheyHangOnAlone) {
  CandidateResult result;
  result.unworn.emplace().omega = 2;
  result.worn.emplace().omega = 1;
  for (const Response& response : responses()) {
    SCOPED_TRACE(response.name);
    if (response.off == nullptr) continue;
    EXPECT_FALSE(response.off(result, {}).has_value());
    const LeftOpen of_worn{.worn_volume = 1, .worn_depth = 1, .drift = 1, .worn_amplitude = 1},
        of_slip{.slip_energy = 1};
    EXPECT_FALSE(response.off(result, response.stage < Stage::worn_state ? of_worn : of_slip).has_value());
  }
}

}  // namespace
}  // namespace dovetail::optimizer
