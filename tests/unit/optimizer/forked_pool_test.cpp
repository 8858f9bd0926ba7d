// Workers that are processes: who ends or hangs takes nobody along.
#include "optimizer/workers/forked_pool.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace dovetail::optimizer {
namespace {

using testing::HasSubstr;

/// Answers with what all tasks have in common, the task and who it is; dies, throws or sleeps when it is asked to.
WorkerFactory odd() {
  return [](const std::string& common) -> Worker {
    return [common](const std::string& task) -> std::string {
      if (task == "die") std::raise(SIGKILL);
      if (task == "exit") std::_Exit(7);
      if (task == "throw") throw std::runtime_error("no more");
      if (task == "sleep") std::this_thread::sleep_for(std::chrono::seconds(60));
      return common + ":" + task + ":" + std::to_string(::getpid());
    };
  };
}

std::map<std::size_t, Finished> run(ForkedPool& pool, const std::vector<std::string>& tasks) {
  std::map<std::size_t, Finished> told;
  pool.run(tasks, [&](Finished finished) {
    const std::size_t task = finished.task;
    EXPECT_TRUE(told.emplace(task, std::move(finished)).second);
    return true;
  });
  EXPECT_EQ(told.size(), tasks.size());
  return told;
}

TEST(ForkedPool, AnswersEveryTaskInOtherProcesses) {
  ForkedPool pool(3, odd(), 60);
  pool.prepare("a");
  const std::vector<std::string> tasks(20, "x");
  std::set<std::string> workers;
  for (const auto& [task, finished] : run(pool, tasks)) {
    ASSERT_TRUE(finished.answer);
    EXPECT_THAT(*finished.answer, HasSubstr("a:x:"));
    workers.insert(finished.answer->substr(4));
  }
  EXPECT_LE(workers.size(), 3U);
  EXPECT_FALSE(workers.contains(std::to_string(::getpid())));
  pool.prepare("b");
  EXPECT_THAT(*run(pool, {"y"}).at(0).answer, HasSubstr("b:y:"));
}

TEST(ForkedPool, LongTextsComeThroughWhole) {
  ForkedPool pool(
      2, [](const std::string&) { return [](const std::string& task) { return task + task; }; }, 60);
  pool.prepare("");
  const std::string text(3000000, 'q');
  for (const auto& [task, finished] : run(pool, {text, text, text})) EXPECT_EQ(*finished.answer, text + text);
}

TEST(ForkedPool, WhoEndsIsReplacedAndTold) {
  ForkedPool pool(2, odd(), 60);
  pool.prepare("");
  const std::map<std::size_t, Finished> told = run(pool, {"x", "die", "x", "exit", "throw", "x", "x"});
  for (const std::size_t task : {0, 2, 5, 6}) EXPECT_TRUE(told.at(task).answer) << task;
  for (const std::size_t task : {1, 3, 4}) EXPECT_FALSE(told.at(task).answer) << task;
  EXPECT_THAT(told.at(1).ended, HasSubstr("signal 9"));
  EXPECT_THAT(told.at(3).ended, HasSubstr("exit status 7"));
}

TEST(ForkedPool, WhoHangsIsGivenUp) {
  ForkedPool pool(2, odd(), 0.3);
  pool.prepare("");
  const std::map<std::size_t, Finished> told = run(pool, {"sleep", "x", "x"});
  EXPECT_THAT(told.at(0).ended, HasSubstr("gave no answer in 0.3 s"));
  EXPECT_TRUE(told.at(1).answer && told.at(2).answer);
}

/// Answers with how many work at that moment, by files in a folder, this one among them.
WorkerFactory counting() {
  return [](const std::string& folder) -> Worker {
    return [folder](const std::string&) -> std::string {
      const std::filesystem::path own = std::filesystem::path(folder) / std::to_string(::getpid());
      std::ofstream(own) << "here";
      std::this_thread::sleep_for(std::chrono::milliseconds(30));
      const auto all = std::distance(std::filesystem::directory_iterator(folder), {});
      std::filesystem::remove(own);
      return std::to_string(all);
    };
  };
}

TEST(ForkedPool, NoMoreWorkAtOnceThanMemoryHasRoomFor) {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("dovetail_pool_" + std::to_string(::getpid()));
  const auto most_at_once = [&](double free, std::string& said) {
    std::filesystem::create_directories(folder);
    ForkedPool pool(4, counting(), 60, [free] { return free; });
    pool.prepare(folder.string());
    testing::internal::CaptureStderr();
    int most = 0;
    bool first = true;
    pool.run(std::vector<std::string>(24, "x"), [&](const Finished& finished) {
      // What one takes is not known before it has answered.
      EXPECT_TRUE(!first || *finished.answer == "1");
      first = false;
      most = std::max(most, std::stoi(*finished.answer));
      return true;
    });
    said = testing::internal::GetCapturedStderr();
    std::filesystem::remove_all(folder);
    return most;
  };
  std::string said;
  EXPECT_GT(most_at_once(1e15, said), 2);
  EXPECT_EQ(said, "");
  EXPECT_EQ(most_at_once(0, said), 1);
  EXPECT_THAT(said, HasSubstr("dovetail: memory has room for 1 of 4 processes: one takes up to"));
}

// A worker of the one must not hold the other's pipes: neither would ever end.
TEST(ForkedPool, TwoAtOnceEndOneAfterTheOther) {
  auto first = std::make_unique<ForkedPool>(2, odd(), 60), second = std::make_unique<ForkedPool>(2, odd(), 60);
  first->prepare("a");
  second->prepare("b");
  EXPECT_EQ(run(*first, {"x", "y"}).size(), 2U);
  EXPECT_EQ(run(*second, {"x", "y"}).size(), 2U);
  first.reset();
  second.reset();
}

TEST(ForkedPool, NoMoreIsHandedOutWhenToldSo) {
  ForkedPool pool(2, odd(), 60);
  pool.prepare("");
  int told = 0;
  pool.run(std::vector<std::string>(30, "x"), [&](const Finished&) { return ++told < 5; });
  EXPECT_GE(told, 5);
  EXPECT_LE(told, 6);
}

}  // namespace
}  // namespace dovetail::optimizer
