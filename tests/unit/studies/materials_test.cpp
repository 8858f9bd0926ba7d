#include "studies/program/study_file/materials.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "studies/program/study_file/study.hpp"
#include "tests/unit/studies/sample_study.hpp"

namespace dovetail::studies {
namespace {

using testing::HasSubstr;

/// The template with other text instead of its material.
std::string with_material(const std::string& text) {
  std::string study = study_template("sample");
  const std::size_t begin = study.find("\n[material.blade]\n"), end = study.find("\n[contact]\n");
  EXPECT_TRUE(begin != std::string::npos && end != std::string::npos);
  return study.replace(begin, end - begin, "\n" + text);
}

optimizer::Scene scene_of(const std::string& text) {
  return read_study(parse_document(text, "s.toml")).scene;
}

std::string told(const std::string& text) {
  try {
    static_cast<void>(scene_of(text));
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

TEST(Materials, AreNamedForBothBodiesOrForOne) {
  // Special Metals gives 29.0 million psi and 0.297 lb/in3 for Inconel 718.
  const NamedMaterial* nickel = find_material("inconel 718");
  ASSERT_NE(nickel, nullptr);
  EXPECT_NEAR(nickel->at_20_c.youngs_modulus, 29.0e6 * 6894.757, 0.005 * 200e9);
  EXPECT_NEAR(nickel->at_20_c.density, 0.297 * 27679.9, 10);

  // Keys of a file stand before its first section.
  const optimizer::Scene both = scene_of("material = \"Inconel 718\"\n" + with_material(""));
  EXPECT_EQ(both.blade.density, nickel->at_20_c.density);
  EXPECT_EQ(both.disk.density, nickel->at_20_c.density);

  const optimizer::Scene one = scene_of(with_material(
      "[material.blade]\ngrade = \"Ti-6Al-4V\"\nyoungs_modulus_gpa = 100\n[material.disk]\ngrade = \"inconel 718\"\n"));
  EXPECT_EQ(one.blade.youngs_modulus, 100e9);
  EXPECT_EQ(one.blade.density, fem::Material{}.density);
  EXPECT_EQ(one.disk.youngs_modulus, nickel->at_20_c.youngs_modulus);
}

TEST(Materials, OfOtherNamesAreRefusedWithThoseThereAre) {
  EXPECT_THAT(told("material = \"unobtainium\"\n" + with_material("")), HasSubstr("Ti-6Al-4V, Ti-6Al-2Sn-4Zr-2Mo"));
  EXPECT_THAT(told(with_material("[material.blade]\ngrade = 718\n")), HasSubstr("material.blade.grade = 718"));
  EXPECT_THAT(told(replaced(study_template("sample"), "[material.blade]\n", "[material.blade]\ngrade = \"17-4PH\"\n")),
              HasSubstr("changes nothing"));
  const std::string varied = "[[variable]]\nkey = \"material.blade.density_kg_m3\"\nlower = 4000\nupper = 9000\n";
  EXPECT_THAT(told("material = \"17-4PH\"\n" + with_material("") + varied),
              HasSubstr("[material.blade] and [material.disk] with grade = \"17-4PH\""));
  // As it says.
  const std::string both = with_material("[material.blade]\ngrade = \"17-4PH\"\n[material.disk]\ngrade = \"17-4PH\"\n");
  EXPECT_EQ(told(both + varied), "");
}

TEST(Materials, AndLimitsThatNobodyMeansAreDoubted) {
  const auto doubts = [](const std::string& text) { return warnings(read_study(parse_document(text, "s.toml"))); };
  const std::string plain = with_material("[material.blade]\ngrade = \"17-4PH\"\n");
  EXPECT_TRUE(doubts(plain).empty());
  const std::vector<std::string> modulus =
      doubts(with_material("[material.blade]\ngrade = \"17-4PH\"\nyoungs_modulus_gpa = 200e9\n"));
  ASSERT_EQ(modulus.size(), 1U);
  EXPECT_THAT(modulus.front(), HasSubstr("material.blade.youngs_modulus_gpa"));
  const std::vector<std::string> limit =
      doubts(plain + "[[constraint]]\nresponse = \"contact_pressure_mean_pa\"\nlower = 560\n");
  ASSERT_EQ(limit.size(), 1U);
  EXPECT_THAT(limit.front(), HasSubstr("560 Pa of contact_pressure_mean_pa"));
  const std::vector<std::string> variable =
      doubts(plain + "[[variable]]\nkey = \"contact.friction\"\nlower = 0.3\nupper = 0.6\n");
  ASSERT_EQ(variable.size(), 1U);
  EXPECT_THAT(variable.front(), HasSubstr("[[uncertain]]"));
}

// What is said of cases and of what is not certain is doubted as what the file itself says, once.
TEST(Materials, AndNumbersOfCasesAndSamplesAreDoubted) {
  const auto doubts = [](const std::string& more) {
    return warnings(read_study(parse_document(study_template("sample") + more, "s.toml")));
  };
  using testing::ElementsAre;
  EXPECT_THAT(doubts("[[case]]\nname = \"fast\"\n\"scene.speed_rpm\" = 1e9\n"),
              ElementsAre(HasSubstr("[[case]] fast: scene.speed_rpm = 1e+09")));
  EXPECT_THAT(doubts("[[case]]\nname = \"hot\"\n\"material.blade.youngs_modulus_gpa\" = 1e11\n"),
              testing::Contains(HasSubstr("[[case]] hot: material.blade.youngs_modulus_gpa = 1e+11")));
  EXPECT_THAT(doubts("[[uncertain]]\nkey = \"contact.friction\"\nlower = 0.3\nupper = 1.9\n"),
              ElementsAre(HasSubstr("[[uncertain]]: contact.friction = ")));
  EXPECT_THAT(doubts("[[case]]\nname = \"idle\"\n\"scene.speed_rpm\" = 6000\n"
                     "[[uncertain]]\nkey = \"contact.friction\"\nrelative = 0.2\n"),
              testing::IsEmpty());
}

}  // namespace
}  // namespace dovetail::studies
