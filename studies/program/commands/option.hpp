#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "core/options.hpp"
#include "studies/program/study_file/refusal.hpp"

/// One table of options per struct of a command. From it follow the command line and its help (command_line.cpp), the
/// checks of ranges and of options that contradict each other (here), and the test that commands.md knows them all.
namespace dovetail::studies {

/// With what an option has a meaning.
struct Meaning {
  enum class Kind { only_with, not_with, needed_with };
  Kind kind;
  std::string_view other;       ///< "--resume", "--follow band", or several of these joined by " or "
  std::string_view value = {};  ///< of this option, for which that holds; empty: any
  std::string_view words = {};  ///< of the refusal; empty: "only has a meaning with ..." and the like
};

/// An option of the command line that sets a member of S.
template <class S>
struct Option {
  std::string name;  ///< "--from"; "-o,--output"; "INPUT": a word without a name
  std::variant<bool S::*, int S::*, double S::*, std::string S::*, std::optional<int> S::*, std::optional<double> S::*,
               std::vector<int> S::*, std::vector<std::string> S::*, EnumMember<S>>
      member;
  std::string_view type = {};  ///< of its value, as the help shows it
  std::string help = {};
  bool required = false;
  Range range = kAnyNumber;                    ///< numbers only
  std::vector<std::string_view> choices = {};  ///< texts only; empty: anything. Of an enumeration: its names
  std::vector<Meaning> meaning = {};
  int values = 1;  ///< that follow a list's name, as often as it is given
};

/// Specialise for each options struct: `template <> std::span<const Option<X>> command_options<X>();`
template <class S>
[[nodiscard]] std::span<const Option<S>> command_options();

/// Calls `visit(object, table)` with the options of a command and with the groups of options that it has as members.
template <class Options, class Visit>
void visit_options(Options& options, const Visit& visit) {
  const auto group = [&]<class S>(S& part) { visit(part, command_options<std::remove_const_t<S>>()); };
  group(options);
  if constexpr (requires { options.choice; }) group(options.choice);
  if constexpr (requires { options.deck; }) group(options.deck);
  if constexpr (requires { options.solver; }) group(options.solver);
  if constexpr (requires { options.tell; }) group(options.tell);
}

/// Value of every option that is given or has a default, as text; of flags and lists the empty text.
using GivenOptions = std::map<std::string, std::string, std::less<>>;

/// Adds to `wrong` what `meaning` has against that option beside the others.
void check_meaning(const std::string& name, std::span<const Meaning> meaning, const GivenOptions& given,
                   Complaints& wrong);

/// The number, or nothing for an option that is absent or no number.
template <class S>
[[nodiscard]] std::optional<double> number_of(const S& options, const Option<S>& option) {
  return std::visit(
      [&](const auto& member) -> std::optional<double> {
        if constexpr (requires { options.*member; }) {
          const auto& value = options.*member;
          using T = std::decay_t<decltype(value)>;
          if constexpr (std::is_same_v<T, int> || std::is_same_v<T, double>) return static_cast<double>(value);
          if constexpr (requires { value.has_value(); })
            if (value) return static_cast<double>(*value);
        }
        return std::nullopt;
      },
      option.member);
}

template <class S>
[[nodiscard]] std::optional<std::string> text_of(const S& options, const Option<S>& option) {
  if (const std::optional<double> number = number_of(options, option)) return shortest(*number);
  const auto given = [](std::string text) { return text.empty() ? std::nullopt : std::optional(std::move(text)); };
  if (const auto* text = std::get_if<std::string S::*>(&option.member)) return given(options.*(*text));
  if (const auto* words = std::get_if<EnumMember<S>>(&option.member)) return given(std::string(words->name(options)));
  if (const auto* flag = std::get_if<bool S::*>(&option.member))
    return options.*(*flag) ? std::optional<std::string>("") : std::nullopt;
  return std::nullopt;
}

/// Numbers out of range and options without a meaning, as far as the options alone tell it.
template <class Options>
[[nodiscard]] Complaints complaints(const Options& options) {
  GivenOptions given;
  Complaints wrong;
  visit_options(options, [&]<class S>(const S& part, std::span<const Option<S>> table) {
    for (const Option<S>& option : table)
      if (const std::optional<std::string> text = text_of(part, option)) given[option.name] = *text;
  });
  visit_options(options, [&]<class S>(const S& part, std::span<const Option<S>> table) {
    for (const Option<S>& option : table) {
      if (const std::optional<double> number = number_of(part, option))
        wrong.require(option.name, *number, option.range);
      check_meaning(option.name, option.meaning, given, wrong);
    }
  });
  return wrong;
}

}  // namespace dovetail::studies
