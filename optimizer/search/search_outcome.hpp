#pragma once

#include <cstdint>
#include <exception>
#include <string>
#include <vector>

#include "optimizer/search/search_functions.hpp"

namespace dovetail::optimizer {

/// What a run says that ended for want of evaluations.
inline constexpr const char* kBudgetUsedUp = "the budget of evaluations is used up";

/// How one run of an algorithm ended. The candidates are in the session.
struct SearchOutcome {
  Status status = Status::stalled;
  std::string message;
};

/// How it ended, for people.
[[nodiscard]] inline std::string words_of(const SearchOutcome& outcome) {
  if (outcome.status == Status::iteration_limit && outcome.message.empty()) return kBudgetUsedUp;
  if (outcome.status == Status::interrupted) return "interrupted; everything finished is kept";
  return outcome.message;
}

/// Keeps what a callback throws while a C library is on the stack: `run` returns false once anything was thrown, and
/// the caller rethrows when the library has returned.
class CallbackGuard {
 public:
  template <class Callback>
  bool run(Callback&& callback) {
    if (error_) return false;
    try {
      callback();
      return true;
    } catch (...) {
      error_ = std::current_exception();
      return false;
    }
  }
  [[nodiscard]] bool failed() const { return static_cast<bool>(error_); }
  void rethrow() const {
    if (error_) std::rethrow_exception(error_);
  }

 private:
  std::exception_ptr error_;
};

}  // namespace dovetail::optimizer
