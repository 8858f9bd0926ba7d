// Error bars against refined references.
#include "quality/error_bars.hpp"
#include "paths/steady_state.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <vector>

#include "tests/verification/steady/fine_reference.hpp"
#include "tests/verification/steady/random_contact.hpp"

namespace dovetail::verification {
namespace {

using quality::Quantities;
using steady::Options;
using steady::State;

/// True errors beside their bars.
struct Comparison {
  std::string name;
  std::vector<double> ratio = {};  ///< bar / true error
  int inside = 0, cases = 0;

  void add(double error, double bar, double scale) {
    ++cases;
    // Rounding of both solutions.
    const double rounding = 1e-8 * std::abs(scale);
    if (error <= bar + rounding) ++inside;
    if (error > rounding) ratio.push_back(bar / error);
  }
  [[nodiscard]] double fraction() const { return static_cast<double>(inside) / cases; }
  [[nodiscard]] double median() {
    std::ranges::nth_element(ratio, ratio.begin() + static_cast<std::ptrdiff_t>(ratio.size() / 2));
    return ratio[ratio.size() / 2];
  }
  void report() {
    std::printf("%-18s %3d cases, %5.1f %% inside, median bar / error %.2f\n", name.c_str(), cases, 100 * fraction(),
                median());
  }
};

// References of 31 harmonics have about (3/31)^1.5 = 3 % of the error of the 3 harmonics judged, those of 2048 samples
// with second-order slip less than that of 128.
TEST(ErrorBars, HoldTheTrueErrorsOfRandomStructures) {
  Comparison amplitude{"amplitude"}, energy{"friction energy"}, rate{"largest wear rate"}, volume{"wear volume rate"};
  for (unsigned seed = 1; seed <= 60; ++seed) {
    const RandomContact contact = random_contact(seed);
    const auto model = condensed(contact.model);
    const steady::State state = paths::steady_state({model, {}, {}}, contact.omega);
    ASSERT_EQ(state.status, Status::converged) << seed;
    const quality::ErrorBars bars = quality::error_bars({model, {}, {}}, state);
    ASSERT_EQ(bars.status, Status::converged) << seed;
    const steady::State fine = fine_reference(model, state, 31, 2048);
    ASSERT_EQ(fine.status, Status::converged) << seed;
    const quality::Quantities exact = quality::quantities(*model, fine), error = distance(bars.value, exact);
    amplitude.add(error.amplitudes(0), bars.total.amplitudes(0), exact.amplitudes(0));
    // Stuck everywhere: no energy and no bar.
    if (exact.friction_energy == 0 && bars.value.friction_energy == 0) continue;
    energy.add(error.friction_energy, bars.total.friction_energy, exact.friction_energy);
    rate.add(error.largest_wear_rate, bars.total.largest_wear_rate, exact.largest_wear_rate);
    volume.add(error.wear_volume_rate, bars.total.wear_volume_rate, exact.wear_volume_rate);
  }
  for (Comparison* one : {&amplitude, &energy, &rate, &volume}) {
    one->report();
    EXPECT_GE(one->cases, 45) << one->name;
    EXPECT_GE(one->fraction(), 0.95) << one->name;
    EXPECT_LE(one->median(), 10) << one->name;
  }
}

// Rigid friction with mass on the contact: errors fall like H^-0.5 to H^-1 against Den Hartog's closed form.
TEST(ErrorBars, HoldWhereContactHasMass) {
  for (const double omega : {0.8, 2.0}) {
    const auto model = condensed(den_hartog(0.4));
    ASSERT_FALSE(model->massless_contact());
    const double v = 1 / (1 - omega * omega), u = std::tan(std::numbers::pi / (2 * omega)) / omega;
    const double exact = std::sqrt(v * v - 0.16 * u * u);
    for (const int harmonics : {3, 7}) {
      const steady::Options options{.harmonics = harmonics, .samples = 512};
      const steady::State state = paths::steady_state({model, {}, options}, omega);
      ASSERT_EQ(state.status, Status::converged);
      const double error = std::abs(state.amplitudes(0) - exact);
      const double bar = quality::error_bars({model, {}, options}, state).total.amplitudes(0);
      EXPECT_LE(error, bar) << omega << " " << harmonics;
      EXPECT_LE(bar, 4 * error) << omega << " " << harmonics;
    }
  }
}

TEST(ErrorBars, AreUnknownWhereARefinementFails) {
  const auto model = condensed(single_node());
  steady::State state = paths::steady_state({model, {}, {}}, 1.1);
  ASSERT_EQ(state.status, Status::converged);
  const quality::ErrorBars starved =
      quality::error_bars({model, {}, {.max_iterations = 1, .penalty_cascade = false}}, state);
  EXPECT_NE(starved.status, Status::converged);
  EXPECT_EQ(starved.total.amplitudes(0), kInfinity);
  EXPECT_EQ(starved.total.friction_energy, kInfinity);
  state.status = Status::stalled;
  const quality::ErrorBars failed = quality::error_bars({model, {}, {}}, state);
  EXPECT_EQ(failed.status, Status::stalled);
  EXPECT_EQ(failed.total.wear_volume_rate, kInfinity);
}

}  // namespace
}  // namespace dovetail::verification
