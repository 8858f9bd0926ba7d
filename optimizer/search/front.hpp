#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "optimizer/problem/problem.hpp"

namespace dovetail::optimizer {

struct Candidate;

/// What several objectives come to that are wanted each for itself. Values are those of Judgement::terms: less is
/// better.
struct Front {
  /// Candidates that no other beats: feasible, and whoever is better in one objective is worse in another. By the first
  /// objective, least first; of several with the same values the first that was seen.
  std::vector<std::size_t> points;
  std::vector<double> ideal;      ///< least of every objective on it
  std::vector<double> reference;  ///< beyond it nothing counts
  bool moves = false;             ///< the reference is not given, and hangs on the points
  double hypervolume = 0;         ///< between the points and the reference, in the product of the objectives' units
  std::size_t compromise = 0;     ///< the point nearest to the ideal, by the extent of the front in every objective
};

/// The front of the candidates as they are judged; without points where none is feasible. The values themselves decide:
/// a search has no bars.
///
/// The reference of an objective is what its term says; otherwise the worst value of start and scan that keeps limits
/// on the mesh of the search, which no search and no resumption moves. Where nothing of a scan does it is the worst
/// value of start and front, against the start alone what is given up in one objective would count nothing, and moves
/// with it.
[[nodiscard]] Front front_of(const Problem& problem, std::span<const Candidate> candidates);

/// At most `count` of the points of a front, its ends among them, spread: one after the other the point that is
/// farthest from those taken, by the extent of the front in every objective. In the order of the front.
/// - `terms`: of each point
[[nodiscard]] std::vector<std::size_t> spread(const std::vector<std::vector<double>>& terms, std::size_t count);

}  // namespace dovetail::optimizer
