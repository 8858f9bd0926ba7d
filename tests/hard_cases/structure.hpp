#pragma once

#include "tests/hard_cases/problem.hpp"
#include "tests/hard_cases/random.hpp"

namespace dovetail::hard_cases {

struct Range {
  double low, high;
};

/// What the excitation is measured by: the multiple `reach` of the load at which, in the linear response of the glued
/// structure, the first node slips or lifts off; or at which, without contact, the first gap closes; or as it is.
enum class Measure { slip, lift, gap, load };
/// Modes of the structure with contact fixed, with the normal directions fixed, or without contact.
enum class Modes { glued, sliding, free };

/// A random structure: masses linked in a chain by random springs, each massless contact node behind a spring of
/// random direction at one of them. Masses have as many directions as contact nodes; springs of the chain are about 1.
struct Recipe {
  int nodes = 1, masses = 1, directions = 2;
  Range friction{0.01, 1.5};         ///< log-uniform
  Range contact_stiffness{0.3, 30};  ///< of the springs at contact nodes, log-uniform
  double coupling = 0.3;             ///< springs between neighbouring contact nodes, relative to theirs
  Range preload{0.3, 3};             ///< static normal force of each node, log-uniform
  double unloaded = 0;               ///< share of the nodes without preload
  Range gap{0, 0};                   ///< uniform
  Range mass{0.5, 2};                ///< log-uniform
  double contact_mass = 0;           ///< of every contact dof
  bool quasi_static = false;         ///< no mass, no damping
  double ground = 1;                 ///< springs that hold masses, relative to the chain's; 0: only contact holds
  Range damping_ratio{0.002, 0.05};  ///< at omega, log-uniform; {0, 0}: none
  bool proportional = true;          ///< damping C = a M + b K, else random dashpots
  Modes modes = Modes::glued;        ///< the frequency is near one of these
  Range detuning{0.5, 1.6};          ///< omega / mode, uniform
  Range reach{0.5, 5};               ///< log-uniform
  Measure measure = Measure::slip;
  int forcing_harmonics = 1;
  int harmonics = 5, samples = 128;
};

/// Throws nothing: every recipe gives a model that passes the engine's checks.
[[nodiscard]] Problem build(const Recipe& recipe, Random& random);

}  // namespace dovetail::hard_cases
