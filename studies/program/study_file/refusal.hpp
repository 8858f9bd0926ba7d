#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/options.hpp"

namespace dovetail::studies {

/// Throws the InputError "[file: ]key[ = value]: allowed".
[[noreturn]] inline void refuse(const std::string& key, const std::string& allowed, const std::string& value = {},
                                const std::string& file = {}) {
  throw InputError(Violation{.file = file, .key = key, .value = value, .allowed = allowed});
}

/// Throws all there are.
inline void refuse(std::vector<Violation> found) {
  if (!found.empty()) throw InputError(std::move(found));
}

/// What is wrong with the options of a command, to be told together.
class Complaints {
 public:
  void add(const std::string& option, const std::string& allowed, const std::string& value = {}) {
    found_.push_back({.file = {}, .key = option, .value = value, .allowed = allowed});
  }
  void require(const std::string& option, double value, const Range& within) {
    if (!within.contains(value)) add(option, within.phrase(), shortest(value));
  }
  /// Throws them, if there are any.
  void raise() const { refuse(found_); }

 private:
  std::vector<Violation> found_;
};

/// `points` values from one end to the other, both exactly as given.
[[nodiscard]] inline std::vector<double> evenly_spaced(double from, double to, int points) {
  std::vector<double> values;
  for (int i = 0; i < points; ++i)
    values.push_back(i == 0 ? from : i == points - 1 ? to : from + static_cast<double>(i) / (points - 1) * (to - from));
  return values;
}

}  // namespace dovetail::studies
