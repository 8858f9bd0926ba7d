#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

#include "tests/hard_cases/problem.hpp"

namespace dovetail::hard_cases {

/// What a converged state claims: everything the check takes from the engine.
struct Claim {
  Eigen::MatrixXd displacement;        ///< U [nc, 2H+1], m
  Eigen::MatrixXd force;               ///< lambda [nc, 2H+1], N
  Eigen::VectorXd normal, tangential;  ///< the eps it was solved with [Nc], N/m
  double friction_energy = 0;          ///< J per cycle
  double input_energy = 0, damping_energy = 0, contact_work = 0;
};

/// What is checked. P = lambda + eps (U - g - W) is the prediction of the claim, a polynomial of degree H in e^(i tau);
/// the contact law turns it into forces with kinks and jumps of slope, L = law(P), of which the claim can only hold the
/// truncation T L to H harmonics. At an instant it may therefore miss the exact force by the truncation error
/// E = L - T L there, a number known from P alone, and no more: lambda + E is the force, and P - lambda - E = eps X the
/// slip and the opening, that have to obey the law. The laws of normal contact need no march, L_N = max(0, P_N).
/// Of a claim that passes `march` the five laws from tension to stick hold as well, if the oracle's own march obeys
/// them: they judge that march, too, and the three of normal contact do so without it.
enum class Check {
  equilibrium,      ///< |F - Z U - lambda|
  march,            ///< |lambda - T L| for L marched on the claim's samples
  finer_march,      ///< the same for 16 times as many samples, beyond what large steps may cost (law.hpp)
  tension,          ///< lambda_N + E_N < 0: the contact pulls
  penetration,      ///< eps X_N = P_N - lambda_N - E_N > 0: the bodies penetrate
  complementarity,  ///< both lambda_N + E_N > 0 and a gap
  cone,             ///< |lambda_T + E_T| - mu (lambda_N + E_N) > 0
  stick,            ///< eps X_T moves although the force is inside the cone, or not against it
  energy,           ///< input - damping - contact work
};
constexpr std::size_t kChecks = 9;
[[nodiscard]] const char* name(Check check);

/// Findings: each violation and what the tolerance of the solve and rounding account for, N (J: energy).
struct Verdict {
  struct Finding {
    double found = 0, allowed = 0;  ///< of the node that exceeds its bound by the largest factor
    [[nodiscard]] bool rejects() const { return !(found <= allowed); }
  };
  std::array<Finding, kChecks> findings = {};
  double rounding = 0;    ///< what rounding leaves of the forces, relative to the excitation
  double resolution = 0;  ///< largest cost of large steps of a node, relative to its largest force
  bool periodic = true;   ///< the march repeats
  int drifting = 0;       ///< nodes without an orbit at fine steps: the finer march does not judge them

  [[nodiscard]] const Finding& operator[](Check check) const { return findings[static_cast<std::size_t>(check)]; }
  [[nodiscard]] bool rejects(Check check) const { return (*this)[check].rejects(); }
};

/// Condenses the model itself, marches the contact law itself from its own Fourier sums, and compares. Nothing of
/// dovetail::contact, dovetail::numerics or dovetail::steady takes part. O(n^3 H + Nc N H).
[[nodiscard]] Verdict examine(const Problem& problem, const Claim& claim);

/// What a node does at a sample by the oracle's march; `touching` at the first loaded sample.
enum class Contact { open, touching, sticking, slipping };
/// Of all nodes at all samples [Nc][N].
[[nodiscard]] std::vector<std::vector<Contact>> contact_states(const Problem& problem, const Claim& claim);

/// Reactions F - Z U of displacements U [nc, 2H+1], N, from the uncondensed equations.
[[nodiscard]] Eigen::MatrixXd reactions(const Problem& problem, const Eigen::MatrixXd& displacement);

/// Empty when the verdict is consistent with a converged solve at the tolerance, else what is wrong.
[[nodiscard]] std::string objection(const Verdict& verdict);

}  // namespace dovetail::hard_cases
