// The program driven by others: Dakota's files, the protocol of UM-Bridge.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/errors.hpp"
#include "core/replace_file.hpp"
#include "studies/program/answers/dakota.hpp"
#include "studies/program/answers/um_bridge.hpp"

namespace dovetail::studies {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

DakotaQuestion asked(const std::string& text) {
  const std::filesystem::path file =
      std::filesystem::temp_directory_path() / ("dovetail_params_" + std::to_string(::getpid()));
  replace_file(file, text);
  try {
    DakotaQuestion question = read_dakota(file.string());
    std::filesystem::remove(file);
    return question;
  } catch (...) {
    std::filesystem::remove(file);
    throw;
  }
}

const std::string kStandard =
    "                                          2 variables\n"
    "                  8.749999999999998e+00 geometry.neck_width_mm\n"
    "                  -1.2e+01 geometry_flank_mismatch_um\n"
    "                                          2 functions\n"
    "                                          1 ASV_1:mass_kg\n"
    "                                          0 ASV_2:resonance_hz\n"
    "                                          2 derivative_variables\n"
    "                                          1 DVV_1:geometry.neck_width_mm\n"
    "                                          2 DVV_2:geometry_flank_mismatch_um\n"
    "                                          0 analysis_components\n"
    "                                          7 eval_id\n";
const std::string kAprepro =
    "{ DAKOTA_VARS = 2 }\n{ geometry.neck_width_mm = 8.749999999999998e+00 }\n{ geometry_flank_mismatch_um = -1.2e+01 "
    "}\n"
    "{ DAKOTA_FNS = 2 }\n{ ASV_1:mass_kg = 1 }\n{ ASV_2:resonance_hz = 0 }\n"
    "{ DAKOTA_DER_VARS = 2 }\n{ DVV_1:geometry.neck_width_mm = 1 }\n{ DVV_2:geometry_flank_mismatch_um = 2 }\n"
    "{ DAKOTA_AN_COMPS = 1 }\n{ AC_1:mesh = mesh }\n{ DAKOTA_EVAL_ID = 7 }\n";

TEST(Dakota, AsksInTwoFormats) {
  for (const std::string& text : {kStandard, kAprepro}) {
    const DakotaQuestion question = asked(text);
    EXPECT_THAT(question.set,
                ElementsAre("geometry.neck_width_mm=8.749999999999998", "geometry.flank_mismatch_um=-12"));
    ASSERT_EQ(question.functions.size(), 2U);
    EXPECT_EQ(question.functions[0].response, "mass_kg");
    EXPECT_FALSE(question.asks_for_derivatives());
    optimizer::Evaluation evaluation;
    evaluation.responses = {{"mass_kg", 0.1}, {"resonance_hz", 480}};
    EXPECT_EQ(dakota_results(question, evaluation, {}),
              "0.10000000000000001 mass_kg\n");  // what is not asked is not given
  }
}

TEST(Dakota, AsksForWhatCasesComeTo) {
  optimizer::Problem problem;
  problem.cases.resize(2);
  problem.cases[0].name = "cruise";
  problem.cases[0].weight = 3;
  problem.cases[1].name = "climb";
  optimizer::Evaluation evaluation;
  evaluation.responses = {{"mass_kg", 1}, {"mass_kg@cruise", 1}, {"mass_kg@climb", 5}};
  const auto answer = [&](const std::string& name) {
    const DakotaQuestion question{.file = "p.in", .set = {}, .functions = {{.response = name, .asked = 1}}};
    return dakota_results(question, evaluation, problem);
  };
  EXPECT_EQ(answer("mass_kg"), "1 mass_kg\n");
  EXPECT_EQ(answer("mass_kg@climb"), "5 mass_kg@climb\n");
  EXPECT_EQ(answer("mass_kg@worst"), "5 mass_kg@worst\n");
  EXPECT_EQ(answer("mass_kg@mean"), "2 mass_kg@mean\n");
  EXPECT_EQ(answer("mass_kg@sum"), "8 mass_kg@sum\n");
  EXPECT_EQ(answer("mass_kg@idle"), "fail: mass_kg@idle has no value\n");
}

std::string replaced_once(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

TEST(Dakota, HearsOfDesignsAndDerivativesThatFail) {
  const DakotaQuestion question = asked(kStandard);
  optimizer::Evaluation evaluation;
  evaluation.status = "infeasible";
  evaluation.messages = {"the neck is too thin"};
  EXPECT_EQ(dakota_results(question, evaluation, {}), "fail: infeasible: the neck is too thin\n");
  evaluation = {};
  EXPECT_EQ(dakota_results(question, evaluation, {}), "fail: mass_kg has no value\n");
  const DakotaQuestion gradient = asked(replaced_once(kStandard, "1 ASV_1", "3 ASV_1"));
  EXPECT_TRUE(gradient.asks_for_derivatives());
  EXPECT_THAT(dakota_results(gradient, evaluation, {}), testing::StartsWith("fail: derivatives are asked for"));
}

TEST(Dakota, FilesThatMeanSomethingElseAreRefused) {
  const auto told = [](const std::string& text) {
    try {
      static_cast<void>(asked(text));
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_THAT(told(replaced_once(kStandard, "geometry.neck_width_mm", "geometry.neck_wdth_mm")),
              HasSubstr("did you mean geometry.neck_width_mm?"));
  EXPECT_THAT(told(replaced_once(kStandard, ":mass_kg", ":mas_kg")), HasSubstr("did you mean mass_kg?"));
  EXPECT_THAT(told(kStandard.substr(0, kStandard.find("                  -1.2e+01"))), HasSubstr("cut short"));
  EXPECT_THAT(told("[geometry]\nneck = 3\n"), HasSubstr("is no line of a Dakota parameters file"));
  EXPECT_THAT(told(replaced_once(kStandard, "8.749999999999998e+00", "wide")), HasSubstr("is no line"));
  for (const char* count : {"-1", "1e300", "2.5", "nan", "99999999999", "two"}) {
    const std::string text = replaced_once(kStandard, "2 variables", std::string(count) + " variables");
    EXPECT_THAT(told(text), HasSubstr(std::string("variables = ") + count + ": must be a whole number, >= 0 and <= "));
    const std::string set = replaced_once(kStandard, "1 ASV_1", std::string(count) + " ASV_1");
    EXPECT_THAT(told(set), testing::AnyOf(HasSubstr("ASV_1:mass_kg = " + std::string(count) + ": must be a whole"),
                                          HasSubstr("two ASV_1:mass_kg: is no line")));
  }
  EXPECT_THAT(told(replaced_once(kStandard, "2 variables", "variables")), HasSubstr("variables: is no line"));
  EXPECT_THAT(told(replaced_once(kStandard, "2 variables", "1 variables")), HasSubstr("is no line"));
  EXPECT_THAT(told(replaced_once(kStandard, "1 ASV_1", "8 ASV_1")), HasSubstr("<= 7"));
}

/// A model of a sum.
UmModel sum() {
  return {.name = "sum", .inputs = {"a", "b"}, .outputs = {"mass_kg"}, .evaluate = [](std::span<const double> x) {
            optimizer::Evaluation evaluation;
            if (x[0] < 0) throw InputError({.file = {}, .key = "a", .value = "-1", .allowed = "must be > 0"});
            if (x[0] > 100) evaluation.status = "infeasible";
            evaluation.responses["mass_kg"] = x[0] + x[1];
            return evaluation;
          }};
}

nlohmann::json um(const std::string& path, const std::string& body, int status = 200) {
  const UmReply reply = um_bridge(sum(), path, body);
  EXPECT_EQ(reply.status, status) << reply.body;
  return nlohmann::json::parse(reply.body);
}

TEST(UmBridge, AnswersTheProtocol) {
  EXPECT_EQ(um("/Info", ""), nlohmann::json::parse(R"({"protocolVersion": 1.0, "models": ["sum"]})"));
  const std::string name = R"({"name": "sum", "config": {}})";
  EXPECT_EQ(um("/InputSizes", name), nlohmann::json::parse(R"({"inputSizes": [2]})"));
  EXPECT_EQ(um("/OutputSizes", name), nlohmann::json::parse(R"({"outputSizes": [1]})"));
  EXPECT_EQ(
      um("/ModelInfo", R"({"name": "sum"})").at("support"),
      nlohmann::json::parse(R"({"Evaluate": true, "Gradient": false, "ApplyJacobian": false, "ApplyHessian": false})"));
  EXPECT_EQ(um("/Evaluate", R"({"name": "sum", "input": [[1, 2.5]], "config": {}})"),
            nlohmann::json::parse(R"({"output": [[3.5]]})"));
}

TEST(UmBridge, NamesWhatIsWrong) {
  const auto type = [](const std::string& path, const std::string& body, int status) {
    return um(path, body, status).at("error").at("type").get<std::string>();
  };
  EXPECT_EQ(type("/Evaluate", R"({"name": "product", "input": [[1, 2]]})", 400), "ModelNotFound");
  for (const char* input : {"[[1]]", "[1, 2]", "[[1, 2], [3]]", R"([["1", 2]])", "3"})
    EXPECT_EQ(type("/Evaluate", std::string(R"({"name": "sum", "input": )") + input + "}", 400), "InvalidInput")
        << input;
  EXPECT_EQ(type("/Evaluate", "{", 400), "InvalidInput");
  EXPECT_EQ(type("/Evaluate", R"({"name": "sum", "input": [[-1, 2]]})", 400), "InvalidInput");
  EXPECT_EQ(type("/Evaluate", R"({"name": "sum", "input": [[101, 2]]})", 500), "InvalidOutput");
  EXPECT_EQ(type("/Evaluate", R"({"name": "sum", "input": [[1, 2]], "config": {"level": 1}})", 400), "InvalidInput");
  EXPECT_EQ(type("/Gradient", R"({"name": "sum"})", 400), "UnsupportedFeature");
  EXPECT_EQ(type("/Nowhere", R"({"name": "sum"})", 404), "InvalidInput");
}

}  // namespace
}  // namespace dovetail::studies
