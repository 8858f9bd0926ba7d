#pragma once

#include <array>

namespace dovetail::optimizer {

// The numbers that steer the choice of settings. They lead to what is tried next; what is handed over was computed with
// bars at exactly those settings.

/// Settings that are tried, coarse to fine. A study's own value is one of them, too.
struct SettingLadders {
  std::array<double, 11> mesh{0.5, 0.667, 0.833, 1, 1.333, 1.667,
                              2,   2.667, 3.333, 4, 5.333};          ///< edges over the study's
  std::array<int, 10> harmonics{1, 3, 5, 7, 9, 11, 15, 19, 23, 31};  ///< even ones hardly move of flanks under pressure
  std::array<int, 8> samples{64, 96, 128, 192, 256, 384, 512, 1024};
  std::array<int, 9> modes{4, 6, 8, 12, 16, 20, 30, 45, 60};
};

/// Orders in which parts of the error fall, and powers with which parts of the time grow, of sections with 34 to 208
/// contact nodes. Off by one: another round.
struct SettingsParams {
  double by_harmonics = 1.5;  ///< order of what harmonics and the pseudo-penalty leave, by 2H+1
  double by_samples = 1;      ///< of samples
  double by_modes = 2;        ///< of modes: like the inverse square of the first frequency left out
  double matrices = 2.2;      ///< power of edges, of the time of meshing, matrices and modes in a plane
  double matrices_in_space = 3;
  double contact = 2;            ///< of contact nodes times 2H+1, of the time of steady states and wear
  double contact_samples = 0.2;  ///< share of that time that grows with samples instead
  double modes_share = 0.4;      ///< of the time of matrices, that grows with the number of modes
  double aim = 0.85;             ///< of the accuracy: what is predicted is a little off
  double worth = 0.8;            ///< of the time: for less than that saved nothing else is tried
  double step = 2;               ///< finer or coarser meshes than by this are not foreseen from one round
  int rounds = 5;
};

static_assert(SettingsParams{}.aim < 1 && SettingsParams{}.worth < 1 && SettingsParams{}.step > 1,
              "shares and a factor");

}  // namespace dovetail::optimizer
