#pragma once

#include <Eigen/Core>
#include <memory>

#include "response/steady_state.hpp"

namespace dovetail::response {

/// f(U) of one frequency as `options` ask for it, with eps multiplied by `penalty_ratio`. `basis` is that of the
/// options, made once for many problems.
[[nodiscard]] SteadyResidual steady_problem(const std::shared_ptr<const CondensedModel>& model,
                                            std::shared_ptr<const HarmonicSystem> system,
                                            const numerics::FourierBasis& basis, const ContactCondition& condition,
                                            const SteadyOptions& options, double penalty_ratio);

/// What becomes of the Jacobian of a state found.
enum class AtSolution {
  linearise,     ///< kept, factorised
  show_regular,  ///< factorised and forgotten
  trust,         ///< not looked at
};

/// What there is to say of U [nc, 2H+1], found with `status`: everything of a SteadyState but counts and the penalty
/// ratio. A converged U whose Jacobian is singular becomes Status::singular unless it is trusted. `previous`, met on
/// the way, lends its factors where the Jacobian is the same.
[[nodiscard]] SteadyState described(const SteadyResidual& residual, const Eigen::MatrixXd& displacement, Status status,
                                    AtSolution jacobian, const Linearisation* previous = nullptr);

/// What is left of forces after cancellation, relative to the excitation: no smaller residual can be asked for at this
/// point.
[[nodiscard]] double rounding_floor(const SteadyResidual& residual, const ResidualState& state);
/// The residual asked for is raised to the floor of the start up to this: a start at which rounding swamps the
/// excitation is no measure of the solution. A solution with a floor above it is none.
inline constexpr double kLargestFloor = 1e-6;

/// Whether the contact that carries load holds the body: the static stiffness with those nodes closed and stuck must
/// not have a negative direction. Spin softening gives a floating blade a root of the equations far away from its slot
/// (K regular but indefinite, all nodes open): the residual vanishes there, but it is no state the blade can be in.
[[nodiscard]] bool is_held(const SteadyResidual& residual, const ResidualState& state);

}  // namespace dovetail::response
