// Response curves of a design: unworn, worn and glued.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <numbers>
#include <set>
#include <utility>

#include "paths/frequency_response.hpp"
#include "studies/report/record/design_record.hpp"

namespace dovetail::report {

namespace {

using optimizer::CandidateModel;
using optimizer::CandidateResult;
using optimizer::Scene;

constexpr double kTwoPi = 2 * std::numbers::pi;

/// Where curves with friction are computed.
struct CurveParams {
  /// Every so many of the frequencies at first, a power of 2.
  std::size_t first = 4;
  /// How far a point may lie from the line between its neighbours, of the highest amplitude: lines drawn between all
  /// three are then within a quarter of it, which is a pixel or two of a drawing.
  double bend = 0.02;
};

/// Half range of frequencies on either side of the resonances.
struct Band {
  double lower = 0, upper = 0;  ///< rad/s
};

double glued_amplitude(const dynamics::CondensedModel& model, double omega, Status& status) {
  const dynamics::CondensedHarmonic at = model.harmonic(1, omega);
  status = at.status;
  return std::abs(model.outputs(at, Eigen::VectorXcd::Zero(model.contact_size()))(0));
}

/// The peaks with `widths` half-power widths around them. Friction widens the peak as it lowers it, so the width is
/// the linear one times the ratio of the amplitudes.
Band band(const Scene& scene, const CandidateResult& result, double glued, double widths) {
  Status status = Status::converged;
  const double linear = glued_amplitude(*result.model.condensed, glued, status);
  const double damping = scene.loading.damping_ratio * std::max(1.0, linear / result.unworn->amplitude);
  const double half = widths * std::max(damping, 1e-5) * glued;
  double lowest = std::min(glued, result.unworn->omega), highest = std::max(glued, result.unworn->omega);
  if (result.worn && result.worn->status == Status::converged) {
    lowest = std::min(lowest, result.worn->omega);
    highest = std::max(highest, result.worn->omega);
  }
  return {.lower = std::max(lowest - half, 0.1 * lowest), .upper = highest + half};
}

/// Frequencies over the band, closest together at `peak`.
Numbers frequencies(const Band& range, double peak, int points) {
  Numbers omega;
  for (int i = 0; i < points; ++i) {
    const double t = points == 1 ? 0 : 2.0 * i / (points - 1) - 1;
    const double offset = 0.12 * t + 0.88 * t * t * t;
    omega.push_back(peak + offset * (t < 0 ? peak - range.lower : range.upper - peak));
  }
  return omega;
}

void add_point(double omega, double amplitude, Status status, ResponseCurve& curve) {
  curve.frequency_hz.push_back(omega / kTwoPi);
  curve.amplitude_m.push_back(status == Status::converged ? amplitude : std::numeric_limits<double>::quiet_NaN());
  curve.status.emplace_back(to_string(status));
}

/// Points of a curve by their place among all frequencies: the amplitude, and how the point ended.
using Points = std::map<std::size_t, std::pair<double, Status>>;

/// The places halfway to the neighbours of every point at which the curve bends, or that failed.
std::set<std::size_t> between_bends(const Points& points) {
  double highest = 0;
  for (const auto& [place, point] : points) highest = std::max(highest, point.first);
  std::set<std::size_t> places;
  for (auto here = std::next(points.begin()); std::next(here) != points.end(); ++here) {
    const auto &before = *std::prev(here), &after = *std::next(here);
    const auto [left, right] = std::pair(here->first - before.first, after.first - here->first);
    const auto all = {before.second.second, here->second.second, after.second.second};
    const bool failed = std::ranges::any_of(all, [](Status status) { return status != Status::converged; });
    const double slope = (after.second.first - before.second.first) / static_cast<double>(left + right);
    const double bend = here->second.first - before.second.first - slope * static_cast<double>(left);
    if (!failed && std::abs(bend) <= CurveParams{}.bend * highest) continue;
    if (left > 1) places.insert(here->first - left / 2);
    if (right > 1) places.insert(here->first + right / 2);
  }
  return places;
}

/// At as many of the frequencies as show it: from every few of them on, those where it bends.
ResponseCurve frictional_curve(const Scene& scene, const CandidateModel& model, const Numbers& omega,
                               const steady::Condition& condition) {
  const steady::Joint joint{model.condensed, condition, optimizer::steady_options(scene.solver)};
  std::set<std::size_t> places;
  for (std::size_t place = 0; place < omega.size(); place += CurveParams{}.first) places.insert(place);
  places.insert({omega.size() / 2, omega.size() - 1});  // the resonance, and the end
  Points points;
  while (!places.empty()) {
    Numbers at;
    for (const std::size_t place : places) at.push_back(omega[place]);
    auto place = places.begin();
    for (const steady::State& state : paths::frequency_response(joint, at))
      points[*place++] = {state.status == Status::converged ? state.amplitudes(0) : 0, state.status};
    places = points.size() < 3 ? std::set<std::size_t>{} : between_bends(points);
  }
  ResponseCurve curve;
  for (const auto& [place, point] : points) add_point(omega[place], point.first, point.second, curve);
  return curve;
}

ResponseCurve glued_curve(const CandidateModel& model, const Numbers& omega) {
  ResponseCurve curve;
  for (const double w : omega) {
    Status status = Status::converged;
    const double amplitude = glued_amplitude(*model.condensed, w, status);
    add_point(w, amplitude, status, curve);
  }
  return curve;
}

}  // namespace

void add_curves(const Scene& scene, const CandidateResult& result, const DesignRecordOptions& options,
                DesignRecord& record) {
  if (options.curve_points < 1) return;
  if (!result.unworn || result.unworn->status != Status::converged) {
    record.notes.push_back("No response curves were computed: the unworn resonance was not found.");
    return;
  }
  const CandidateModel& model = result.model;
  const double glued = model.glued_frequencies(scene.loading.mode - 1);
  const Band range = band(scene, result, glued, options.curve_widths);
  record.glued = glued_curve(model, frequencies(range, glued, options.curve_points));
  record.unworn = frictional_curve(scene, model, frequencies(range, result.unworn->omega, options.curve_points), {});
  if (result.worn && result.worn->status == Status::converged && result.asymptote)
    record.worn = frictional_curve(scene, model, frequencies(range, result.worn->omega, options.curve_points),
                                   {.wear_depth = result.asymptote->depth, .released = {}, .slip_origin = {}});
  for (const auto& [name, curve] : {std::pair{"new", &record.unworn}, std::pair{"worn", &record.worn}}) {
    const auto failed = std::count_if(curve->status.begin(), curve->status.end(),
                                      [](const std::string& s) { return !optimizer::converged(s); });
    if (failed > 0)
      record.notes.push_back(
          fmt::format("{} of {} points of the response curve of the {} joint did not converge and are left out.",
                      failed, curve->status.size(), name));
  }
}

}  // namespace dovetail::report
