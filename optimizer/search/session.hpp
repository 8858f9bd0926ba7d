#pragma once

#include <cstddef>
#include <deque>
#include <exception>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "optimizer/search/cache.hpp"
#include "optimizer/search/run.hpp"

namespace dovetail::optimizer {

/// Thrown through an algorithm to end it: the budget is used up (iteration_limit), the user asked (interrupted) or the
/// algorithm only asks again for what it knows (stalled).
struct StopSearch {
  Status reason;
};

/// One objective of several in place of the others, which are limited instead.
struct Focus {
  std::vector<double> weights{};  ///< of the terms: 1 of the one that counts, next to nothing of the others
  std::vector<double> most{};     ///< of each term; infinite: no limit, as of the term that counts
  std::vector<double> size{};     ///< of a notable violation, > 0
};

/// The candidates of one run: answers from cache and journal, else calls the evaluator, records, counts, judges.
/// Algorithms see unit coordinates, rounded to multiples of 2^-40 so that an algorithm's internal scaling, which moves
/// a point by some units in the last place, does not cost an evaluation.
class EvaluationSession {
 public:
  EvaluationSession(const Problem& problem, const Evaluator& evaluator, const OptimizerOptions& options,
                    const RunHooks& hooks);

  /// The start of the design space, with exactly the values given there.
  std::size_t evaluate_start();
  /// Index of the candidate at `unit`. Throws StopSearch, and whatever the evaluator throws.
  std::size_t evaluate(std::span<const double> unit, const std::string& phase);
  /// The same for several, at once where there are hooks for that; recorded in the order given. When the budget ends on
  /// the way, those within it are evaluated before StopSearch.
  std::vector<std::size_t> evaluate_all(const std::vector<std::vector<double>>& units, const std::string& phase);

  /// Evaluations from now on end at this number of candidates, the options' max_evaluations at most.
  void limit(std::size_t candidates);
  /// Candidates keep their limits when c + shift does, but those accepted; order of constraint_names. All are judged
  /// again.
  void shift_constraints(std::vector<double> shifts);
  [[nodiscard]] const std::vector<double>& shifts() const { return shifts_; }
  /// From now on candidates are judged by this, which adds a limit for each term; by nothing: as the problem says.
  void focus(std::optional<Focus> on);
  /// Whatever its values say, this candidate does not keep its limits.
  void reject(std::size_t index);
  /// This candidate keeps its limits, whatever shifts say: finer meshes were asked about itself.
  void accept(std::size_t index);
  [[nodiscard]] bool accepted(std::size_t index) const;

  /// `unit` as it will be evaluated: in the box, on the grid.
  [[nodiscard]] static std::vector<double> snap(std::span<const double> unit);

  [[nodiscard]] const Problem& problem() const { return problem_; }
  [[nodiscard]] const OptimizerOptions& options() const { return options_; }
  [[nodiscard]] const std::deque<Candidate>& candidates() const { return candidates_; }
  [[nodiscard]] const Candidate& operator[](std::size_t index) const { return candidates_[index]; }
  [[nodiscard]] const std::vector<double>& unit(std::size_t index) const { return units_[index]; }
  [[nodiscard]] std::optional<std::size_t> best() const { return best_; }
  /// The candidate with the smallest violation, computed ones before those without physics; nothing if all failed.
  [[nodiscard]] std::optional<std::size_t> least_broken() const;
  /// Of candidates refused by shifts alone, the one with the smallest violation.
  [[nodiscard]] std::optional<std::size_t> refused_by_shifts() const;
  [[nodiscard]] SearchStatistics& statistics() { return statistics_; }
  [[nodiscard]] int unused_records() const;
  /// Throws StopSearch when the user asked for the end.
  void stop_if_asked() const;
  /// No evaluation begins any more. The start is computed whatever the time.
  [[nodiscard]] bool time_over() const { return hooks_.time_over && !candidates_.empty() && hooks_.time_over(); }

 private:
  struct Pending {
    std::vector<double> unit, x;
    const Evaluation* known = nullptr;  ///< in the journal
    Evaluation evaluation = {};
    std::exception_ptr error = {};
    bool done = false;
  };
  void compute(std::vector<Pending>& pending, const std::string& phase);
  void compute_at_once(std::vector<Pending>& pending, const std::string& phase);
  void call_evaluator(Pending& candidate) const;
  void commit(Pending& candidate, const std::string& phase);
  void judge_again();
  [[nodiscard]] Judgement judged(std::size_t index, const Evaluation& evaluation) const;

  const Problem& problem_;
  const Evaluator& evaluator_;
  const OptimizerOptions& options_;
  const RunHooks& hooks_;
  ExactCache by_unit_, by_value_, in_journal_;
  std::deque<Candidate> candidates_;
  std::deque<std::vector<double>> units_;
  std::size_t limit_;
  std::vector<double> shifts_;  // [constraints]
  std::vector<std::size_t> rejected_, accepted_;
  std::optional<Focus> focus_;
  std::optional<std::size_t> best_;
  SearchStatistics statistics_;
  bool responses_known_ = false;
  int repeats_in_a_row_ = 0;
};

}  // namespace dovetail::optimizer
