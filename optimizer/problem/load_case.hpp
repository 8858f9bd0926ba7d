#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/enum_names.hpp"

namespace dovetail::optimizer {

/// One key of the study file with another number, in the unit of the file: `times` the number it has, plus `value`.
struct KeyChange {
  std::string key;
  double value = 0;
  double times = 0;  ///< 0: `value` takes the place of the number
};

/// What a blade goes through for a share of its life: keys of the study file that are different there.
struct LoadCase {
  std::string name;
  double weight = 1;  ///< > 0, share of the life; only ratios count
  std::vector<KeyChange> changes;
  /// The case whose uncertain numbers it has a sample of; empty: it is one by itself.
  std::string sample_of = {};
  /// Of a sequence of samples: it is of the first half, which is a coarser rule by itself.
  bool first_half = false;
};

/// What several cases come to in one number. Anything else that is said of it is the name of one case, of whose samples
/// the worst counts.
enum class Over {
  worst,      ///< the case that is farthest from where it should be
  mean,       ///< by weight
  sum,        ///< of the numbers times their weights
  deviation,  ///< standard deviation, by weight
  quantile,   ///< what a share of them, by weight, stays below
};
constexpr EnumNames<Over, 5> enum_names(Over) {
  return {{{Over::worst, "worst"},
           {Over::mean, "mean"},
           {Over::sum, "sum"},
           {Over::deviation, "deviation"},
           {Over::quantile, "quantile"}}};
}
[[nodiscard]] constexpr std::string_view to_string(Over over) {
  return name_of(over);
}

/// A response of one case in the maps of an evaluation; without a case its plain name.
[[nodiscard]] std::string of_case(std::string_view response, std::string_view load_case);

/// A name of these maps as response and case.
struct CaseResponse {
  std::string_view response, load_case;
};
[[nodiscard]] CaseResponse split_case(std::string_view name);

/// A number with its bar; NaN where there is none.
struct Barred {
  double value = 0, bar = 0;
};

/// What the numbers of all cases, larger ones worse, come to. The worst may be another case within the bars. Where the
/// cases are samples of a sequence the bar has what its second half changes besides.
/// - `share`: of the quantile, in (0, 1)
[[nodiscard]] Barred over_cases(std::string_view over, std::span<const LoadCase> cases, std::span<const Barred> numbers,
                                double share);

}  // namespace dovetail::optimizer
