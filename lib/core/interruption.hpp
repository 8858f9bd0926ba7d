#pragma once

#include <atomic>
#include <utility>

namespace dovetail {

/// Thrown out of a computation that was told to end at once. No std::exception: nothing that turns errors into answers
/// catches it.
struct Interrupted {};

namespace interruption {
inline thread_local const std::atomic<bool>* asked = nullptr;  ///< of this thread; null: nobody asks
}

/// While it lives, computations on this thread end with Interrupted once `flag` is true. What they were to answer is
/// lost: those that hand over what is finished have a stop of their own (wear::Watcher, optimizer::RunHooks).
class Interruptible {
 public:
  explicit Interruptible(const std::atomic<bool>& flag) : before_(std::exchange(interruption::asked, &flag)) {}
  ~Interruptible() { interruption::asked = before_; }
  Interruptible(const Interruptible&) = delete;
  Interruptible& operator=(const Interruptible&) = delete;

 private:
  const std::atomic<bool>* before_;
};

/// Called where a long computation comes by every few hundredths of a second: before sparse factorisations, steps of
/// eigenvalue searches, and marches of the contact.
inline void end_if_interrupted() {
  if (interruption::asked != nullptr && interruption::asked->load(std::memory_order_relaxed)) throw Interrupted{};
}

}  // namespace dovetail
