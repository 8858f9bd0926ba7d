#include "studies/paper_sequence/findings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "studies/report/words/units.hpp"

namespace dovetail::paper_sequence {
namespace {

using report::significant;

/// "12.3 % lower": the change from `before` to `after`.
std::string change(double before, double after, const char* more, const char* less) {
  const double share = 100 * (after / before - 1);
  return significant(std::abs(share), 3) + "\u00a0% " + (share < 0 ? less : more);
}

std::string in(double value, double si, const char* unit, int digits = 3) {
  return significant(value / si, digits) + "\u00a0" + unit;
}

Verdict when(bool holds) {
  return holds ? Verdict::holds : Verdict::fails;
}

Finding damping(const Results& r) {
  Finding f{.key = "friction_damps",
            .paper = "Friction in the joint lowers the resonance peak against glued flanks (fig. 6).",
            .verdict = when(r.resonance_m < r.glued_m && r.resonance_hz < r.glued_hz)};
  f.here = fmt::format("The peak is {} ({} against {}), and {} in frequency.",
                       change(r.glued_m, r.resonance_m, "higher", "lower"), in(r.resonance_m, 1e-3, "mm", 4),
                       in(r.glued_m, 1e-3, "mm", 4), change(r.glued_hz, r.resonance_hz, "higher", "lower"));
  f.why = fmt::format(
      "How much depends on the damping besides the friction, {}\u00a0% of critical here and not given there, and on "
      "how "
      "large "
      "0.5 N are for the joint.",
      significant(100 * r.scene.loading.damping_ratio, 2));
  return f;
}

Finding power(const Results& r) {
  const Numbers& power_w = r.states.front().curve.power_w;
  const Largest most = largest_of(power_w);
  const double at = r.frequency_hz[most.at] / r.resonance_hz - 1;
  const double ends = std::max(power_w.front(), power_w.back()) / most.value;
  const std::string where =
      std::abs(at) < 1e-6 ? "at the resonance" : significant(100 * std::abs(at), 2) + "\u00a0% beside the resonance";
  const std::string left = ends < 1e-6 ? "nothing" : significant(100 * ends, 2) + "\u00a0% of that";
  return {.key = "power_peaks_at_resonance",
          .paper = "The power dissipated in the contact has its peak at the resonance (fig. 7).",
          .here = fmt::format("It is largest {}, {}, and falls to {} at the ends of the range.", where,
                              in(most.value, 1, "W"), left),
          .why = {},
          .verdict = when(std::abs(at) < 1e-3 && ends < 0.05)};
}

Finding rates(const Results& r) {
  const RateCourses courses = rate_courses(r.history);
  Finding f{.key = "rates_rise_peak_vanish",
            .paper =
                "Wear rates of some nodes first rise, reach a peak and fall to zero; those of others only fall "
                "(fig. 10)."};
  f.here =
      fmt::format("Of {} nodes that wear, the rates of {} rise to a peak and then fall, those of {} only fall{}.",
                  courses.rise_first + courses.only_fall + courses.still_rising, courses.rise_first, courses.only_fall,
                  courses.still_rising > 0 ? fmt::format(", those of {} still rise", courses.still_rising) : "");
  f.verdict = courses.still_rising > 0                          ? Verdict::fails
              : courses.rise_first > 0 && courses.only_fall > 0 ? Verdict::holds
                                                                : Verdict::partly;
  if (f.verdict == Verdict::partly)
    f.why = "Both kinds need a worn zone of several nodes whose pressure moves while it wears.";
  return f;
}

Finding steady_state(const Results& r) {
  const History& history = r.history;
  const double share = r.resonance_wear_ratio;
  const double volume = history.volume_m3.back();
  return {
      .key = "wear_comes_to_rest",
      .paper = "Wear tends to a steady state with no wear rate (fig. 9, 10).",
      .here = fmt::format("After {} cycles the largest rate is {} of the first one. The worn volume, {}, is then {} "
                          "that of the state at rest found directly at the same nodes, which leaves {}.",
                          significant(history.cycles.back(), 2), significant(share, 2), in(volume, 1e-9, "mm\u00b3"),
                          change(r.asymptote_volume_m3, volume, "above", "below"),
                          r.certificate < 1e-9 ? "no wear rate" : significant(r.certificate, 2) + " of the first rate"),
      .verdict = when(share < 1e-2 && r.certificate < 1e-2)};
}

Finding depth(const Results& r) {
  const double most = largest_of(r.states.back().depth_m).value;
  return {.key = "depths_of_microns",
          .paper = "Worn depths of a few microns change the vibration a lot.",
          .here = fmt::format("The largest depth is {}, both surfaces together.", in(most, 1e-6, "\u00b5m")),
          .why =
              "The depth grows with the slip, so with the amplitude: stiffness, speed and damping of the reference are "
              "not known. With four times the damping it wears under a micron.",
          .verdict = most >= 1e-6   ? Verdict::holds
                     : most >= 1e-7 ? Verdict::partly
                                    : Verdict::fails};
}

/// Largest difference between the depths of the flanks, over the largest depth: between mirror images, or between
/// images turned about the blade's radial axis, which is how flanks of a twisted blade resemble each other.
double flanks_apart(const report::ContactRecord& contact, bool turned) {
  const Numbers left = of_flank(contact, contact.depth_m, 0);
  Numbers right = of_flank(contact, contact.depth_m, 1);
  if (turned) {
    const Numbers across = of_flank(contact, contact.across_m, 1);
    std::vector<std::size_t> order(right.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return across[a] > across[b] + 1e-9; });
    Numbers reversed;
    for (const std::size_t i : order) reversed.push_back(right[i]);
    right = reversed;
  }
  double apart = 0;
  for (std::size_t i = 0; i < std::min(left.size(), right.size()); ++i)
    apart = std::max(apart, std::abs(left[i] - right[i]));
  return apart / std::max(largest_of(left).value, largest_of(right).value);
}

/// Share of a flank's worn volume in its half with z > 0.
double front_share(const report::ContactRecord& contact, std::int64_t flank) {
  const Numbers depth = of_flank(contact, contact.depth_m, flank);
  const Numbers area = of_flank(contact, contact.area_m2, flank), across = of_flank(contact, contact.across_m, flank);
  double front = 0, all = 0;
  for (std::size_t i = 0; i < depth.size(); ++i) {
    const double volume = area[i] * depth[i];
    all += volume;
    front += std::abs(across[i]) < 1e-9 ? volume / 2 : across[i] > 0 ? volume : 0;
  }
  return all > 0 ? front / all : 0.5;
}

/// In space: along the flank, along the slot, and between the flanks.
Finding asymmetry_in_space(const Results& r) {
  const report::ContactRecord& contact = r.design.contact;
  const double neck = neck_side_share(contact), left = front_share(contact, 0), right = front_share(contact, 1);
  const double slot = std::max({left, 1 - left, right, 1 - right});
  const bool turned = flanks_apart(contact, true) < 0.02;
  return {
      .key = "profiles_asymmetric",
      .paper = "The final profiles are very asymmetric (fig. 11).",
      .here = fmt::format("Along a flank: {}\u00a0% of the volume is worn off its neck-side half. Along the slot: "
                          "{}\u00a0% of the left "
                          "flank\u2019s and {}\u00a0% of the right flank\u2019s wear lies in the half with z > 0{}.",
                          significant(100 * neck, 3), significant(100 * left, 3), significant(100 * right, 3),
                          turned ? "; turned about the blade\u2019s axis, the two are alike" : ""),
      .why =
          "A twisted and staggered blade bends about an axis that is not the slot\u2019s, so it presses diagonally "
          "opposite corners of the two flanks.",
      .verdict = std::abs(neck - 0.5) > 0.2 && slot > 0.6   ? Verdict::holds
                 : std::abs(neck - 0.5) > 0.2 || slot > 0.6 ? Verdict::partly
                                                            : Verdict::fails};
}

Finding asymmetry(const Results& r) {
  if (r.in_space()) return asymmetry_in_space(r);
  const double share = neck_side_share(r.design.contact);
  const double apart = flanks_apart(r.design.contact, false);
  const std::string between = apart < 1e-4 ? "both flanks wear alike"
                                           : fmt::format("the flanks differ by up to {}\u00a0% of the largest depth",
                                                         significant(100 * apart, 2));
  Finding f{
      .key = "profiles_asymmetric",
      .paper = "The final profiles are very asymmetric (fig. 11).",
      .here = fmt::format("Along a flank: {}\u00a0% of the volume is worn off its neck-side half. Between them: {}.",
                          significant(100 * share, 3), between),
      .verdict = std::abs(share - 0.5) < 0.2 ? Verdict::fails
                 : apart > 0.05              ? Verdict::holds
                                             : Verdict::partly};
  f.why =
      "The plane section is its own mirror image and the force reverses every half period, so both flanks wear "
      "alike; the reference's blade is curved and its two sides are not.";
  if (r.unequal_flanks_volume_m3.size() == 2 && r.unequal_flanks_volume_m3[1] > 0)
    f.why += fmt::format(
        " With the angle of the left flank {}\u00a0degree larger, {} times as much wears on the left as on the right.",
        significant(r.unequal_flanks_degrees, 1),
        significant(r.unequal_flanks_volume_m3[0] / r.unequal_flanks_volume_m3[1], 3));
  return f;
}

/// Of the unworn peak, Hz; between the points of the curve.
double half_power_width(const Results& r) {
  const Numbers& amplitude = r.states.front().curve.amplitude_m;
  double lower = r.resonance_hz, upper = r.resonance_hz;
  for (std::size_t i = 0; i < amplitude.size(); ++i) {
    if (!(amplitude[i] > r.resonance_m / std::sqrt(2.0))) continue;
    lower = std::min(lower, r.frequency_hz[i]);
    upper = std::max(upper, r.frequency_hz[i]);
  }
  return upper - lower;
}

Finding held(const Results& r) {
  const WornState& last = r.states.back();
  const double most = largest_of(r.history.amplitude_m).value;
  const std::string first = most > 1.002 * r.resonance_m ? fmt::format(", after it first rose by {}\u00a0%",
                                                                       significant(100 * (most / r.resonance_m - 1), 2))
                                                         : "";
  return {.key = "amplitude_falls_at_unworn_resonance",
          .paper = "Excited at the unworn resonance, the amplitude falls as the joint wears (fig. 13).",
          .here = fmt::format("It ends {} than it began{}.", change(r.resonance_m, last.amplitude_m, "higher", "lower"),
                              first),
          .why = fmt::format("The peak moves by {} of its width at half power.",
                             significant(std::abs(last.peak_hz - r.resonance_hz) / half_power_width(r), 2)),
          .verdict = when(last.amplitude_m < r.resonance_m)};
}

Finding moves(const Results& r) {
  const WornState& last = r.states.back();
  return {.key = "peak_moves_down",
          .paper = "The resonance slides to lower frequencies (fig. 12).",
          .here = fmt::format("It moves from {} to {}, {}.", in(r.resonance_hz, 1, "Hz", 6),
                              in(last.peak_hz, 1, "Hz", 6), change(r.resonance_hz, last.peak_hz, "up", "down")),
          .why = {},
          .verdict = when(last.peak_found && last.peak_hz < r.resonance_hz)};
}

Finding grows(const Results& r) {
  const WornState& last = r.states.back();
  return {.key = "peak_grows",
          .paper = "At the moved resonance the amplitude is higher than at the unworn one (fig. 12, 13).",
          .here = fmt::format("The peak ends {}: {} against {}, with {} for glued flanks.",
                              change(r.resonance_m, last.peak_m, "higher", "lower"), in(last.peak_m, 1e-3, "mm", 4),
                              in(r.resonance_m, 1e-3, "mm", 4), in(r.glued_m, 1e-3, "mm", 4)),
          .why = "What is worn off no longer rubs, so friction damps less.",
          .verdict = when(last.peak_found && last.peak_m > r.resonance_m)};
}

}  // namespace

Largest largest_of(const Numbers& values) {
  Largest most;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (std::isfinite(values[i]) && values[i] > most.value) most = {values[i], i};
  return most;
}

RateCourses rate_courses(const History& history) {
  RateCourses courses;
  if (history.rate_m_per_cycle.empty()) return courses;
  const Numbers& first = history.rate_m_per_cycle.front();
  const double deepest = largest_of(history.depth_m.back()).value;
  for (std::size_t node = 0; node < first.size(); ++node) {
    if (history.depth_m.back()[node] < 0.01 * deepest) continue;
    Numbers course;
    for (const Numbers& rates : history.rate_m_per_cycle) course.push_back(rates[node]);
    const Largest peak = largest_of(course);
    if (peak.at + 1 == course.size())
      ++courses.still_rising;
    else if (peak.value > 1.02 * first[node])
      ++courses.rise_first;
    else
      ++courses.only_fall;
  }
  return courses;
}

double neck_side_share(const report::ContactRecord& contact) {
  double neck = 0, all = 0;
  const double middle =
      contact.along_m.empty() ? 0 : *std::max_element(contact.along_m.begin(), contact.along_m.end()) / 2;
  for (std::size_t i = 0; i < contact.depth_m.size(); ++i) {
    const double volume = contact.area_m2[i] * contact.depth_m[i];
    all += volume;
    if (contact.along_m[i] < middle) neck += volume;
  }
  return all > 0 ? neck / all : 0.5;
}

std::vector<Finding> findings(const Results& r) {
  if (r.states.size() < 2 || r.history.cycles.size() < 2) return {};
  return {damping(r), power(r), rates(r), steady_state(r), depth(r), asymmetry(r), held(r), moves(r), grows(r)};
}

}  // namespace dovetail::paper_sequence
