#pragma once

#include <string_view>

#include "contact/slip_return.hpp"
#include "core/budget.hpp"
#include "core/enum_names.hpp"
#include "core/options.hpp"

namespace dovetail::steady {

/// What solves the equations. Each starts from the guess or closed contact and, with `penalty_cascade`, tries other
/// pseudo-penalties where that fails.
enum class Solver {
  automatic,  ///< Newton's method; with `penalty_cascade` also over neighbouring problems (paths/ways.hpp)
  newton,     ///< Newton's method, no neighbouring problems
  powell,     ///< hybrid Powell with the exact Jacobian
  powell_fd,  ///< the same with finite differences, for comparison
};
constexpr EnumNames<Solver, 4> enum_names(Solver) {
  return {{{Solver::automatic, "auto"},
           {Solver::newton, "newton"},
           {Solver::powell, "powell"},
           {Solver::powell_fd, "powell_fd"}}};
}
[[nodiscard]] constexpr std::string_view to_string(Solver solver) {
  return name_of(solver);
}

/// How a steady state is computed. Flat; see option_table<Options>() for keys, ranges and help.
struct Options {
  int harmonics = 5;        ///< H >= 1
  int samples = 128;        ///< N > 2H per period
  double tolerance = 1e-9;  ///< of the residual force relative to the excitation, > 0
  int max_iterations = 60;  ///< Jacobians per pseudo-penalty tried, >= 1
  Solver solver = Solver::automatic;
  double normal_penalty = 0;         ///< eps_N of all nodes, N/m; 0: local contact stiffness
  double tangential_penalty = 0;     ///< eps_T of all nodes, N/m; 0: local contact stiffness
  double penalty_scale = 1;          ///< multiplies both, > 0
  bool penalty_cascade = true;       ///< try other ratios, then what else the solver has, when a solve fails
  int max_rescue_iterations = 5000;  ///< Jacobians that auto spends on neighbouring problems, >= 0
  contact::SlipReturn slip_return = contact::SlipReturn::second_order;
  int max_periods = 2000;             ///< marched before a node counts as not periodic, >= 2
  double periodic_tolerance = 1e-10;  ///< of the slip state, relative to the largest limit force, > 0
  bool linearise = true;              ///< keep the factorised Jacobian of the solution, for predictors and derivatives
  /// Show that the Jacobian of the solution is regular, which takes a factorisation; may be left out without
  /// `linearise` for a state next to one that was shown to be.
  bool show_regular = true;
  SharedBudget budget = {};  ///< of everything computed with these options; null: not limited

  /// The same with one method and one eps, no fallbacks: failing is cheap and says where a branch ends.
  [[nodiscard]] Options plain() const;
};

/// Throws InputError listing every option out of range.
void validate(const Options& options);

}  // namespace dovetail::steady

namespace dovetail {
template <>
std::span<const Field<steady::Options>> option_table<steady::Options>();
}
