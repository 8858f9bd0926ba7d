#include "studies/program/commands/kept_rounds.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <tuple>

#include "core/replace_file.hpp"

namespace dovetail::studies {
namespace {

namespace fs = std::filesystem;

optimizer::AccuracyAnswer answer(double value) {
  optimizer::Evaluation evaluation;
  evaluation.responses = {{"mass_kg", value}};
  evaluation.error_sources = {{"mass_kg", {{"mesh", value / 3}}}};
  evaluation.unbounded = {"contact_pressure_max_pa"};
  evaluation.model = {{"dofs", value}};
  return {evaluation, {{"mass_kg", value / 7}}};
}

// What was cut off goes on with the same bits; another design, other settings and another question are asked.
TEST(KeptRounds, AnswerWhatWasAskedBefore) {
  const fs::path file = fs::temp_directory_path() / ("dovetail_kept_rounds_" + std::to_string(::getpid()) + ".jsonl");
  fs::remove(file);
  int computed = 0;
  const auto ask = [&](const std::string& question, int design, double mesh) {
    KeptRounds rounds(file, question);
    return rounds.at(design)({.mesh = mesh}, [&] { return answer(++computed / 9.0); });
  };
  const optimizer::AccuracyAnswer first = ask("one", 0, 1), second = ask("one", 0, 2), middle = ask("one", 1, 1);
  EXPECT_EQ(computed, 3);
  for (const auto& [known, design, mesh] : {std::tuple(first, 0, 1.0), {second, 0, 2.0}, {middle, 1, 1.0}}) {
    const optimizer::AccuracyAnswer again = ask("one", design, mesh);
    EXPECT_EQ(again.evaluation.responses, known.evaluation.responses);
    EXPECT_EQ(again.evaluation.error_sources, known.evaluation.error_sources);
    EXPECT_EQ(again.evaluation.unbounded, known.evaluation.unbounded);
    EXPECT_EQ(again.evaluation.model, known.evaluation.model);
    EXPECT_EQ(again.beside, known.beside);
  }
  EXPECT_EQ(computed, 3);
  (void)ask("another", 0, 1);
  EXPECT_EQ(computed, 4);
  // What another run writes is left to it.
  {
    const KeptRounds writing(file, "another");
    EXPECT_THROW((void)KeptRounds(file, "a third"), InputError);
  }
  (void)ask("another", 0, 1);
  EXPECT_EQ(computed, 4);
  // Cut off within a round it is computed again, however often.
  std::string text(std::istreambuf_iterator<char>(std::ifstream(file).rdbuf()), {});
  text.resize(text.rfind('\n', text.size() - 2) + 1);
  replace_file(file, text);
  const optimizer::AccuracyAnswer again = ask("another", 0, 1), known = ask("another", 0, 1);
  EXPECT_EQ(computed, 5);
  EXPECT_EQ(known.evaluation.responses, again.evaluation.responses);
  computed = 4;
  replace_file(file, "torn");
  (void)ask("another", 0, 1);
  EXPECT_EQ(computed, 5);
  KeptRounds(file, "another").forget();
  EXPECT_FALSE(fs::exists(file));
}

}  // namespace
}  // namespace dovetail::studies
