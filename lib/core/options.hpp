#pragma once

#include <cmath>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/errors.hpp"

namespace dovetail {

/// Allowed interval of a number, in the unit of the study file. NaN is never inside.
struct Range {
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  bool lower_open = false;
  bool upper_open = false;

  [[nodiscard]] bool contains(double value) const;
  /// The same for a number converted to SI and back, which may have left a closed end by a few roundings.
  [[nodiscard]] bool contains_rounded(double value) const;
  /// "must be > 0 and <= 90", "must be a finite number"
  [[nodiscard]] std::string phrase() const;
};

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();
inline constexpr Range kAnyNumber{};
inline constexpr Range kPositive{.lower = 0, .lower_open = true};
inline constexpr Range kNonNegative{.lower = 0};

/// One option of the flat struct S: the key it has in a study file (with its unit), the member it
/// sets, the factor to SI, what is allowed and one sentence of documentation. The table of a struct
/// drives the study file, unknown-key messages, provenance and the reference documentation.
template <class S>
struct Field {
  std::string_view key;
  std::variant<double S::*, int S::*, bool S::*, std::string S::*> member;
  double si_per_unit = 1.0;  ///< value in the study file times this is the member's value
  Range range = kAnyNumber;  ///< numbers only, in the file's unit
  std::string_view help = {};
  bool required = false;                       ///< the study file must give it
  std::vector<std::string_view> choices = {};  ///< strings only; empty: anything
};

/// Specialise for each options struct: `template <> std::span<const Field<X>> option_table<X>();`
template <class S>
[[nodiscard]] std::span<const Field<S>> option_table();

/// The value of a numeric field in the unit of the study file.
template <class S>
[[nodiscard]] double value_in_file_unit(const S& options, const Field<S>& field) {
  if (const auto* real = std::get_if<double S::*>(&field.member)) return options.*(*real) / field.si_per_unit;
  if (const auto* whole = std::get_if<int S::*>(&field.member)) return options.*(*whole);
  return std::numeric_limits<double>::quiet_NaN();
}

/// All values of `options` outside their range, keys prefixed by "prefix.".
template <class S>
[[nodiscard]] std::vector<Violation> violations(const S& options, const std::string& prefix = {});

/// The candidate closest to `word` in edit distance; empty when nothing is near enough to suggest.
[[nodiscard]] std::string nearest(std::string_view word, std::span<const std::string> candidates);

/// Shortest decimal text that reads back to the same double.
[[nodiscard]] std::string shortest(double value);

/// Appends what is wrong with one value; for `violations`.
void check_choice(const std::string& prefix, std::string_view key, const std::string& value,
                  std::span<const std::string_view> choices, std::vector<Violation>& found);
void check_range(const std::string& prefix, std::string_view key, double value, const Range& range,
                 std::vector<Violation>& found);

template <class S>
std::vector<Violation> violations(const S& options, const std::string& prefix) {
  std::vector<Violation> found;
  for (const Field<S>& field : option_table<S>()) {
    if (const auto* text = std::get_if<std::string S::*>(&field.member))
      check_choice(prefix, field.key, options.*(*text), field.choices, found);
    else if (!std::holds_alternative<bool S::*>(field.member))
      check_range(prefix, field.key, value_in_file_unit(options, field), field.range, found);
  }
  return found;
}

}  // namespace dovetail
