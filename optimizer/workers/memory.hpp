#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string_view>

namespace dovetail::optimizer {

/// Bytes that processes may still take: of the machine, or of the control groups that this process is in, such as a
/// batch system's, where these leave less. Infinite where nothing tells.
[[nodiscard]] double free_memory();

/// The same as the files below a root have it: its proc/meminfo, proc/self/cgroup and sys/fs/cgroup.
[[nodiscard]] double free_memory_in(const std::filesystem::path& root);

/// What a process of this machine takes, and the most it has taken, in bytes; 0 where nothing tells.
struct MemoryTaken {
  double now = 0, most = 0;
};
[[nodiscard]] MemoryTaken memory_taken(pid_t process);

/// How many processes that take up to `each` bytes fit into `free` bytes beside what `taken` of them take now, one at
/// least.
[[nodiscard]] std::size_t processes_that_fit(double each, double taken, double free);

}  // namespace dovetail::optimizer
