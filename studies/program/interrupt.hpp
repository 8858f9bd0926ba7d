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

/// Handles SIGINT and SIGTERM of this process from now on.
void install_interrupt_handler();

/// While it lives, an interrupt that ends the process removes this file first. One at a time.
class RemoveOnInterrupt {
 public:
  explicit RemoveOnInterrupt(const std::string& file);
  ~RemoveOnInterrupt();
  RemoveOnInterrupt(const RemoveOnInterrupt&) = delete;
  RemoveOnInterrupt& operator=(const RemoveOnInterrupt&) = delete;
};

}  // namespace dovetail::studies
