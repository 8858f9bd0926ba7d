#include "geometry/rules/feasibility.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>
#include <string_view>

#include "geometry/profile/exact_section.hpp"
#include "geometry/profile/measures.hpp"
#include "geometry/rules/params.hpp"
#include "geometry/rules/solid_rules.hpp"

namespace dovetail::geometry {

namespace {

/// Minus the sum of squares of the broken margins among the rules named; -1 when none is broken.
double crossing_margin(const std::vector<Rule>& rules, std::initializer_list<std::string_view> names) {
  double sum = 0;
  for (const Rule& rule : rules)
    if (rule.margin < 0 && std::find(names.begin(), names.end(), rule.name) != names.end())
      sum += rule.margin * rule.margin;
  return sum > 0 ? -sum : -1;
}

Rule simple_rule(const char* body, const Chain& chain, const std::vector<Rule>& rules,
                 std::initializer_list<std::string_view> causes) {
  const bool simple = is_simple(chain), bounds = simple && area(chain) > 0;
  return {.name = std::string(body) + "_simple",
          .margin = bounds ? 0 : crossing_margin(rules, causes),
          .sentence = fmt::format("the outline of the {} {}", body,
                                  bounds   ? "does not cross itself"
                                  : simple ? "is inside out"
                                           : "crosses itself")};
}

Rule overlap_rule(double overlap, double flank_length) {
  const double depth = overlap / flank_length;
  return {
      .name = "no_overlap",
      .margin = overlap > 0 ? -depth / RuleParams{}.overlap_unit : 0,
      .sentence = overlap > 0
                      ? fmt::format("blade and disk overlap by {:.4g} mm2, {:.4g} mm deep on the mean over the flanks",
                                    overlap * 1e6, depth * 1e3)
                      : "blade and disk have only their flanks in common"};
}

bool all_kept(const std::vector<Rule>& rules) {
  return std::all_of(rules.begin(), rules.end(), [](const Rule& rule) { return rule.margin >= 0; });
}

}  // namespace

Feasibility check_feasibility(const ProfileParameters& parameters, const FeasibilityLimits& limits) {
  Feasibility result;
  result.rules = closed_form_rules(parameters, limits);
  const Profile profile = build_profile(parameters);
  const Rule blade = simple_rule("blade", profile.blade, result.rules,
                                 {"neck_left_fits", "neck_right_fits", "shoulder_fits", "shank_fits",
                                  "platform_underside_fits", "platform_top_fits", "aerofoil_fits", "root_bottom_fits"});
  const Rule disk = simple_rule(
      "disk", profile.disk, result.rules,
      {"slot_floor_fits", "mouth_left_fits", "mouth_right_fits", "runout_left_fits", "runout_right_fits", "web_wall",
       "slot_left_within_cut", "slot_right_within_cut", "mouth_left_within_cut", "mouth_right_within_cut"});
  result.rules.push_back(blade);
  result.rules.push_back(disk);
  if (blade.margin < 0 || disk.margin < 0) {
    result.rules.push_back(
        {.name = "no_overlap",
         .margin = std::min(blade.margin, disk.margin),
         .sentence = "whether blade and disk overlap cannot be told: an outline crosses itself or is inside out"});
  } else {
    const double overlap = overlap_area(profile.blade, profile.disk);
    result.overlap_area = overlap > ExactParams{}.noise ? overlap : 0;
    result.rules.push_back(overlap_rule(result.overlap_area, 2 * parameters.mean(&FlankParameters::length)));
  }
  result.feasible = all_kept(result.rules);
  return result;
}

Feasibility check_feasibility(const ProfileParameters& parameters, const SolidParameters& solid,
                              const FeasibilityLimits& limits) {
  Feasibility result = check_feasibility(parameters, limits);
  const std::vector<Rule> rules = solid_rules(parameters, solid);
  result.feasible = result.feasible && all_kept(rules);
  result.rules.insert(result.rules.end(), rules.begin(), rules.end());
  return result;
}

}  // namespace dovetail::geometry
