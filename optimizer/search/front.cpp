#include "optimizer/search/front.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/options.hpp"
#include "optimizer/search/pagmo_search.hpp"
#include "optimizer/search/run.hpp"

namespace dovetail::optimizer {

namespace {

using Terms = std::vector<std::vector<double>>;

/// Whether `a` is nowhere worse and somewhere better than `b`; or the same, and farther from slip or seen before.
bool beats(const Candidate& a, const Candidate& b, bool before) {
  bool nearer = false;
  for (std::size_t i = 0; i < a.judgement.terms.size(); ++i) {
    if (a.judgement.terms[i] > b.judgement.terms[i]) return false;
    nearer = nearer || a.judgement.terms[i] < b.judgement.terms[i];
  }
  if (nearer) return true;
  return better(a.judgement, b.judgement) || (before && !better(b.judgement, a.judgement));
}

std::vector<double> worst_of(std::size_t count, const Terms& all) {
  std::vector<double> worst(count, -kInfinity);
  for (const std::vector<double>& terms : all)
    for (std::size_t i = 0; i < count; ++i) worst[i] = std::max(worst[i], terms[i]);
  return worst;
}

/// Points as fractions of the extent of all of them.
Terms in_extent(const Terms& all) {
  Terms result = all;
  for (std::size_t i = 0; !all.empty() && i < all.front().size(); ++i) {
    const auto of = [i](const std::vector<double>& terms) { return terms[i]; };
    const auto [least, most] = std::ranges::minmax(all, {}, of);
    for (std::vector<double>& terms : result)
      terms[i] = most[i] > least[i] ? (terms[i] - least[i]) / (most[i] - least[i]) : 0;
  }
  return result;
}

double distance(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += std::pow(a[i] - b[i], 2);
  return std::sqrt(sum);
}

}  // namespace

Front front_of(const Problem& problem, std::span<const Candidate> candidates) {
  Front front;
  const std::size_t count = problem.objective.size();
  Terms first;
  front.moves = true;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const Candidate& one = candidates[i];
    // As their values say: what looks at finer meshes bring comes and goes with the length of the run.
    if (one.evaluation.feasible && (one.phase == kStartPhase || one.phase == kScanPhase)) {
      first.push_back(one.judgement.terms);
      front.moves = front.moves && one.phase != kScanPhase;
    }
    if (!one.judgement.feasible) continue;
    bool beaten = false;
    for (std::size_t j = 0; j < candidates.size() && !beaten; ++j)
      beaten = j != i && candidates[j].judgement.feasible && beats(candidates[j], one, j < i);
    if (!beaten) front.points.push_back(i);
  }
  std::ranges::stable_sort(front.points, {}, [&](std::size_t i) { return candidates[i].judgement.terms; });
  Terms terms;
  for (const std::size_t i : front.points) terms.push_back(candidates[i].judgement.terms);
  if (front.moves) first.insert(first.end(), terms.begin(), terms.end());
  front.reference = worst_of(count, first);
  for (std::size_t i = 0; i < count; ++i)
    if (const auto& given = problem.objective[i].reference) front.reference[i] = as_term(problem.objective[i], *given);
  front.moves =
      front.moves && std::ranges::any_of(problem.objective, [](const ObjectiveTerm& term) { return !term.reference; });
  if (terms.empty()) return front;
  front.ideal.assign(count, kInfinity);
  for (const std::vector<double>& one : terms)
    for (std::size_t i = 0; i < count; ++i) front.ideal[i] = std::min(front.ideal[i], one[i]);
  front.hypervolume = hypervolume(terms, front.reference);
  const Terms relative = in_extent(terms);
  const std::vector<double> ideal(count, 0.0);
  const auto nearest = std::ranges::min_element(relative, {}, [&](const auto& one) { return distance(one, ideal); });
  front.compromise = front.points[static_cast<std::size_t>(nearest - relative.begin())];
  return front;
}

std::vector<std::size_t> spread(const Terms& terms, std::size_t count) {
  std::vector<std::size_t> taken;
  if (terms.empty()) return taken;
  const Terms relative = in_extent(terms);
  const auto take = [&](std::size_t i) {
    if (taken.size() < count && std::ranges::find(taken, i) == taken.end()) taken.push_back(i);
  };
  for (std::size_t i = 0; i < terms.front().size(); ++i)
    take(static_cast<std::size_t>(
        std::ranges::min_element(terms, {}, [i](const std::vector<double>& one) { return one[i]; }) - terms.begin()));
  while (taken.size() < std::min(count, terms.size())) {
    std::size_t farthest = 0;
    double most = -1;
    for (std::size_t i = 0; i < relative.size(); ++i) {
      double near = kInfinity;
      for (const std::size_t j : taken) near = std::min(near, distance(relative[i], relative[j]));
      if (near > most && std::ranges::find(taken, i) == taken.end()) {
        most = near;
        farthest = i;
      }
    }
    taken.push_back(farthest);
  }
  std::ranges::sort(taken);
  return taken;
}

}  // namespace dovetail::optimizer
