#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>

namespace dovetail::optimizer {

/// What came of a task.
struct Finished {
  std::size_t task = 0;                    ///< its place among those handed out
  std::optional<std::string> answer = {};  ///< nothing where whoever worked on it ended without one
  std::string ended = {};                  ///< how, in words: "killed by signal 11 (Segmentation fault)"
};

/// Answers a task, both as text.
using Worker = std::function<std::string(const std::string& task)>;
/// Makes a worker of what all tasks have in common; called where the worker is.
using WorkerFactory = std::function<Worker(const std::string& common)>;

/// Others who work on independent tasks: processes of this machine, or of many.
class WorkerPool {
 public:
  WorkerPool() = default;
  WorkerPool(const WorkerPool&) = delete;
  WorkerPool& operator=(const WorkerPool&) = delete;
  virtual ~WorkerPool() = default;

  /// How many tasks are worked on at once.
  [[nodiscard]] virtual std::size_t size() const = 0;

  /// From now on workers are made with this; those that are have answered all they were asked.
  virtual void prepare(const std::string& common) = 0;

  /// Hands out the tasks in their order, each to the next who is free, and tells of each on this thread as it ends.
  /// When `told` returns false no more are handed out, and those under way are still told of. A task whose worker ended
  /// or took too long is told without an answer, and another worker is made.
  virtual void run(std::span<const std::string> tasks, const std::function<bool(Finished)>& told) = 0;
};

}  // namespace dovetail::optimizer
