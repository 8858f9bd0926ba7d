#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace dovetail::optimizer {

/// A file of the test's own that is gone afterwards.
class ScratchFile : public ::testing::Test {
 protected:
  ScratchFile() {
    const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
    std::string name = std::string("dovetail-") + info->test_suite_name() + "-" + info->name();
    std::replace(name.begin(), name.end(), '/', '-');
    // Thousands of flushed records take minutes on a disk and no time in memory.
    const std::filesystem::path memory = "/dev/shm";
    const bool fast = ::access(memory.c_str(), W_OK) == 0;
    file = (fast ? memory : std::filesystem::temp_directory_path()) / (name + "-" + std::to_string(::getpid()));
    std::filesystem::remove(file);
  }
  ~ScratchFile() override { std::filesystem::remove(file); }

  [[nodiscard]] std::string contents() const {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  void overwrite(const std::string& text) const { std::ofstream(file, std::ios::binary) << text; }

  std::filesystem::path file;
};

}  // namespace dovetail::optimizer
