#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "optimizer/search/session.hpp"

namespace dovetail::optimizer {

/// What an algorithm sees of one candidate; always finite.
struct SearchValue {
  double objective = 0;             ///< scaled: a typical objective is +-1
  std::vector<double> constraints;  ///< c <= 0: the response constraints, then one for the geometric rules
  bool computed = false;            ///< from physics; otherwise the substitutes described at SearchFunctions
};

/// The exact penalty f + weight sum max(0, c), of algorithms that know no constraints.
[[nodiscard]] double penalised(const SearchValue& value, double weight);

struct SearchGradient {
  std::vector<double> objective;                 ///< [n], by unit coordinates
  std::vector<std::vector<double>> constraints;  ///< [constraint][n]
};

/// Objective and constraints as functions of unit coordinates for a library that knows nothing of failures.
///
/// With f_s the median |objective| of the computed candidates so far, frozen at construction:
/// - computed: f/f_s; every response c + its shift + constraint_margin; the rules as their largest c, or -0.01 when
/// none is reported.
/// - infeasible (rule broken, no physics): level + v, with v the sum of the broken rules and level the worst scaled
///   objective so far, at most 1 above the best; response constraints as at the best; the rules as their largest c.
///   So the way back into the geometry is downhill.
/// - failed: level + 2, response constraints as at the best, and 1 for the rules.
///
/// Gradients come from finite differences of difference_step(): forward, turned round at the upper bound, or central.
/// A neighbour without physics is replaced by the one on the other side; when that has none either, the component is 0
/// (the algorithm then moves along the other variables) and counted as a fall-back.
class SearchFunctions {
 public:
  /// `phase` names the candidates. The reference candidate is the best, else the least broken, else the first.
  SearchFunctions(EvaluationSession& session, std::string phase);

  [[nodiscard]] std::size_t size() const;
  [[nodiscard]] std::size_t constraint_count() const;
  [[nodiscard]] std::size_t reference() const { return reference_; }
  [[nodiscard]] SearchValue value(std::span<const double> unit);
  /// Of many, at once where there are hooks for that.
  [[nodiscard]] std::vector<SearchValue> values(const std::vector<std::vector<double>>& units);
  [[nodiscard]] SearchGradient gradient(std::span<const double> unit);
  [[nodiscard]] const OptimizerOptions& options() const { return session_.options(); }

 private:
  /// c of a limit as algorithms see it.
  [[nodiscard]] double aimed(const Judgement& judgement, std::size_t j) const;
  [[nodiscard]] SearchValue seen(const Candidate& candidate) const;
  [[nodiscard]] SearchGradient differences(std::size_t base);

  EvaluationSession& session_;
  std::string phase_;
  std::size_t reference_ = 0;
  double scale_ = 1;
  double level_ = 0;
  std::vector<double> reference_constraints_;  ///< as aimed at
};

}  // namespace dovetail::optimizer
