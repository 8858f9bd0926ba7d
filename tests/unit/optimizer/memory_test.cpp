// What memory leaves room for.
#include "optimizer/workers/memory.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <vector>

namespace dovetail::optimizer {
namespace {

constexpr double kGigabyte = 1024.0 * 1024 * 1024;

/// Files of a machine, below a folder that goes with the test.
class Machine : public testing::Test {
 protected:
  void SetUp() override {
    root_ = std::filesystem::temp_directory_path() / ("dovetail_memory_" + std::to_string(::getpid()));
    write("proc/meminfo", "MemTotal:       16777216 kB\nMemAvailable:    8388608 kB\n");
  }
  void TearDown() override { std::filesystem::remove_all(root_); }

  void write(const std::string& name, const std::string& text) const {
    std::filesystem::create_directories((root_ / name).parent_path());
    std::ofstream(root_ / name) << text;
  }
  [[nodiscard]] double free() const { return free_memory_in(root_) / kGigabyte; }

  std::filesystem::path root_;
};

TEST_F(Machine, HasWhatItSaysIsAvailable) {
  EXPECT_EQ(free(), 8);
  std::filesystem::remove(root_ / "proc/meminfo");
  EXPECT_TRUE(std::isinf(free()));
}

TEST_F(Machine, MayBeSharedByGroupsWithLessForEach) {
  write("proc/self/cgroup", "0::/batch/job\n");
  write("sys/fs/cgroup/batch/job/memory.max", "max\n");
  write("sys/fs/cgroup/batch/job/memory.current", "1073741824\n");
  EXPECT_EQ(free(), 8);
  // A group above it counts, too, and what is only kept in case it is read again does not.
  write("sys/fs/cgroup/batch/memory.max", "4294967296\n");
  write("sys/fs/cgroup/batch/memory.current", "2147483648\n");
  EXPECT_EQ(free(), 2);
  write("sys/fs/cgroup/batch/memory.stat", "anon 5\ninactive_file 1073741824\n");
  EXPECT_EQ(free(), 3);
}

TEST_F(Machine, MayHaveGroupsOfTheFirstVersion) {
  write("proc/self/cgroup", "9:cpu:/other\n7:memory:/job\n");
  write("sys/fs/cgroup/memory/job/memory.limit_in_bytes", "2147483648\n");
  write("sys/fs/cgroup/memory/job/memory.usage_in_bytes", "1073741824\n");
  EXPECT_EQ(free(), 1);
  write("sys/fs/cgroup/memory/job/memory.limit_in_bytes", "9223372036854771712\n");
  EXPECT_EQ(free(), 8);
}

TEST(Memory, OfThisProcessIsKnown) {
  const MemoryTaken before = memory_taken(::getpid());
  ASSERT_GT(before.now, 0);
  std::vector<char> more(200 << 20, 'x');
  EXPECT_GT(memory_taken(::getpid()).most, before.now + 0.9 * static_cast<double>(more.size()));
  EXPECT_EQ(memory_taken(-1).most, 0);
  EXPECT_GT(free_memory(), 0);
}

TEST(Memory, HasRoomForOneAtLeast) {
  EXPECT_EQ(processes_that_fit(2, 3, 6), 4U);
  EXPECT_EQ(processes_that_fit(2, 0, 1), 1U);
  EXPECT_EQ(processes_that_fit(2, 0, -9), 1U);
  EXPECT_GT(processes_that_fit(1, 0, INFINITY), 100U);
}

}  // namespace
}  // namespace dovetail::optimizer
