#pragma once

#include <chrono>
#include <filesystem>

namespace dovetail::studies {

/// The seconds that a run takes over all its sessions, kept in its directory: of one that is killed all but the last
/// few.
class RunClock {
 public:
  /// A session begins.
  /// @param resume  it goes on with the run there
  RunClock(const std::filesystem::path& directory, bool resume);
  ~RunClock();
  RunClock(const RunClock&) = delete;
  RunClock& operator=(const RunClock&) = delete;

  /// s, of this session
  [[nodiscard]] double session() const;
  /// s, of all of them
  [[nodiscard]] double total() const { return before_ + session(); }
  /// Keeps the total where it was not for some seconds.
  void tick();

 private:
  using Clock = std::chrono::steady_clock;
  void keep();

  std::filesystem::path directory_;
  Clock::time_point begin_ = Clock::now();
  double before_ = 0, kept_ = 0;
};

/// s, of all sessions of the run in the directory; 0 where it is not known.
[[nodiscard]] double seconds_taken(const std::filesystem::path& directory);
/// Says so of a run that is made of others.
void keep_seconds_taken(const std::filesystem::path& directory, double seconds);

}  // namespace dovetail::studies
