#include "wear/asymptote.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "wear/certificate.hpp"
#include "wear/gross_sliding.hpp"
#include "wear/implicit_history.hpp"
#include "wear/measures.hpp"
#include "wear/passes.hpp"
#include "wear/start.hpp"

namespace dovetail::wear {

namespace {

using Eigen::Index;
using Eigen::VectorXd;

void set_depth(const reduction::ContactNodes& contact, const VectorXd& depth, Asymptote& result) {
  result.depth = depth;
  result.worn_volume = worn_volume(contact, depth);
  result.largest_depth = depth.size() == 0 ? 0.0 : depth.maxCoeff();
}

/// What is known when the passes of release are over.
struct Direct {
  bool settled = false;  ///< `result` holds its depth
  std::string doubt;     ///< why it may not be where wear ends
};

/// A node that an earlier pass wore deeper than the last one needs lost contact on the way; a history may have worn it
/// before the load came back to others, and ends deeper.
bool reloads(const VectorXd& deepest, const VectorXd& depth, double tolerance) {
  return deepest.size() > 0 && (deepest - depth).maxCoeff() > tolerance * depth.maxCoeff();
}

/// A node that touches at times only may wear to where it touches without slip, well before it touches nothing.
bool lifts_off(const Passes& passes, const VectorXd& depth, double tolerance) {
  const double least = tolerance * depth.maxCoeff();
  for (std::size_t i = 0; i < passes.touching.size(); ++i)
    if (passes.touching[i] && depth[static_cast<Index>(i)] > least) return true;
  return false;
}

/// What rates are held against, m per cycle.
struct Rates {
  double fastest = 0.0;  ///< unworn
  double none = 0.0;     ///< counts as no wear

  /// Relative to the unworn rate; where that is none itself, to what counts as none.
  [[nodiscard]] double certificate(double rate) const {
    if (fastest > none) return rate / fastest;
    return rate <= none ? 0.0 : rate / none;
  }
  [[nodiscard]] double limit(double certificate_limit) const {
    return fastest > none ? std::max(certificate_limit, none / fastest) : 1.0;
  }
};

/// Solves once more with the worn gap and contact everywhere.
void certify(Release& release, const Rates& rates, const AsymptoteOptions& options, Asymptote& result) {
  const steady::State worn = release.solve_worn(result.depth, result.steady.displacement);
  if (worn.status != Status::converged) {
    result.verdict = Verdict::not_converged;
    result.status = worn.status;
    return;
  }
  result.rate = worn.wear_rate;
  result.steady = worn;
  result.certificate = rates.certificate(worn.wear_rate.maxCoeff());
  if (!(result.certificate <= rates.limit(options.certificate_limit))) {
    result.verdict = Verdict::not_converged;
    result.status = Status::stalled;
  }
}

/// A node that sticks with little to spare may slip while its neighbours wear, and the history wears it, too.
bool near_slip(const dynamics::CondensedModel& model, const steady::State& state, const std::vector<bool>& released) {
  // Half-plane punches whose histories took one node more ended with 0.015 to 0.03, others with 0.04 and above.
  constexpr double kMargin = 0.05;
  for (std::size_t i = 0; i < released.size(); ++i) {
    const auto node = static_cast<Index>(i);
    if (!released[i] && state.nodes[i].carries_load &&
        friction_margin(state, node, model.contact().friction[node]) < kMargin)
      return true;
  }
  return false;
}

Bearing bearing_of(const dynamics::CondensedModel& model, const Asymptote& result) {
  return bearing(model, result.unworn, result.steady, result.depth);
}

/// A state that hardly anything bears is an answer only when the history comes to it.
void refuse_gross_sliding(const dynamics::CondensedModel& model, Asymptote& result) {
  if (result.verdict != Verdict::asymptote) return;
  result.bearing = bearing_of(model, result);
  if (!result.bearing.impossible() && (result.confirmed_by_history || !result.bearing.doubtful())) return;
  result.verdict = Verdict::not_converged;
  result.status = Status::gross_sliding;
}

/// Whether the answer rests at finer settings, too.
void certify_finer(const steady::Joint& joint, const Rates& rates, const AsymptoteOptions& options, Release& release,
                   Asymptote& result) {
  if (result.verdict != Verdict::asymptote || !options.certify_finer || release.stopped()) return;
  result.finer =
      certificate(joint.worn(result.depth).with(finer_settings(joint.options)), rates.fastest, result.steady);
  release.count(1, result.finer.jacobians);
  if (!(rates.fastest > rates.none)) result.finer.remaining = rates.certificate(result.finer.remaining * rates.fastest);
  result.holds_finer =
      result.finer.status == Status::converged && result.finer.remaining <= rates.limit(options.certificate_limit);
  // Whatever else was in doubt has been settled when the history has decided.
  if (!result.holds_finer && (result.doubt.empty() || result.confirmed_by_history)) result.doubt = "finer_settings";
}

OtherState other_state(std::string found_by, const reduction::ContactNodes& contact, const VectorXd& depth) {
  return {.found_by = std::move(found_by),
          .depth = depth,
          .worn_volume = worn_volume(contact, depth),
          .largest_depth = depth.size() == 0 ? 0.0 : depth.maxCoeff()};
}

bool same_depth(const VectorXd& a, const VectorXd& b, double tolerance) {
  if (a.size() == 0) return true;
  return (a - b).cwiseAbs().maxCoeff() <= tolerance * std::max(a.maxCoeff(), b.maxCoeff());
}

/// The implicit history has the last word. Where it cannot be followed to its end a settled direct answer stands,
/// unconfirmed; any other becomes not_converged.
void arbitrate(const steady::Joint& joint, Release& release, const Rates& rates, const AsymptoteOptions& options,
               const Direct& direct, const Control& control, Asymptote& result) {
  const reduction::ContactNodes& contact = joint.model->contact();
  const ImplicitHistory past = implicit_history(joint, result.unworn.omega,
                                                {.tolerance = options.history_tolerance,
                                                 .rate_fraction = options.relative_threshold,
                                                 .rate_threshold = rates.none},
                                                &result.unworn, control);
  release.count(past.solves, past.jacobians);
  const Index last = past.cycles.size() - 1;
  const bool certified = direct.settled && result.verdict == Verdict::asymptote;
  if (past.end != HistoryEnd::worn_out && past.end != HistoryEnd::steady_rate) {
    if (past.end == HistoryEnd::interrupted || !certified) {
      result.verdict = Verdict::not_converged;
      if (result.status == Status::converged || cut_short(past.status)) result.status = past.status;
    }
    // However it went on: it has worn more than any state of the joint has.
    if (result.verdict == Verdict::not_converged && past.end != HistoryEnd::interrupted && last >= 0 &&
        bearing(*joint.model, result.unworn, result.unworn, past.depth.row(last).transpose()).impossible())
      result.status = Status::gross_sliding;
    return;
  }
  result.confirmed_by_history = true;
  result.status = Status::converged;
  const VectorXd depth = past.depth.row(last).transpose();
  const VectorXd rate = past.rate.row(last).transpose();
  if (past.end == HistoryEnd::worn_out && certified && same_depth(depth, result.depth, options.state_tolerance)) return;
  std::erase_if(result.other_states,
                [&](const OtherState& state) { return same_depth(state.depth, depth, options.state_tolerance); });
  if (certified) result.other_states.insert(result.other_states.begin(), other_state("release", contact, result.depth));
  set_depth(contact, depth, result);
  result.decided_by = "history";
  result.rate = rate;
  result.steady = past.steady;
  if (past.end == HistoryEnd::steady_rate) {
    result.verdict = Verdict::no_asymptote;
    return;
  }
  result.certificate = rates.certificate(rate.maxCoeff());
  result.verdict = Verdict::asymptote;
}

}  // namespace

std::string_view to_string(Verdict verdict) {
  switch (verdict) {
    case Verdict::asymptote:
      return "asymptote";
    case Verdict::no_asymptote:
      return "no_asymptote";
    case Verdict::not_converged:
      return "not_converged";
  }
  return "unknown";
}

Asymptote asymptote(const steady::Joint& joint, double omega, const AsymptoteOptions& options,
                    const steady::State* unworn, const Control& control) {
  if (std::vector<Violation> wrong = violations(options, "asymptote"); !wrong.empty())
    throw InputError(std::move(wrong));
  require_nothing_released(joint.condition);

  const reduction::ContactNodes& contact = joint.model->contact();
  Release release(joint, omega, control);
  Asymptote result;
  result.certificate = std::numeric_limits<double>::quiet_NaN();
  Passes passes(joint.model->nodes());
  const auto finish = [&] {
    refuse_gross_sliding(*joint.model, result);
    result.released = passes.released;
    result.trail = passes.trail;
    result.passes = passes.count;
    result.solves = release.solves();
    result.jacobians = release.jacobians();
    return std::move(result);
  };

  set_depth(contact, release.start(), result);
  result.rate = VectorXd::Zero(joint.model->nodes());
  passes.state = unworn != nullptr ? *unworn : release.solve(passes.released, {});
  result.unworn = passes.state;
  result.status = passes.state.status;
  if (passes.state.status != Status::converged) return finish();
  result.unworn_rate = passes.state.wear_rate;
  Rates rates{.fastest = options.reference_rate,
              .none = no_wear_rate(options.rate_threshold, *joint.model, result.unworn)};
  if (!(rates.fastest > 0.0) && result.unworn_rate.size() > 0) rates.fastest = result.unworn_rate.maxCoeff();
  const double threshold = std::max(rates.none, options.relative_threshold * rates.fastest);

  const Ending ending = release_slipping(release, threshold, options.passes, control, passes);
  result.status = passes.status;
  result.steady = passes.state;
  result.rate = passes.state.wear_rate;
  if (cut_short(passes.status)) return finish();
  Direct direct;
  if (ending == Ending::failed) {
    direct.doubt = "pass_failed";
  } else if (ending == Ending::nothing_holds) {
    direct.doubt = "nothing_holds";
    result.rate = result.unworn_rate;
    result.verdict = Verdict::no_asymptote;
    result.status = Status::converged;
  } else {
    direct.settled = true;
    result.verdict = Verdict::asymptote;
    set_depth(contact, release.depth(passes.released, passes.state), result);
    if (options.certify) certify(release, rates, options, result);
    const bool slips_at_rest = rests_in_slip(*joint.model) && result.largest_depth > 0.0;
    if (result.verdict != Verdict::asymptote)
      direct.doubt = "certificate";
    else if (slips_at_rest)
      direct.doubt = "threshold";
    else if (bearing_of(*joint.model, result).doubtful())
      direct.doubt = "gross_sliding";
    else if (reloads(passes.deepest, result.depth, options.state_tolerance))
      direct.doubt = "reload";
    else if (lifts_off(passes, result.depth, options.state_tolerance))
      direct.doubt = "lift_off";
  }
  const int solves = release.solves();
  const int jacobians = release.jacobians();
  const auto count_arbitration = [&] {
    result.arbitration_solves = release.solves() - solves;
    result.arbitration_jacobians = release.jacobians() - jacobians;
  };
  const bool asked = options.arbitration == "always";
  const bool looks_further = asked || options.arbitration == "auto";
  if (looks_further && passes.count > 0 && direct.settled && (direct.doubt.empty() || asked)) {
    const SlowRelease slow = release_slowly(release, result.unworn, threshold, options.passes);
    const bool elsewhere = !same_depth(slow.depth, result.depth, options.state_tolerance);
    if (slow.settled && elsewhere) result.other_states.push_back(other_state("worst_first", contact, slow.depth));
    if (direct.doubt.empty() &&
        (!slow.settled || elsewhere || reloads(slow.deepest, slow.depth, options.state_tolerance)))
      direct.doubt = "worst_first";
    else if (direct.doubt.empty() && near_slip(*joint.model, result.steady, passes.released))
      direct.doubt = "near_slip";
  }
  result.doubt = direct.doubt.empty() && asked ? "always" : direct.doubt;
  const bool stands = direct.settled && result.verdict == Verdict::asymptote && direct.doubt != "gross_sliding" &&
                      direct.doubt != "threshold";
  if (result.doubt.empty() || options.arbitration == "never" || (options.arbitration == "unsettled" && stands)) {
    count_arbitration();
    certify_finer(joint, rates, options, release, result);
    return finish();
  }
  arbitrate(joint, release, rates, options, direct, control, result);
  if (result.decided_by == "history")
    for (std::size_t i = 0; i < passes.released.size(); ++i)
      passes.released[i] = result.depth[static_cast<Index>(i)] > release.start()[static_cast<Index>(i)] &&
                           !result.steady.nodes[i].carries_load;
  count_arbitration();
  certify_finer(joint, rates, options, release, result);
  return finish();
}

}  // namespace dovetail::wear
