#pragma once

#include <sys/types.h>

#include <chrono>
#include <vector>

#include "optimizer/workers/worker_pool.hpp"

namespace dovetail::optimizer {

/// Processes of this machine. A worker that crashes takes nobody along. They do not hear Ctrl-C, which is for whoever
/// hands out the work, and end with it.
class ForkedPool : public WorkerPool {
 public:
  /// @param patience_s  > 0; a task that takes longer is given up
  ForkedPool(std::size_t size, WorkerFactory factory, double patience_s);
  ForkedPool(const ForkedPool&) = delete;
  ForkedPool& operator=(const ForkedPool&) = delete;
  ~ForkedPool() override;

  [[nodiscard]] std::size_t size() const override { return workers_.size(); }
  void prepare(const std::string& common) override;
  void run(std::span<const std::string> tasks, const std::function<bool(Finished)>& told) override;

 private:
  using Clock = std::chrono::steady_clock;
  struct Process {
    pid_t id = -1;           // -1: none
    int to = -1, from = -1;  // pipes
    std::optional<std::size_t> task = {};
    Clock::time_point since = {};
  };

  void start(Process& process);
  /// Ends it, with the words of how it ended.
  static std::string end(Process& process, bool kill);
  void hand_out(Process& process, std::size_t task, const std::string& text);
  /// What a worker came to that has something to say, or nothing.
  [[nodiscard]] Finished heard(Process& process);
  /// Until some worker has something to say or has taken too long. @return the places of those
  [[nodiscard]] std::vector<std::size_t> waited() const;

  WorkerFactory factory_;
  std::chrono::duration<double> patience_;
  std::string common_;
  std::vector<Process> workers_;
};

}  // namespace dovetail::optimizer
