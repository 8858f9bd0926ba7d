#include "optimizer/search/finer_limits.hpp"

#include <algorithm>
#include <utility>

#include "optimizer/search/params.hpp"

namespace dovetail::optimizer {

FinerLimits::FinerLimits(EvaluationSession& session, const RunHooks& hooks) : session_(session), hooks_(hooks) {}

bool FinerLimits::active() const {
  return hooks_.finer && session_.options().finer_meshes > 0 && !session_.shifts().empty();
}

const FinerCheck& FinerLimits::look(std::size_t candidate, int level) {
  for (const FinerCheck& check : checks_)
    if (check.candidate == candidate && check.level == level) return check;
  session_.stop_if_asked();
  const std::vector<double>& x = session_[candidate].x;
  std::vector<double> key = x;
  key.push_back(level);
  FinerCheck check{.candidate = candidate, .level = level, .evaluation = {}, .constraints = {}};
  const JournalRecord* known = nullptr;
  if (hooks_.finer_journal != nullptr)
    for (const JournalRecord& record : hooks_.finer_journal->records())
      if (record.x == key) known = &record;
  check.evaluation =
      known != nullptr ? known->evaluation : evaluated_or_refused([&] { return hooks_.finer(x, level); });
  const double tolerance = session_.options().constraint_tolerance;
  annotate(session_.problem(), tolerance, check.evaluation);
  if (known == nullptr && hooks_.finer_journal != nullptr) hooks_.finer_journal->append(key, check.evaluation);
  const Judgement judgement = judge(session_.problem(), check.evaluation, tolerance);
  check.constraints = judgement.constraints;
  check.held = judgement.feasible;
  checks_.push_back(std::move(check));
  return checks_.back();
}

void FinerLimits::make_up(const FinerCheck& check, double more, std::vector<double>& shifts) const {
  const std::vector<double>& here = session_[check.candidate].judgement.constraints;
  for (std::size_t j = 0; j < shifts.size(); ++j) {
    const double change = check.constraints[j] - here[j];
    shifts[j] = std::max(shifts[j], (check.constraints[j] > 0 ? more : 1.0) * change);
  }
}

bool FinerLimits::correct(std::size_t candidate) {
  if (!session_[candidate].judgement.computed) return false;
  const bool kept = session_[candidate].evaluation.feasible;
  const FinerCheck& check = look(candidate, 1);
  if (!check.evaluation.converged()) return kept;
  std::vector<double> shifts(session_.shifts().size(), 0.0);
  make_up(check, 1, shifts);
  if (!kept && std::ranges::max(shifts) > CorrectionParams{}.guide) return false;
  session_.shift_constraints(std::move(shifts));
  return true;
}

bool FinerLimits::holds(std::size_t candidate) {
  std::vector<double> shifts(session_.shifts().size(), 0.0);
  bool held = true;
  for (int level = 1; held && level <= session_.options().finer_meshes; ++level) {
    const FinerCheck& check = look(candidate, level);
    held = check.held;
    // Without an answer there nothing is learned, and what was known stays.
    if (held || check.evaluation.converged())
      make_up(check, CorrectionParams{}.more, shifts);
    else
      std::ranges::transform(shifts, session_.shifts(), shifts.begin(),
                             [](double a, double b) { return std::max(a, b); });
  }
  // Of one that held they are known to be too large only where they refused it.
  if (!held || !session_[candidate].judgement.feasible) session_.shift_constraints(std::move(shifts));
  if (held)
    session_.accept(candidate);
  else
    session_.reject(candidate);
  return held;
}

}  // namespace dovetail::optimizer
