#include "studies/program/engine/interrupt.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstring>
#include <string>
#include <utility>

#include "core/replace_file.hpp"

namespace dovetail::studies {
namespace {

// What a signal handler may touch: lock-free atomics and memory that does not move.
std::atomic<bool> stop_requested{false};
std::atomic<bool> orderly{false};
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<int>::is_always_lock_free);

/// A sentence that may be exchanged while a handler reads it: new ones are written beside the one that is valid.
class Sentence {
 public:
  void set(const std::string& text) {
    const int next = 1 - shown_.load();
    std::array<char, 512>& place = texts_.at(static_cast<std::size_t>(next));
    const std::size_t length = std::min(text.size(), place.size() - 1);
    std::memcpy(place.data(), text.data(), length);
    place[length] = '\0';
    shown_ = next;
  }
  /// Nothing can be done where nobody listens.
  void write() const {
    const char* text = texts_[static_cast<std::size_t>(shown_.load())].data();
    if (::write(STDERR_FILENO, text, std::strlen(text)) < 0) return;
  }

 private:
  std::array<std::array<char, 512>, 2> texts_{};
  std::atomic<int> shown_{0};
};
Sentence finishing, ending;

thread_local std::atomic<bool>* asked_to_end = nullptr;  // null: signals ask

extern "C" void on_interrupt(int) {
  if (orderly.load() && !stop_requested.exchange(true)) return finishing.write();
  remove_unfinished_file();
  ending.write();
  ::_exit(kInterrupted);
}

}  // namespace

void say_when_interrupted(const std::string& under_way, const std::string& kept) {
  if (asked_to_end != nullptr) return;  // nobody hears it, and of all threads only one may change it
  finishing.set("\ndovetail: finishing " + under_way + "; Ctrl-C again to stop now\n");
  ending.set("\ndovetail: interrupted; " + kept + "\n");
}

OrderlyInterrupt::OrderlyInterrupt() : flag_(asked_to_end != nullptr ? *asked_to_end : stop_requested) {
  if (asked_to_end != nullptr) return;
  stop_requested = false;
  orderly = true;
}
OrderlyInterrupt::~OrderlyInterrupt() {
  if (&flag_ == &stop_requested) orderly = false;
}

AskedToEnd::AskedToEnd(std::atomic<bool>& flag) : before_(std::exchange(asked_to_end, &flag)) {}
AskedToEnd::~AskedToEnd() {
  asked_to_end = before_;
}

void request_interrupt() {
  (asked_to_end != nullptr ? *asked_to_end : stop_requested) = true;
}

void install_interrupt_handler() {
  say_when_interrupted("what is under way", "nothing is written");
  struct sigaction action {};
  action.sa_handler = on_interrupt;
  sigemptyset(&action.sa_mask);
  action.sa_flags = SA_RESTART;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

}  // namespace dovetail::studies
