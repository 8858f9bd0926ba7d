#include "optimizer/scene/scene.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "optimizer/scene/scene_kind.hpp"

namespace dovetail::optimizer {
namespace {

TEST(Scene, EveryNumberReadsBackAsItWasSet) {
  for (const Parameter& p : scene_parameters()) {
    if (p.kind == Parameter::Kind::text || p.kind == Parameter::Kind::truth) continue;
    Scene scene;
    const double value = p.kind == Parameter::Kind::whole ? 7 : 0.123456789;
    set_parameter(scene, p.key, value);
    EXPECT_EQ(parameter(scene, p.key), value) << p.key;
  }
}

TEST(Scene, DefaultsAreValid) {
  EXPECT_TRUE(violations(Scene{}).empty());
}

TEST(Scene, AFlankKeySetsBothFlanksOrOne) {
  Scene scene;
  set_parameter(scene, "geometry.flank_angle_deg", 48);
  EXPECT_EQ(scene.geometry.flank("left").angle, scene.geometry.flank("right").angle);
  EXPECT_EQ(parameters(scene).count("geometry.left.flank_angle_deg"), 0U);
  set_parameter(scene, "geometry.right.flank_angle_deg", 52);
  EXPECT_DOUBLE_EQ(scene.geometry.flank("left").angle, 48 * std::numbers::pi / 180);
  EXPECT_EQ(parameters(scene).at("geometry.right.flank_angle_deg"), 52);
  EXPECT_EQ(parameters(scene).count("geometry.flank_angle_deg"), 0U);
}

TEST(SceneKind, EveryOneHasANameAndChangesKeysThatThereAre) {
  EXPECT_EQ(find_scene_kind("solid"), nullptr);
  for (const SceneKind* kind : scene_kinds()) {
    SCOPED_TRACE(kind->name);
    EXPECT_EQ(find_scene_kind(kind->name), kind);
    Scene scene;
    scene.kind = kind;
    EXPECT_TRUE(violations(scene).empty());
    for (const auto& keys : {kind->counts, kind->lengths, kind->beside})
      for (const std::string_view key : keys) EXPECT_NE(find_parameter(key), nullptr) << key;
  }
}

// Bounds of a variable are held against the range of its key when a study is read; rules between keys are not. So no
// rule may ask for more of a real number than its range.
TEST(Scene, TheRangeOfARealNumberIsAllThatIsAskedOfIt) {
  for (const SceneKind* kind : scene_kinds())
    for (const Parameter& p : scene_parameters()) {
      if (p.kind != Parameter::Kind::real) continue;
      Scene scene;
      scene.kind = kind;
      if (p.wear_law != nullptr) scene.contact.wear_law = p.wear_law->name;
      for (const double value : {p.range.lower, p.range.upper, 0.0, 1e-3, 0.3, 7.0, 1e5, 1e10}) {
        if (!p.range.contains(value)) continue;
        set_parameter(scene, p.key, value);
        EXPECT_TRUE(contradictions(scene).empty()) << p.key << " = " << value;
      }
    }
}

TEST(Scene, FrictionIsThatOfTheSelfLockingRuleToo) {
  Scene scene;
  set_parameter(scene, "contact.friction", 0.3);
  EXPECT_EQ(scene.limits.friction, 0.3);
}

TEST(Scene, NumbersOfAWearLawCountWithThatLawAlone) {
  for (const contact::WearLaw* law : contact::wear_laws())
    for (const contact::WearParameter& wear : law->parameters) {
      SCOPED_TRACE(wear.key);
      const std::string key = "contact." + std::string(wear.key);
      const Parameter* parameter = find_parameter(key);
      ASSERT_NE(parameter, nullptr);
      EXPECT_EQ(parameter->wear_law, law);
      Scene scene;
      set_parameter(scene, key, 2 * wear.standard + 1e-7);
      EXPECT_EQ(scene.contact.wear.at(std::string(law->name)).*wear.number, 2 * wear.standard + 1e-7);
      for (const contact::WearLaw* used : contact::wear_laws()) {
        scene.contact.wear_law = used->name;
        EXPECT_EQ(parameter->left_aside(scene), used != law);
        // A file may keep the numbers of the law that is used by default.
        EXPECT_EQ(violations(scene).empty(), used == law || law == contact::wear_laws().front());
      }
    }
}

TEST(Scene, WrongKeysAndKindsAreRefused) {
  Scene scene;
  const auto refusal = [&](const char* key, double value) -> std::string {
    try {
      set_parameter(scene, key, value);
    } catch (const InputError& error) {
      return error.what();
    }
    return {};
  };
  EXPECT_THAT(refusal("geometry.nek_width_mm", 8), testing::HasSubstr("did you mean geometry.neck_width_mm?"));
  EXPECT_THAT(refusal("solver.solver", 8), testing::HasSubstr("is not a number"));
  EXPECT_THAT(refusal("solver.modes", 8.5), testing::HasSubstr("must be a whole number"));
}

TEST(Scene, ViolationsAreInTheFilesUnit) {
  Scene scene;
  scene.geometry.neck_width = -3e-3;
  ASSERT_EQ(violations(scene).size(), 1U);
  EXPECT_THAT(violations(scene)[0].sentence(), testing::StartsWith("geometry.neck_width_mm = -3: must be > 0"));
}

}  // namespace
}  // namespace dovetail::optimizer
