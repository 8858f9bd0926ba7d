#include "optimizer/journal/journal.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <limits>

#include "core/errors.hpp"
#include "core/options.hpp"
#include "scratch_file.hpp"

namespace dovetail::optimizer {
namespace {

Evaluation rich() {
  Evaluation e;
  e.status = "wear: iteration_limit";
  e.feasible = false;
  e.parameters = {{"geometry.a_um", 0.1 + 0.2}};
  e.responses = {{"tiny", 5e-324}, {"nan", std::nan("")}, {"up", kInfinity}, {"down", -kInfinity}, {"zero", -0.0}};
  e.constraints = {{"rule:wall", 1.0 / 3}};
  e.error_estimates = {{"tiny", 0x1.fffffffffffffp-1}};
  e.model = {{"dofs", 26700}};
  e.timings_s = {{"mesh", 0.25}};
  e.messages = {"wall of the neck is \"thin\"\n\xff"};
  e.derivatives = {{"tiny", {1, std::nan(""), -kInfinity}}};
  return e;
}

void expect_same_bits(double a, double b) {
  if (std::isnan(a) && std::isnan(b)) return;
  EXPECT_EQ(std::bit_cast<std::uint64_t>(a), std::bit_cast<std::uint64_t>(b)) << a << " " << b;
}

class JournalFile : public ScratchFile {
 protected:
  void write_three() {
    Journal journal = Journal::create(file, "study-1");
    for (const double i : {0.0, 1.0, 2.0}) journal.append(std::vector{i, 0.1 * i}, rich());
  }
};

TEST_F(JournalFile, ReadsBackEveryBit) {
  write_three();
  const JournalContents contents = read_journal(file);
  EXPECT_EQ(contents.fingerprint, "study-1");
  EXPECT_TRUE(contents.note.empty());
  ASSERT_EQ(contents.records.size(), 3U);
  const JournalRecord& record = contents.records[2];
  expect_same_bits(record.x[1], 0.1 * 2);
  const Evaluation expected = rich();
  const Evaluation& found = record.evaluation;
  EXPECT_EQ(found.status, expected.status);
  EXPECT_EQ(found.feasible, expected.feasible);
  EXPECT_EQ(found.parameters, expected.parameters);
  ASSERT_EQ(found.responses.size(), expected.responses.size());
  for (const auto& [name, value] : expected.responses) expect_same_bits(found.responses.at(name), value);
  EXPECT_EQ(found.constraints, expected.constraints);
  EXPECT_EQ(found.error_estimates, expected.error_estimates);
  EXPECT_EQ(found.model, expected.model);
  EXPECT_EQ(found.timings_s, expected.timings_s);
  ASSERT_EQ(found.derivatives.at("tiny").size(), 3U);
  for (std::size_t i = 0; i < 3; ++i)
    expect_same_bits(found.derivatives.at("tiny")[i], expected.derivatives.at("tiny")[i]);
  EXPECT_EQ(found.messages[0], "wall of the neck is \"thin\"\n\xEF\xBF\xBD");
}

TEST_F(JournalFile, ToleratesATornLastLineAtEveryByte) {
  write_three();
  const std::string whole = contents();
  const std::size_t header = whole.find('\n') + 1;
  const std::size_t last = whole.rfind('\n', whole.size() - 2) + 1;
  for (std::size_t length = last + 1; length < whole.size(); ++length) {
    overwrite(whole.substr(0, length));
    const JournalContents read = read_journal(file);
    ASSERT_EQ(read.records.size(), 2U) << length;
    ASSERT_THAT(read.note, ::testing::HasSubstr("line 4 was cut short"));
    ASSERT_EQ(read.valid_bytes, last);
  }
  for (std::size_t length = 0; length < header; ++length) {
    overwrite(whole.substr(0, length));
    ASSERT_TRUE(read_journal(file).records.empty());
    ASSERT_EQ(Journal::resume(file, "study-1").size(), 0U);
    ASSERT_EQ(read_journal(file).fingerprint, "study-1");
  }
}

// What a process took with it says nothing of the design: whoever resumes asks again.
TEST_F(JournalFile, ForgetsWhatWasLostWithAProcess) {
  {
    Journal journal = Journal::create(file, "study-1");
    Evaluation lost, of_case, answered;
    lost.status = "worker: ended by signal 9";
    of_case.status = "case a: worker: gave no answer in 1 s";
    answered.status = "preload: iteration_limit";
    for (const auto& [x, evaluation] : {std::pair{0.0, lost}, {1.0, of_case}, {2.0, answered}})
      journal.append(std::vector{x}, evaluation);
  }
  Journal journal = Journal::resume(file, "study-1");
  ASSERT_EQ(journal.records().size(), 1U);
  EXPECT_EQ(journal.records()[0].x[0], 2);
  journal.append(std::vector{0.0}, rich());
  EXPECT_EQ(read_journal(file).records.size(), 4U);
}

TEST_F(JournalFile, ContinuesAfterATornLine) {
  write_three();
  const std::string whole = contents();
  overwrite(whole.substr(0, whole.size() - 10));
  {
    Journal journal = Journal::resume(file, "study-1");
    EXPECT_EQ(journal.size(), 2U);
    EXPECT_FALSE(journal.note().empty());
    journal.append(std::vector{2.0, 0.1 * 2}, rich());
  }
  EXPECT_EQ(contents(), whole);
}

TEST_F(JournalFile, RefusesAnyChangedByteBeforeTheLastLine) {
  write_three();
  const std::string whole = contents();
  const std::size_t last = whole.rfind('\n', whole.size() - 2) + 1;
  for (std::size_t at = 0; at < last; at += 3) {
    std::string damaged = whole;
    damaged[at] = static_cast<char>(damaged[at] ^ 1);
    overwrite(damaged);
    ASSERT_THROW(static_cast<void>(read_journal(file)), InputError) << at;
    ASSERT_THROW(static_cast<void>(Journal::resume(file, "study-1")), InputError) << at;
    ASSERT_EQ(contents(), damaged) << "a refused file must not be changed";
  }
}

TEST_F(JournalFile, RefusesAMissingOrRepeatedLine) {
  write_three();
  const std::string whole = contents();
  const std::size_t first = whole.find('\n') + 1;
  const std::size_t second = whole.find('\n', first) + 1;
  overwrite(whole.substr(0, first) + whole.substr(second));
  try {
    static_cast<void>(read_journal(file));
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.violations()[0].line, 2);
    EXPECT_THAT(error.what(), ::testing::HasSubstr("record 1 where record 0 belongs"));
  }
  overwrite(whole.substr(0, second) + whole.substr(first));
  EXPECT_THROW(static_cast<void>(read_journal(file)), InputError);
}

TEST_F(JournalFile, RefusesAnotherStudy) {
  write_three();
  const std::string before = contents();
  try {
    static_cast<void>(Journal::resume(file, "study-2"));
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), ::testing::AllOf(::testing::HasSubstr("must belong to the study at hand"),
                                               ::testing::HasSubstr("choose another folder")));
  }
  EXPECT_EQ(contents(), before);
}

TEST_F(JournalFile, RefusesOtherFilesAndLeavesThemAlone) {
  for (const std::string text : {"[optimizer]\nalgorithm = 'cobyla'\n", "no newline", "{\"a\":1}\n"}) {
    overwrite(text);
    EXPECT_THROW(static_cast<void>(Journal::resume(file, "study-1")), InputError);
    EXPECT_EQ(contents(), text);
  }
  EXPECT_THROW(static_cast<void>(read_journal(file.string() + ".missing")), InputError);
}

TEST_F(JournalFile, IsNotOverwrittenByANewRun) {
  write_three();
  EXPECT_THROW(static_cast<void>(Journal::create(file, "study-1")), InputError);
}

TEST_F(JournalFile, HasOneWriterAtATime) {
  const Journal journal = Journal::create(file, "study-1");
  try {
    static_cast<void>(Journal::resume(file, "study-1"));
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("in use"));
  }
}

TEST_F(JournalFile, MergesThoseOfOneStudy) {
  write_three();
  const std::filesystem::path other = file.string() + ".other", merged = file.string() + ".merged";
  {
    Journal journal = Journal::create(other, "study-1");
    for (const double i : {2.0, 3.0, 4.0}) journal.append(std::vector{i, 0.1 * i}, Evaluation{});
  }
  EXPECT_EQ(merge_journals(std::vector{file, other}, merged), 5U);
  const JournalContents contents = read_journal(merged);
  ASSERT_EQ(contents.records.size(), 5U);
  EXPECT_EQ(contents.records[2].evaluation.status, rich().status);  // the first to have it
  std::filesystem::remove(other);
  std::filesystem::remove(merged);
  { Journal journal = Journal::create(other, "study-2"); }
  EXPECT_THROW(merge_journals(std::vector{file, other}, merged), InputError);
  std::filesystem::remove(other);
}

}  // namespace
}  // namespace dovetail::optimizer
