#pragma once

#include <cstddef>
#include <vector>

#include "optimizer/search/session.hpp"

namespace dovetail::optimizer {

/// Limits of a search as finer meshes see them. The objective is not corrected: a change that is the same for all
/// designs does not move its minimum, and how large it is the error bar of what is handed over has to say.
class FinerLimits {
 public:
  FinerLimits(EvaluationSession& session, const RunHooks& hooks);

  /// There are limits, and finer meshes to look at them.
  [[nodiscard]] bool active() const;
  /// Shifts the session's constraints by what one level finer changes at a candidate. Of one that breaks limits large
  /// changes say nothing of others: as a part of what it has too much of they may refuse all. Whether it says anything.
  /// Throws StopSearch.
  bool correct(std::size_t candidate);
  /// Whether the candidate keeps its limits on every level. If so, it is accepted; if not, rejected, and the session's
  /// constraints are shifted by what was seen. Throws StopSearch.
  bool holds(std::size_t candidate);

  [[nodiscard]] const std::vector<FinerCheck>& checks() const { return checks_; }

 private:
  const FinerCheck& look(std::size_t candidate, int level);
  /// Shifts that make up for what `check` says, `more` times.
  void make_up(const FinerCheck& check, double more, std::vector<double>& shifts) const;

  EvaluationSession& session_;
  const RunHooks& hooks_;
  std::vector<FinerCheck> checks_;
};

}  // namespace dovetail::optimizer
