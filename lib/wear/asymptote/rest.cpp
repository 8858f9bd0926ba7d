#include "wear/asymptote/rest.hpp"

#include <cmath>
#include <utility>

#include "paths/steady_state.hpp"
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
    Rest rest = found(joint_, options_.history ? Arbitration::automatic : Arbitration::unsettled, unworn);
    if (options_.history) weigh(rest);
    if (options_.asymptote.certify_finer && !watcher_.stopped()) certify(rest);
    rest.solves = solves_;
    rest.jacobians = jacobians_;
    return rest;
  }

 private:
  [[nodiscard]] const reduction::ContactNodes& contact() const { return joint_.model->contact(); }

  [[nodiscard]] Rest found(const steady::Joint& joint, Arbitration arbitration, const steady::State* unworn) {
    AsymptoteOptions settings = options_.asymptote;
    settings.arbitration = arbitration;
    settings.certify_finer = false;  // of the answer alone
    Rest rest;
    if (options_.follow) {
      static_cast<FollowedAsymptote&>(rest) = followed_asymptote(joint, omega_, settings, {}, unworn, watcher_);
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

  /// Holds what the history says against the direct answer, which is found again without it: most often it is not
  /// needed.
  void weigh(Rest& asked) {
    const Asymptote& history = asked.asymptote;
    if (history.doubt != Doubt::none && !history.confirmed_by_history) asked.unfinished = unfinished(history);
    // A direct answer that cannot stand without the history is none to be held against it.
    const bool decides = history.decided_by == FoundBy::history && history.verdict == Verdict::asymptote &&
                         entry(history.doubt).direct_stands;
    // On the way along resonances the history may have led astray.
    const bool fails =
        options_.follow && history.verdict == Verdict::not_converged && history.status != Status::interrupted;
    if (!fails && (!decides || options_.lines.empty())) return;
    const steady::State unworn = asked.held ? asked.held->unworn : history.unworn;
    Rest rest = found(joint_, Arbitration::unsettled, &unworn);
    Asymptote& direct = rest.asymptote;
    if (direct.verdict != Verdict::asymptote) return;
    if (fails) {
      direct.doubt = history.doubt == Doubt::none ? Doubt::unfinished : history.doubt;
      rest.unfinished = unfinished(history);
      asked = std::move(rest);
      return;
    }
    if (direct.decided_by != FoundBy::release) return;
    Ends ends = compared(history, direct, unworn);
    if (ends.direct_stays) {
      direct.doubt = history.doubt;
      direct.confirmed_by_history = true;
      direct.other_states = {other_state(FoundBy::history, contact(), history.depth)};
      asked = std::move(rest);
    } else {
      asked.unfinished = ends.unfinished;
    }
    if (ends.finer) asked.asymptote.other_states.push_back(std::move(*ends.finer));
  }

  static Unfinished unfinished(const Asymptote& answer) {
    return answer.history == Status::budget_spent ? Unfinished::history_budget : Unfinished::history;
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
    steady::Joint joint = joint_.with(finer_settings(joint_.options));
    if (options_.asymptote.history_budget) joint.options.budget = options_.asymptote.history_budget(joint.options);
    const steady::State start =
        paths::steady_state(joint, unworn.omega, paths::padded(unworn.displacement, joint.options.harmonics));
    ++solves_;
    jacobians_ += start.iterations;
    if (start.status != Status::converged) return {};
    Asymptote finer = found(joint, Arbitration::always, &start).asymptote;
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
