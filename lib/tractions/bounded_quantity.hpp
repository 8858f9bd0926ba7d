#pragma once

#include <Eigen/Core>
#include <memory>
#include <string_view>

#include "core/enum_names.hpp"
#include "steady/state.hpp"
#include "tractions/slip_origin_sensitivity.hpp"

namespace dovetail::tractions {

/// What is bounded over the residual tractions.
enum class BoundedQuantity {
  amplitude,        ///< half peak-to-peak of one output at the frequency given
  friction_energy,  ///< J per cycle
  wear_rate,        ///< sum over nodes of area times depth per cycle, m^3
};

constexpr EnumNames<BoundedQuantity, 3> enum_names(BoundedQuantity) {
  return {{{BoundedQuantity::amplitude, "amplitude"},
           {BoundedQuantity::friction_energy, "friction_energy"},
           {BoundedQuantity::wear_rate, "wear_rate"}}};
}
[[nodiscard]] constexpr std::string_view to_string(BoundedQuantity quantity) {
  return name_of(quantity);
}

/// One quantity of the family of steady states over the slip origins: how a member is solved for, its value and
/// d value / d X_T. Counts the solves.
class FamilyQuantity {
 public:
  /// `omega` rad/s: of all members.
  FamilyQuantity(steady::Joint joint, BoundedQuantity quantity, Eigen::Index output, double omega);

  [[nodiscard]] const dynamics::CondensedModel& model() const { return *joint_.model; }
  [[nodiscard]] int solves() const { return solves_; }

  /// The member that starts from `origin` X_T [Nc, d-1], empty for the one given; with its tangent.
  [[nodiscard]] steady::State solve(const Eigen::MatrixXd& origin, const Eigen::MatrixXd& guess);
  [[nodiscard]] double value(const steady::State& member) const;
  /// Below a fraction of this a change of the value is none, however small the value.
  [[nodiscard]] double scale(const steady::State& member) const;
  /// [Nc, d-1]; zero for nodes that forgot where they started.
  [[nodiscard]] Eigen::MatrixXd gradient(const steady::State& member) const;

 private:
  [[nodiscard]] SlipWeights weights(const steady::State& member) const;

  steady::Joint joint_;
  BoundedQuantity quantity_;
  Eigen::Index output_;
  double omega_;
  int solves_ = 0;
};

}  // namespace dovetail::tractions
