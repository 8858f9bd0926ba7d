#include "core/replace_file.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <sstream>

#include "core/errors.hpp"

namespace dovetail {
namespace {

namespace fs = std::filesystem;

/// A folder of its own, removed at the end.
class ReplaceFile : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder_); }
  void TearDown() override { fs::remove_all(folder_); }

  [[nodiscard]] std::ptrdiff_t files() const {
    return std::distance(fs::directory_iterator(folder_), fs::directory_iterator());
  }
  [[nodiscard]] static std::string content(const fs::path& file) {
    std::ostringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
  }
  const fs::path folder_ = fs::temp_directory_path() / ("dovetail_replace_" + std::to_string(::getpid()));
};

TEST_F(ReplaceFile, LeavesTheNewContentAlone) {
  const fs::path file = folder_ / "a.json";
  replace_file(file, "old and long");
  replace_file(file, "new");
  EXPECT_EQ(content(file), "new");
  EXPECT_EQ(files(), 1);
}

TEST_F(ReplaceFile, WritesBesideTheTargetWithItsEnding) {
  const fs::path file = folder_ / "a.json";
  replace_file(file, [&](const fs::path& place) {
    EXPECT_EQ(place.parent_path(), folder_);
    EXPECT_EQ(place.extension(), ".json");
    EXPECT_NE(place, file);
    std::ofstream(place) << "text";
  });
  EXPECT_EQ(content(file), "text");
}

TEST_F(ReplaceFile, KeepsTheOldFileWhenWritingFails) {
  const fs::path file = folder_ / "a.json";
  replace_file(file, "old");
  const auto fail = [](const fs::path& place) {
    std::ofstream(place) << "half";
    throw std::runtime_error("no more");
  };
  EXPECT_THROW(replace_file(file, fail), std::runtime_error);
  EXPECT_EQ(content(file), "old");
  EXPECT_EQ(files(), 1);
}

TEST_F(ReplaceFile, RefusesWhatCannotBeWritten) {
  EXPECT_THROW(replace_file(folder_ / "missing" / "a.json", "x"), InputError);
  EXPECT_THROW(replace_file(folder_, "x"), InputError);
  EXPECT_THROW(replace_file("", "x"), InputError);
  // Nothing was written where a file was promised: there is nothing to rename.
  EXPECT_THROW(replace_file(folder_ / "a.json", [](const fs::path&) {}), InputError);
  EXPECT_EQ(files(), 0);
}

TEST_F(ReplaceFile, WritesToADeviceWithoutReplacingIt) {
  replace_file("/dev/null", "x");
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

TEST_F(ReplaceFile, AnInterruptRemovesTheFileBeingWritten) {
  remove_unfinished_file();  // nothing is being written
  const fs::path file = folder_ / "a.json";
  const auto interrupted = [&](const fs::path& place) {
    std::ofstream(place) << "half";
    EXPECT_EQ(files(), 1);
    remove_unfinished_file();
    EXPECT_EQ(files(), 0);
  };
  EXPECT_THROW(replace_file(file, interrupted), InputError);
  replace_file(file, "whole");
  remove_unfinished_file();
  EXPECT_EQ(content(file), "whole");
}

}  // namespace
}  // namespace dovetail
