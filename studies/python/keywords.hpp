#pragma once

#include <pybind11/pybind11.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <initializer_list>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "studies/program/commands/option.hpp"

/// The options of the program's commands as keywords of Python: from their tables follow the keywords, the checks and
/// what help() shows.
namespace dovetail::python {

/// Options that Python has in another way: words without a name, files of answers, files of another driver, values of
/// a study, and what the terminal shows (remarks are handed over).
[[nodiscard]] inline bool is_keyword(std::string_view option, std::initializer_list<std::string_view> without) {
  constexpr std::array<std::string_view, 4> kElsewhere{"--set", "--json", "--dakota", "--quiet"};
  return option.starts_with("--") && std::ranges::find(kElsewhere, option) == kElsewhere.end() &&
         std::ranges::find(without, option) == without.end();
}

/// "--history-tolerance" -> "history_tolerance"
[[nodiscard]] inline std::string keyword(std::string_view option) {
  std::string name(option.substr(2));
  std::ranges::replace(name, '-', '_');
  return name;
}

template <class S>
void set_option(S& options, const studies::Option<S>& option, const pybind11::handle& value) {
  namespace py = pybind11;
  std::visit(
      [&](const auto& member) {
        if constexpr (std::is_same_v<std::decay_t<decltype(member)>, EnumMember<S>>) {
          const std::string word = py::str(value).cast<std::string>();
          if (std::ranges::find(member.names(), word) == member.names().end())
            studies::refuse(option.name, one_of(member.names()), word);
          member.set(options, word);
        } else {
          using T = std::decay_t<decltype(options.*member)>;
          if constexpr (std::is_same_v<T, std::string>)
            options.*member = py::str(value).cast<std::string>();
          else
            options.*member = value.cast<T>();
        }
      },
      option.member);
}

/// Sets what the keywords name and checks all of it. Throws InputError, TypeError for an unknown keyword or a value of
/// a wrong type. None leaves the default.
template <class Options>
void take_keywords(Options& options, const pybind11::kwargs& given, const std::string& function,
                   std::initializer_list<std::string_view> without = {}) {
  namespace py = pybind11;
  std::vector<std::string> known;
  studies::visit_options(options, [&]<class S>(S& part, std::span<const studies::Option<S>> table) {
    for (const studies::Option<S>& option : table) {
      if (!is_keyword(option.name, without)) continue;
      const std::string name = keyword(option.name);
      known.push_back(name);
      if (!given.contains(name) || given[name.c_str()].is_none()) continue;
      try {
        set_option(part, option, given[name.c_str()]);
      } catch (const py::cast_error&) {
        throw py::type_error(function + "(): " + name + " = " + py::repr(given[name.c_str()]).cast<std::string>() +
                             " has the wrong type");
      }
    }
  });
  for (const auto& [key, value] : given) {
    const std::string name = py::str(key).cast<std::string>();
    if (std::ranges::find(known, name) != known.end()) continue;
    const std::string near = nearest(name, known);
    throw py::type_error(function + "() has no keyword " + name + (near.empty() ? "" : "; did you mean " + near + "?"));
  }
  studies::complaints(options).raise();
}

/// "wear(model, *, method=None, ...)\n--\n\nwords" and a line for each keyword, as help() and inspect read it.
template <class Options>
[[nodiscard]] std::string documented(const std::string& function, const std::string& positional,
                                     const std::string& words, std::initializer_list<std::string_view> without = {}) {
  Options options;
  std::string keywords, lines;
  studies::visit_options(options, [&]<class S>(S&, std::span<const studies::Option<S>> table) {
    for (const studies::Option<S>& option : table) {
      if (!is_keyword(option.name, without)) continue;
      const bool flag = std::holds_alternative<bool S::*>(option.member);
      keywords += ", " + keyword(option.name) + (flag ? "=False" : "=None");
      lines += "    " + keyword(option.name) + (option.type.empty() ? "" : " (" + std::string(option.type) + ")") +
               ": " + option.help + "\n";
    }
  });
  return function + "(" + positional + ", *" + keywords + ")\n--\n\n" + words +
         "\n\nKeywords, as the program's options:\n" + lines;
}

}  // namespace dovetail::python
