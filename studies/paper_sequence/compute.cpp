#include "studies/paper_sequence/compute.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "optimizer/evaluator.hpp"
#include "paths/frequency_response.hpp"
#include "paths/steady_state.hpp"
#include "studies/report/record/design_record.hpp"
#include "wear/asymptote/asymptote.hpp"
#include "wear/asymptote/drift.hpp"
#include "wear/history/history.hpp"

namespace dovetail::paper_sequence {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;
constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
Numbers list(const Eigen::Ref<const Eigen::VectorXd>& values) {
  return {values.data(), values.data() + values.size()};
}

class Study {
 public:
  Study(const optimizer::Scene& scene, const ComputeOptions& options)
      : options_(options), steady_(optimizer::steady_options(scene.solver)) {
    results_.scene = scene;
  }

  Results run() {
    say("model and preload");
    const optimizer::ModelBuilder builder(results_.scene);
    candidate_.model = builder.build(results_.scene);
    if (candidate_.model.converged()) optimizer::fit_contact(results_.scene, {}, candidate_.model);
    if (!candidate_.model.converged()) {
      fail("The model could not be computed: " + candidate_.model.status + ".");
      return std::move(results_);
    }
    if (!unworn()) return std::move(results_);
    asymptote();
    record();
    history();
    curves();
    if (!results_.in_space()) unequal_flanks();
    return std::move(results_);
  }

 private:
  void say(const std::string& what) const {
    if (options_.progress) options_.progress(what);
  }
  void fail(std::string sentence) { results_.failures.push_back(std::move(sentence)); }

  bool unworn() {
    say("unworn resonance");
    const optimizer::CandidateModel& model = candidate_.model;
    const double glued = model.glued_frequencies(results_.scene.loading.mode - 1);
    candidate_.unworn = paths::resonance({model.condensed, {}, steady_}, glued);
    if (candidate_.unworn->status != Status::converged) {
      fail("The unworn resonance was not found: " + std::string(to_string(candidate_.unworn->status)) + ".");
      return false;
    }
    results_.resonance_hz = candidate_.unworn->omega / kTurn;
    results_.resonance_m = candidate_.unworn->amplitude;
    results_.glued_hz = glued / kTurn;
    results_.glued_m = glued_amplitude(glued);
    return true;
  }

  [[nodiscard]] double glued_amplitude(double omega) const {
    const dynamics::CondensedModel& model = *candidate_.model.condensed;
    const dynamics::CondensedHarmonic at = model.harmonic(1, omega);
    if (at.status != Status::converged) return kUnknown;
    return std::abs(model.outputs(at, Eigen::VectorXcd::Zero(model.contact_size()))(0));
  }

  void asymptote() {
    say("asymptote");
    candidate_.asymptote = wear::asymptote({candidate_.model.condensed, {}, steady_}, candidate_.unworn->omega,
                                           {.arbitration = wear::Arbitration::unsettled}, &candidate_.unworn->state);
    const wear::Asymptote& found = *candidate_.asymptote;
    if (found.verdict != wear::Verdict::asymptote)
      fail("No worn state at rest was found: " + std::string(wear::to_string(found.verdict)) + ".");
    results_.asymptote_volume_m3 = found.worn_volume;
    results_.certificate = found.certificate;
  }

  void record() {
    say("frequencies over nodal diameters");
    results_.design = report::make_design_record(results_.scene, candidate_,
                                                 {.curve_points = 0,
                                                  .nodal_diameter_modes = options_.nodal_diameter_modes,
                                                  .history_steps = 0,
                                                  .fields = false});
  }

  void history() {
    say("history");
    const double depth = candidate_.asymptote->largest_depth;
    if (!(depth > 0)) {
      fail("Nothing wears, so there is no history.");
      return;
    }
    wear::HistoryOptions options;
    options.increment = depth / options_.history_steps;
    options.steps = 5 * options_.history_steps;
    const wear::History found =
        wear::history({candidate_.model.condensed, {}, steady_}, {.omega = candidate_.unworn->omega}, options);
    if (found.status != Status::converged)
      fail("The history ended early: " + std::string(to_string(found.status)) + ".");
    History& out = results_.history;
    out.end = std::string(wear::to_string(found.end));
    out.cycles = list(found.cycles);
    out.volume_m3 = list(found.worn_volume);
    out.amplitude_m = list(found.amplitude);
    out.solves = found.solves;
    out.jacobians = found.jacobians;
    for (Eigen::Index s = 0; s < found.depth.rows(); ++s) {
      out.depth_m.push_back(list(Eigen::VectorXd(found.depth.row(s).transpose())));
      out.rate_m_per_cycle.push_back(list(Eigen::VectorXd(found.rate.row(s).transpose())));
    }
    if (found.rate.rows() > 0)
      results_.resonance_wear_ratio = found.rate.row(found.rate.rows() - 1).maxCoeff() / found.rate.row(0).maxCoeff();
  }

  /// States by equal shares of the final volume: cycles between them grow by orders of magnitude.
  [[nodiscard]] std::vector<WornState> chosen_states() const {
    std::vector<WornState> states{{.cycles = 0, .depth_m = Numbers(results_.design.contact.flank.size(), 0.0)}};
    const History& history = results_.history;
    for (int k = 1; k + 1 < options_.curve_states && history.cycles.size() > 1; ++k) {
      const double volume = history.volume_m3.back() * k / (options_.curve_states - 1);
      const auto at = static_cast<std::size_t>(
          std::lower_bound(history.volume_m3.begin(), history.volume_m3.end(), volume) - history.volume_m3.begin());
      if (history.cycles[at] > states.back().cycles)
        states.push_back({.cycles = history.cycles[at], .depth_m = history.depth_m[at]});
    }
    if (candidate_.asymptote->verdict == wear::Verdict::asymptote)
      states.push_back(
          {.cycles = std::numeric_limits<double>::infinity(), .depth_m = list(candidate_.asymptote->depth)});
    return states;
  }

  void curves() {
    say("response curves");
    Numbers omega;
    for (int i = 0; i < options_.curve_points; ++i) {
      const double t = 2.0 * i / (options_.curve_points - 1) - 1;
      omega.push_back(candidate_.unworn->omega * (1 + options_.range * (0.3 * t + 0.7 * t * t * t)));
    }
    for (const double w : omega) {
      results_.frequency_hz.push_back(w / kTurn);
      results_.glued_amplitude_m.push_back(glued_amplitude(w));
    }
    for (WornState& state : chosen_states()) {
      response_of(omega, state);
      results_.states.push_back(std::move(state));
    }
  }

  void response_of(const Numbers& omega, WornState& state) {
    const steady::Joint worn = steady::Joint{candidate_.model.condensed, {}, steady_}.worn(
        Eigen::Map<const Eigen::VectorXd>(state.depth_m.data(), static_cast<Eigen::Index>(state.depth_m.size())));
    int failed = 0;
    for (const steady::State& found : paths::frequency_response(worn, omega)) {
      const bool good = found.status == Status::converged;
      if (!good) ++failed;
      state.curve.amplitude_m.push_back(good ? found.amplitudes(0) : kUnknown);
      state.curve.power_w.push_back(good ? found.friction_energy * found.omega / kTurn : kUnknown);
    }
    if (failed > 0) fail(fmt::format("{} of {} points of a response curve did not converge.", failed, omega.size()));
    const wear::Drift drift = wear::resonance_drift(worn, *candidate_.unworn, {});
    state.peak_found = drift.worn.status == Status::converged;
    state.peak_hz = drift.worn.omega / kTurn;
    state.peak_m = drift.worn.amplitude;
    if (!state.peak_found) fail("A worn resonance was not found: " + std::string(to_string(drift.worn.status)) + ".");
    const steady::State held = paths::steady_state(worn, candidate_.unworn->omega);
    state.amplitude_m = held.status == Status::converged ? held.amplitudes(0) : kUnknown;
  }

  /// The same joint with a left flank a degree flatter: what becomes of the symmetry of the flanks.
  void unequal_flanks() {
    say("flanks of unequal angles");
    constexpr double kDegrees = 1;
    optimizer::Scene scene = results_.scene;
    optimizer::set_parameter(scene, "geometry.left.flank_angle_deg",
                             optimizer::parameter(scene, "geometry.left.flank_angle_deg") + kDegrees);
    optimizer::CandidateModel model = optimizer::ModelBuilder(scene).build(scene);
    if (model.converged()) optimizer::fit_contact(scene, {}, model);
    if (!model.converged()) return;
    const double glued = model.glued_frequencies(scene.loading.mode - 1);
    const paths::Resonance unworn = paths::resonance({model.condensed, {}, steady_}, glued);
    if (unworn.status != Status::converged) return;
    const wear::Asymptote found = wear::asymptote({model.condensed, {}, steady_}, unworn.omega,
                                                  {.arbitration = wear::Arbitration::unsettled}, &unworn.state);
    if (found.verdict != wear::Verdict::asymptote) return;
    results_.unequal_flanks_degrees = kDegrees;
    results_.unequal_flanks_volume_m3.assign(2, 0.0);
    const fem::ContactCells& surface = model.cells;
    for (Eigen::Index i = 0; i < surface.count(); ++i)
      results_.unequal_flanks_volume_m3[surface.flank(i) == 0 ? 0 : 1] += surface.area(i) * found.depth(i);
  }

  ComputeOptions options_;
  steady::Options steady_;
  optimizer::CandidateResult candidate_;
  Results results_;
};

}  // namespace

Numbers of_flank(const report::ContactRecord& contact, const Numbers& values, std::int64_t flank) {
  Numbers chosen;
  for (std::size_t i = 0; i < std::min(values.size(), contact.flank.size()); ++i)
    if (contact.flank[i] == flank) chosen.push_back(values[i]);
  return chosen;
}

Results compute(const optimizer::Scene& scene, const ComputeOptions& options) {
  return Study(scene, options).run();
}

}  // namespace dovetail::paper_sequence
