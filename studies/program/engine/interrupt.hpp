#pragma once

#include <atomic>
#include <string>

namespace dovetail::studies {

/// Exit status of a process that was interrupted.
inline constexpr int kInterrupted = 130;

/// While it lives, the first Ctrl-C (or SIGTERM) only sets the flag, for the computation to end in order; the second
/// ends the process with status 130. Without one, install_interrupt_handler lets the first end the process.
class OrderlyInterrupt {
 public:
  OrderlyInterrupt();
  ~OrderlyInterrupt();
  OrderlyInterrupt(const OrderlyInterrupt&) = delete;
  OrderlyInterrupt& operator=(const OrderlyInterrupt&) = delete;

  [[nodiscard]] const std::atomic<bool>& flag() const { return flag_; }
  [[nodiscard]] bool requested() const { return flag_.load(); }

 private:
  const std::atomic<bool>& flag_;
};

/// While it lives, an OrderlyInterrupt of this thread looks at this flag, and signals and other threads' computations
/// are nothing to it: for who handles signals himself, or computes in several threads.
class AskedToEnd {
 public:
  explicit AskedToEnd(std::atomic<bool>& flag);
  ~AskedToEnd();
  AskedToEnd(const AskedToEnd&) = delete;
  AskedToEnd& operator=(const AskedToEnd&) = delete;

 private:
  std::atomic<bool>* before_;
};

/// What the handler says from now on, on standard error: where the first Ctrl-C only asks, what is finished; where the
/// process ends, what of its work is kept. Not from a handler.
void say_when_interrupted(const std::string& under_way, const std::string& kept);
/// Asks the computation of this thread to end in order.
void request_interrupt();

/// Handles SIGINT and SIGTERM of this process from now on. One that ends the process removes the file being written.
void install_interrupt_handler();

}  // namespace dovetail::studies
