#include "wear/mission/mission.hpp"

#include <algorithm>
#include <utility>

#include "wear/asymptote/rest.hpp"
#include "wear/asymptote/worn_zones.hpp"
#include "wear/measures.hpp"
#include "wear/no_wear.hpp"
#include "wear/release/friction_reserve.hpp"
#include "wear/release/passes.hpp"
#include "wear/wearing_joint.hpp"

namespace dovetail::wear {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

bool same(const VectorXd& a, const VectorXd& b, double tolerance) {
  return (a - b).cwiseAbs().maxCoeff() <= tolerance * std::max(largest(a), largest(b));
}

/// All loads on the same flanks.
class MissionSearch {
 public:
  MissionSearch(std::span<const MissionLoad> loads, const MissionOptions& options, const Watcher& watcher)
      : loads_(loads), options_(options), watcher_(watcher) {
    for (const MissionLoad& load : loads_) joints_.emplace_back(load.joint, load.omega, watcher_);
  }

  [[nodiscard]] Mission run() {
    if (begin() && answered() && (options_.turns || result_.verdict != Verdict::asymptote)) look_at_the_order();
    refuse_gross_sliding();
    for (const WearingJoint& joint : joints_) result_.solves += joint.solves();
    return std::move(result_);
  }

 private:
  [[nodiscard]] const reduction::ContactNodes& contact() const { return joints_.front().model().contact(); }

  [[nodiscard]] bool ended(std::size_t load, Status status, Verdict verdict = Verdict::not_converged) {
    result_.failed = load;
    result_.status = status;
    result_.verdict = verdict;
    return false;
  }

  /// Directly, or that is left to the loads in turn; false where the search has failed.
  [[nodiscard]] bool answered() {
    for (std::size_t k = 0; k < joints_.size(); ++k)
      if (rests_in_slip(joints_[k].model()) && fastest_[k] > thresholds_[k]) return !ended(k, Status::stalled);
    if (!release()) return false;
    if (!options_.asymptote.certify) return rests();
    return certify() || result_.status == Status::stalled;
  }

  [[nodiscard]] bool rests() {
    result_.verdict = Verdict::asymptote;
    return true;
  }

  /// Every load on the flanks as they are.
  [[nodiscard]] bool begin() {
    const Index nodes = loads_.front().joint.model->nodes();
    result_.released.assign(static_cast<std::size_t>(nodes), false);
    result_.depth = VectorXd::Zero(nodes);
    for (std::size_t k = 0; k < joints_.size(); ++k) {
      start_ = k == 0 ? joints_[k].start() : VectorXd(start_.cwiseMax(joints_[k].start()));
      steady::State state = loads_[k].unworn != nullptr ? *loads_[k].unworn : joints_[k].worn(joints_[k].start(), {});
      if (state.status != Status::converged) return ended(k, state.status);
      const double none = no_wear_rate(options_.asymptote.rate_threshold, joints_[k].model(), state);
      fastest_.push_back(largest(state.wear_rate));
      thresholds_.push_back(std::max(none, options_.asymptote.relative_threshold * fastest_.back()));
      unworn_.push_back(state);
      result_.states.push_back(std::move(state));
    }
    result_.trails.assign(joints_.size(), {});
    for (ReleaseTrail& trail : result_.trails) trail.released_in.assign(result_.released.size(), -1);
    return true;
  }

  [[nodiscard]] bool release() {
    for (int pass = 0;; ++pass) {
      std::vector<bool> next = result_.released;
      bool slipping = false;
      std::vector<std::vector<bool>> slips;
      for (std::size_t k = 0; k < joints_.size(); ++k) {
        slips.push_back(wear_off(result_.states[k], result_.released, thresholds_[k]));
        for (std::size_t i = 0; i < next.size(); ++i)
          if (slips[k][i]) next[i] = slipping = true;
      }
      if (!slipping) break;
      if (pass >= options_.asymptote.passes) return ended(0, Status::iteration_limit);
      remember(pass, slips, next);
      for (std::size_t k = 0; k < joints_.size(); ++k) {
        bool held = false;
        for (std::size_t i = 0; i < next.size(); ++i)
          held = held || (!next[i] && result_.states[k].nodes[i].carries_load);
        steady::State state = joints_[k].released(next, result_.states[k].displacement, !held);
        if (state.status != Status::converged)
          return held || cut_short(state.status) ? ended(k, state.status)
                                                 : ended(k, Status::converged, Verdict::no_asymptote);
        result_.states[k] = std::move(state);
      }
      result_.released = std::move(next);
    }
    VectorXd depth = start_;
    for (std::size_t k = 0; k < joints_.size(); ++k)
      depth = depth.cwiseMax(joints_[k].depth(result_.released, result_.states[k]));
    set_depth(depth);
    return true;
  }

  /// What a pass sees, for the ends of worn zones.
  void remember(int pass, const std::vector<std::vector<bool>>& slips, const std::vector<bool>& next) {
    for (std::size_t k = 0; k < joints_.size(); ++k) {
      ReleaseTrail& trail = result_.trails[k];
      trail.reserves.push_back(friction_reserve(joints_[k].model(), result_.states[k], slips[k]));
      for (std::size_t i = 0; i < next.size(); ++i)
        if (next[i] && !result_.released[i]) trail.released_in[i] = pass;
    }
  }

  void set_depth(const VectorXd& depth) {
    result_.depth = depth;
    result_.worn_volume = worn_volume(contact(), depth);
    result_.largest_depth = largest(depth);
    result_.least_volume = result_.largest_volume = result_.worn_volume;
  }

  /// Every load once more, with contact everywhere: it wears no further.
  [[nodiscard]] bool certify() {
    for (std::size_t k = 0; k < joints_.size(); ++k) {
      steady::State state = joints_[k].worn(result_.depth, result_.states[k].displacement);
      if (state.status != Status::converged) return ended(k, state.status);
      const double allowed = std::max(thresholds_[k], options_.asymptote.certificate_limit * fastest_[k]);
      if (largest(state.wear_rate) > allowed) return ended(k, Status::stalled);
      result_.states[k] = std::move(state);
    }
    return rests();
  }

  /// A state that hardly anything bears.
  void refuse_gross_sliding() {
    if (result_.verdict != Verdict::asymptote) return;
    const bool confirmed = result_.took_turns && !result_.order_matters;
    for (std::size_t k = 0; k < joints_.size(); ++k) {
      const Bearing here = bearing(joints_[k].model(), unworn_[k], result_.states[k], result_.depth);
      if (k == 0 || here.share < result_.bearing.share) result_.bearing = here;
      if (!here.impossible() && (confirmed || !here.doubtful())) continue;
      static_cast<void>(ended(k, Status::gross_sliding));
      return;
    }
  }

  /// Each load in turn, until it has come to rest, where in doubt by its history.
  [[nodiscard]] std::optional<VectorXd> in_turn(bool reversed) {
    RestOptions alone{.asymptote = options_.asymptote, .history = options_.turns, .lines = options_.lines};
    alone.asymptote.certify_finer = false;
    VectorXd depth = start_;
    for (int round = 0; round < options_.rounds; ++round) {
      const VectorXd before = depth;
      for (std::size_t i = 0; i < loads_.size(); ++i) {
        const MissionLoad& load = loads_[reversed ? loads_.size() - 1 - i : i];
        const Asymptote rest = comes_to_rest(load.joint.worn(depth), load.omega, alone, nullptr, watcher_).asymptote;
        result_.solves += rest.solves;
        if (rest.verdict != Verdict::asymptote) return {};
        depth = rest.depth;
      }
      if (same(before, depth, options_.unchanged)) return depth;
    }
    return {};
  }

  /// Where what all loads release together does not rest - pressures shift, and nodes touch that were free - the flanks
  /// are those that the loads leave in turn.
  void look_at_the_order() {
    for (const bool reversed : {false, true}) {
      const std::optional<VectorXd> depth = in_turn(reversed);
      if (!depth) continue;
      result_.took_turns = true;
      if (result_.verdict != Verdict::asymptote) {
        set_depth(*depth);
        if (!certify()) return;
        result_.failed.reset();
        result_.status = Status::converged;
      }
      const double volume = worn_volume(contact(), *depth);
      result_.least_volume = std::min(result_.least_volume, volume);
      result_.largest_volume = std::max(result_.largest_volume, volume);
      if (!same(*depth, result_.depth, options_.state_tolerance) &&
          !a_node_apart(options_.lines, contact().area, *depth, result_.depth))
        result_.order_matters = true;
    }
  }

  std::span<const MissionLoad> loads_;
  const MissionOptions& options_;
  const Watcher& watcher_;
  std::vector<WearingJoint> joints_;
  std::vector<double> fastest_, thresholds_;  // of each load, m per cycle
  std::vector<steady::State> unworn_;
  VectorXd start_;
  Mission result_;
};

/// Loads that wear nothing, whatever they do to the flanks, are put in their places on those that the others leave.
void add_without_wear(std::span<const MissionLoad> loads, const std::vector<std::size_t>& wearing,
                      const Watcher& watcher, Mission& result) {
  if (result.failed) result.failed = wearing[*result.failed];
  if (result.verdict != Verdict::asymptote) return;
  std::vector<steady::State> states;
  auto next = wearing.begin();
  for (std::size_t k = 0; k < loads.size(); ++k) {
    if (next != wearing.end() && *next == k) {
      states.push_back(std::move(result.states[static_cast<std::size_t>(next++ - wearing.begin())]));
      continue;
    }
    WearingJoint joint(loads[k].joint, loads[k].omega, watcher);
    const MatrixXd start = loads[k].unworn != nullptr ? loads[k].unworn->displacement : MatrixXd();
    states.push_back(joint.worn(result.depth, start));
    result.solves += joint.solves();
    if (states.back().status == Status::converged) continue;
    result.failed = k;
    result.status = states.back().status;
    result.verdict = Verdict::not_converged;
    return;
  }
  result.states = std::move(states);
}

}  // namespace

Mission mission(std::span<const MissionLoad> loads, const MissionOptions& options, const Watcher& watcher) {
  if (std::vector<Violation> wrong = violations(options.asymptote, "asymptote"); !wrong.empty())
    throw InputError(std::move(wrong));
  std::vector<std::size_t> wearing;
  std::vector<MissionLoad> those;
  for (std::size_t k = 0; k < loads.size(); ++k)
    if (loads[k].joint.model->contact().wear_coefficient.maxCoeff() > 0) {
      wearing.push_back(k);
      those.push_back(loads[k]);
    }
  if (those.empty() || those.size() == loads.size()) return MissionSearch(loads, options, watcher).run();
  Mission result = MissionSearch(those, options, watcher).run();
  add_without_wear(loads, wearing, watcher, result);
  return result;
}

MissionHistory mission_history(std::span<const MissionLoad> loads, const MissionHistoryOptions& options,
                               const Watcher& watcher) {
  MissionHistory result;
  std::vector<WearingJoint> joints;
  double shares = 0;
  for (const MissionLoad& load : loads) {
    joints.emplace_back(load.joint, load.omega, watcher);
    shares += load.share;
  }
  std::vector<Eigen::MatrixXd> last(loads.size());
  VectorXd depth = VectorXd::Zero(loads.front().joint.model->nodes());
  for (const WearingJoint& joint : joints) depth = depth.cwiseMax(joint.start());
  double first = 0;
  for (; result.steps < options.steps && !watcher.stopped(); ++result.steps) {
    VectorXd rate = VectorXd::Zero(depth.size());
    for (std::size_t k = 0; k < loads.size(); ++k) {
      const steady::State state = joints[k].worn(depth, last[k]);
      result.status = state.status;
      if (state.status != Status::converged) return result;
      last[k] = state.displacement;
      rate += loads[k].share / shares * state.wear_rate;
    }
    first = std::max(first, largest(rate));
    result.at_rest = largest(rate) <= options.rate_fraction * first;
    if (result.at_rest) break;
    depth += cycle_jump(rate, options.increment) * rate;
  }
  result.depth = depth;
  result.worn_volume = worn_volume(joints.front().model().contact(), depth);
  return result;
}

}  // namespace dovetail::wear
