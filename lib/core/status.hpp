#pragma once

#include <string_view>

#include "core/enum_names.hpp"

namespace dovetail {

/// How an iterative computation ended. Non-convergence is a value a caller must look at: no solver
/// of this project throws because it did not converge, and none returns `converged` when it did not.
enum class Status {
  converged,        ///< the stopping rule of the solver holds
  iteration_limit,  ///< the allowed number of iterations was used up
  stalled,          ///< steps or decrease fell below what double precision resolves
  singular,         ///< a linear system could not be solved
  not_finite,       ///< a NaN or infinity appeared
  not_periodic,     ///< the contact march did not become periodic
  no_bracket,       ///< a scalar search found no sign change / no extremum in its range
  interrupted,      ///< the caller asked to stop
  gross_sliding,    ///< rest only with nearly the whole contact worn off (wear/asymptote/gross_sliding.hpp)
  budget_spent,     ///< the work allowed for the whole computation was used up (core/budget.hpp)
};

constexpr EnumNames<Status, 10> enum_names(Status) {
  return {{{Status::converged, "converged"},
           {Status::iteration_limit, "iteration_limit"},
           {Status::stalled, "stalled"},
           {Status::singular, "singular"},
           {Status::not_finite, "not_finite"},
           {Status::not_periodic, "not_periodic"},
           {Status::no_bracket, "no_bracket"},
           {Status::interrupted, "interrupted"},
           {Status::gross_sliding, "gross_sliding"},
           {Status::budget_spent, "budget_spent"}}};
}
[[nodiscard]] constexpr std::string_view to_string(Status status) {
  return name_of(status);
}

/// Ended from outside: this says nothing about what was to be solved.
[[nodiscard]] constexpr bool cut_short(Status status) {
  return status == Status::interrupted || status == Status::budget_spent;
}

}  // namespace dovetail
