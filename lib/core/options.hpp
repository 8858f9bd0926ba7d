#pragma once

#include <cassert>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/enum_names.hpp"
#include "core/errors.hpp"

namespace dovetail {

/// Allowed interval of a number, in the unit of the study file. NaN is never inside.
struct Range {
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  bool lower_open = false;
  bool upper_open = false;
  /// What 0 means where it is allowed besides the interval, as a value of its own that nothing leads to step by step.
  std::string_view zero = {};

  [[nodiscard]] bool contains(double value) const;
  /// Whether the value is that 0.
  [[nodiscard]] bool is_zero_apart(double value) const { return !zero.empty() && value == 0; }
  /// The interval alone.
  [[nodiscard]] Range interval() const;
  /// The same for a number converted to SI and back, which may have left a closed end by a few roundings.
  [[nodiscard]] bool contains_rounded(double value) const;
  /// "must be > 0 and <= 90", "must be a finite number", "must be 0 (rigid) or >= 5"
  [[nodiscard]] std::string phrase() const;
};

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();
inline constexpr Range kAnyNumber{};
inline constexpr Range kPositive{.lower = 0, .lower_open = true};
inline constexpr Range kNonNegative{.lower = 0};
inline constexpr Range kAccuracyRange{.lower = 1e-6, .upper = 0.5};  ///< that is asked for: bar over value

/// A member of S that is an enumeration with names, or an optional one, set and read by these names.
template <class S>
class EnumMember {
 public:
  template <NamedEnum E>
  EnumMember(E S::*member)  // not explicit: it stands where a pointer to any other member does
      : names_(names_of<E>()),
        name_([member](const S& object) { return name_of(object.*member); }),
        set_([member](S& object, std::string_view name) { object.*member = required<E>(name); }) {}
  template <NamedEnum E>
  EnumMember(std::optional<E> S::*member)  // as above
      : names_(names_of<E>()),
        name_([member](const S& object) { return object.*member ? name_of(*(object.*member)) : std::string_view{}; }),
        set_([member](S& object, std::string_view name) { object.*member = required<E>(name); }) {}

  [[nodiscard]] const std::vector<std::string_view>& names() const { return names_; }
  /// Empty where an optional one has no value.
  [[nodiscard]] std::string_view name(const S& object) const { return name_(object); }
  /// `name` must be one of names().
  void set(S& object, std::string_view name) const { set_(object, name); }

 private:
  template <NamedEnum E>
  [[nodiscard]] static E required(std::string_view name) {
    const std::optional<E> value = named<E>(name);
    assert(value.has_value());
    return *value;
  }

  std::vector<std::string_view> names_;
  std::function<std::string_view(const S&)> name_;
  std::function<void(S&, std::string_view)> set_;
};

/// One option of the flat struct S: the key it has in a study file (with its unit), the member it
/// sets, the factor to SI, what is allowed and one sentence of documentation. The table of a struct
/// drives the study file, unknown-key messages, provenance and the reference documentation.
template <class S>
struct Field {
  std::string_view key;
  std::variant<double S::*, int S::*, bool S::*, std::string S::*, EnumMember<S>> member;
  double si_per_unit = 1.0;  ///< value in the study file times this is the member's value
  Range range = kAnyNumber;  ///< numbers only, in the file's unit
  std::string_view help = {};
  bool required = false;                       ///< the study file must give it
  std::vector<std::string_view> choices = {};  ///< strings only; empty: anything. Of an enumeration: see choices_of
};

/// Whether the study file has a text there: a string or the name of a value.
template <class S>
[[nodiscard]] bool is_text(const Field<S>& field) {
  return std::holds_alternative<std::string S::*>(field.member) || std::holds_alternative<EnumMember<S>>(field.member);
}

/// What a text may be; empty: anything.
template <class S>
[[nodiscard]] const std::vector<std::string_view>& choices_of(const Field<S>& field) {
  const auto* words = std::get_if<EnumMember<S>>(&field.member);
  return words ? words->names() : field.choices;
}

/// The text of a field that is one; nothing of the others.
template <class S>
[[nodiscard]] std::optional<std::string> text_in(const S& options, const Field<S>& field) {
  if (const auto* words = std::get_if<EnumMember<S>>(&field.member)) return std::string(words->name(options));
  if (const auto* text = std::get_if<std::string S::*>(&field.member)) return options.*(*text);
  return std::nullopt;
}

/// Sets a field that is a text, to one of its choices.
template <class S>
void set_text(S& options, const Field<S>& field, const std::string& value) {
  if (const auto* words = std::get_if<EnumMember<S>>(&field.member)) words->set(options, value);
  if (const auto* text = std::get_if<std::string S::*>(&field.member)) options.*(*text) = value;
}

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

/// Shortest decimal text that reads back to the same double; "nan" for a NaN of either sign.
[[nodiscard]] std::string shortest(double value);

/// "must be one of soft, hard", "must be hard"
[[nodiscard]] std::string one_of(std::span<const std::string_view> names);

/// Appends what is wrong with one value; for `violations`.
void check_choice(const std::string& prefix, std::string_view key, const std::string& value,
                  std::span<const std::string_view> choices, std::vector<Violation>& found);
void check_range(const std::string& prefix, std::string_view key, double value, const Range& range,
                 std::vector<Violation>& found);

template <class S>
std::vector<Violation> violations(const S& options, const std::string& prefix) {
  std::vector<Violation> found;
  for (const Field<S>& field : option_table<S>()) {
    if (const std::optional<std::string> text = text_in(options, field)) {
      const bool left_open = text->empty() && std::holds_alternative<EnumMember<S>>(field.member);
      if (!left_open) check_choice(prefix, field.key, *text, choices_of(field), found);
    } else if (!std::holds_alternative<bool S::*>(field.member)) {
      check_range(prefix, field.key, value_in_file_unit(options, field), field.range, found);
    }
  }
  return found;
}

}  // namespace dovetail
