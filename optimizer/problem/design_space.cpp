#include "optimizer/problem/design_space.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <set>

#include "core/errors.hpp"
#include "core/options.hpp"

namespace dovetail::optimizer {

DesignSpace::DesignSpace(std::vector<DesignVariable> variables) : variables_(std::move(variables)) {
  std::vector<Violation> found;
  std::set<std::string> seen;
  for (const DesignVariable& v : variables_) {
    const std::string at = v.key.empty() ? "variable" : v.key;
    if (v.key.empty())
      found.push_back({.file = {}, .key = "variable", .value = "", .allowed = "must name the key it varies"});
    std::vector<std::string> keys{v.key};
    keys.insert(keys.end(), v.also.begin(), v.also.end());
    for (const std::string& key : keys)
      if (!seen.insert(key).second)
        found.push_back({.file = {}, .key = at, .value = key, .allowed = "must be varied only once"});
    if (!std::isfinite(v.lower) || !std::isfinite(v.upper) || !(v.lower < v.upper) ||
        !std::isfinite(v.upper - v.lower)) {
      found.push_back({.file = {},
                       .key = at + ".upper",
                       .value = shortest(v.upper),
                       .allowed = "must be finite and > lower = " + shortest(v.lower)});
    } else if (!(v.start >= v.lower && v.start <= v.upper)) {
      found.push_back({.file = {},
                       .key = at + ".start",
                       .value = shortest(v.start),
                       .allowed = Range{.lower = v.lower, .upper = v.upper}.phrase()});
    }
  }
  if (!found.empty()) throw InputError(std::move(found));
}

std::vector<std::string> DesignSpace::keys() const {
  std::vector<std::string> keys;
  for (const DesignVariable& v : variables_) keys.push_back(v.key);
  return keys;
}

std::map<std::string, double> DesignSpace::settings(std::span<const double> values) const {
  std::map<std::string, double> settings;
  for (std::size_t i = 0; i < variables_.size(); ++i) {
    settings[variables_[i].key] = values[i];
    for (const std::string& key : variables_[i].also) settings[key] = values[i];
  }
  return settings;
}

std::vector<double> DesignSpace::start() const {
  std::vector<double> values;
  for (const DesignVariable& v : variables_) values.push_back(v.start);
  return clamp(values);
}

std::vector<double> DesignSpace::to_unit(std::span<const double> values) const {
  assert(values.size() == size());
  std::vector<double> unit(size());
  for (std::size_t i = 0; i < size(); ++i)
    unit[i] = (values[i] - variables_[i].lower) / (variables_[i].upper - variables_[i].lower);
  return unit;
}

std::vector<double> DesignSpace::from_unit(std::span<const double> unit) const {
  assert(unit.size() == size());
  std::vector<double> values(size());
  for (std::size_t i = 0; i < size(); ++i) {
    assert(!std::isnan(unit[i]));
    const double u = std::clamp(unit[i], 0.0, 1.0);
    const DesignVariable& v = variables_[i];
    values[i] = u == 1.0 ? v.upper : v.lower + u * (v.upper - v.lower);
  }
  return clamp(values);
}

std::vector<double> DesignSpace::clamp(std::span<const double> values) const {
  assert(values.size() == size());
  std::vector<double> clamped(size());
  // Adding +0.0 turns -0.0 into 0.0, so that one design has one bit pattern.
  for (std::size_t i = 0; i < size(); ++i)
    clamped[i] = std::clamp(values[i], variables_[i].lower, variables_[i].upper) + 0.0;
  return clamped;
}

}  // namespace dovetail::optimizer
