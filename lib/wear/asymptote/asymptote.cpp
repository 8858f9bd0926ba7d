#include "wear/asymptote/asymptote.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

#include "wear/asymptote/signs_of_doubt.hpp"
#include "wear/history/history.hpp"
#include "wear/measures.hpp"
#include "wear/release/passes.hpp"
#include "wear/wearing_joint.hpp"

namespace dovetail::wear {

namespace {

using Eigen::Index;
using Eigen::VectorXd;

void set_depth(const reduction::ContactNodes& contact, const VectorXd& depth, Asymptote& result) {
  result.depth = depth;
  result.worn_volume = worn_volume(contact, depth);
  result.largest_depth = largest(depth);
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

Rates rates(const dynamics::CondensedModel& model, const AsymptoteOptions& options, const steady::State& unworn) {
  Rates found{.fastest = options.reference_rate, .none = no_wear_rate(options.rate_threshold, model, unworn)};
  if (!(found.fastest > 0.0)) found.fastest = largest(unworn.wear_rate);
  return found;
}

/// The direct answer, what is in doubt about it, and who settles that.
class WornStateSearch {
 public:
  WornStateSearch(const steady::Joint& joint, double omega, const AsymptoteOptions& options, const Watcher& watcher)
      : joint_(joint),
        model_(*joint.model),
        options_(options),
        watcher_(watcher),
        omega_(omega),
        wearing_(joint, omega, watcher),
        passes_(joint.model->nodes()) {}

  [[nodiscard]] Asymptote run(const steady::State* unworn) {
    if (begin(unworn) && release()) {
      const bool asked = options_.arbitration == Arbitration::always;
      if ((asked || options_.arbitration == Arbitration::automatic) && settled_ && passes_.count > 0 &&
          (doubt() == Doubt::none || asked))
        look_further();
      if (doubt() == Doubt::none && asked) result_.doubt = Doubt::always;
      if (history_decides()) arbitrate();
    }
    refuse_gross_sliding();
    result_.released = std::move(passes_.released);
    result_.trail = std::move(passes_.trail);
    result_.passes = passes_.count;
    result_.solves = wearing_.solves();
    result_.jacobians = wearing_.jacobians();
    return std::move(result_);
  }

 private:
  [[nodiscard]] Doubt doubt() const { return result_.doubt; }
  [[nodiscard]] const reduction::ContactNodes& contact() const { return model_.contact(); }
  [[nodiscard]] bool rests() const { return result_.verdict == Verdict::asymptote; }

  /// The unworn state; false where there is none.
  [[nodiscard]] bool begin(const steady::State* unworn) {
    result_.certificate = std::numeric_limits<double>::quiet_NaN();
    set_depth(contact(), wearing_.start(), result_);
    result_.rate = VectorXd::Zero(model_.nodes());
    passes_.state = unworn != nullptr ? *unworn : wearing_.worn(wearing_.start(), {});
    result_.unworn = passes_.state;
    result_.status = passes_.state.status;
    if (result_.status != Status::converged) return false;
    result_.unworn_rate = passes_.state.wear_rate;
    rates_ = rates(model_, options_, result_.unworn);
    threshold_ = std::max(rates_.none, options_.relative_threshold * rates_.fastest);
    return true;
  }

  /// The direct answer and what its own passes leave in doubt; false where it was cut short.
  [[nodiscard]] bool release() {
    const Ending ending = release_slipping(wearing_, threshold_, options_.passes, watcher_, passes_);
    result_.status = passes_.status;
    result_.steady = passes_.state;
    result_.rate = passes_.state.wear_rate;
    if (cut_short(passes_.status)) return false;
    if (ending == Ending::failed) {
      result_.doubt = Doubt::pass_failed;
    } else if (ending == Ending::nothing_holds) {
      result_.doubt = Doubt::nothing_holds;
      result_.rate = result_.unworn_rate;
      result_.verdict = Verdict::no_asymptote;
      result_.status = Status::converged;
    } else {
      settled_ = true;
      result_.verdict = Verdict::asymptote;
      set_depth(contact(), wearing_.depth(passes_.released, passes_.state), result_);
      if (options_.certify) certify();
      result_.doubt = doubt_of_passes();
    }
    return true;
  }

  [[nodiscard]] Doubt doubt_of_passes() const {
    if (!rests()) return Doubt::certificate;
    if (rests_in_slip(model_) && result_.largest_depth > 0.0) return Doubt::threshold;
    if (bears().doubtful()) return Doubt::gross_sliding;
    if (reloads(passes_.deepest, result_.depth, options_.state_tolerance)) return Doubt::reload;
    if (lifts_off(passes_, result_.depth, options_.state_tolerance)) return Doubt::lift_off;
    return Doubt::none;
  }

  /// Solves once more with the worn gap and contact everywhere.
  void certify() {
    const steady::State worn = wearing_.worn(result_.depth, result_.steady.displacement);
    if (worn.status != Status::converged) {
      result_.verdict = Verdict::not_converged;
      result_.status = worn.status;
      return;
    }
    result_.rate = worn.wear_rate;
    result_.steady = worn;
    result_.certificate = rates_.certificate(worn.wear_rate.maxCoeff());
    if (!(result_.certificate <= rates_.limit(options_.certificate_limit))) {
      result_.verdict = Verdict::not_converged;
      result_.status = Status::stalled;
    }
  }

  /// The other order of release, and nodes that hardly stick.
  void look_further() {
    WearingJoint looking(closer(), omega_, watcher_);
    look_with(looking);
    wearing_.count(looking.solves(), looking.jacobians());
  }

  void look_with(WearingJoint& looking) {
    const SlowRelease slow = release_slowly(looking, result_.unworn, threshold_, options_.passes);
    const bool elsewhere = !same_depth(slow.depth, result_.depth, options_.state_tolerance);
    if (slow.settled && elsewhere)
      result_.other_states.push_back(other_state(FoundBy::worst_first, contact(), slow.depth));
    if (doubt() != Doubt::none) return;
    if (!slow.settled || elsewhere || reloads(slow.deepest, slow.depth, options_.state_tolerance))
      result_.doubt = Doubt::worst_first;
    else if (slips_on_the_way(looking, result_.unworn, result_.depth, passes_.released))
      result_.doubt = Doubt::on_the_way;
    else if (near_slip(model_, result_.steady, passes_.released))
      result_.doubt = Doubt::near_slip;
  }

  /// The joint on the budget of the closer look and of the history.
  [[nodiscard]] const steady::Joint& closer() {
    if (!closer_) {
      closer_ = joint_;
      if (options_.history_budget) closer_->options.budget = options_.history_budget(closer_->options);
    }
    return *closer_;
  }

  [[nodiscard]] bool history_decides() const {
    if (doubt() == Doubt::none || options_.arbitration == Arbitration::never) return false;
    return options_.arbitration != Arbitration::unsettled || !entry(doubt()).direct_stands;
  }

  /// The implicit history has the last word. Where it cannot be followed to its end a settled direct answer stands,
  /// unconfirmed; any other becomes not_converged.
  void arbitrate() {
    HistoryOptions options = HistoryOptions::implicit();
    options.tolerance = options_.history_tolerance;
    options.rate_fraction = options_.relative_threshold;
    options.rate_threshold = rates_.none;
    const History past =
        history(closer(), {.omega = result_.unworn.omega, .unworn = &result_.unworn}, options, watcher_);
    wearing_.count(past.solves, past.jacobians);
    const bool certified = settled_ && rests();
    if (past.end != HistoryEnd::worn_out && past.end != HistoryEnd::steady_rate) return keep_direct(past, certified);
    result_.confirmed_by_history = true;
    result_.status = Status::converged;
    const VectorXd& depth = past.final_depth;
    if (past.end == HistoryEnd::worn_out && certified && same_depth(depth, result_.depth, options_.state_tolerance))
      return;
    std::erase_if(result_.other_states,
                  [&](const OtherState& state) { return same_depth(state.depth, depth, options_.state_tolerance); });
    if (certified)
      result_.other_states.insert(result_.other_states.begin(),
                                  other_state(FoundBy::release, contact(), result_.depth));
    set_depth(contact(), depth, result_);
    result_.decided_by = FoundBy::history;
    result_.rate = past.final_rate;
    result_.steady = past.steady;
    if (past.end == HistoryEnd::steady_rate) {
      result_.verdict = Verdict::no_asymptote;
    } else {
      result_.certificate = rates_.certificate(past.final_rate.maxCoeff());
      result_.verdict = Verdict::asymptote;
    }
    for (std::size_t i = 0; i < passes_.released.size(); ++i)
      passes_.released[i] = depth[static_cast<Index>(i)] > wearing_.start()[static_cast<Index>(i)] &&
                            !result_.steady.nodes[i].carries_load;
  }

  /// What is left where the history came to no end.
  void keep_direct(const History& past, bool certified) {
    const Status status = past.end == HistoryEnd::steps ? Status::iteration_limit : past.status;
    result_.history = status;
    if (past.end == HistoryEnd::interrupted || !certified) {
      result_.verdict = Verdict::not_converged;
      if (result_.status == Status::converged || cut_short(status)) result_.status = status;
    }
    // However it went on: it has worn more than any state of the joint has.
    if (!rests() && past.end != HistoryEnd::interrupted && past.cycles.size() > 0 &&
        bearing(model_, result_.unworn, result_.unworn, past.final_depth).impossible())
      result_.status = Status::gross_sliding;
  }

  [[nodiscard]] Bearing bears() const { return bearing(model_, result_.unworn, result_.steady, result_.depth); }

  /// A state that hardly anything bears is an answer only when the history comes to it.
  void refuse_gross_sliding() {
    if (!rests()) return;
    result_.bearing = bears();
    if (!result_.bearing.impossible() && (result_.confirmed_by_history || !result_.bearing.doubtful())) return;
    result_.verdict = Verdict::not_converged;
    result_.status = Status::gross_sliding;
  }

  const steady::Joint& joint_;
  const dynamics::CondensedModel& model_;
  const AsymptoteOptions& options_;
  const Watcher& watcher_;
  double omega_;
  std::optional<steady::Joint> closer_;
  WearingJoint wearing_;
  Passes passes_;
  Rates rates_;
  double threshold_ = 0.0;  // wear per cycle below which a node sticks, m
  bool settled_ = false;    // release came to an end: the result has its depth
  Asymptote result_;
};

}  // namespace

OtherState other_state(FoundBy found_by, const reduction::ContactNodes& contact, const VectorXd& depth) {
  return {.found_by = found_by,
          .depth = depth,
          .worn_volume = worn_volume(contact, depth),
          .largest_depth = largest(depth)};
}

Asymptote asymptote(const steady::Joint& joint, double omega, const AsymptoteOptions& options,
                    const steady::State* unworn, const Watcher& watcher) {
  if (std::vector<Violation> wrong = violations(options, "asymptote"); !wrong.empty())
    throw InputError(std::move(wrong));
  require_nothing_released(joint.condition);

  Asymptote found = WornStateSearch(joint, omega, options, watcher).run(unworn);
  if (options.certify_finer && found.verdict == Verdict::asymptote && !watcher.stopped())
    certify_finer(joint, options, found);
  return found;
}

void certify_finer(const steady::Joint& joint, const AsymptoteOptions& options, Asymptote& answer) {
  const Rates reference = rates(*joint.model, options, answer.unworn);
  Certificate& finer = answer.finer;
  finer = certificate(joint.worn(answer.depth).with(finer_settings(joint.options)), reference.fastest, answer.steady);
  ++answer.solves;
  answer.jacobians += finer.jacobians;
  if (!(reference.fastest > reference.none))
    finer.remaining = reference.certificate(finer.remaining * reference.fastest);
  answer.holds_finer =
      finer.status == Status::converged && finer.remaining <= reference.limit(options.certificate_limit);
  // Whatever else was in doubt has been settled when the history has decided.
  if (!answer.holds_finer && (answer.doubt == Doubt::none || answer.confirmed_by_history))
    answer.doubt = Doubt::finer_settings;
}

}  // namespace dovetail::wear
