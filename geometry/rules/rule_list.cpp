#include "geometry/rules/rule_list.hpp"

#include <fmt/format.h>

#include <cmath>

#include "geometry/profile/key_units.hpp"
#include "geometry/rules/params.hpp"

namespace dovetail::geometry {

void RuleList::at_least(std::string name, const std::string& what, double value, double bound,
                        const std::string& of_what, double scale) {
  add(std::move(name), what, {value / kMillimetre, bound / kMillimetre, "mm"}, of_what, (value - bound) / scale);
}

void RuleList::straight(const std::string& part, const std::string& what, double length) {
  at_least(part + "_fits", "the straight part of " + what, length, RuleParams{}.straight,
           "to leave room for the fillets beside it");
}

void RuleList::angle_at_least(std::string name, const std::string& what, double value, double bound,
                              const std::string& of_what) {
  add(std::move(name), what, {value / kDegree, bound / kDegree, "degrees"}, of_what, (value - bound) / (45 * kDegree));
}

void RuleList::share_at_least(std::string name, const std::string& what, double value, double bound,
                              const std::string& of_what) {
  add(std::move(name), what, {100 * value, 100 * bound, "%"}, of_what, value - bound);
}

void RuleList::add(std::string name, const std::string& what, const Shown& shown, const std::string& of_what,
                   double margin) {
  const auto& [value, bound, unit] = shown;
  rules_.push_back({.name = std::move(name),
                    .margin = margin,
                    .sentence = fmt::format("{} is {:.4g} {}; it must be at least {:.4g} {} {} ({:.4g} {} {})", what,
                                            value, unit, bound, unit, of_what, std::abs(value - bound), unit,
                                            margin < 0 ? "short" : "to spare")});
}

}  // namespace dovetail::geometry
