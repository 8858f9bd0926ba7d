#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/enum_names.hpp"
#include "studies/paper_sequence/results.hpp"

namespace dovetail::paper_sequence {

enum class Verdict { holds, partly, fails };
constexpr EnumNames<Verdict, 3> enum_names(Verdict) {
  return {{{Verdict::holds, "holds"}, {Verdict::partly, "holds in part"}, {Verdict::fails, "does not hold"}}};
}
[[nodiscard]] constexpr std::string_view to_string(Verdict verdict) {
  return name_of(verdict);
}

/// One finding of the reference beside what the scene gives.
struct Finding {
  std::string key = {};    ///< fit for files
  std::string paper = {};  ///< what the reference found
  std::string here = {};   ///< computed, in a sentence
  std::string why = {};    ///< of a difference; or empty
  Verdict verdict = Verdict::fails;
};

/// In the reference's order; empty without states to compare.
[[nodiscard]] std::vector<Finding> findings(const Results& results);

/// How the wear rate of the nodes that wear goes over the cycles.
struct RateCourses {
  int rise_first = 0;  ///< a peak more than 2 % above the first rate, then falling
  int only_fall = 0;
  int still_rising = 0;  ///< largest at the end
};
[[nodiscard]] RateCourses rate_courses(const History& history);

/// Share of the worn volume in the neck-side half of the flanks.
[[nodiscard]] double neck_side_share(const report::ContactRecord& contact);

/// Largest finite value and where it is.
struct Largest {
  double value = 0;
  std::size_t at = 0;
};
[[nodiscard]] Largest largest_of(const Numbers& values);

}  // namespace dovetail::paper_sequence
