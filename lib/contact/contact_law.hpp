#pragma once

#include <Eigen/Core>
#include <span>
#include <string_view>

namespace dovetail::contact {

struct NodeLaw;

/// The largest tangential force of a node under a normal force, N, and its derivative with respect to that.
struct FrictionLimit {
  double force = 0, by_normal = 0;
};

/// When a node that is closed begins to slip. All else about it follows from this: stick below the limit, slip along
/// the trial force at it, the derivative of a march, the energy dissipated, what is left of the friction, the instants
/// of events.
struct ContactLaw {
  std::string_view name;
  /// Without a normal force 0, never falling with it. Continued smoothly to negative forces, which the search for the
  /// instant of an event meets.
  FrictionLimit (*limit)(const NodeLaw& node, double normal);
};

/// Every law there is, the first by default. A new one is a file beside coulomb.cpp, and an entry here.
[[nodiscard]] std::span<const ContactLaw* const> contact_laws();

/// mu lambda_N.
extern const ContactLaw kCoulomb;

/// What one node is, besides its prediction forces: its law and what the law knows of it.
struct NodeLaw {
  const ContactLaw* law = &kCoulomb;
  double friction = 0;                   ///< mu >= 0
  double tangential_penalty = 1;         ///< eps_T > 0, N/m, one for both tangential directions
  Eigen::Vector2d slip_origin = {0, 0};  ///< X_T at which the march starts, m

  [[nodiscard]] FrictionLimit limit(double normal) const { return law->limit(*this, normal); }
  /// Whether it resists slip at all.
  [[nodiscard]] bool rubs() const { return limit(1).force > 0; }
};

}  // namespace dovetail::contact
