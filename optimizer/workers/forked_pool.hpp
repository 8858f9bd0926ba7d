#pragma once

#include <sys/types.h>

#include <chrono>
#include <functional>
#include <vector>

#include "optimizer/workers/worker_pool.hpp"

namespace dovetail::optimizer {

/// Bytes that processes may still take.
using FreeMemory = std::function<double()>;

/// Processes of this machine. A worker that crashes takes nobody along. They do not hear Ctrl-C, which is for whoever
/// hands out the work, and end with it.
class ForkedPool : public WorkerPool {
 public:
  /// - `patience_s`: > 0; a task that takes longer is given up
  /// - `free`: where given no more processes work at once than memory has room for, by the most that one has taken;
  ///   until one has answered nobody knows that, and it works alone
  ForkedPool(std::size_t size, WorkerFactory factory, double patience_s, FreeMemory free = {});
  ForkedPool(const ForkedPool&) = delete;
  ForkedPool& operator=(const ForkedPool&) = delete;
  ~ForkedPool() override;

  [[nodiscard]] std::size_t size() const override;
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

  /// The same as size(), and says so where that is fewer than there are.
  [[nodiscard]] std::size_t room();

  WorkerFactory factory_;
  std::chrono::duration<double> patience_;
  std::string common_;
  std::vector<Process> workers_;
  FreeMemory free_;
  double most_taken_ = 0;  // bytes, by one process
  std::size_t told_ = 0;   // of how many that fit
};

}  // namespace dovetail::optimizer
