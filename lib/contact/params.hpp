#pragma once

#include <array>

namespace dovetail::contact {

/// The eps of the dynamic Lagrangian. Solutions hardly depend on it, the way to them does.
struct PenaltyParams {
  /// Ratios tried one after the other when a solve fails. The answer at a given number of harmonics depends slightly on
  /// eps: the most accurate one, that of the local stiffness, comes first. Tuned on the cases of tests/hard_cases.
  std::array<double, 6> cascade{1, 0.5, 0.1, 2, 0.02, 10};
  /// Local stiffness, over the largest of any node, that counts as none, and what stands for it then.
  double no_stiffness = 1e-12, least_stiffness = 1e-3;
  /// Of contact that has mass, which resists the faster it is moved, without limit: eps in proportion to that.
  double of_mass = 1e-3;
};

/// How a march in time ends.
struct SettlingParams {
  /// Slip that dies out slowly approaches its periodic state geometrically: from so many periods on it is extrapolated,
  /// and again after so many more. Earlier, transients are taken for the limit; later, marches are longer.
  int patience = 16, interval = 8;
  double rounding = 1e-14;  ///< of the friction limit: a change below it is none
  double errors = 8;        ///< that many of them say nothing about a ratio: they may go on for ever
};

static_assert(PenaltyParams{}.cascade[0] == 1, "the most accurate eps comes first");
static_assert(PenaltyParams{}.no_stiffness < PenaltyParams{}.least_stiffness, "what stands for none is more than none");
static_assert(SettlingParams{}.interval <= SettlingParams{}.patience, "transients of an extrapolation die out sooner");

}  // namespace dovetail::contact
