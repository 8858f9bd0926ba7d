#pragma once

#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace dovetail::optimizer {

/// One design variable, in the unit its key names.
struct DesignVariable {
  std::string key;  ///< dotted path in the study file, e.g. "geometry.flank_mismatch_um"
  double lower = 0;
  double upper = 1;                    ///< > lower
  double start = 0;                    ///< within [lower, upper]
  std::vector<std::string> also = {};  ///< other keys that have its value
};

/// The box the optimiser searches. Algorithms work in unit coordinates u in [0,1]^n, everything else in file units:
/// `value = lower + u (upper - lower)`.
class DesignSpace {
 public:
  DesignSpace() = default;
  /// Throws InputError naming every variable whose bounds or start are wrong, and repeated keys.
  explicit DesignSpace(std::vector<DesignVariable> variables);

  [[nodiscard]] std::size_t size() const { return variables_.size(); }
  [[nodiscard]] const std::vector<DesignVariable>& variables() const { return variables_; }
  [[nodiscard]] std::vector<std::string> keys() const;
  /// What a point sets: every key, and those that have its value.
  [[nodiscard]] std::map<std::string, double> settings(std::span<const double> values) const;
  /// Start values, file units.
  [[nodiscard]] std::vector<double> start() const;

  /// File units -> unit coordinates (not clamped).
  [[nodiscard]] std::vector<double> to_unit(std::span<const double> values) const;
  /// Unit coordinates -> file units; u is clamped to [0,1], so 0 and 1 give the bounds exactly and nothing leaves the
  /// box. Never returns -0.0. A NaN coordinate is an assertion.
  [[nodiscard]] std::vector<double> from_unit(std::span<const double> unit) const;
  /// The nearest point of the box, file units.
  [[nodiscard]] std::vector<double> clamp(std::span<const double> values) const;

 private:
  std::vector<DesignVariable> variables_;
};

}  // namespace dovetail::optimizer
