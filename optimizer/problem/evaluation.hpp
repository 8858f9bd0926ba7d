#pragma once

#include <functional>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "core/errors.hpp"
#include "optimizer/problem/outcome.hpp"

namespace dovetail::optimizer {

/// What one candidate came to. Parameters are in the unit of the study file, all else SI.
struct Evaluation {
  /// See Outcome; of a failure the first stage that failed and why, e.g. "steady_state: iteration_limit". Only a
  /// converged evaluation may be used as a result.
  std::string status = status_of(Outcome::converged);
  bool feasible = true;                           ///< geometry valid and all constraints met
  std::map<std::string, double> parameters;       ///< KEY as for --set -> value in the file's unit
  std::map<std::string, double> responses;        ///< name with SI unit -> value
  std::map<std::string, double> constraints;      ///< name -> c, satisfied when c <= 0 (normalised, smooth)
  std::map<std::string, double> error_estimates;  ///< response name -> error bar over all sources
  std::map<std::string, std::map<std::string, double>> error_sources;  ///< response name -> source -> part of the bar
  std::vector<std::string> unbounded;              ///< responses without a bar: they have no limit, or it is not known
  std::vector<std::string> undecided_constraints;  ///< names of those that the values do not decide: within their bar,
                                                   ///< without one, or without a value
  std::map<std::string, double> model;             ///< sizes chosen: dofs, contact nodes, modes, ...
  std::map<std::string, double> timings_s;
  std::vector<std::string> messages;  ///< broken rules, re-meshing, fall-backs: for people
  /// Optional derivatives: name of a response or constraint -> gradient by design variable, in the
  /// order of the design space. Empty when not computed.
  std::map<std::string, std::vector<double>> derivatives;

  [[nodiscard]] bool converged() const { return outcome_of(status) == Outcome::converged; }
  [[nodiscard]] bool infeasible() const { return outcome_of(status) == Outcome::infeasible; }
  /// Whether its worn state is in doubt, and no history that was asked has settled that.
  [[nodiscard]] bool left_to_history() const {
    const auto found = model.find("wear_history_may_differ");
    return found != model.end() && found->second != 0;
  }
};

/// Evaluates one point of the design space (values in the study file's units, design-space order).
using Evaluator = std::function<Evaluation(std::span<const double>)>;

/// What `evaluate` returns. A design that it refuses as wrong input is a failure of that design, not of what asked for
/// it.
template <class Evaluate>
[[nodiscard]] Evaluation evaluated_or_refused(const Evaluate& evaluate) {
  try {
    return evaluate();
  } catch (const InputError& error) {
    Evaluation refused;
    refused.status = failed_at("scene", error.what());
    return refused;
  }
}

}  // namespace dovetail::optimizer
