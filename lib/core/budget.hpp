#pragma once

#include <chrono>
#include <limits>
#include <memory>

#include "core/status.hpp"

namespace dovetail {

/// The work that all stages of one computation may spend together, counted in operations of dense linear algebra:
/// every march of the contact and every factorisation adds its own (steady/work.hpp). That count depends on nothing
/// but the computation, so that one which is repeated ends at the same place. Seconds, which do not, are optional.
/// Belongs to one computation on one thread.
class Budget {
 public:
  /// Both > 0; by default work is counted and not limited.
  explicit Budget(double operations = std::numeric_limits<double>::infinity(),
                  double seconds = std::numeric_limits<double>::infinity())
      : operations_(operations), seconds_(seconds), begin_(Clock::now()) {}

  void spend(double operations) { used_ += operations; }
  void spend_on_factors(double operations) {
    spend(operations);
    on_factors_ += operations;
  }
  [[nodiscard]] double used() const { return used_; }
  [[nodiscard]] double on_factors() const { return on_factors_; }  ///< the part of it that was dense factorisations
  [[nodiscard]] bool spent() const {
    if (used_ >= operations_) return true;
    return seconds_ < std::numeric_limits<double>::infinity() && elapsed() >= seconds_;
  }
  /// A budget of this part of what is left.
  [[nodiscard]] Budget part_of_rest(double part) const {
    return Budget(part * (operations_ - used_), part * (seconds_ - elapsed()));
  }

 private:
  using Clock = std::chrono::steady_clock;
  [[nodiscard]] double elapsed() const { return std::chrono::duration<double>(Clock::now() - begin_).count(); }

  double operations_, seconds_, used_ = 0, on_factors_ = 0;
  Clock::time_point begin_;
};

/// Options, and what is solved with them, share the budget of their computation. Null: nothing is counted or limited.
using SharedBudget = std::shared_ptr<Budget>;

/// Once this is true no further Jacobian is factorised.
[[nodiscard]] inline bool spent(const SharedBudget& budget) {
  return budget && budget->spent();
}

/// How a computation ended: what failed after its budget was spent failed for that.
[[nodiscard]] inline Status within(const SharedBudget& budget, Status status) {
  const bool failed = status != Status::converged && status != Status::interrupted;
  return failed && spent(budget) ? Status::budget_spent : status;
}

}  // namespace dovetail
