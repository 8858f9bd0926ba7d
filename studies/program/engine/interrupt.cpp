#include "studies/program/engine/interrupt.hpp"

#include <unistd.h>

#include <csignal>

#include "core/replace_file.hpp"

namespace dovetail::studies {
namespace {

// What a signal handler may touch: lock-free atomics.
std::atomic<bool> stop_requested{false};
std::atomic<bool> orderly{false};
static_assert(std::atomic<bool>::is_always_lock_free);

extern "C" void on_interrupt(int) {
  if (orderly.load() && !stop_requested.exchange(true)) return;
  remove_unfinished_file();
  constexpr char kWords[] = "\ndovetail: interrupted\n";
  if (::write(STDERR_FILENO, kWords, sizeof kWords - 1) < 0) ::_exit(kInterrupted);  // nobody listens
  ::_exit(kInterrupted);
}

}  // namespace

OrderlyInterrupt::OrderlyInterrupt() {
  stop_requested = false;
  orderly = true;
}
OrderlyInterrupt::~OrderlyInterrupt() {
  orderly = false;
}
const std::atomic<bool>& OrderlyInterrupt::flag() const {
  return stop_requested;
}

void request_interrupt() {
  stop_requested = true;
}

void install_interrupt_handler() {
  struct sigaction action {};
  action.sa_handler = on_interrupt;
  sigemptyset(&action.sa_mask);
  action.sa_flags = SA_RESTART;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

}  // namespace dovetail::studies
