#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "reduction/reduced_model.hpp"
#include "stability/contact_timeline.hpp"

namespace dovetail::stability {

/// A node whose contact state matters to a perturbation: its rows among the static dofs.
struct SwitchingNode {
  const ContactTimeline* timeline = nullptr;
  Eigen::Index normal = 0;
  std::vector<Eigen::Index> tangential;  ///< empty without friction: those dofs are free at all times
  Eigen::Index memory = -1;              ///< first of its slip memory among the memory variables; -1: none
};

/// The linear structure around a periodic solution, in time tau = w t: dofs that are fixed at all times (stuck nodes,
/// closed normal directions without friction) are gone, the others are dynamic ones of unit mass or static ones,
///   q'' + D q' + K_dd q + K_ds u / w^2 = 0,   K_sd q + K_ss u + d lambda = 0.
struct PerturbedStructure {
  bool meaningful = true;                 ///< false with `reason`: the model leaves open what happens next
  std::string reason;                     ///< not empty: nothing else is filled
  double omega = 0;                       ///< rad/s
  Eigen::MatrixXd damping;                ///< D / w [nd, nd]
  Eigen::MatrixXd dynamic;                ///< K_dd / w^2 [nd, nd]
  Eigen::MatrixXd coupling;               ///< K_sd [ns, nd]
  Eigen::MatrixXd stiffness;              ///< K_ss [ns, ns]
  std::vector<Eigen::Index> free_static;  ///< static dofs that no contact ever holds
  std::vector<SwitchingNode> nodes;
  Eigen::Index memory = 0;  ///< slip memory variables that are not frozen all the period
  int neutral = 0;          ///< those that are
};

/// Splits `model` by what its nodes do, one timeline per contact node.
[[nodiscard]] PerturbedStructure perturbed_structure(const reduction::ReducedModel& model, double omega,
                                                     const std::vector<ContactTimeline>& timelines);

/// The map of a perturbation (q, q', slip memory) over one period; a sentence in `failure` when there is none.
struct Monodromy {
  Eigen::MatrixXd map;
  std::string failure;
};

/// Exponentials of constant phases, split into steps of 2 pi / samples by the midpoint rule while a node slips in two
/// directions, and the maps of slip memory at the changes of state.
[[nodiscard]] Monodromy monodromy(const PerturbedStructure& structure, int samples);

}  // namespace dovetail::stability
