#include "studies/program/commands/option.hpp"

#include <algorithm>

namespace dovetail::studies {
namespace {

/// Whether one of the alternatives "--option" or "--option value" holds.
bool holds(std::string_view alternatives, const GivenOptions& given) {
  constexpr std::string_view kOr = " or ";
  while (!alternatives.empty()) {
    const std::size_t end = std::min(alternatives.find(kOr), alternatives.size());
    const std::string_view one = alternatives.substr(0, end);
    alternatives.remove_prefix(std::min(end + kOr.size(), alternatives.size()));
    const std::size_t space = one.find(' ');
    const auto found = given.find(one.substr(0, space));
    if (found != given.end() && (space == one.npos || found->second == one.substr(space + 1))) return true;
  }
  return false;
}

}  // namespace

void check_meaning(const std::string& name, std::span<const Meaning> meaning, const GivenOptions& given,
                   Complaints& wrong) {
  using enum Meaning::Kind;
  const auto own = given.find(name);
  for (const Meaning& rule : meaning) {
    const bool present = own != given.end() && (rule.value.empty() || own->second == rule.value);
    if (present == (rule.kind == needed_with) || holds(rule.other, given) == (rule.kind == only_with)) continue;
    const std::string_view general = rule.kind == only_with  ? "only has a meaning with "
                                     : rule.kind == not_with ? "has no meaning with "
                                                             : "is needed with ";
    wrong.add(name, rule.words.empty() ? std::string(general).append(rule.other) : std::string(rule.words),
              present ? own->second : std::string());
  }
}

}  // namespace dovetail::studies
