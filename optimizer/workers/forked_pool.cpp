#include "optimizer/workers/forked_pool.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <iostream>
#include <mutex>
#include <set>
#include <system_error>
#include <utility>

#include "optimizer/workers/memory.hpp"

namespace dovetail::optimizer {

namespace {

/// Whether all of it was written or read; not where the other side has ended.
bool write_all(int to, const char* data, std::size_t size) {
  while (size > 0) {
    const ssize_t count = ::write(to, data, size);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    data += count;
    size -= static_cast<std::size_t>(count);
  }
  return true;
}

bool read_all(int from, char* data, std::size_t size) {
  while (size > 0) {
    const ssize_t count = ::read(from, data, size);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    data += count;
    size -= static_cast<std::size_t>(count);
  }
  return true;
}

/// A text with its length before it.
bool send(int to, const std::string& text) {
  const std::uint64_t size = text.size();
  std::array<char, sizeof size> head{};
  std::memcpy(head.data(), &size, sizeof size);
  return write_all(to, head.data(), head.size()) && write_all(to, text.data(), text.size());
}

std::optional<std::string> receive(int from) {
  std::uint64_t size = 0;
  std::array<char, sizeof size> head{};
  if (!read_all(from, head.data(), head.size())) return {};
  std::memcpy(&size, head.data(), sizeof size);
  std::string text(size, '\0');
  if (!read_all(from, text.data(), text.size())) return {};
  return text;
}

/// The life of a worker: it answers until nobody asks.
[[noreturn]] void work(const WorkerFactory& factory, const std::string& common, int from, int to) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  std::signal(SIGINT, SIG_IGN);
  std::signal(SIGPIPE, SIG_DFL);
  int status = EXIT_SUCCESS;
  try {
    const Worker worker = factory(common);
    while (const std::optional<std::string> task = receive(from))
      if (!send(to, worker(*task))) break;
  } catch (const std::exception& error) {
    std::cerr << "dovetail: a worker: " << error.what() << std::endl;
    status = EXIT_FAILURE;
  }
  // Nothing of the process it was made from is to be written or removed a second time.
  std::_Exit(status);
}

/// The ends of pipes to workers that this process holds, of all pools. One that stayed open in another worker would
/// keep its own alive.
struct Held {
  std::mutex mutex;
  std::set<int> descriptors;
};

Held& held() {
  static Held all;
  return all;
}

std::string words(int status) {
  if (WIFSIGNALED(status)) return fmt::format("ended by signal {} ({})", WTERMSIG(status), strsignal(WTERMSIG(status)));
  return fmt::format("ended with exit status {}", WEXITSTATUS(status));
}

}  // namespace

ForkedPool::ForkedPool(std::size_t size, WorkerFactory factory, double patience_s, FreeMemory free)
    : factory_(std::move(factory)), patience_(patience_s), workers_(size), free_(std::move(free)), told_(size) {}

ForkedPool::~ForkedPool() {
  for (Process& process : workers_) static_cast<void>(end(process, process.task.has_value()));
}

void ForkedPool::prepare(const std::string& common) {
  for (Process& process : workers_) static_cast<void>(end(process, false));
  common_ = common;
}

void ForkedPool::start(Process& process) {
  std::array<int, 2> asks{}, answers{};
  const std::scoped_lock one(held().mutex);
  if (::pipe2(asks.data(), O_CLOEXEC) != 0) throw std::system_error(errno, std::generic_category(), "pipe");
  if (::pipe2(answers.data(), O_CLOEXEC) != 0) throw std::system_error(errno, std::generic_category(), "pipe");
  std::cout.flush();
  std::cerr.flush();
  const pid_t id = ::fork();
  if (id < 0) throw std::system_error(errno, std::generic_category(), "fork");
  if (id == 0) {
    for (const int descriptor : held().descriptors) ::close(descriptor);
    ::close(asks[1]);
    ::close(answers[0]);
    work(factory_, common_, asks[0], answers[1]);
  }
  ::close(asks[0]);
  ::close(answers[1]);
  held().descriptors.insert({asks[1], answers[0]});
  process = {.id = id, .to = asks[1], .from = answers[0], .task = {}, .since = {}};
}

std::string ForkedPool::end(Process& process, bool kill) {
  if (process.id < 0) return {};
  if (kill) ::kill(process.id, SIGKILL);
  {
    const std::scoped_lock one(held().mutex);
    for (const int descriptor : {process.to, process.from}) {
      held().descriptors.erase(descriptor);
      ::close(descriptor);
    }
  }
  int status = 0;
  while (::waitpid(process.id, &status, 0) < 0 && errno == EINTR) {
  }
  process = {};
  return words(status);
}

void ForkedPool::hand_out(Process& process, std::size_t task, const std::string& text) {
  if (process.id < 0) start(process);
  process.task = task;
  process.since = Clock::now();
  // One that has ended is heard of when it is read from.
  static_cast<void>(send(process.to, text));
}

Finished ForkedPool::heard(Process& process) {
  Finished result{.task = process.task.value()};
  const bool late = Clock::now() - process.since > patience_;
  pollfd ready{.fd = process.from, .events = POLLIN, .revents = 0};
  if (::poll(&ready, 1, 0) > 0) result.answer = receive(process.from);
  most_taken_ = std::max(most_taken_, memory_taken(process.id).most);
  process.task.reset();
  if (!result.answer) {
    result.ended = end(process, late);
    if (late) result.ended = fmt::format("gave no answer in {:g} s", patience_.count());
  }
  return result;
}

std::vector<std::size_t> ForkedPool::waited() const {
  std::vector<pollfd> ready;
  std::vector<std::size_t> places, found;
  double left = patience_.count();
  const auto now = Clock::now();
  for (std::size_t i = 0; i < workers_.size(); ++i) {
    if (!workers_[i].task) continue;
    ready.push_back({.fd = workers_[i].from, .events = POLLIN, .revents = 0});
    places.push_back(i);
    left = std::min(left, patience_.count() - std::chrono::duration<double>(now - workers_[i].since).count());
  }
  // A signal ends the wait early, which its handler's flag is looked at after.
  constexpr double kLongest = 1e6;
  const int milliseconds = static_cast<int>(1000 * std::clamp(left, 0.0, kLongest)) + 1;
  if (::poll(ready.data(), ready.size(), milliseconds) < 0 && errno != EINTR)
    throw std::system_error(errno, std::generic_category(), "poll");
  for (std::size_t i = 0; i < places.size(); ++i)
    if (ready[i].revents != 0 || Clock::now() - workers_[places[i]].since > patience_) found.push_back(places[i]);
  return found;
}

std::size_t ForkedPool::size() const {
  if (!free_) return workers_.size();
  if (most_taken_ == 0) return 1;
  double taken = 0;
  for (const Process& process : workers_)
    if (process.id >= 0) taken += memory_taken(process.id).now;
  return std::min(workers_.size(), processes_that_fit(most_taken_, taken, free_()));
}

std::size_t ForkedPool::room() {
  const std::size_t fit = size();
  if (most_taken_ == 0 || fit >= told_) return fit;
  constexpr double kGigabyte = 1e9;
  std::cerr
      << fmt::format(
             "dovetail: memory has room for {} of {} processes: one takes up to {:.2g} GB (--jobs N has N of them "
             "all the same)",
             fit, workers_.size(), most_taken_ / kGigabyte)
      << std::endl;
  told_ = fit;
  return fit;
}

void ForkedPool::run(std::span<const std::string> tasks, const std::function<bool(Finished)>& told) {
  // Writing to a worker that has ended is no reason to end, too.
  const auto before = std::signal(SIGPIPE, SIG_IGN);
  std::size_t next = 0, under_way = 0;
  bool goes_on = true;
  while (true) {
    for (Process& process : workers_) {
      if (!goes_on || next == tasks.size()) break;
      if (process.task) continue;
      if (under_way > 0 && under_way >= room()) break;
      hand_out(process, next, tasks[next]);
      ++next;
      ++under_way;
    }
    if (under_way == 0) break;
    for (const std::size_t place : waited()) {
      --under_way;
      goes_on = told(heard(workers_[place])) && goes_on;
    }
  }
  std::signal(SIGPIPE, before);
}

}  // namespace dovetail::optimizer
