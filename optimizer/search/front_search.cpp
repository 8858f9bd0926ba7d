#include "optimizer/search/front_search.hpp"

#include <algorithm>
#include <limits>
#include <string>

#include "core/options.hpp"
#include "optimizer/search/params.hpp"
#include "optimizer/search/space_filling.hpp"

namespace dovetail::optimizer {

namespace {

/// Where the other objectives are limited, run by run: fractions of the way from their worst to their best value.
std::vector<std::vector<double>> fractions(std::size_t runs, std::size_t others, int seed) {
  if (runs == 0) return {};
  if (others > 1) return latin_hypercube(runs, others, static_cast<std::uint64_t>(seed));
  std::vector<std::vector<double>> even;
  for (std::size_t k = 1; k <= runs; ++k) even.push_back({static_cast<double>(k) / static_cast<double>(runs + 1)});
  return even;
}

/// Terms among which `counts` does.
std::vector<double> weights_of(const EvaluationSession& session, std::size_t terms, std::size_t counts) {
  std::vector<double> weights(terms, 0.0), least(terms, kInfinity), most(terms, -kInfinity);
  for (const Candidate& candidate : session.candidates())
    for (std::size_t i = 0; candidate.judgement.computed && i < terms; ++i) {
      least[i] = std::min(least[i], candidate.judgement.terms[i]);
      most[i] = std::max(most[i], candidate.judgement.terms[i]);
    }
  for (std::size_t i = 0; i < terms; ++i)
    if (most[i] > least[i] && most[counts] > least[counts])
      weights[i] = EpsilonParams{}.others * (most[counts] - least[counts]) / (most[i] - least[i]);
  weights[counts] = 1;
  return weights;
}

}  // namespace

SearchOutcome epsilon_constraint(EvaluationSession& session, const std::function<SearchOutcome()>& search) {
  const OptimizerOptions& options = session.options();
  const std::size_t terms = session.problem().objective.size();
  const auto all = static_cast<std::size_t>(options.max_evaluations);
  const std::size_t runs = std::max(static_cast<std::size_t>(options.front_points), terms);
  const std::string name = "epsilon-constraint with " + std::string(to_string(options.algorithm));
  std::size_t left = runs, limited = 0;
  const auto run = [&](const Focus& focus) {
    session.focus(focus);
    const std::size_t done = session.candidates().size();
    session.limit(done + (all - std::min(all, done)) / left--);
    limited += search().status == Status::converged ? 0 : 1;
  };
  std::vector<std::vector<double>> ends;
  for (std::size_t i = 0; i < terms; ++i) {
    run({.weights = weights_of(session, terms, i),
         .most = std::vector<double>(terms, kInfinity),
         .size = std::vector<double>(terms, 1.0)});
    if (!session.best())
      return {.status = Status::stalled, .message = name + ": found no candidate that keeps the limits"};
    ends.push_back(session[*session.best()].judgement.terms);
  }
  std::vector<double> best(terms), worst(terms);
  for (std::size_t i = 0; i < terms; ++i) {
    const auto [least, most] = std::ranges::minmax(ends, {}, [i](const auto& end) { return end[i]; });
    best[i] = least[i];
    worst[i] = most[i];
  }
  const std::vector<double> weights = weights_of(session, terms, 0);
  for (const std::vector<double>& way : fractions(left, terms - 1, options.seed)) {
    Focus focus{
        .weights = weights, .most = std::vector<double>(terms, kInfinity), .size = std::vector<double>(terms, 1.0)};
    for (std::size_t i = 1; i < terms; ++i) {
      if (!(worst[i] > best[i])) continue;  // this objective is at its best wherever the others are
      focus.most[i] = worst[i] + way[i - 1] * (best[i] - worst[i]);
      focus.size[i] = worst[i] - best[i];
    }
    run(focus);
  }
  if (limited == 0) return {.status = Status::converged, .message = name + ": every run reached its stopping rule"};
  return {.status = Status::iteration_limit,
          .message = name + ": " + std::to_string(limited) + " of " + std::to_string(runs) +
                     " runs were ended by their share of the budget"};
}

}  // namespace dovetail::optimizer
