#pragma once

#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "optimizer/problem/design_space.hpp"
#include "optimizer/problem/evaluation.hpp"
#include "optimizer/problem/load_case.hpp"

namespace dovetail::optimizer {

/// One term of the objective: `weight * r / scale`, or `weight * |r - target| / scale` when `absolute`.
struct ObjectiveTerm {
  std::string response;   ///< e.g. "asymptotic_wear_volume_m3"
  double weight = 1;      ///< negative: the response is maximised
  double scale = 0;       ///< > 0, in the response's SI unit; 0: not given, allowed (and then 1) for a single term only
  bool absolute = false;  ///< of the distance from the target, e.g. of resonance_drift from 0; has a kink there
  double accuracy = 0;    ///< asked of the response, relative; 0: as of the others
  double target = 0;      ///< of an absolute one
  std::string over{to_string(Over::worst)};  ///< see over_cases; of no interest without cases
  std::optional<double> reference = {};      ///< of a front: values of the response beyond it count nothing; SI
};

/// Limits on one response. Each gives a smooth normalised c <= 0:
/// upper: `c = (r - upper)/s`, lower: `c = (lower - r)/s`, with `s = scale`, or |limit| when scale is 0.
struct ResponseConstraint {
  std::string response;
  std::optional<double> lower, upper;  ///< at least one; SI
  double scale = 0;                    ///< > 0, needed when a limit is 0; 0: |limit|
  bool absolute = false;               ///< limits |r|
  double accuracy = 0;                 ///< asked of the response, relative; 0: as of the others
  std::string over{to_string(Over::worst)};
  /// What the distance from one of its limits is divided by.
  [[nodiscard]] double scale_at(double limit) const { return scale > 0 ? scale : std::abs(limit); }
};

/// What is minimised over which variables under which limits.
struct Problem {
  DesignSpace space;
  std::vector<ObjectiveTerm> objective;  ///< their sum, or each for itself
  bool front = false;                    ///< several terms are wanted, each for itself: designs that no other beats
  std::vector<ResponseConstraint> constraints;
  /// Empty: a design has one load, that of the study. Otherwise an evaluation has responses of every case under the
  /// names of of_case, and under the plain ones those of the first case.
  std::vector<LoadCase> cases;
  double quantile = 0.95;  ///< in (0, 1): the share that stays below where a term counts the quantile
};

/// Throws InputError with everything wrong in the terms and limits there are (non-finite weights, missing limits, zero
/// scales): enough to judge a design.
void check_terms(const Problem& problem);
/// The same, and what a search needs besides: a variable and a term.
void check(const Problem& problem);

/// Responses that the objective and the constraints name, in this order, each once.
[[nodiscard]] std::vector<std::string> responses_of(const Problem& problem);

/// Names of the response constraints in the order algorithms see them: "peak_amplitude_m:upper", of one case or over
/// all in another way than by the worst "peak_amplitude_m@idle:upper", ...
[[nodiscard]] std::vector<std::string> constraint_names(const Problem& problem);

/// Prefix of geometric rules in Evaluation::constraints; c = -margin, normalised, c <= 0 is met. Exactly 0 says that
/// the rule is kept without saying how far.
inline constexpr const char* kRulePrefix = "rule:";

/// One evaluation seen through the problem.
struct Judgement {
  bool computed = false;                 ///< converged with every response of the problem finite
  double objective = 0;                  ///< of a front its first term; NaN unless computed
  std::vector<double> terms = {};        ///< of the objective, in its order; NaN unless computed
  std::vector<double> constraints = {};  ///< c in the order of constraint_names, NaN unless computed
  std::optional<double> rules =
      {};                 ///< largest c != 0 of the rules reported; an infeasible candidate without any has 1
  double violation = 0;   ///< sum of max(0, c) over rules and constraints known
  bool feasible = false;  ///< computed, and no c above the tolerance
  /// What decides between designs of one objective, see better: of the case with the least of it, kSlipMargin - none
  /// without any - and of the one with the largest, the amplitude.
  double slip_margin = -1;
  double amplitude = 0;
};

/// Entry of Evaluation::model of a design that does not wear: what is left of the friction, as a share, before a
/// contact node slips in every cycle.
inline constexpr const char* kSlipMargin = "slip_margin";

/// Whether a design is better than another one, both feasible: by its objective; where that is the same to the bit, as
/// of designs that do not wear, by its margin against slip, and then by its amplitude.
[[nodiscard]] bool better(const Judgement& one, const Judgement& other);

/// Judges with the exact constraints: feasible when every c <= tolerance. Pure; never throws.
/// - `shifts`: added to the response constraints before they count, order of constraint_names; empty: none
[[nodiscard]] Judgement judge(const Problem& problem, const Evaluation& evaluation, double tolerance,
                              std::span<const double> shifts = {});

/// A response's value as a term of the objective has it: less is better.
[[nodiscard]] double as_term(const ObjectiveTerm& term, double response);

/// What a term comes to, and by how much it may be off; NaN where that is not known.
[[nodiscard]] Barred term_value(const Problem& problem, const ObjectiveTerm& term,
                                const std::map<std::string, double>& responses,
                                const std::map<std::string, double>& error_estimates);

/// The value of a term in the unit of its response, and as it is where more is better.
[[nodiscard]] Barred as_response(const ObjectiveTerm& term, Barred value);

/// A response as an objective or limit sees it.
struct CaseNumber {
  std::string name;      ///< of the worst case the plain one, else of one case or over all
  std::string response;  ///< of which
  Barred number;         ///< in the response's unit
  double size = 0;  ///< what its accuracy is relative to: its own; of a deviation the mean, of a distance from a target
                    ///< what the responses themselves come to
};

/// Of objective and limits, whose cases are there; NaN where one of them is not.
[[nodiscard]] std::vector<CaseNumber> numbers_asked(const Problem& problem,
                                                    const std::map<std::string, double>& responses,
                                                    const std::map<std::string, double>& bars);

/// Error bars of responses as the objective and the constraints have them, order of constraint_names; NaN where there
/// is none.
struct JudgementBars {
  double objective = 0;
  std::vector<double> terms = {};
  std::vector<double> constraints = {};
};
[[nodiscard]] JudgementBars judgement_bars(const Problem& problem, const std::map<std::string, double>& responses,
                                           const std::map<std::string, double>& error_estimates);

/// Writes what the problem makes of it into the evaluation: its constraints by name, `feasible` as the values say,
/// which constraints their bars leave undecided, and a failing status
/// ("response: NAME is not finite" / "is missing") when a response of the problem has no value. Idempotent.
void annotate(const Problem& problem, double tolerance, Evaluation& evaluation);

/// A response the problem names is absent from a converged evaluation: InputError with the nearest name there is.
void require_responses(const Problem& problem, const Evaluation& evaluation);

}  // namespace dovetail::optimizer
