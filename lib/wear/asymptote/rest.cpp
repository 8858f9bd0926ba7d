#include "wear/asymptote/rest.hpp"

#include <cmath>
#include <utility>

#include "paths/steady_state.hpp"
#include "wear/asymptote/followed_asymptote.hpp"
#include "wear/asymptote/worn_zones.hpp"
#include "wear/measures.hpp"

namespace dovetail::wear {

namespace {

/// Where history and direct method end, and where a finer history does if they are far apart.
struct Ends {
  bool direct_stays = false;
  std::optional<OtherState> finer = {};
  Unfinished unfinished = Unfinished::none;
};

class Rule {
 public:
  Rule(const steady::Joint& joint, double omega, const RestOptions& options, const Watcher& watcher)
      : joint_(joint), omega_(omega), options_(options), watcher_(watcher) {}

  [[nodiscard]] Rest apply(const steady::State* unworn) {
    Rest rest = found(joint_, "unsettled", unworn);
    if (options_.history && rest.asymptote.verdict == Verdict::asymptote) settle(rest);
    if (options_.asymptote.certify_finer && !watcher_.stopped()) certify(rest);
    rest.solves = solves_;
    rest.jacobians = jacobians_;
    return rest;
  }

 private:
  [[nodiscard]] const reduction::ContactNodes& contact() const { return joint_.model->contact(); }

  [[nodiscard]] Rest found(const steady::Joint& joint, const char* arbitration, const steady::State* unworn) {
    AsymptoteOptions settings = options_.asymptote;
    settings.arbitration = arbitration;
    settings.certify_finer = false;  // of the answer alone
    Rest rest;
    if (options_.follow) {
      rest = followed_asymptote(joint, omega_, settings, {}, unworn, watcher_);
    } else {
      rest.asymptote = asymptote(joint, omega_, settings, unworn, watcher_);
      rest.omegas = {omega_};
      rest.solves = rest.asymptote.solves;
      rest.jacobians = rest.asymptote.jacobians;
    }
    solves_ += rest.solves;
    jacobians_ += rest.jacobians;
    return rest;
  }

  [[nodiscard]] steady::Joint with_own_budget(steady::Joint joint) const {
    if (options_.budget) joint.options.budget = options_.budget(joint.options);
    return joint;
  }

  /// Looks for doubt in a direct answer and asks the history.
  void settle(Rest& rest) {
    const steady::State unworn = rest.held ? rest.held->unworn : rest.asymptote.unworn;
    const steady::Joint joint = with_own_budget(joint_);
    Rest asked = found(joint, "auto", &unworn);
    Asymptote &history = asked.asymptote, &direct = rest.asymptote;
    const Unfinished unfinished = spent(joint.options.budget) ? Unfinished::history_budget : Unfinished::history;
    if (history.verdict == Verdict::not_converged && history.status != Status::interrupted) {
      direct.doubt = history.doubt == Doubt::none ? Doubt::unfinished : history.doubt;
      rest.unfinished = unfinished;
      return;
    }
    Ends ends;
    if (!options_.lines.empty() && history.decided_by == FoundBy::history && direct.decided_by == FoundBy::release &&
        history.verdict == Verdict::asymptote)
      ends = compared(history, direct, unworn);
    if (ends.direct_stays) {
      direct.doubt = history.doubt;
      direct.confirmed_by_history = true;
      direct.other_states = {other_state(FoundBy::history, contact(), history.depth)};
    } else {
      rest = std::move(asked);
      const bool undecided = direct.doubt != Doubt::none && !direct.confirmed_by_history;
      rest.unfinished = undecided ? unfinished : ends.unfinished;
    }
    if (ends.finer) direct.other_states.push_back(std::move(*ends.finer));
  }

  [[nodiscard]] Ends compared(const Asymptote& history, const Asymptote& direct, const steady::State& unworn) {
    const Eigen::VectorXd& area = contact().area;
    if (!far_apart(area, history.depth, direct.depth))
      return {.direct_stays = a_node_apart(options_.lines, area, history.depth, direct.depth)};
    Ends ends{.finer = finer_history(unworn)};
    if (!ends.finer)
      ends.unfinished = Unfinished::finer_history;
    else
      ends.direct_stays = std::abs(ends.finer->worn_volume - direct.worn_volume) <
                          std::abs(ends.finer->worn_volume - history.worn_volume);
    return ends;
  }

  /// Where the history ends with more harmonics and samples; nothing where it comes to no end.
  [[nodiscard]] std::optional<OtherState> finer_history(const steady::State& unworn) {
    const steady::Joint joint = with_own_budget(joint_.with(finer_settings(joint_.options)));
    const steady::State start =
        paths::steady_state(joint, unworn.omega, paths::padded(unworn.displacement, joint.options.harmonics));
    ++solves_;
    jacobians_ += start.iterations;
    if (start.status != Status::converged) return {};
    Asymptote finer = found(joint, "always", &start).asymptote;
    if (finer.verdict != Verdict::asymptote || !finer.confirmed_by_history) return {};
    return other_state(FoundBy::finer_history, contact(), finer.depth);
  }

  /// What is left of the wear is held against the unworn rate, also where it came to rest at another frequency.
  void certify(Rest& rest) {
    AsymptoteOptions settings = options_.asymptote;
    if (rest.held && !(settings.reference_rate > 0.0)) settings.reference_rate = largest(rest.held->unworn_rate);
    if (rest.asymptote.verdict != Verdict::asymptote) return;
    certify_finer(joint_, settings, rest.asymptote);
    ++solves_;
    jacobians_ += rest.asymptote.finer.jacobians;
  }

  const steady::Joint& joint_;
  double omega_;
  const RestOptions& options_;
  const Watcher& watcher_;
  int solves_ = 0, jacobians_ = 0;
};

}  // namespace

Rest comes_to_rest(const steady::Joint& joint, double omega, const RestOptions& options, const steady::State* unworn,
                   const Watcher& watcher) {
  return Rule(joint, omega, options, watcher).apply(unworn);
}

}  // namespace dovetail::wear
