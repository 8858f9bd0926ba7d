#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/options.hpp"
#include "core/status.hpp"
#include "steady/state.hpp"
#include "wear/asymptote/asymptote.hpp"

namespace dovetail::wear {

/// How far the data behind a worn state are varied.
struct SpreadOptions {
  // in [0, 1). Relative change of every friction coefficient.
  double friction = 0.2;
  // in [0, 1). Relative change of the harmonics of the excitation; the static load stays.
  double load = 0.1;
  // in [0, 1). Relative change of every wear coefficient.
  double wear_coefficient = 0.5;
  // Residual tractions of stuck nodes at corners of what friction admits.
  bool tractions = true;
  // All changes together that make for the most wear, and for the least.
  bool combined = true;
};

/// What one computation of a worn state came to.
struct WornEnd {
  Verdict verdict = Verdict::not_converged;
  Status status = Status::converged;
  double volume = 0;      ///< m^3
  Eigen::VectorXd depth;  ///< [Nc] m
  int solves = 0;         ///< steady states computed

  [[nodiscard]] double largest_depth() const { return depth.size() > 0 ? depth.maxCoeff() : 0.0; }
};

/// Computes the worn state of a joint; the same way for every member of a spread.
using WornComputation = std::function<WornEnd(const steady::Joint&)>;

/// One changed problem.
struct SpreadMember {
  std::string source;  ///< friction | load | wear_coefficient | residual_tractions | combined
  std::string change;  ///< for people: "x 0.8", "left +, right -"
  WornEnd end;
};

/// What the members of one source span, the unchanged problem included. Only members with an asymptote count for
/// values; `verdict` is not_converged when any failed, else no_asymptote when any keeps wearing, else asymptote.
struct SpreadRange {
  std::string source;
  Verdict verdict = Verdict::asymptote;
  double lowest_volume = 0, highest_volume = 0;  ///< m^3
  double lowest_depth = 0, highest_depth = 0;    ///< largest depth, m
  double profile_change = 0;  ///< largest change of depth at a node over the largest depth of the unchanged problem
  int members = 0, failed = 0;
};

struct Spread {
  WornEnd nominal;
  std::vector<SpreadMember> members;  ///< all of them, failed ones too
  std::vector<SpreadRange> ranges;    ///< one for each source that applies, last the combined one: over all members
  int solves = 0;                     ///< steady states over all members
};

/// How far the worn state depends on what is not known well: each source is varied alone, then all of them together
/// towards more and towards less wear. Ranges are attained values, not bounds.
///
/// Archard's rates are proportional to k_w, so that k_w common to all nodes sets the pace of wear but not where it
/// ends; the source wear_coefficient measures this. Residual tractions are slip origins of the nodes that stay stuck in
/// `unworn`: the corners where every stuck node of a flank (of half of it, when there is one flank) is at its friction
/// limit the same way.
/// - `unworn`: steady state of the unchanged unworn joint with its tangent; without: no residual tractions
///
/// Cost: ten to fifteen calls of `compute`. Throws InputError for options out of range.
[[nodiscard]] Spread spread(const steady::Joint& joint, const WornEnd& nominal, const WornComputation& compute,
                            const steady::State* unworn = nullptr, const SpreadOptions& options = {});

}  // namespace dovetail::wear

namespace dovetail {
template <>
std::span<const Field<wear::SpreadOptions>> option_table<wear::SpreadOptions>();
}
