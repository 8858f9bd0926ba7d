#pragma once

#include <chrono>
#include <condition_variable>
#include <filesystem>
#include <mutex>
#include <thread>

namespace dovetail::studies {

/// The seconds that a run takes over all its sessions, kept in its directory: of one that is killed all but the last
/// few. A thread of its own writes them.
class RunClock {
 public:
  /// A session begins.
  /// @param resume  it goes on with the run there
  RunClock(const std::filesystem::path& directory, bool resume);
  ~RunClock();
  RunClock(const RunClock&) = delete;
  RunClock& operator=(const RunClock&) = delete;

  /// The directory is this run's: from now on its time is kept to the end, however short it was.
  void counts() { counts_ = true; }
  /// s, of this session
  [[nodiscard]] double session() const;
  /// s, of all of them
  [[nodiscard]] double total() const { return before_ + session(); }

 private:
  using Clock = std::chrono::steady_clock;
  void keep();

  std::filesystem::path directory_;
  Clock::time_point begin_ = Clock::now();
  double before_ = 0;
  bool counts_ = false;
  std::mutex mutex_;
  std::condition_variable_any ends_;
  std::jthread writer_;
};

/// s, of all sessions of the run in the directory; 0 where it is not known.
[[nodiscard]] double seconds_taken(const std::filesystem::path& directory);
/// Says so of a run that is made of others.
void keep_seconds_taken(const std::filesystem::path& directory, double seconds);

}  // namespace dovetail::studies
