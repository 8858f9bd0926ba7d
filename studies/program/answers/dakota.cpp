#include "studies/program/answers/dakota.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <optional>
#include <sstream>

#include "optimizer/problem/load_case.hpp"
#include "optimizer/responses/response_table.hpp"
#include "optimizer/scene/scene.hpp"
#include "studies/program/study_file/document.hpp"
#include "studies/program/study_file/refusal.hpp"

namespace dovetail::studies {
namespace {

/// "1.5 geometry.neck_width_mm" or "{ geometry.neck_width_mm = 1.5 }".
struct Line {
  std::string value, tag;
};

std::optional<Line> split(const std::string& text) {
  std::istringstream words(text);
  Line line;
  std::string first;
  if (!(words >> first)) return {};
  if (first != "{") {
    line.value = first;
    words >> line.tag;
    return line;
  }
  std::string equals;
  words >> line.tag >> equals >> line.value;
  return line;
}

std::optional<double> number(const std::string& text) {
  double value = 0;
  const char* end = text.data() + text.size();
  const char* begin = text.starts_with("+") ? text.data() + 1 : text.data();
  const auto [stop, error] = std::from_chars(begin, end, value);
  if (error != std::errc() || stop != end) return {};
  return value;
}

/// The key that a variable means.
std::string key_of(const std::string& file, const std::string& tag) {
  std::vector<std::string> keys;
  for (const optimizer::Parameter& parameter : optimizer::scene_parameters()) {
    std::string spelled = parameter.key;
    std::ranges::replace(spelled, '.', '_');
    if (parameter.key == tag || spelled == tag) return parameter.key;
    keys.push_back(parameter.key);
  }
  const std::string near = nearest(tag, keys);
  refuse(tag, "is a variable, but no key of a study file" + (near.empty() ? "" : "; did you mean " + near + "?"), {},
         file);
}

/// The response that "ASV_1:mass_kg" or "{ ASV_1:mass_kg = 1 }" asks for.
std::string response_of(const std::string& file, const std::string& tag) {
  const std::size_t colon = tag.find(':');
  std::string name = colon == tag.npos ? tag : tag.substr(colon + 1);
  const std::string plain(optimizer::split_case(name).response);
  if (optimizer::find_response(plain) == nullptr) {
    const std::string near = nearest(plain, optimizer::response_names());
    refuse(name, "is a function, but no response" + (near.empty() ? "" : "; did you mean " + near + "?"), {}, file);
  }
  return name;
}

/// What the lines that follow a count are.
enum class Section { none, variables, functions, other };

Section section_of(const std::string& tag) {
  const auto any_of = [&](std::initializer_list<const char*> names) {
    return std::ranges::find(names, tag) != names.end();
  };
  if (any_of({"variables", "DAKOTA_VARS"})) return Section::variables;
  if (any_of({"functions", "DAKOTA_FNS"})) return Section::functions;
  if (any_of({"derivative_variables", "DAKOTA_DER_VARS", "analysis_components", "DAKOTA_AN_COMPS", "metadata",
              "DAKOTA_METADATA"}))
    return Section::other;
  return Section::none;
}

/// Lines that a section may announce, and what an active set vector may ask for: 1 + 2 + 4.
constexpr Range kLines{.lower = 0, .upper = 1e6}, kAsked{.lower = 0, .upper = 7};

int whole(const std::string& file, const Line& line, const Range& range) {
  const std::optional<double> value = number(line.value);
  if (!value || !range.contains(*value) || *value != std::floor(*value))
    refuse(line.tag, "must be a whole number, " + range.phrase().substr(std::string_view("must be ").size()),
           one_line(line.value), file);
  return static_cast<int>(*value);
}

}  // namespace

bool DakotaQuestion::asks_for_derivatives() const {
  constexpr int kValue = 1;
  return std::ranges::any_of(functions, [](const Function& one) { return (one.asked & ~kValue) != 0; });
}

DakotaQuestion read_dakota(const std::string& file) {
  errno = 0;
  std::ifstream stream(file);
  if (!stream) refuse(file, std::string("cannot be read: ") + (errno != 0 ? std::strerror(errno) : "it does not open"));
  DakotaQuestion question{.file = file, .set = {}, .functions = {}};
  const auto wrong = [&](const std::string& line) {
    refuse(one_line(line), "is no line of a Dakota parameters file", {}, file);
  };
  Section section = Section::none;
  int left = 0;
  for (std::string text; std::getline(stream, text);) {
    const std::optional<Line> line = split(text);
    if (!line) continue;
    if (left == 0) {
      section = section_of(line->tag);
      if (section == Section::none && line->tag != "eval_id" && line->tag != "DAKOTA_EVAL_ID") wrong(text);
      left = section == Section::none ? 0 : whole(file, *line, kLines);
      continue;
    }
    --left;
    if (section == Section::other) continue;
    const std::optional<double> value = number(line->value);
    if (!value || line->tag.empty()) wrong(text);
    if (section == Section::variables && std::ranges::any_of(question.set, [&](const std::string& other) {
          return other.starts_with(key_of(file, line->tag) + "=");
        }))
      refuse(line->tag, "is a variable twice", {}, file);
    if (section == Section::variables)
      question.set.push_back(key_of(file, line->tag) + "=" + shortest(*value));
    else
      question.functions.push_back({.response = response_of(file, line->tag), .asked = whole(file, *line, kAsked)});
  }
  if (left > 0 || question.functions.empty()) refuse(file, "is no Dakota parameters file, or it is cut short");
  return question;
}

namespace {

/// A response, of one case as `NAME@CASE`, or what the cases come to together, as `NAME@mean`; NaN where there is none.
double value_of(const std::string& name, const optimizer::Evaluation& evaluation, const optimizer::Problem& problem) {
  if (const auto found = evaluation.responses.find(name); found != evaluation.responses.end()) return found->second;
  const auto [response, over] = optimizer::split_case(name);
  if (problem.cases.empty() || !named<optimizer::Over>(over)) return std::numeric_limits<double>::quiet_NaN();
  const optimizer::ObjectiveTerm term{.response = std::string(response), .over = std::string(over)};
  return term_value(problem, term, evaluation.responses, {}).value;
}

}  // namespace

std::string dakota_results(const DakotaQuestion& question, const optimizer::Evaluation& evaluation,
                           const optimizer::Problem& problem) {
  if (question.asks_for_derivatives())
    return "fail: derivatives are asked for, and there are none: numerical_gradients and no_hessians in the responses "
           "of "
           "Dakota's input\n";
  if (!evaluation.converged())
    return fmt::format("fail: {}{}\n", evaluation.status,
                       evaluation.messages.empty() ? "" : ": " + evaluation.messages.front());
  std::string text;
  for (const DakotaQuestion::Function& one : question.functions) {
    if (one.asked == 0) continue;
    const double value = value_of(one.response, evaluation, problem);
    if (!std::isfinite(value)) return fmt::format("fail: {} has no value\n", one.response);
    text += fmt::format("{:.17g} {}\n", value, one.response);
  }
  return text;
}

}  // namespace dovetail::studies
