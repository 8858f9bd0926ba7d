#include "studies/program/interrupt.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <climits>
#include <csignal>

namespace dovetail::studies {
namespace {

// What a signal handler may touch: lock-free atomics and memory that does not move.
std::atomic<bool> stop_requested{false};
std::atomic<bool> orderly{false};
std::atomic<bool> has_file{false};
std::array<char, PATH_MAX> file_name{};
static_assert(std::atomic<bool>::is_always_lock_free);

extern "C" void on_interrupt(int) {
  if (orderly.load() && !stop_requested.exchange(true)) return;
  if (has_file.load()) ::unlink(file_name.data());
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

void install_interrupt_handler() {
  struct sigaction action {};
  action.sa_handler = on_interrupt;
  sigemptyset(&action.sa_mask);
  action.sa_flags = SA_RESTART;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

RemoveOnInterrupt::RemoveOnInterrupt(const std::string& file) {
  if (file.size() + 1 > file_name.size()) return;
  std::copy(file.begin(), file.end(), file_name.begin());
  file_name[file.size()] = '\0';
  has_file = true;
}
RemoveOnInterrupt::~RemoveOnInterrupt() {
  has_file = false;
}

}  // namespace dovetail::studies
