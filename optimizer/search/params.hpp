#pragma once

#include <cstddef>

namespace dovetail::optimizer {

// The numbers that steer searches, beside those that a study may set (OptimizerOptions). Objectives are scaled to about
// one and lengths are fractions of the variables' ranges.

/// What an algorithm is told of candidates that have no value.
struct SubstituteParams {
  double unknown_rules = -0.01;  ///< c of the rules when a computed candidate reports none
  double failed = 2.0;           ///< objective of a failed candidate above the level
  double most_violation = 1e3;   ///< keeps sums finite whatever a rule reports
};

/// How a search goes on after a look at finer meshes.
struct CorrectionParams {
  double reserve = 0.2;      ///< of the evaluations, for what is left to do after a look
  double uncorrected = 0.5;  ///< the same, where the search begins with no design to correct limits by
  /// Of a limit, change on a finer mesh of a design that breaks limits, up to which it is a guide to others. With the
  /// 0.7 that a sharp flank end adds to a pressure everybody is refused, and nothing is found. 0: no guide.
  double guide = 0.1;
  double step = 0.25;  ///< first step of the search that goes on, by that of the search; halves from round to round
  int looks = 6;       ///< while the search goes on, and as many in the end at what is known
  double apart = 0.1;  ///< a known design closer than this in every variable to one that broke its limits is passed
                       ///< over
  /// Of a limit that was broken in spite of the shifts so far, so that the next design does not miss it by as little
  /// again. 1: it does.
  double more = 1.2;
};

/// Limits of algorithms that know none, as a penalty.
struct PenaltyParams {
  double weight = 10;        ///< first one, which a scaled objective hardly outweighs
  double growth = 10;        ///< where the violation did not fall
  double falls = 0.25;       ///< to this part of the last one
  double most = 1e6;         ///< weight; beyond it the objective is lost to rounding
  int rounds = 10;           ///< of the augmented Lagrangian
  double smallest_step = 4;  ///< first step of a round, in stopping steps
};

/// Differential evolution [Storn, Price 1997], as pagmo has it: DE/rand/1/bin, the variant its authors begin with.
struct DifferentialParams {
  double weight = 0.7;     ///< F; theirs are 0.5 to 1
  double crossover = 0.9;  ///< CR; variables are hardly separable
  unsigned variant = 7;    ///< rand/1/bin
};

/// NSGA-II [Deb 2002]; each child has one of its variables mutated on average. The larger an index the nearer are
/// children to their parents. Deb has 15 to 20 for tens of thousands of evaluations; of a few hundred these found 1 to
/// 3 % more of the hypervolume on four to six dimensions of a dovetail.
struct GeneticParams {
  double crossover = 0.9;
  double crossover_index = 5;
  double mutation_index = 5;
};

/// The epsilon-constraint method.
struct EpsilonParams {
  /// Weight of the objectives that do not count, by the extent of what is known: where the one that counts is at its
  /// least over a whole stretch of designs, the best in the others is wanted [Mavrotas 2009].
  double others = 1e-3;
  /// Evaluations of a run, times the number of variables and one; twice as many each time all runs are done again.
  std::size_t share = 3;
};

/// When the libraries' own algorithms stop.
struct LibraryParams {
  double constraint_tolerance = 1e-8;  ///< at most; half of optimizer.constraint_margin where that is more
  double least_noise = 1e-15;          ///< of responses that are said to have none
  double acceptable = 100;             ///< slope over the aimed one at which Ipopt may stop
  int acceptable_iterations = 5;       ///< in a row
  int iterations = 1000;
};

/// An algorithm asking this often for known candidates only will not come to new ones.
inline constexpr int kMostRepeatsInARow = 5000;
/// Latin hypercubes of which the one with the widest spacing is taken. More: slightly wider, at their cost.
inline constexpr int kHypercubes = 20;

static_assert(SubstituteParams{}.unknown_rules < 0, "who reports none breaks none");
static_assert(SubstituteParams{}.failed < SubstituteParams{}.most_violation,
              "a broken rule may be worse than a failure");
static_assert(CorrectionParams{}.reserve < 1 && CorrectionParams{}.step < 1, "the search comes first");
static_assert(CorrectionParams{}.more >= 1, "a shift makes up for what was seen");
static_assert(PenaltyParams{}.weight < PenaltyParams{}.most && PenaltyParams{}.growth > 1, "weights grow");

}  // namespace dovetail::optimizer
