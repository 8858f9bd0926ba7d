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

/// The same in an order that is spread over all of them wherever it is cut short: halves, quarters, eighths, ...
std::vector<std::size_t> spread_order(std::size_t count) {
  std::vector<std::size_t> order;
  std::vector<bool> taken(count);
  for (std::size_t parts = 2; order.size() < count; parts *= 2)
    for (std::size_t odd = 1; odd < parts; odd += 2) {
      const std::size_t at = odd * count / parts;
      if (!taken[at]) order.push_back(at);
      taken[at] = true;
    }
  return order;
}

}  // namespace

SearchOutcome epsilon_constraint(EvaluationSession& session, const std::function<SearchOutcome()>& search) {
  const OptimizerOptions& options = session.options();
  const std::size_t terms = session.problem().objective.size();
  const auto all = static_cast<std::size_t>(options.max_evaluations);
  const std::size_t runs = std::max(static_cast<std::size_t>(options.front_points), terms);
  const std::string name = "epsilon-constraint with " + std::string(to_string(options.algorithm));
  // Of no run does the way hang on how long the whole may become: a longer budget goes on where a shorter one ended.
  std::size_t share = EpsilonParams{}.share * (session.problem().space.size() + 1), limited = 0;
  const auto run = [&](const Focus& focus) {
    session.focus(focus);
    const std::size_t before = session.candidates().size();
    session.limit(before + share);
    const bool converged = search().status == Status::converged;
    if (!converged && (session.candidates().size() == all || session.time_over()))
      throw StopSearch{Status::iteration_limit};
    limited += converged ? 0 : 1;
  };
  const std::vector<std::vector<double>> ways = fractions(runs - terms, terms - 1, options.seed);
  const std::vector<std::size_t> order = spread_order(ways.size());
  while (true) {
    const std::size_t known = session.candidates().size();
    limited = 0;
    std::vector<std::vector<double>> ends;
    for (std::size_t i = 0; i < terms; ++i) {
      run({.weights = weights_of(session, terms, i),
           .most = std::vector<double>(terms, kInfinity),
           .size = std::vector<double>(terms, 1.0)});
      if (!session.best()) continue;
      ends.push_back(session[*session.best()].judgement.terms);
    }
    if (ends.empty())
      return {.status = Status::stalled, .message = name + ": found no candidate that keeps the limits"};
    std::vector<double> best(terms), worst(terms);
    for (std::size_t i = 0; i < terms; ++i) {
      const auto [least, most] = std::ranges::minmax(ends, {}, [i](const auto& end) { return end[i]; });
      best[i] = least[i];
      worst[i] = most[i];
    }
    const std::vector<double> weights = weights_of(session, terms, 0);
    for (const std::size_t at : order) {
      Focus focus{
          .weights = weights, .most = std::vector<double>(terms, kInfinity), .size = std::vector<double>(terms, 1.0)};
      for (std::size_t i = 1; i < terms; ++i) {
        if (!(worst[i] > best[i])) continue;  // this objective is at its best wherever the others are
        focus.most[i] = worst[i] + ways[at][i - 1] * (best[i] - worst[i]);
        focus.size[i] = worst[i] - best[i];
      }
      run(focus);
    }
    if (limited == 0) return {.status = Status::converged, .message = name + ": every run reached its stopping rule"};
    if (session.candidates().size() == known)
      return {.status = Status::stalled, .message = name + ": asks only for candidates it already knows"};
    share *= 2;
  }
}

}  // namespace dovetail::optimizer
