#include "studies/program/study_file/study.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "optimizer/cases.hpp"
#include "optimizer/scene/scene_kind.hpp"
#include "tests/unit/studies/sample_study.hpp"

namespace dovetail::studies {
namespace {

using testing::HasSubstr;
using testing::Not;

const std::string& sample() {
  static const std::string text = study_template("sample");
  return text;
}

Study read(const std::string& text) {
  return read_study(parse_document(text, "s.toml"));
}

/// Every key of the scene that the template writes as "leaf = value" in its section.
struct Place {
  optimizer::Parameter parameter;
  std::string section, leaf;
};
std::vector<Place> places() {
  std::vector<Place> found;
  for (const optimizer::Parameter& p : optimizer::scene_parameters()) {
    const std::size_t dot = p.key.rfind('.');
    const std::string section = p.key.substr(0, dot);
    if (section == "geometry.left" || section == "geometry.right" || section == "material.disk") continue;
    found.push_back({p, section, p.key.substr(dot + 1)});
  }
  return found;
}

/// The sample with the line of that key, which may be left a comment, replaced.
std::string with_line(const Place& place, const std::string& line) {
  const std::size_t section = sample().find("\n[" + place.section + "]\n");
  EXPECT_NE(section, std::string::npos) << place.section;
  const std::size_t begin =
      std::min(sample().find("\n" + place.leaf + " = ", section), sample().find("\n# " + place.leaf + " = ", section));
  EXPECT_NE(begin, std::string::npos) << place.leaf;
  std::string text = sample();
  text.replace(begin + 1, text.find('\n', begin + 1) - begin - 1, line);
  return text;
}

TEST(Study, TemplateReadsAsTheDefaults) {
  const Study study = read(sample());
  EXPECT_EQ(study.name, "s");
  EXPECT_EQ(study.title, "sample");
  EXPECT_EQ(optimizer::parameters(study.scene), optimizer::parameters(optimizer::Scene{}));
  EXPECT_EQ(study.problem.space.size(), 3U);
  EXPECT_EQ(study.problem.constraints.size(), 2U);
}

/// All kinds of templates are studies without a doubt, and show what a study may say beside its numbers.
TEST(Study, TemplatesOfEveryKindReadWithoutADoubt) {
  for (const std::string_view name : names_of<Template>()) {
    const std::string text = study_template("sample", *named<Template>(name));
    const Study study = read(text);
    EXPECT_TRUE(warnings(study).empty()) << name;
    for (const char* shown : {"start = ", "scale = ", "name = "}) EXPECT_THAT(text, HasSubstr(shown)) << name;
    EXPECT_EQ(study.scene.kind->in_space, name == "sector");
    EXPECT_EQ(study.problem.front, name == "front");
    EXPECT_EQ(!study.problem.cases.empty(), name == "robust");
  }
  const Study robust = read(study_template("sample", Template::robust));
  EXPECT_EQ(robust.problem.cases.size(), 2U * 5U);  // corners and middle of two numbers in two cases
}

TEST(Study, WarnsOfAResponseWithoutLimit) {
  const std::string limit = "[[constraint]]\nresponse = \"contact_pressure_max_pa\"\nupper = 400e6\n";
  EXPECT_TRUE(warnings(read(sample())).empty());
  const std::vector<std::string> sharp = warnings(read(sample() + limit));
  ASSERT_EQ(sharp.size(), 1U);
  EXPECT_THAT(sharp.front(), HasSubstr("contact_pressure_max_pa"));
  Study rounded = read(sample() + limit);
  rounded.scene.geometry.flank("left").edge_radius = rounded.scene.geometry.flank("right").edge_radius = 5e-3;
  // A limit that only a fine mesh sees.
  ASSERT_EQ(warnings(rounded).size(), 1U);
  EXPECT_THAT(warnings(rounded).front(), testing::HasSubstr("look at its error bar"));
  Study rough = read(sample() + limit);
  rough.scene.contact.normal_stiffness = 1e14;
  ASSERT_EQ(warnings(rough).size(), 1U);
  EXPECT_THAT(warnings(rough).front(), testing::HasSubstr("look at its error bar"));
  rough.scene.kind = &optimizer::kSector;
  EXPECT_THAT(warnings(rough).front(), testing::HasSubstr("in space it has no error bar"));
}

TEST(Study, EveryRequiredKeyIsMissedByName) {
  int required = 0;
  for (const Place& place : places()) {
    const std::string told = complaints(with_line(place, ""));
    if (place.parameter.required) {
      EXPECT_THAT(told, HasSubstr(place.parameter.key + ": is missing; it must be")) << place.parameter.key;
      ++required;
    } else {
      EXPECT_EQ(told, "") << place.parameter.key;
    }
  }
  EXPECT_GT(required, 10);
}

TEST(Study, EveryKeyRefusesAWrongTypeWithItsLine) {
  for (const Place& place : places()) {
    const bool text = place.parameter.kind == optimizer::Parameter::Kind::text;
    const std::string told = complaints(with_line(place, place.leaf + (text ? " = 3" : " = \"three\"")));
    EXPECT_THAT(told, testing::MatchesRegex("s\\.toml:[0-9]+: [^\n]*")) << place.parameter.key;
    EXPECT_THAT(told, HasSubstr(place.parameter.key + (text ? " = 3: must be" : " = \"three\": must be a")));
  }
}

TEST(Study, EveryNumberRefusesNotANumberAndInfinity) {
  for (const Place& place : places()) {
    if (place.parameter.kind == optimizer::Parameter::Kind::text) continue;
    for (const std::string value : {"nan", "inf", "-inf"})
      EXPECT_THAT(complaints(with_line(place, place.leaf + " = " + value)),
                  HasSubstr(place.parameter.key + " = " + value + ": must be a"));
  }
}

TEST(Study, EveryNumberKeepsItsRange) {
  for (const Place& place : places()) {
    const Range& range = place.parameter.range;
    const bool whole = place.parameter.kind == optimizer::Parameter::Kind::whole;
    if (place.parameter.kind == optimizer::Parameter::Kind::text) continue;
    for (const double bound : {range.lower, range.upper}) {
      if (!std::isfinite(bound)) continue;
      const double step = (bound == range.lower ? -1 : 1) * std::max(1.0, 1e-6 * std::abs(bound));
      std::string value = shortest(bound + step);
      if (!whole && value.find_first_of(".e") == std::string::npos) value += ".0";
      EXPECT_THAT(complaints(with_line(place, place.leaf + " = " + value)), HasSubstr(": " + range.phrase()))
          << place.parameter.key << " = " << value;
    }
  }
}

TEST(Study, AThresholdNeedsTheLawThatHasOne) {
  const std::string threshold = replaced(sample(), "energy_threshold_j_per_m2 = 0", "energy_threshold_j_per_m2 = 3");
  EXPECT_THAT(complaints(threshold),
              HasSubstr("contact.energy_threshold_j_per_m2 = 3: has no meaning unless contact.wear_law = \"energy\""));
  EXPECT_EQ(read(replaced(threshold, "wear_law = \"archard\"", "wear_law = \"energy\""))
                .scene.contact.wear.at("energy")
                .threshold,
            3);
}

TEST(Study, WholeNumbersRefuseFractions) {
  EXPECT_THAT(complaints(replaced(sample(), "harmonics = 5", "harmonics = 3.5")),
              HasSubstr("solver.harmonics = 3.5: must be a whole number >= 1"));
}

TEST(Study, EveryProblemIsToldAtOnceInTheOrderOfTheFile) {
  std::string text = replaced(sample(), "speed_rpm = 10000", "speed_rpm = -1");
  text = replaced(text, "neck_width_mm = 8.5", "nek_width_mm = 8.5");
  text = replaced(text, "friction = 0.5", "friction = nan");
  const std::string told = complaints(text);
  const std::size_t speed = told.find("scene.speed_rpm = -1: must be > 0");
  const std::size_t neck = told.find("geometry.nek_width_mm = 8.5: unknown key; did you mean geometry.neck_width_mm?");
  const std::size_t friction = told.find("contact.friction = nan: must be a number >= 0");
  EXPECT_NE(speed, std::string::npos) << told;
  EXPECT_NE(neck, std::string::npos) << told;
  EXPECT_NE(friction, std::string::npos) << told;
  EXPECT_LT(speed, neck);
  EXPECT_LT(neck, friction);
  EXPECT_THAT(told, HasSubstr("geometry.neck_width_mm: is missing"));
}

TEST(Study, UnknownSectionsAndKeysElsewhereAreNamed) {
  EXPECT_THAT(complaints(replaced(sample(), "\n[contact]", "\n[contacts]")),
              HasSubstr("contacts = {...}: unknown section; did you mean contact?"));
  EXPECT_THAT(complaints(replaced(sample(), "\n[contact]\n", "\n[contact]\ntip_force_n = 3\n")),
              HasSubstr("contact.tip_force_n = 3: unknown key; did you mean loading.tip_force_n?"));
  EXPECT_THAT(complaints(replaced(sample(), "\n[contact]\n", "\n[contact]\nnormal_stiffness = 1e13\n")),
              HasSubstr("unknown key; did you mean contact.normal_stiffness_n_per_m3?"));
}

TEST(Study, AsperitiesAreStiffOrRigid) {
  const auto told = [](const char* stiffness) {
    return complaints(
        replaced(sample(), "normal_stiffness_n_per_m3 = 0", std::string("normal_stiffness_n_per_m3 = ") + stiffness));
  };
  EXPECT_EQ(told("1e9"), "");
  EXPECT_EQ(told("0"), "");
  const auto told_of_variable = [](const std::string& lower, const std::string& start) {
    return complaints(sample() + "\n[[variable]]\nkey = \"contact.normal_stiffness_n_per_m3\"\nlower = " + lower +
                      "\nupper = 1e14\n" + start);
  };
  EXPECT_EQ(told_of_variable("1e12", "start = 1e13\n"), "");
  EXPECT_THAT(told_of_variable("1e8", "start = 1e13\n"), HasSubstr("lower = 1e+08: must be 0 (rigid) or >= 1e+09"));
  EXPECT_THAT(told_of_variable("0", "start = 1e13\n"), HasSubstr("0 means rigid and cannot be part of a range"));
  EXPECT_THAT(told_of_variable("1e12", "start = 0\n"), HasSubstr("start = 0: must be between lower = 1e+12"));
  EXPECT_THAT(told_of_variable("1e12", ""), HasSubstr("or give the variable a start"));
  EXPECT_THAT(told("1e8"), HasSubstr("contact.normal_stiffness_n_per_m3 = 1e+08: must be 0 (rigid) or >= 1e+09"));
}

TEST(Study, AnAccuracyOfOneResponseNeedsOneOfAll) {
  const std::string text = replaced(sample(), "upper = 300e6\n", "upper = 300e6\naccuracy = 0.1\n");
  EXPECT_THAT([&] { (void)read(text); }, testing::ThrowsMessage<InputError>(HasSubstr("counts only where")));
  for (const char* key : {"\naccuracy = ", "\nverify_accuracy = "}) {
    const std::string of_all = replaced(text, std::string(key) + "0\n", std::string(key) + "0.2\n");
    EXPECT_EQ(read(of_all).problem.constraints.front().accuracy, 0.1);
  }
}

TEST(Study, SectionsThatAreNoneAreRefused) {
  EXPECT_THAT(complaints("scene = 3\nvariable = 2\n"), HasSubstr("s.toml:1: scene = 3: must be a section, [scene]"));
  EXPECT_THAT(complaints("variable = 2\n"), HasSubstr("variable = 2: must be written as [[variable]]"));
  EXPECT_THAT(complaints("[variable]\nkey = \"a\"\n"), HasSubstr("must be written as [[variable]]"));
}

TEST(Study, AnEmptyFileMissesWhatIsRequired) {
  const std::string told = complaints("");
  EXPECT_THAT(told, HasSubstr("s.toml: scene.type: is missing; it must be one of section, sector"));
  EXPECT_THAT(told, HasSubstr("s.toml: geometry.flank_angle_deg: is missing"));
  EXPECT_THAT(told, Not(HasSubstr("objective")));
}

TEST(Study, OtherSceneTypesAreRefused) {
  EXPECT_THAT(complaints(replaced(sample(), "type = \"section\"", "type = \"solid\"")),
              HasSubstr("scene.type = \"solid\": must be one of section, sector"));
}

TEST(Study, ASectorHasKeysOfItsOwnAndASectionMayCarryThem) {
  for (const char* type : {"section", "sector"}) {
    std::string text = replaced(sample(), "type = \"section\"", std::string("type = \"") + type + '"');
    text = replaced(replaced(text, "skew_angle_deg = 0", "skew_angle_deg = 20"), "stagger_deg = 0", "stagger_deg = 30");
    const Study study = read(text);
    EXPECT_EQ(study.scene.kind, optimizer::find_scene_kind(type));
    EXPECT_DOUBLE_EQ(study.scene.solid.skew_angle, 20 * std::numbers::pi / 180);
    EXPECT_DOUBLE_EQ(optimizer::parameter(study.scene, "geometry.stagger_deg"), 30);
    // What old runs are recognised by.
    EXPECT_THAT(physics_text(study.scene), HasSubstr(std::string("scene.type = ") + type + "\n"));
    EXPECT_THAT(physics_text(study.scene), HasSubstr("geometry.stagger_deg = 30\n"));
  }
}

// A run is resumed with its own wear law and its own way of following the resonance alone.
TEST(Study, ModesOtherThanTheDefaultOnesAreItsPhysics) {
  const Study plain = read(sample());
  optimizer::Scene scene = plain.scene;
  EXPECT_THAT(physics_text(scene), Not(AnyOf(HasSubstr("wear_law"), HasSubstr("follow"))));
  scene.contact.wear_law = "energy";
  scene.loading.follow = wear::Follow::resonance;
  EXPECT_THAT(physics_text(scene), Not(HasSubstr("prestress")));
  scene.solver.prestress = optimizer::Prestress::shared;
  EXPECT_THAT(physics_text(scene),
              AllOf(HasSubstr("contact.wear_law = energy\n"), HasSubstr("loading.follow = resonance\n"),
                    HasSubstr("solver.prestress = shared\n")));
}

// Unless a study says otherwise its designs share their matrices where all of them have the same mesh.
TEST(Study, DesignsWithOneMeshShareTheirMatrices) {
  const std::string& silent = sample();
  const std::string given = replaced(silent, "# prestress = ", "prestress = ");
  EXPECT_EQ(read(silent).scene.solver.prestress, optimizer::Prestress::own);
  const auto of_variable = [](std::string text, const std::string& variable) {
    for (std::size_t at = text.find("\n[[variable]]"); at != std::string::npos; at = text.find("\n[[variable]]"))
      text.erase(at, text.find("\n[", at + 2) - at);
    return read(text + "\n[[variable]]\n" + variable).scene.solver.prestress;
  };
  const std::string crown = "key = \"geometry.left.flank_crown_um\"\nlower = 0\nupper = 9\n";
  EXPECT_EQ(of_variable(silent, crown), optimizer::Prestress::shared);
  EXPECT_EQ(of_variable(given, crown), optimizer::Prestress::own);
  EXPECT_EQ(of_variable(silent, "key = \"geometry.neck_width_mm\"\nlower = 8\nupper = 9\n"), optimizer::Prestress::own);
  // What follows from a variable may move the mesh though the variable does not.
  const auto linked = [](const char* key) {
    return "[[linked]]\nkey = \"" + std::string(key) + "\"\nvalue = \"9 + geometry_left_flank_crown_um / 100\"\n";
  };
  EXPECT_EQ(of_variable(silent, crown + linked("geometry.shank_width_mm")), optimizer::Prestress::own);
  // Cases of one design share them where they differ in what leaves the mesh.
  const auto of_cases = [&](const std::string& text, const std::string& key, const std::string& variable) {
    const auto load = [&](const char* name, const char* value) {
      return std::string("[[case]]\nname = \"") + name + "\"\n\"" + key + "\" = " + value + "\n";
    };
    return of_variable(text, variable + load("one", "0.4") + load("other", "0.3"));
  };
  const std::string width = "key = \"geometry.neck_width_mm\"\nlower = 8\nupper = 9\n";
  EXPECT_EQ(of_cases(silent, "contact.friction", width), optimizer::Prestress::cases);
  EXPECT_EQ(of_cases(silent, "loading.tip_force_n", width), optimizer::Prestress::own);      // which they share anyway
  EXPECT_EQ(of_cases(silent, "geometry.flank_crown_um", width), optimizer::Prestress::own);  // two to share are too few
  const std::string third = "[[case]]\nname = \"third\"\ngeometry.flank_crown_um = 0.2\n";
  EXPECT_EQ(of_cases(silent, "geometry.flank_crown_um", width + third), optimizer::Prestress::shared);
  EXPECT_EQ(of_cases(silent, "geometry.shank_height_mm", width), optimizer::Prestress::own);
  EXPECT_EQ(of_cases(silent, "contact.friction", crown), optimizer::Prestress::shared);
  EXPECT_EQ(of_cases(given, "contact.friction", width), optimizer::Prestress::own);
  const std::string friction = "\n[[variable]]\nkey = \"contact.friction\"\nlower = 0.3\nupper = 0.6\n";
  const std::string uncertain = "[[uncertain]]\nkey = \"contact.friction\"\nplus_minus = 0.1\n";
  EXPECT_EQ(of_variable(silent, width + uncertain), optimizer::Prestress::cases);
  EXPECT_EQ(of_variable(silent, width + friction + uncertain), optimizer::Prestress::shared);
  // Two alike of three are too few.
  const std::string faster = "[[case]]\nname = \"faster\"\nscene.speed_rpm = 11000\n";
  EXPECT_EQ(of_cases(silent, "contact.friction", width + faster), optimizer::Prestress::own);
  EXPECT_EQ(of_variable(silent, crown + linked("geometry.right.flank_crown_um")), optimizer::Prestress::shared);
}

TEST(Study, AContactGridFinerThanTheMeshIsRefused) {
  const std::string fine = replaced(sample(), "contact_slot_elements = 0", "contact_slot_elements = 9");
  EXPECT_EQ(complaints(fine), "");  // a section has no grid along the slot
  EXPECT_THAT(complaints(replaced(fine, "type = \"section\"", "type = \"sector\"")),
              HasSubstr("mesh.contact_slot_elements = 9: must not exceed slot_elements (8)"));
}

TEST(Study, FlankKeysSetBothSidesAndOneSideOverrides) {
  const Study study = read(sample() + "\n[geometry.left]\nflank_angle_deg = 48.0\n");
  EXPECT_DOUBLE_EQ(study.scene.geometry.flank("left").angle, 48 * std::numbers::pi / 180);
  EXPECT_DOUBLE_EQ(study.scene.geometry.flank("right").angle, 50 * std::numbers::pi / 180);
  const std::string both_sides = "[geometry.left]\nflank_angle_deg = 48\n[geometry.right]\nflank_angle_deg = 52\n";
  const Study split = read(without(sample(), "flank_angle_deg") + both_sides);
  EXPECT_DOUBLE_EQ(split.scene.geometry.flank("right").angle, 52 * std::numbers::pi / 180);
  EXPECT_THAT(complaints(without(sample(), "flank_angle_deg") + "[geometry.left]\nflank_angle_deg = 48\n"),
              HasSubstr("geometry.flank_angle_deg: is missing"));
}

TEST(Study, TheDiskIsOfTheBladesMaterialUnlessGiven) {
  const std::string steel = replaced(sample(), "density_kg_m3 = 4430", "density_kg_m3 = 7800");
  EXPECT_EQ(read(steel).scene.disk.density, 7800);
  EXPECT_EQ(read(replaced(steel, "# density_kg_m3 = 4430", "density_kg_m3 = 8000")).scene.disk.density, 8000);
}

TEST(Study, VariablesAreChecked) {
  const auto variable = [](const std::string& body) { return complaints(sample() + "\n[[variable]]\n" + body); };
  EXPECT_THAT(variable("key = \"geometry.neck_width_mm\"\nlower = 8.0\nupper = 9.0\n"),
              HasSubstr("variable[3].key = \"geometry.neck_width_mm\": is already a variable"));
  EXPECT_THAT(variable("key = \"geometry.left.flank_crown_um\"\nlower = 0\nupper = 9.0\n"),
              HasSubstr("sets the same dimension as the variable geometry.flank_crown_um"));
  EXPECT_THAT(variable("key = \"geometry.flank_angel_deg\"\nlower = 45\nupper = 55\n"),
              HasSubstr("did you mean \"geometry.flank_angle_deg\"?"));
  EXPECT_THAT(variable("key = \"flank_angle_deg\"\nlower = 45\nupper = 55\n"),
              HasSubstr("did you mean \"geometry.flank_angle_deg\"?"));
  EXPECT_THAT(variable("key = \"geometry.flank_angle_deg\"\nlower = 45\nupper = 95\n"),
              HasSubstr("variable[3].upper = 95: must be >= 5 and <= 85"));
  EXPECT_THAT(variable("key = \"geometry.flank_angle_deg\"\nlower = 55\nupper = 45\n"),
              HasSubstr("variable[3].upper = 45: must be > lower = 55"));
  EXPECT_THAT(variable("key = \"geometry.flank_angle_deg\"\nlower = 52\nupper = 55\n"),
              HasSubstr("geometry.flank_angle_deg = 50: is the start of variable[3] and must be between"));
  EXPECT_THAT(variable("key = \"geometry.flank_angle_deg\"\nlower = 52\nupper = 55\nstart = 56\n"),
              HasSubstr("variable[3].start = 56: must be between lower = 52 and upper = 55"));
  EXPECT_THAT(variable("key = \"solver.tolerance\"\nlower = 1e-9\nupper = 1e-8\n"),
              HasSubstr("cannot be varied: it is no property of a design"));
  EXPECT_THAT(variable("key = \"geometry.sectors\"\nlower = 40\nupper = 50\n"), HasSubstr("it is not a real number"));
  EXPECT_THAT(variable("key = \"material.blade.density_kg_m3\"\nlower = 4000\nupper = 5000\n"),
              HasSubstr("unless material.disk.density_kg_m3 is given"));
  EXPECT_THAT(variable("key = \"contact.energy_threshold_j_per_m2\"\nlower = 0\nupper = 5\n"),
              HasSubstr("changes nothing with contact.wear_law = \"archard\""));
  EXPECT_THAT(variable("lower = nan\n"), HasSubstr("variable[3].key: is missing"));
  EXPECT_THAT(variable("key = 3\nlower = 4\nupper = 5\nunit = \"mm\"\n"), HasSubstr("variable[3].unit"));
}

TEST(Study, WithoutVariablesADesignIsStillJudged) {
  std::string text = sample();
  for (std::size_t at = text.find("\n[[variable]]"); at != std::string::npos; at = text.find("\n[[variable]]"))
    text.erase(at, text.find("\n[", at + 2) - at);
  const Study study = read(text);
  EXPECT_EQ(study.problem.space.size(), 0U);
  EXPECT_EQ(study.problem.objective.size(), 1U);
  EXPECT_EQ(study.problem.constraints.size(), 2U);
  EXPECT_THAT(complaints(text + "\n[[constraint]]\nresponse = \"mass_kg\"\nupper = 1\n\n"
                                "[[constraint]]\nresponse = \"mass_kg\"\nupper = 2\n"),
              HasSubstr("constraint[3].upper = 2: is limited from above already"));
}

TEST(Study, AVariableOfBothFlanksConflictsWithOneFixed) {
  EXPECT_THAT(complaints(sample() + "\n[geometry.left]\nflank_crown_um = 2\n"),
              HasSubstr("cannot vary both flanks while geometry.left.flank_crown_um fixes one of them"));
}

TEST(Study, ObjectivesAreChecked) {
  const std::string none =
      replaced(sample(), "[[objective]]\nresponse = \"asymptotic_wear_volume_m3\"\nweight = 1\n", "");
  EXPECT_THAT(complaints(none), HasSubstr("objective: is missing"));
  EXPECT_THAT(complaints(replaced(sample(), "response = \"asymptotic_wear_volume_m3\"",
                                  "response = \"asymptotic_wear_volume\"")),
              HasSubstr("did you mean \"asymptotic_wear_volume_m3\"?"));
  EXPECT_THAT(complaints(replaced(sample(), "weight = 1\n", "weight = 0\n")), HasSubstr("objective[0].weight = 0"));
  EXPECT_THAT(complaints(sample() + "\n[[objective]]\nresponse = \"mass_kg\"\n"),
              HasSubstr("objective[0].scale: is missing"));
}

TEST(Study, SeveralObjectivesAreASumWithWeightsAndAFrontWithout) {
  const std::string one = replaced(sample(), "weight = 1\n", ""), other = "\n[[objective]]\nresponse = \"mass_kg\"\n";
  const optimizer::Problem front = read_study(parse_document(one + other + "reference = 0.2\n", "s.toml")).problem;
  EXPECT_TRUE(front.front);
  EXPECT_EQ(front.objective[1].reference, 0.2);
  EXPECT_FALSE(read_study(parse_document(one, "s.toml")).problem.front);
  const std::string sum = replaced(sample(), "weight = 1\n", "weight = 1\nscale = 1e-10\n");
  EXPECT_FALSE(read_study(parse_document(sum + other + "weight = 2\nscale = 0.1\n", "s.toml")).problem.front);
  EXPECT_THAT(complaints(sum + other + "scale = 0.1\n"), HasSubstr("objective[1].weight: is missing; of several"));
  EXPECT_THAT(complaints(replaced(sample(), "weight = 1\n", "reference = 1e-9\n")),
              HasSubstr("objective[0].reference = 1e-09: has a meaning where several objectives without weight"));
  EXPECT_THAT(complaints(one + other + "scale = 0.1\n"), HasSubstr("objective[1].scale = 0.1: has a meaning in a sum"));
  EXPECT_THAT(complaints(one + other + other), HasSubstr("is an objective of the front already"));
}

TEST(Study, AlgorithmsHaveToSuitTheObjectives) {
  const auto with = [](const std::string& algorithm, int population) {
    return replaced(replaced(sample(), "algorithm = \"cobyla\"", "algorithm = \"" + algorithm + "\""), "population = 0",
                    "population = " + std::to_string(population));
  };
  const std::string other = "\n[[objective]]\nresponse = \"mass_kg\"\n";
  EXPECT_EQ(complaints(with("de", 8)), "");
  EXPECT_EQ(complaints(replaced(with("nsga2", 8), "weight = 1\n", "") + other), "");
  EXPECT_THAT(complaints(with("nsga2", 0)),
              HasSubstr("optimizer.algorithm = \"nsga2\": finds a front and needs several"));
  EXPECT_THAT(complaints(replaced(with("nsga2", 10), "weight = 1\n", "") + other),
              HasSubstr("optimizer.population = 10: must be a multiple of 4"));
  EXPECT_THAT(complaints(with("de", 4)), HasSubstr("or >= 5"));
  EXPECT_THAT(complaints(with("cobyla", 8)), HasSubstr("optimizer.population = 8: has a meaning with algorithm"));
}

TEST(Study, ConstraintsAreChecked) {
  const auto limit = [](const std::string& body) { return complaints(sample() + "\n[[constraint]]\n" + body); };
  EXPECT_THAT(limit("response = \"mass_kg\"\n"), HasSubstr("constraint[2]: needs an upper or a lower limit"));
  EXPECT_THAT(limit("response = \"mass_kg\"\nlower = 2\nupper = 1\n"),
              HasSubstr("contradicts the other limit of mass_kg: nothing is >= 2 and <= 1"));
  EXPECT_THAT(limit("response = \"post_width_m\"\nupper = 1e-3\n"), HasSubstr("nothing is >= 0.004 and <= 0.001"));
  EXPECT_THAT(limit("response = \"resonance_drift\"\nupper = 0\n"), HasSubstr("constraint[2].scale: is missing"));
  EXPECT_THAT(limit("response = \"mass_kg\"\nupper = inf\n"), HasSubstr("constraint[2].upper = inf: must be a finite"));
  EXPECT_EQ(limit("response = \"mass_kg\"\nlower = 1\nupper = 2\n"), "");
}

TEST(Study, ContradictionsAcrossKeysNameTheirPlace) {
  EXPECT_THAT(complaints(replaced(sample(), "harmonics = 5", "harmonics = 100")),
              testing::MatchesRegex("s.toml:[0-9]+: solver.samples = 128: must be >= .* = 202"));
  EXPECT_THAT(complaints(replaced(sample(), "nodal_diameter = 0", "nodal_diameter = 2")),
              HasSubstr("scene.nodal_diameter = 2: must be 0"));
  EXPECT_THAT(complaints(replaced(sample(), "\nmode = 1\n", "\nmode = 30\n")),
              HasSubstr("scene.mode = 30: must be <= solver.modes = 20"));
}

TEST(Study, TheNameIsAFolder) {
  EXPECT_THAT(complaints("name = \"../out\"\n" + sample()), HasSubstr("name = \"../out\": must be letters"));
  EXPECT_EQ(read_study(parse_document(sample(), "/a/fan/study.toml")).name, "fan");
}

TEST(Study, ExportFormatsAreKnown) {
  EXPECT_THAT(complaints(replaced(sample(), "formats = [\"dxf\"]", "formats = [\"dwg\"]")),
              HasSubstr("export.formats = \"dwg\": must be one of dxf"));
  EXPECT_THAT(complaints(replaced(sample(), "formats = [\"dxf\"]", "formats = \"dxf\"")), HasSubstr("must be a list"));
}

/// The sample with more text behind it.
Study with(const std::string& more) {
  return read(sample() + more);
}

std::string complaint(const std::string& more) {
  try {
    static_cast<void>(with(more));
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

TEST(StudyCases, AreReadWithKeysInQuotesOrNot) {
  const Study study = with(R"(
[[case]]
name = "cruise"
weight = 3
"loading.tip_force_n" = 1.5
[[case]]
name = "climb"
scene.speed_rpm = 11000
"material.blade.youngs_modulus_gpa" = 100
[[constraint]]
response = "mass_kg"
upper = 9
over = "climb"
)");
  ASSERT_EQ(study.problem.cases.size(), 2U);
  EXPECT_EQ(study.problem.cases[0].weight, 3);
  EXPECT_EQ(study.problem.cases[0].changes.at(0).value, 1.5);
  EXPECT_EQ(study.problem.cases[1].changes.at(0).key, "scene.speed_rpm");
  // The disk is of the blade's material, in every case.
  EXPECT_EQ(study.problem.cases[1].changes.at(2).key, "material.disk.youngs_modulus_gpa");
  EXPECT_EQ(study.problem.constraints.back().over, "climb");
  EXPECT_EQ(study.problem.objective.front().over, "worst");
}

TEST(StudyCases, TheDiskFollowsTheBladeInSamplesToo) {
  const char *blade = "material.blade.youngs_modulus_gpa", *disk = "material.disk.youngs_modulus_gpa";
  const std::string uncertain = "[[uncertain]]\nkey = \"" + std::string(blade) + "\"\nplus_minus = 7\n";
  const Study study = with("[[case]]\nname = \"hot\"\n\"" + std::string(blade) + "\" = 100\n" + uncertain);
  std::vector<double> moduli;
  for (const optimizer::LoadCase& sample : study.problem.cases) {
    const optimizer::Scene scene = optimizer::in_case(study.scene, sample);
    moduli.push_back(optimizer::parameter(scene, blade));
    EXPECT_EQ(optimizer::parameter(scene, disk), moduli.back()) << sample.name;
  }
  EXPECT_THAT(moduli, testing::UnorderedElementsAre(93, 100, 107));
  const Study own = read(replaced(sample() + uncertain, "[material.disk]\n", "[material.disk]\ngrade = \"17-4PH\"\n"));
  for (const optimizer::LoadCase& sample : own.problem.cases)
    EXPECT_EQ(optimizer::parameter(optimizer::in_case(own.scene, sample), disk), optimizer::parameter(own.scene, disk));
}

TEST(StudyCases, WrongOnesAreRefused) {
  const std::string named = "[[case]]\nname = \"a\"\n";
  EXPECT_THAT(complaint("[[case]]\nweight = 1\n"), HasSubstr("case[0].name: is missing"));
  EXPECT_THAT(complaint(named + "weight = 0\n"), HasSubstr("case[0].weight = 0: must be"));
  EXPECT_THAT(complaint(named + named), HasSubstr("is the name of another case"));
  EXPECT_THAT(complaint("[[case]]\nname = \"mean\"\n"), HasSubstr("says how cases count"));
  EXPECT_THAT(complaint("[[case]]\nname = \"a@b\"\n"), HasSubstr("must be letters"));
  EXPECT_THAT(complaint(named + "\"loading.tip_force\" = 1\n"), HasSubstr("did you mean \"loading.tip_force_n\"?"));
  EXPECT_THAT(complaint(named + "\"loading.tip_force_n\" = -1\n"), HasSubstr("must be"));
  EXPECT_THAT(complaint(named + "\"loading.tip_force_n\" = \"much\"\n"), HasSubstr("must be a number"));
  EXPECT_THAT(complaint(named + "\"scene.mode\" = 1.5\n"), HasSubstr("must be a whole number"));
  EXPECT_THAT(complaint(named + "\"scene.nodal_diameter\" = 2\n"),
              HasSubstr("case[0].scene.nodal_diameter = 2: must be 0"));
  EXPECT_THAT(complaint(named + "scene.mode = 99\n"), HasSubstr("case[0].scene.mode = 99: must be <= solver.modes"));
  EXPECT_THAT(complaint(named + "\"mesh.flank_elements\" = 9\n"), HasSubstr("is the same for all cases"));
  EXPECT_THAT(complaint(named + "\"geometry.left.flank_mismatch_um\" = 9\n"), HasSubstr("is a design variable"));
  EXPECT_THAT(complaint(named + "\"loading.tip_force_n\" = 1\nloading.tip_force_n = 2\n"),
              HasSubstr("sets the same number"));
  EXPECT_THAT(complaint("[[constraint]]\nresponse = \"mass_kg\"\nupper = 9\nover = \"mean\"\n"),
              HasSubstr("there is no [[case]]"));
  EXPECT_THAT(complaint(named + "[[constraint]]\nresponse = \"mass_kg\"\nupper = 9\nover = \"b\"\n"),
              HasSubstr("deviation, quantile, a"));
}

TEST(StudyCases, SamplesOutsideOfTheRangeOfTheirKeyAreRefused) {
  const std::string uncertain = "[[uncertain]]\nkey = \"contact.friction\"\n";
  EXPECT_EQ(complaint(uncertain + "plus_minus = 0.1\n"), "");
  EXPECT_THAT(
      complaint(uncertain + "plus_minus = 0.9\n"),
      HasSubstr("uncertain[0].key = \"contact.friction\": becomes -0.4 in sample/2 of its samples: must be >= 0"));
  // A range would take the place of what a case says.
  const std::string own = "[[case]]\nname = \"a\"\n\"contact.friction\" = 0.3\n";
  EXPECT_THAT(complaint(own + uncertain + "lower = 0.4\nupper = 0.6\n"), HasSubstr("number of its own in case a"));
  EXPECT_EQ(complaint(own + uncertain + "plus_minus = 0.1\n"), "");
  // One wrong line is one sentence.
  const std::string mean = "[[constraint]]\nresponse = \"mass_kg\"\nupper = 9\nover = \"mean\"\n";
  EXPECT_EQ(complaint(uncertain + "plus_minus = 0.1\n" + mean), "");
  EXPECT_THAT(complaint(uncertain + "plus_minus = -1\n" + mean), testing::Not(HasSubstr("there is no [[case]]")));
}

TEST(StudyCases, ActTogetherOnFlanksOfOneShapeAtHeldFrequencies) {
  const std::string limit = "[[constraint]]\nresponse = \"mission_wear_volume_m3\"\nupper = 1e-9\n";
  const std::string cases = "[[case]]\nname = \"a\"\n[[case]]\nname = \"b\"\n";
  EXPECT_EQ(complaint(cases + "\"loading.tip_force_n\" = 1\n" + limit), "");
  EXPECT_EQ(complaint(limit), "");
  EXPECT_THAT(complaint(cases + "\"geometry.platform_width_mm\" = 29\n" + limit),
              HasSubstr("none of them may change the geometry"));
  EXPECT_THAT(complaint(cases + "\"loading.tip_force_n\" = 1\n" + limit + "over = \"sum\"\n"),
              HasSubstr("one number of them all"));
  // Where what is uncertain is wrong there are no samples to tell whether something goes over them.
  EXPECT_THAT(complaint("[[uncertain]]\nkey = \"contact.friction\"\nplus_minus = -1\n" + limit + "over = \"mean\"\n"),
              testing::Not(HasSubstr("one number of them all")));
  const std::string drift =
      cases + "\"loading.tip_force_n\" = 1\n[[constraint]]\nresponse = \"mission_drift\"\nupper = 0.01\nover = ";
  EXPECT_EQ(complaint(drift + "\"b\"\n"), "");
  EXPECT_THAT(complaint(drift + "\"mean\"\n"), HasSubstr("the name of a case"));
}

/// The sample with another objective.
optimizer::ObjectiveTerm term(const std::string& lines) {
  std::string text = sample();
  const std::size_t begin = text.find("\n[[objective]]\n");
  text.replace(begin, text.find("\n[[constraint]]\n") - begin, "\n[[objective]]\n" + lines + "\n");
  return read(text).problem.objective.at(0);
}

TEST(StudyAims, SayWhichWayAResponseShallGo) {
  const std::string drift = "response = \"resonance_drift\"\n", mass = "response = \"mass_kg\"\n";
  EXPECT_EQ(term(mass + "aim = \"max\"").weight, -1);
  EXPECT_FALSE(term(mass + "aim = \"min\"").absolute);
  EXPECT_TRUE(term(mass + "aim = 3.5").absolute);
  EXPECT_EQ(term(mass + "aim = 3.5").target, 3.5);
  // A drift to either side is one.
  EXPECT_TRUE(term(drift).absolute);
  EXPECT_TRUE(term(drift + "aim = \"zero\"").absolute);
  EXPECT_FALSE(term(drift + "aim = \"min\"").absolute);
  EXPECT_FALSE(term(drift + "absolute = false").absolute);
  EXPECT_THROW(term(mass + "aim = \"low\""), InputError);
  EXPECT_THROW(term(mass + "aim = \"min\"\nabsolute = true"), InputError);
  EXPECT_THROW(term(mass + "aim = \"max\"\nweight = -1"), InputError);
}

TEST(StudyVariables, MayHoldSeveralKeysAtOneValue) {
  const std::string both =
      "[[variable]]\nkeys = [\"geometry.shank_width_mm\", \"geometry.aerofoil_root_thickness_mm\"]\n";
  Study study = with(both + "lower = 4\nupper = 12\nstart = 5\n");
  ASSERT_EQ(study.problem.space.size(), 4U);
  const std::vector<double> x = study.problem.space.start();
  EXPECT_EQ(study.problem.space.settings(x).at("geometry.shank_width_mm"), 5);
  EXPECT_EQ(study.problem.space.settings(x).at("geometry.aerofoil_root_thickness_mm"), 5);
  EXPECT_THAT(complaint(both + "key = \"geometry.bore_radius_mm\"\nlower = 4\nupper = 12\n"),
              HasSubstr("must not be given beside key"));
  EXPECT_THAT(complaint("[[variable]]\nkeys = []\nlower = 4\nupper = 12\n"), HasSubstr("must be a list of keys"));
  EXPECT_THAT(complaint("[[variable]]\nkeys = [\"geometry.shank_width_mm\", \"geometry.shank_width_mm\"]\nlower = "
                        "4\nupper = 12\nstart = 5\n"),
              HasSubstr("is already a variable"));
  EXPECT_THAT(complaint("[[variable]]\nkeys = [\"geometry.shank_width_mm\", \"geometry.neck_width_mm\"]\nlower = "
                        "4\nupper = 12\nstart = 5\n"),
              HasSubstr("is already a variable"));
}

TEST(StudyLinks, FollowFromTheVariables) {
  const Study study =
      with("[[linked]]\nkey = \"geometry.shank_width_mm\"\nvalue = \"2 * geometry_neck_width_mm - sqrt(16)\"\n");
  ASSERT_EQ(study.linked.size(), 1U);
  // At the file's own numbers at once, and at those of every design.
  const double neck = optimizer::parameter(study.scene, "geometry.neck_width_mm");
  EXPECT_NEAR(optimizer::parameter(study.scene, "geometry.shank_width_mm"), 2 * neck - 4, 1e-12);
  std::vector<double> x = study.problem.space.start();
  const std::vector<std::string> keys = study.problem.space.keys();
  const auto at = std::ranges::find(keys, "geometry.neck_width_mm") - keys.begin();
  x[static_cast<std::size_t>(at)] = 8.25;
  EXPECT_EQ(settings_at(study, x).at("geometry.shank_width_mm"), 12.5);
  EXPECT_EQ(settings_at(study, x).at("geometry.neck_width_mm"), 8.25);
  // Of the variables alone: one link does not hang on another.
  EXPECT_THAT(complaint("[[linked]]\nkey = \"geometry.shank_width_mm\"\nvalue = \"12\"\n[[linked]]\nkey = "
                        "\"geometry.aerofoil_root_thickness_mm\"\nvalue = \"geometry_shank_width_mm / 2\"\n"),
              HasSubstr("must be a formula of the design variables"));
  EXPECT_TRUE(std::isnan(with_linked({{"a", 1}}, {{{"b", "2 * a"}, {"c", "b + 1"}}}).at("c")));
}

TEST(StudyLinks, WithoutAValueAreNone) {
  const std::vector<LinkedKey> linked{{.key = "a", .value = "1 / scene_x"}, {.key = "b", .value = "nonsense("}};
  const std::map<std::string, double> settings = with_linked({{"scene.x", 4}}, linked);
  EXPECT_EQ(settings.at("a"), 0.25);
  EXPECT_TRUE(std::isnan(settings.at("b")));
}

TEST(StudyLinks, WrongOnesAreRefused) {
  const auto linked = [](const std::string& key, const std::string& value) {
    return complaint("[[linked]]\nkey = \"" + key + "\"\nvalue = \"" + value + "\"\n");
  };
  const std::string width = "geometry.shank_width_mm";
  EXPECT_EQ(linked(width, "geometry_neck_width_mm + 2"), "");
  EXPECT_THAT(linked(width, "geometry_neck_width_mm +"), HasSubstr("must be a formula of the design variables"));
  EXPECT_THAT(linked(width, "geometry_neck + 2"), testing::AllOf(HasSubstr("linked[0].value = \"geometry_neck + 2\""),
                                                                 HasSubstr("geometry_neck_width_mm")));
  EXPECT_THAT(linked(width, "-1"), HasSubstr("comes to -1, but geometry.shank_width_mm must be"));
  EXPECT_THAT(linked(width, "0 / 0"), HasSubstr("comes to"));
  EXPECT_THAT(linked(width, "2,5 + geometry_neck_width_mm"), HasSubstr("decimals have a point"));
  EXPECT_EQ(linked(width, "max(9, geometry_neck_width_mm)"), "");
  EXPECT_THAT(linked(width, "10 + 0 * sqrt(8.5001 - geometry_neck_width_mm)"), HasSubstr("in the middle of the"));
  EXPECT_THAT(linked("geometry.neck_width_mm", "9"), HasSubstr("is a design variable"));
  EXPECT_THAT(linked("geometry.shank_widht_mm", "9"), HasSubstr("did you mean \"geometry.shank_width_mm\"?"));
  EXPECT_THAT(linked("mesh.bulk_size_mm", "3"), HasSubstr("cannot be varied"));
  EXPECT_THAT(complaint("[[linked]]\nkey = \"" + width + "\"\n"), HasSubstr("linked[0].value: is missing"));
  const std::string once = "[[linked]]\nkey = \"" + width + "\"\nvalue = \"12\"\n";
  EXPECT_THAT(complaint(once + once), HasSubstr("is linked already"));
  EXPECT_THAT(complaint("[[case]]\nname = \"a\"\n\"" + width + "\" = 12\n" + once), HasSubstr("differs between cases"));
  // At the line where it is linked, not where the file has the number.
  const std::string threshold = linked("contact.energy_threshold_j_per_m2", "3");
  EXPECT_THAT(threshold, HasSubstr("linked[0].key = \"contact.energy_threshold_j_per_m2\": changes nothing with"));
  EXPECT_THAT(threshold, HasSubstr("s.toml:" + std::to_string(std::ranges::count(sample(), '\n') + 2) + ":"));
}

TEST(StudyLinks, CannotBeSetOnTheCommandLine) {
  const std::string key = "geometry.shank_width_mm";
  const std::string text = sample() + "[[linked]]\nkey = \"" + key + "\"\nvalue = \"geometry_neck_width_mm + 2\"\n";
  Document document = parse_document(text, "s.toml");
  const std::vector<Override> given{{.key = key, .value = "12", .origin = "--set " + key + "=12"}};
  apply_overrides(document, given);
  EXPECT_THAT([&] { static_cast<void>(read_study(document)); },
              testing::ThrowsMessage<InputError>(HasSubstr("follows from the design variables and cannot be set")));
}

// Wherever uncertain numbers are looked at: a range of its own would part a key from what it follows.
TEST(StudyLinks, MayBeUncertainAboutWhatTheyFollow) {
  const std::string width = "geometry.shank_width_mm", link = "[[linked]]\nkey = \"" + width + "\"\nvalue = \"12\"\n";
  for (const std::string rule : {"nominal", "corners", "sobol", "gauss"}) {
    const std::string robust =
        "[robust]\nrule = \"" + rule + "\"\n" + link + "[[uncertain]]\nkey = \"" + width + "\"\n";
    EXPECT_THAT(complaint(robust + "lower = 11\nupper = 13\n"), HasSubstr("or follows from some: give plus_minus"));
    EXPECT_EQ(complaint(robust + "plus_minus = 0.1\n"), "") << rule;
    EXPECT_EQ(complaint(robust + "relative = 0.01\n"), "") << rule;
    EXPECT_THAT(complaint(robust + "plus_minus = 0.1\nmean = 12\n"), HasSubstr("only has a meaning")) << rule;
  }
}

}  // namespace
}  // namespace dovetail::studies
