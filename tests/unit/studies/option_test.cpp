#include "studies/program/commands/option.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>

#include "studies/program/commands/commands.hpp"

namespace dovetail::studies {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// What is said about the options, or nothing.
template <class Options>
std::string said(const Options& options) {
  try {
    complaints(options).raise();
    return {};
  } catch (const InputError& error) {
    return error.what();
  }
}

TEST(CommandOptions, DefaultsAreAllowed) {
  EXPECT_EQ(said(WearOptions{}), "");
  EXPECT_EQ(said(EvaluateOptions{}), "");
  EXPECT_EQ(said(ExportOptions{}), "");
}

TEST(CommandOptions, TellEverythingThatIsWrongAtOnce) {
  WearOptions options;
  options.cycles = 5;
  options.band_from_hz = std::nan("");
  options.solver.accuracy = 3;
  EXPECT_THAT(said(options), AllOf(HasSubstr("--cycles = 5: only has a meaning with --method history"),
                                   HasSubstr("--band-from = nan: must be > 0 and <= 1e+09"),
                                   HasSubstr("--band-from = nan: only has a meaning with --follow band"),
                                   HasSubstr("--accuracy = 3: must be >= 1e-08 and <= 1"),
                                   HasSubstr("--accuracy = 3: only has a meaning with --harmonics auto")));
}

TEST(CommandOptions, AMeaningMayBeOfOneValueAlone) {
  WearOptions options;
  EXPECT_EQ(said(options), "");
  options.band_points = 3;
  options.curve_points = 20;
  options.integrator = wear::IntegratorKind::explicit_jumps;
  EXPECT_THAT(said(options), AllOf(HasSubstr("--integrator = explicit: only has a meaning with --method history"),
                                   HasSubstr("--band-points = 3: only has a meaning with --follow band"),
                                   HasSubstr("--curve-points = 20: only has a meaning with --curves")));
  options = {};
  options.integrator = wear::IntegratorKind::implicit_steps;
  options.method = WearMethod::history;
  options.history_tolerance = 0;
  options.follow = Drive::resonance;
  EXPECT_THAT(said(options),
              AllOf(HasSubstr("--history-tolerance = 0: must be > 0"), Not(HasSubstr("--integrator ="))));
  EXPECT_THAT(said(options), HasSubstr("--follow = resonance: needs --integrator explicit"));
  options = {};
  options.history_tolerance = 1e-4;  // of the history that decides
  EXPECT_EQ(said(options), "");
  options.history_tolerance = 0;
  EXPECT_THAT(said(options), HasSubstr("--history-tolerance = 0: must be > 0 with --method asymptote"));
}

TEST(CommandOptions, AnyOfSeveralAlternativesGivesAMeaning) {
  ResponseOptions options;
  options.from_hz = options.to_hz = 1;
  options.solver.accuracy = 0.01;
  EXPECT_NE(said(options), "");
  options.solver.samples = "auto";
  EXPECT_EQ(said(options), "");
}

TEST(CommandOptions, SomeNeedEachOther) {
  WearOptions options;
  options.method = WearMethod::history;
  options.follow = Drive::band;
  EXPECT_THAT(said(options), AllOf(HasSubstr("--band-from: is needed with --follow band"),
                                   HasSubstr("--band-to: is needed with --follow band")));
  options.follow.reset();
  options.curve_from_hz = 1;
  EXPECT_THAT(said(options), HasSubstr("--curve-from = 1: only has a meaning with --curve-to"));
}

TEST(CommandOptions, ABackboneNeedsAForceButNoWear) {
  BackboneOptions options;
  EXPECT_THAT(said(options), AllOf(HasSubstr("--from = 0: must be > 0 with --over force"),
                                   HasSubstr("--to = 0: must be > 0 with --over force")));
  options.over = BackboneOver::wear;
  options.to = 1e-6;
  options.points = 100000;
  EXPECT_EQ(said(options), "");
  options.logarithmic = true;
  EXPECT_THAT(said(options), HasSubstr("--logarithmic: needs --from > 0 and --to > 0"));
  options.from = 1e-9;
  EXPECT_EQ(said(options), "");
  options.to = -1;
  options.points = 0;
  options.frequency_hz = 2e9;
  EXPECT_THAT(said(options), AllOf(HasSubstr("--to = -1: must be >= 0"), HasSubstr("--points = 0: must be >= 1"),
                                   HasSubstr("--frequency = 2e+09: must be > 0 and <= 1e+09")));
}

/// Every option of the commands on a model.
template <class Options>
void expect_in(const std::string& text) {
  const Options options;
  visit_options(options, [&]<class S>(const S&, std::span<const Option<S>> table) {
    for (const Option<S>& option : table)
      if (option.name.starts_with("--")) {
        EXPECT_THAT(text, HasSubstr(option.name)) << "studies/program/commands.md does not name it";
      }
  });
}

TEST(CommandOptions, AreAllOnTheirPage) {
  std::ifstream stream(PAGE_OF_COMMANDS);
  const std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  expect_in<EvaluateOptions>(text);
  expect_in<ResponseOptions>(text);
  expect_in<BackboneOptions>(text);
  expect_in<WearOptions>(text);
  expect_in<ExportOptions>(text);
  expect_in<RunOptions>(text);
}

}  // namespace
}  // namespace dovetail::studies
