#include "wear/no_wear.hpp"

#include <algorithm>

#include "wear/measures.hpp"
#include "wear/params.hpp"

namespace dovetail::wear {

double no_wear_rate(double given, const dynamics::CondensedModel& model, const steady::State& unworn) {
  if (given >= 0.0) return given;
  const reduction::ContactNodes& contact = model.contact();
  double largest = 0.0;
  for (Eigen::Index i = 0; i < contact.count(); ++i) {
    const double force = unworn.nodes[static_cast<std::size_t>(i)].max_normal_force;
    const double limit = model.contact_law(i).limit(force).force;
    const double energy = limit * 4.0 * limit / own_stiffness(model, i, 1);
    const double volume = model.wear_law().volume_per_energy(model.wear_node(i), energy) * energy;
    largest = std::max(largest, volume / contact.area[i]);
  }
  return NoWearParams{}.share * largest;
}

}  // namespace dovetail::wear
