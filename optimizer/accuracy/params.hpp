#pragma once

#include <array>
#include <cstddef>

namespace dovetail::optimizer {

// The numbers that steer the choice of settings. They lead to what is tried next; what is handed over was computed with
// bars at exactly those settings.

/// Settings that are tried, coarse to fine. A study's own value is one of them, too.
struct SettingLadders {
  std::array<double, 11> mesh{0.5, 0.667, 0.833, 1, 1.333, 1.667,
                              2,   2.667, 3.333, 4, 5.333};      ///< edges over the study's
  std::array<double, 6> beside{0.5, 0.707, 1, 1.414, 2, 2.828};  ///< the same beside the flanks
  std::array<int, 9> harmonics{3, 5, 7, 9, 11, 15, 19, 23, 31};  ///< even ones hardly move of flanks under pressure
  std::array<int, 9> samples{64, 96, 128, 192, 256, 384, 512, 768, 1024};
  /// Samples over 2H+1, at least. Fewer: what more harmonics change is what their few samples leave, and harmonics are
  /// bought for it.
  int samples_per_coefficient = 8;
  std::array<int, 9> modes{4, 6, 8, 12, 16, 20, 30, 45, 60};
  std::array<double, 3> resonance_tolerance{1e-7, 1e-6, 1e-5};
  /// Of the half width of a peak, that the tolerance may be at most: amplitudes there err by half the square of it.
  double of_half_width = 1e-2;
  /// Tolerance of a wear history over the accuracy, which its share of a bar is, and at most: well below what two worn
  /// states may differ by to be one.
  double history = 0.1, loosest_history = 5e-3;
};

/// How settings are foreseen from evaluations with bars. Powers of operations in the plane: by the seconds of 145
/// settings of the quickstart's design (16 to 82 contact nodes), of which what follows the matrices grows with the
/// powers 1.7 of the nodes and 0.7 of 2H+1, and somewhat larger, as designs with more slip have up to 3 and 1.1. Those
/// in space are estimates. Off by one: another round.
struct SettingsParams {
  double by_harmonics = 1.5;  ///< order of what harmonics and the pseudo-penalty leave, by 2H+1
  double by_samples = 1;      ///< of samples
  double by_modes = 2;        ///< of modes: like the inverse square of the first frequency left out
  double order_off = 3;       ///< largest factor from these by which two rounds may correct one
  /// Operations of mesh, matrices and modes: these times powers of the unknowns of the mesh and of the modes; the unit
  /// is that of steady::jacobian_operations.
  double matrices_by = 1.4e5, matrices_by_in_space = 1.2e3;
  double matrices_in_plane = 1.1, matrices_in_space = 1.6;
  double modes_power = 0.3, modes = 20;  ///< over so many
  double dofs_in_space = 2.5;
  /// In the plane, by the edges along the flanks and by those beside them: 24 and 48 along them, half as many to twice
  /// as many beside.
  double dofs_along = 0.4, dofs_beside = 0.8;
  /// What follows the matrices: by the contact nodes, which grow by another power of the mesh (long cells do not become
  /// more where there are short ones beside them), by 2H+1 and by the samples.
  double nodes_in_plane = 0.5, nodes_in_space = 1.5;
  double contact_by_nodes = 2.4, contact_by_harmonics = 1.6, contact_by_samples = 0.5;
  double by_digit = 0.12, coarsest_tolerance = 1e-5;  ///< and by each digit of the resonances, from 1e-5 on
  double least_share = 0.1;     ///< of what a mesh leaves, that either part of it counts for at least: none is free
  double coarser_beside = 1.5;  ///< sizes of elements beside the flanks of the mesh that says what they leave
  double aim = 0.95;            ///< of the accuracy: what is foreseen is a little off
  double as_good = 1.02;        ///< bars over the least ones that settings reach: for less no knob is turned
  double hardly_worse = 1.25;   ///< bars over the least ones reached, of settings that are kept where none are enough
  double worth = 0.85;          ///< of the operations: for less than that saved nothing else is tried
  double step = 1.58;           ///< no setting changes by more from one round to the next
  int rounds = 10;
  /// Where none is accurate enough, so many rounds in a row that do not bring what is left below this times the least
  /// before them end the search: bars that scatter lead to ever finer settings.
  int patience = 3;
  double progress = 0.95;
};

/// Whether one round reaches the next rung from any of a ladder.
template <class Rungs>
constexpr bool climbable(const Rungs& rungs, double offset = 0, double factor = 1) {
  for (std::size_t i = 0; i + 1 < rungs.size(); ++i)
    if (factor * rungs[i + 1] + offset > SettingsParams{}.step * (factor * rungs[i] + offset)) return false;
  return true;
}
static_assert(climbable(SettingLadders{}.mesh) && climbable(SettingLadders{}.beside) &&
                  climbable(SettingLadders{}.harmonics, 1, 2) && climbable(SettingLadders{}.samples) &&
                  climbable(SettingLadders{}.modes),
              "a knob whose next rung is out of reach stays where it is for ever");
static_assert(SettingsParams{}.aim < 1 && SettingsParams{}.worth < 1 && SettingsParams{}.step > 1,
              "shares and a factor");
static_assert(SettingsParams{}.patience > 1 && SettingsParams{}.progress < 1, "one round may be out of line");

}  // namespace dovetail::optimizer
