#include "studies/program/answers/teller.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstring>
#include <iostream>
#include <utility>

#include "core/signals_held.hpp"
#include "studies/program/engine/interrupt.hpp"
#include "studies/program/engine/json_values.hpp"
#include "studies/program/study_file/refusal.hpp"

namespace dovetail::studies {
namespace {

constexpr TellerParams kTeller;
constexpr std::string_view kEventBegin = R"({"event")";

double seconds_since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

}  // namespace

std::string time_words(double seconds) {
  constexpr double kMinute = 60, kHour = 3600;
  if (seconds < 2 * kMinute) return fmt::format("{:.0f} s", std::ceil(seconds));
  if (seconds < 2 * kHour) return fmt::format("{:.0f} min", std::ceil(seconds / kMinute));
  return fmt::format("{:.1f} h", seconds / kHour);
}

Teller::Teller(std::ostream& err, const TellChoice& choice, bool plain)
    : err_(err),
      terminal_(&err == &std::cerr && ::isatty(STDERR_FILENO) != 0),
      shows_(!choice.quiet && (plain || terminal_)),
      quiet_(choice.quiet) {
  if (choice.log == "-") refuse("--json-log", "must be a file", choice.log);
  if (!choice.log.empty()) {
    if (std::ifstream before(choice.log); before && before.peek() != std::ifstream::traits_type::eof()) {
      std::string begin(kEventBegin.size(), ' ');
      before.read(begin.data(), static_cast<std::streamsize>(begin.size()));
      if (begin != kEventBegin) refuse("--json-log", "exists, and is no log that could be gone on with", choice.log);
    }
    errno = 0;
    log_.open(choice.log, std::ios::app);
    if (!log_) refuse("--json-log", std::string("cannot be written: ") + std::strerror(errno), choice.log);
  }
  // Of all streams the standard ones alone may be written to by two threads.
  if (!shows_ || &err != &std::cerr) return;
  // Signals are for the thread that computes.
  const SignalsHeld held;
  thread_ = std::thread([this] { tick(); });
}

Teller::~Teller() {
  end();
  {
    const std::scoped_lock lock(mutex_);
    ended_ = true;
  }
  wake_.notify_all();
  if (thread_.joinable()) thread_.join();
}

void Teller::begin(const std::string& what, double expected_s, int all) {
  event("stage", {{"what", what}});
  say_when_interrupted(what, kept_);
  const std::scoped_lock lock(mutex_);
  what_ = what;
  expected_ = expected_s;
  all_ = all;
  done_ = 0;
  const auto words = [this](double seconds) {
    std::string text = "dovetail: " + what_;
    if (all_ > 0) text += fmt::format(" ({} of {})", std::min(done_ + 1, all_), all_);
    text += ": " + time_words(seconds);
    const double left = done_ > 0 ? seconds / done_ * (all_ - done_) : expected_ - seconds;
    return left > 0 ? text + ", about " + time_words(left) + " to go" : text;
  };
  enter(words, terminal_ ? kTeller.terminal_first : kTeller.plain_first);
}

void Teller::step(int done) {
  const std::scoped_lock lock(mutex_);
  done_ = done;
}

void Teller::status(Words words, const std::string& under_way) {
  say_when_interrupted(under_way, kept_);
  const std::scoped_lock lock(mutex_);
  if (shows_) show(words(0));
  enter(std::move(words), terminal_ ? kTeller.terminal_every : kTeller.plain_first);
}

void Teller::end() {
  const std::scoped_lock lock(mutex_);
  stage_.words = {};
  clear();
}

std::ostream& Teller::remark() {
  const std::scoped_lock lock(mutex_);
  clear();
  return quiet_ ? silence_ : err_;
}

void Teller::event(const char* name, const nlohmann::ordered_json& fields) {
  if (!log_.is_open()) return;
  Json json{{"event", name}, {"seconds", std::round(1e3 * seconds_since(begin_)) / 1e3}};
  json.update(fields);
  log_ << json.dump(-1, ' ', false, Json::error_handler_t::replace) << std::endl;
}

void Teller::keeps(const std::string& kept) {
  kept_ = kept;
  say_when_interrupted(what_, kept_);
}

void Teller::enter(Words words, double next) {
  stage_ = {.words = std::move(words), .begin = Clock::now(), .next = next};
}

void Teller::show(const std::string& text) {
  if (terminal_) {
    err_ << "\r\033[K" << text << std::flush;
    open_ = true;
  } else {
    err_ << text << std::endl;
  }
}

void Teller::clear() {
  if (std::exchange(open_, false)) err_ << "\r\033[K" << std::flush;
}

void Teller::tick() {
  constexpr std::chrono::milliseconds kLook{200};
  std::unique_lock lock(mutex_);
  while (!ended_) {
    wake_.wait_for(lock, kLook);
    if (ended_ || !stage_.words || seconds_since(stage_.begin) < stage_.next) continue;
    show(stage_.words(seconds_since(stage_.begin)));
    stage_.next = terminal_ ? stage_.next + kTeller.terminal_every : kTeller.plain_times * stage_.next;
  }
}

}  // namespace dovetail::studies
