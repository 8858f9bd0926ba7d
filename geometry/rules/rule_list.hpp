#pragma once

#include <string>
#include <utility>
#include <vector>

#include "geometry/rules/feasibility.hpp"

namespace dovetail::geometry {

/// A list of rules under construction.
class RuleList {
 public:
  /// `value` must be at least `bound`; both in m. The margin is their difference over `scale`.
  void at_least(std::string name, const std::string& what, double value, double bound, const std::string& of_what,
                double scale = 1e-3);
  /// A straight part between blends.
  void straight(const std::string& part, const std::string& what, double length);
  /// `value` must be at least `bound`; both in rad. The margin is their difference over 45 degrees.
  void angle_at_least(std::string name, const std::string& what, double value, double bound,
                      const std::string& of_what);

  /// `value` must be at least `bound`; both fractions, written in per cent. The margin is their difference.
  void share_at_least(std::string name, const std::string& what, double value, double bound,
                      const std::string& of_what);

  [[nodiscard]] std::vector<Rule> take() { return std::move(rules_); }

 private:
  /// What a sentence says of a rule.
  struct Shown {
    double value, bound;
    const char* unit;
  };
  void add(std::string name, const std::string& what, const Shown& shown, const std::string& of_what, double margin);

  std::vector<Rule> rules_;
};

}  // namespace dovetail::geometry
