// Harmonics and samples chosen for a tolerance, against refined references.
#include "quality/automatic.hpp"
#include "paths/steady_state.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "tests/verification/steady/fine_reference.hpp"
#include "tests/verification/steady/random_contact.hpp"

namespace dovetail::verification {
namespace {

using steady::Options;
using steady::State;

TEST(AutomaticTruncation, ReachesTheToleranceOfRandomStructures) {
  const quality::AutomaticOptions automatic;
  int converged = 0, cases = 0, amplitude = 0, energy = 0;
  for (unsigned seed = 201; seed <= 240; ++seed) {
    const RandomContact contact = random_contact(seed);
    const auto model = condensed(contact.model);
    const quality::AutomaticState chosen = quality::automatic_state({model, {}, {}}, contact.omega, automatic);
    ASSERT_EQ(chosen.state.status, Status::converged) << seed;
    EXPECT_EQ(chosen.state.displacement.cols(), 2 * chosen.options.harmonics + 1);
    EXPECT_EQ(chosen.status == Status::converged, within(chosen.bars, chosen.state, automatic));
    ++cases;
    if (chosen.status != Status::converged) continue;
    ++converged;
    // A third of the truncation error of the settings chosen, or less.
    const steady::State fine = fine_reference(model, chosen.state, std::max(31, 2 * chosen.options.harmonics + 1),
                                              std::max(2048, 2 * chosen.options.samples));
    ASSERT_EQ(fine.status, Status::converged) << seed;
    if (std::abs(chosen.state.amplitudes(0) - fine.amplitudes(0)) <= automatic.amplitude_tolerance * fine.amplitudes(0))
      ++amplitude;
    if (std::abs(chosen.state.friction_energy - fine.friction_energy) <=
        automatic.energy_tolerance * std::max(fine.friction_energy, 1e-3 * fine.input_energy))
      ++energy;
  }
  std::printf("%d of %d within the largest settings; of these amplitude true in %d, energy in %d\n", converged, cases,
              amplitude, energy);
  EXPECT_GE(converged, 0.9 * cases);
  EXPECT_GE(amplitude, 0.95 * converged);
  EXPECT_GE(energy, 0.95 * converged);
}

TEST(AutomaticTruncation, KeepsWhatIsNotItsToChoose) {
  const auto model = condensed(rod(6));
  const steady::Options given{.harmonics = 5, .samples = 96};
  const quality::AutomaticState harmonics = quality::automatic_state({model, {}, given}, 2.5, {.samples = false});
  EXPECT_EQ(harmonics.options.samples, 96);
  EXPECT_GT(harmonics.options.harmonics, 3);
  const quality::AutomaticState samples = quality::automatic_state({model, {}, given}, 2.5, {.harmonics = false});
  EXPECT_EQ(samples.options.harmonics, 5);
  EXPECT_EQ(samples.state.displacement.cols(), 11);
  // 1e-9 is out of reach; the best within the limits comes with what it reached.
  const quality::AutomaticState capped = quality::automatic_state(
      {model, {}, given}, 2.5, {.amplitude_tolerance = 1e-9, .max_harmonics = 7, .max_samples = 256});
  EXPECT_EQ(capped.status, Status::iteration_limit);
  EXPECT_EQ(capped.state.status, Status::converged);
  EXPECT_EQ(capped.options.harmonics, 7);
  EXPECT_EQ(capped.options.samples, 256);
  EXPECT_GT(capped.bars.total.amplitudes(0), 1e-9 * capped.state.amplitudes(0));
}

TEST(AutomaticTruncation, HoldsOnTheCurveItWasChosenFor) {
  const auto model = condensed(rod(6));
  std::vector<double> omega;
  for (int i = 0; i <= 30; ++i) omega.push_back(1 + 0.1 * i);
  const quality::AutomaticSettings settings = quality::automatic_settings({model, {}, {}}, omega);
  ASSERT_EQ(settings.status, Status::converged);
  ASSERT_FALSE(settings.points.empty());
  ASSERT_EQ(settings.points.size(), settings.bars.size());
  // At its most demanding points the tolerance is relative to their own values; elsewhere it is of the largest.
  std::vector<steady::State> curve, fine;
  double largest = 0;
  for (const double w : omega) {
    curve.push_back(paths::steady_state({model, {}, settings.options}, w));
    ASSERT_EQ(curve.back().status, Status::converged);
    fine.push_back(fine_reference(model, curve.back(), 63, 4096));
    ASSERT_EQ(fine.back().status, Status::converged);
    largest = std::max(largest, fine.back().amplitudes(0));
  }
  for (std::size_t i = 0; i < curve.size(); ++i)
    EXPECT_LE(std::abs(curve[i].amplitudes(0) - fine[i].amplitudes(0)), 1e-3 * largest) << omega[i];
  for (const std::size_t i : settings.points) {
    EXPECT_LE(std::abs(curve[i].amplitudes(0) - fine[i].amplitudes(0)), 1e-3 * fine[i].amplitudes(0));
    EXPECT_LE(std::abs(curve[i].friction_energy - fine[i].friction_energy), 1e-2 * fine[i].friction_energy);
  }
}

}  // namespace
}  // namespace dovetail::verification
