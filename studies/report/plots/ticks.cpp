#include "studies/report/plots/ticks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "studies/report/words/units.hpp"

namespace dovetail::report {

namespace {

/// The nice step nearest above `rough`.
double nice_step(double rough) {
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  for (const double factor : {1.0, 2.0, 2.5, 5.0})
    if (factor * power >= rough * (1 - 1e-9)) return factor * power;
  return 10 * power;
}

int decimals_of(double step) {
  for (int d = 0; d < 15; ++d) {
    const double scaled = step * std::pow(10.0, d);
    if (std::abs(scaled - std::round(scaled)) < 1e-6 * scaled) return d;
  }
  return 15;
}

std::string label(double value, int decimals) {
  std::string text = fmt::format("{:.{}f}", value == 0 ? 0.0 : value, decimals);
  if (text.front() == '-') text.replace(0, 1, "\u2212");
  return text;
}

/// Large values as powers, not as rows of zeros; significant() writes them so from a million on.
std::string power_label(double factor, int exponent) {
  if (exponent >= 6) return significant(factor * std::pow(10.0, exponent), 1);
  const std::string million = significant(factor * 1e6, 1);  // its last character, of three bytes, is the exponent
  return million.substr(0, million.size() - 3) + (exponent == 4 ? "\u2074" : "\u2075");
}

}  // namespace

Ticks linear_ticks(double lower, double upper, int count, bool tight) {
  assert(std::isfinite(lower) && std::isfinite(upper) && lower <= upper && count >= 1);
  // Below a relative width of 1e-10 neighbouring labels would be the same text.
  const double least = 1e-10 * std::max(std::abs(lower), std::abs(upper));
  if (upper - lower <= least) {
    const double half = lower == 0 ? 0.5 : std::max(0.1 * std::abs(lower), least);
    lower -= half;
    upper += half;
  }
  const double step = nice_step((upper - lower) / count);
  Ticks ticks{.lower = lower, .upper = upper, .at = {}, .labels = {}};
  constexpr double kRounding = 1e-6;
  const long long first =
      std::llround(tight ? std::ceil(lower / step - kRounding) : std::floor(lower / step + kRounding));
  const long long last =
      std::llround(tight ? std::floor(upper / step + kRounding) : std::ceil(upper / step - kRounding));
  const int decimals = decimals_of(step);
  for (long long i = first; i <= last; ++i) {
    const double at = static_cast<double>(i) * step;
    ticks.at.push_back(at);
    ticks.labels.push_back(label(at, decimals));
  }
  if (!tight) {
    ticks.lower = std::min(lower, static_cast<double>(first) * step);
    ticks.upper = std::max(upper, static_cast<double>(last) * step);
  }
  // Ticks must lie within the range although `first` and `last` were rounded.
  for (double& at : ticks.at) at = std::clamp(at, ticks.lower, ticks.upper);
  return ticks;
}

Ticks logarithmic_ticks(double lower, double upper) {
  assert(lower > 0 && lower <= upper && std::isfinite(upper));
  int first = static_cast<int>(std::floor(std::log10(lower) + 1e-9));
  int last = static_cast<int>(std::ceil(std::log10(upper) - 1e-9));
  if (first == last) ++last;
  Ticks ticks{.lower = std::pow(10.0, first), .upper = std::pow(10.0, last), .at = {}, .labels = {}};
  const int every = std::max(1, (last - first + 6) / 7);
  const bool few = last - first <= 2;
  for (int e = first; e <= last; e += every) {
    for (const double factor : {1.0, 2.0, 5.0}) {
      const double value = factor * std::pow(10.0, e);
      if ((factor > 1 && !few) || value > ticks.upper * (1 + 1e-9)) continue;
      ticks.at.push_back(value);
      ticks.labels.push_back(e < 4 ? significant(value, 1) : power_label(factor, e));
    }
  }
  return ticks;
}

}  // namespace dovetail::report
