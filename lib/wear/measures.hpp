#pragma once

#include <Eigen/Core>
#include <vector>

#include "reduction/reduced_model.hpp"
#include "steady/state.hpp"

namespace dovetail::wear {

/// Largest value over the contact nodes; 0 where there are none.
[[nodiscard]] double largest(const Eigen::VectorXd& of_nodes);

/// Volume removed by nodal depths W: V = sum_i A_i W_i, m^3 (per metre of thickness where areas are).
/// `depth` is [Nc] m, both surfaces together.
[[nodiscard]] double worn_volume(const reduction::ContactNodes& contact, const Eigen::VectorXd& depth);

/// Nodes worn by more than 2 % of the largest depth: less is a trace of the way there.
[[nodiscard]] std::vector<bool> worn_nodes(const Eigen::VectorXd& depth);

/// Whether the wear law lets a node slip a little without wear: then worn nodes come to rest under load, before they
/// are worn off, and no release of nodes finds where.
[[nodiscard]] bool rests_in_slip(const dynamics::CondensedModel& model);

/// Number of cycles in which the fastest node loses `increment`, dN = W_tot / max_i dW_i [Salles 2009, eq. 21-22].
/// `rate` is dW [Nc] m per cycle; infinite where nothing wears.
[[nodiscard]] double cycle_jump(const Eigen::VectorXd& rate, double increment);

/// A node's own stiffness in one direction (0: normal), N/m, all others held. Where nothing holds it, 1e-3 of the
/// largest stiffness of any node, or 1 where there is none, so that what is divided by it stays finite.
[[nodiscard]] double own_stiffness(const dynamics::CondensedModel& model, Eigen::Index node, Eigen::Index direction);

/// Largest lambda_N of a node over its own normal stiffness, m: the depth over which its load changes when it wears.
/// Finite also under a dead load, which does not change.
[[nodiscard]] double largest_penetration(const dynamics::CondensedModel& model, const steady::State& state);

}  // namespace dovetail::wear
