#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/enum_names.hpp"
#include "core/options.hpp"
#include "optimizer/problem/load_case.hpp"

namespace dovetail::optimizer {

/// How an uncertain number is distributed.
enum class Distribution { uniform, normal };
constexpr EnumNames<Distribution, 2> enum_names(Distribution) {
  return {{{Distribution::uniform, "uniform"}, {Distribution::normal, "normal"}}};
}
[[nodiscard]] constexpr std::string_view to_string(Distribution distribution) {
  return name_of(distribution);
}

/// A number of the study that is not known: of a uniform one the range, of a normal one mean and deviation - of the
/// number itself, of what is added to it, or of what it is multiplied by.
struct Uncertain {
  std::string key;
  Distribution distribution = Distribution::uniform;
  double first = 0, second = 0;  ///< lower and upper, or mean and deviation
  enum class Of { itself, offset, factor } of = Of::itself;
};

/// Where uncertain numbers are looked at.
enum class Rule {
  nominal,  ///< nowhere but at the numbers that the file has
  corners,  ///< both ends of every range (of a normal one sqrt 3 deviations away), and the middle
  sobol,    ///< points of a Sobol sequence
  gauss,    ///< a product of Gauss rules, of `points` each
};
constexpr EnumNames<Rule, 4> enum_names(Rule) {
  return {{{Rule::nominal, "nominal"}, {Rule::corners, "corners"}, {Rule::sobol, "sobol"}, {Rule::gauss, "gauss"}}};
}
[[nodiscard]] constexpr std::string_view to_string(Rule rule) {
  return name_of(rule);
}

/// Section [robust] of a study file.
struct RobustOptions {
  Rule rule = Rule::corners;
  int points = 0;          ///< >= 0; 0: 16 of a Sobol sequence, 3 of each Gauss rule; corners have as many as there are
  double quantile = 0.95;  ///< in (0, 1)
};

/// What samples are of where a study has no cases.
inline constexpr const char* kSampleOfStudy = "sample";

/// Samples of each case (of the one there is without cases, named "sample"), with weights that add up to the case's.
/// Throws InputError where there would be more than `most`.
[[nodiscard]] std::vector<LoadCase> sampled(const std::vector<LoadCase>& cases, const std::vector<Uncertain>& uncertain,
                                            const RobustOptions& options, int most = 4096);

}  // namespace dovetail::optimizer

template <>
std::span<const dovetail::Field<dovetail::optimizer::RobustOptions>>
dovetail::option_table<dovetail::optimizer::RobustOptions>();
