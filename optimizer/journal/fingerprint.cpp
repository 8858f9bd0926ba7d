#include "optimizer/journal/fingerprint.hpp"

#include <array>

namespace dovetail::optimizer {

std::uint64_t fnv1a(std::string_view text) {
  std::uint64_t hash = 14695981039346656037ULL;
  for (const char c : text) {
    hash ^= static_cast<unsigned char>(c);
    hash *= 1099511628211ULL;
  }
  return hash;
}

std::string hexadecimal(std::uint64_t value) {
  std::string text(16, '0');
  for (std::size_t i = 16; i-- > 0; value >>= 4) text[i] = "0123456789abcdef"[value & 0xF];
  return text;
}

bool may_change(std::string_view optimizer_key) {
  return optimizer_key == "max_evaluations" || optimizer_key == "time_limit_s" || optimizer_key == "restarts" ||
         optimizer_key == "departures" || optimizer_key.starts_with("verify");
}

std::string fingerprint(const Problem& problem, const OptimizerOptions& options, std::string_view physics) {
  std::string text;
  // Each piece carries its length, so that no two different lists read alike.
  const auto word = [&](std::string_view piece) { text += std::to_string(piece.size()) + ":" + std::string(piece); };
  const auto number = [&](double value) { word(shortest(value)); };
  // Nothing where there are no cases: runs from before there were some can be resumed.
  const auto over = [&](const std::string& rule) {
    if (!problem.cases.empty()) word(rule);
  };
  for (const DesignVariable& v : problem.space.variables()) {
    word(v.key);
    for (const std::string& key : v.also) word(key);
    for (const double value : {v.lower, v.upper, v.start}) number(value);
  }
  text += ";objective";
  for (const ObjectiveTerm& term : problem.objective) {
    word(term.response);
    for (const double value : {term.weight, term.scale, term.absolute ? 1.0 : 0.0}) number(value);
    if (term.target != 0) number(term.target);
    if (term.reference) word("reference " + shortest(*term.reference));
    over(term.over);
  }
  if (problem.front) text += ";front";
  text += ";constraints";
  for (const ResponseConstraint& c : problem.constraints) {
    word(c.response);
    word(c.lower ? shortest(*c.lower) : "none");
    word(c.upper ? shortest(*c.upper) : "none");
    for (const double value : {c.scale, c.absolute ? 1.0 : 0.0}) number(value);
    over(c.over);
  }
  if (!problem.cases.empty()) number(problem.quantile);
  for (const LoadCase& load : problem.cases) {
    word(";case");
    word(load.name);
    number(load.weight);
    for (const auto& [key, value, times] : load.changes) {
      word(key);
      number(value);
      number(times);
    }
  }
  text += ";options";
  for (const Field<OptimizerOptions>& field : option_table<OptimizerOptions>()) {
    if (may_change(field.key)) continue;
    // Keys that came later count where they are not what they are by default: older runs can be resumed.
    if ((field.key == "population" || field.key == "front_points") &&
        value_in_file_unit(options, field) == value_in_file_unit(OptimizerOptions{}, field))
      continue;
    word(field.key);
    if (const std::optional<std::string> choice = text_in(options, field))
      word(*choice);
    else
      number(value_in_file_unit(options, field));
  }
  text += ";physics";
  word(physics);
  return hexadecimal(fnv1a(text));
}

}  // namespace dovetail::optimizer
