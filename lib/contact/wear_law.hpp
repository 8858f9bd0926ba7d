#pragma once

#include <map>
#include <span>
#include <string>
#include <string_view>

#include "core/options.hpp"

namespace dovetail::contact {

/// The numbers that a law may have of its own; its parameters say which it has and what they are.
struct WearNumbers {
  double coefficient = 0;
  double threshold = 0;
};

/// What a wear law knows of a node.
struct WearNode {
  double area = 1;      ///< m^2
  double friction = 0;  ///< mu
  WearNumbers law = {};
};

/// What a march delivers of a cycle: the slip load, int lambda_N |dX_T|, N m, and the energy dissipated, J.
struct Slip {
  double load = 0, energy = 0;
};

/// Depth per cycle, m, and its derivatives with respect to slip load and energy, 1/N.
struct WearRate {
  double depth = 0, by_load = 0, by_energy = 0;
};

/// One of the numbers of a law, as people give it.
struct WearParameter {
  std::string_view key;         ///< in the section [contact] of a study file, with its unit; no other law has it
  std::string_view unit;        ///< SI
  double WearNumbers::*number;  ///< which one it is
  double standard;              ///< where a study does not give it
  Range range;
  std::string_view help;  ///< what it is
};

/// How a node wears by its slip in a cycle.
struct WearLaw {
  std::string_view name;     ///< in files
  std::string_view title;    ///< in a sentence, as "Archard wear"
  std::string_view meaning;  ///< what it makes of what, for the help of study files
  std::span<const WearParameter> parameters;
  /// Zero without slip and never falling with load or energy.
  WearRate (*rate)(const WearNode& node, const Slip& slip);
  /// Energy at which the node does not wear yet, J.
  double (*resting_energy)(const WearNode& node);
  /// Volume that wears for a little more dissipated energy, m^3/J, where the node dissipates `energy`, J, beyond that
  /// at which it rests; 0 without friction.
  double (*volume_per_energy)(const WearNode& node, double energy);

  /// The parameter that is this number, or has this key; null when the law has none.
  [[nodiscard]] const WearParameter* parameter(double WearNumbers::*number) const;
  [[nodiscard]] const WearParameter* parameter(std::string_view key) const;
};

/// Every law there is. A new one is a file beside archard.cpp, and an entry here. The first is that of files that name
/// none.
[[nodiscard]] std::span<const WearLaw* const> wear_laws();
/// The law of this name; null when there is none.
[[nodiscard]] const WearLaw* find_wear_law(std::string_view name);
/// The parameter of this key, and the law that has it; null when there is none.
[[nodiscard]] const WearParameter* find_wear_parameter(std::string_view key);
[[nodiscard]] const WearLaw* law_with_parameter(std::string_view key);
/// The numbers of each law, by its name, where nobody gives them.
[[nodiscard]] std::map<std::string, WearNumbers> standard_wear_numbers();

/// Depth in proportion to pressure and slipped distance [Archard 1953]: coefficient k_w, 1/Pa; no threshold.
extern const WearLaw kArchard;
/// Volume in proportion to the energy that friction dissipates beyond a threshold in each cycle [Fouvry et al. 2003]:
/// coefficient alpha, m^3/J; threshold J/m^2. A node that slips by less than its threshold does not wear.
extern const WearLaw kEnergyWear;

}  // namespace dovetail::contact
