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

  [[nodiscard]] const std::atomic<bool>& flag() const;
  [[nodiscard]] bool requested() const { return flag().load(); }
};

/// What the handler says from now on, on standard error: where the first Ctrl-C only asks, what is finished; where the
/// process ends, what of its work is kept. Not from a handler.
void say_when_interrupted(const std::string& under_way, const std::string& kept);
/// What Ctrl-C does while an OrderlyInterrupt lives, where another handles the signal.
void request_interrupt();

/// Handles SIGINT and SIGTERM of this process from now on. One that ends the process removes the file being written.
void install_interrupt_handler();

}  // namespace dovetail::studies
