#include "optimizer/workers/memory.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>
#include <string>

namespace dovetail::optimizer {

namespace {

constexpr double kKilobyte = 1024, kUnknown = std::numeric_limits<double>::infinity();

/// The number behind a name at the beginning of one of the lines of a file.
double number_in(const std::filesystem::path& file, std::string_view name, double otherwise) {
  std::ifstream lines(file);
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with(name)) continue;
    std::istringstream rest(line.substr(name.size()));
    double number = otherwise;
    return rest >> number ? number : otherwise;
  }
  return otherwise;
}

/// Names of the files of a memory group, version 2 or 1.
struct GroupFiles {
  const char *limit, *used, *reclaimed_at_need;
};
constexpr GroupFiles kVersion2{"memory.max", "memory.current", "inactive_file"},
    kVersion1{"memory.limit_in_bytes", "memory.usage_in_bytes", "total_inactive_file"};

/// What a group and those above it, up to the mounted one, leave.
double left_in_groups(const std::filesystem::path& mounted, std::filesystem::path group, const GroupFiles& files) {
  double left = kUnknown;
  for (;; group = group.parent_path()) {
    const double used = number_in(group / files.used, "", 0);
    const double cached = number_in(group / "memory.stat", files.reclaimed_at_need, 0);
    left = std::min(left, number_in(group / files.limit, "", kUnknown) - std::max(0.0, used - cached));
    if (group == mounted || !group.has_relative_path()) return left;
  }
}

}  // namespace

double free_memory_in(const std::filesystem::path& root) {
  double left = kKilobyte * number_in(root / "proc/meminfo", "MemAvailable:", kUnknown);
  const std::filesystem::path mounted = root / "sys/fs/cgroup";
  std::ifstream groups(root / "proc/self/cgroup");
  for (std::string line; std::getline(groups, line);) {  // "0::/path", or "7:memory:/path" of version 1
    const std::size_t first = line.find(':'), second = line.find(':', first + 1);
    if (second == line.npos) continue;
    const std::string kind = line.substr(first + 1, second - first - 1), path = line.substr(second + 1);
    const auto inside = [&](const std::filesystem::path& of) {
      return path == "/" ? of : of / std::filesystem::path(path).relative_path();
    };
    if (kind.empty()) left = std::min(left, left_in_groups(mounted, inside(mounted), kVersion2));
    if (kind == "memory") left = std::min(left, left_in_groups(mounted / kind, inside(mounted / kind), kVersion1));
  }
  return left;
}

double free_memory() {
  return free_memory_in("/");
}

MemoryTaken memory_taken(pid_t process) {
  const std::filesystem::path status = std::filesystem::path("/proc") / std::to_string(process) / "status";
  return {.now = kKilobyte * number_in(status, "VmRSS:", 0), .most = kKilobyte * number_in(status, "VmHWM:", 0)};
}

std::size_t processes_that_fit(double each, double taken, double free) {
  constexpr double kMost = 1e6;
  return static_cast<std::size_t>(std::clamp(std::floor((free + taken) / each), 1.0, kMost));
}

}  // namespace dovetail::optimizer
