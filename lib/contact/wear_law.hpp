#pragma once

#include <span>
#include <string_view>

namespace dovetail::contact {

/// What a wear law knows of a node.
struct WearNode {
  double area = 1;         ///< m^2
  double friction = 0;     ///< mu
  double coefficient = 0;  ///< of the law
  double threshold = 0;    ///< of the law
};

/// What a march delivers of a cycle: the slip load, int lambda_N |dX_T|, N m, and the energy dissipated, J.
struct Slip {
  double load = 0, energy = 0;
};

/// Depth per cycle, m, and its derivatives with respect to slip load and energy, 1/N.
struct WearRate {
  double depth = 0, by_load = 0, by_energy = 0;
};

/// How a node wears by its slip in a cycle.
struct WearLaw {
  std::string_view name;
  /// Zero without slip and never falling with load or energy.
  WearRate (*rate)(const WearNode& node, const Slip& slip);
  /// Energy at which the node does not wear yet, J.
  double (*resting_energy)(const WearNode& node);
  /// Volume that wears for a little more dissipated energy once the node wears, m^3/J; 0 without friction.
  double (*volume_per_energy)(const WearNode& node);
};

/// Every law there is, the first by default. A new one is a file beside archard.cpp, and an entry here.
[[nodiscard]] std::span<const WearLaw* const> wear_laws();
/// The law of this name; null when there is none.
[[nodiscard]] const WearLaw* find_wear_law(std::string_view name);

/// Depth in proportion to pressure and slipped distance [Archard 1953]: coefficient k_w, 1/Pa; no threshold.
extern const WearLaw kArchard;
/// Volume in proportion to the energy that friction dissipates beyond a threshold in each cycle [Fouvry et al. 2003]:
/// coefficient alpha, m^3/J; threshold J/m^2. A node that slips by less than its threshold does not wear.
extern const WearLaw kEnergyWear;

}  // namespace dovetail::contact
