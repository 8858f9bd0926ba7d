#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <thread>

#include "core/replace_file.hpp"
#include "optimizer/journal/journal.hpp"
#include "studies/program/commands/commands.hpp"
#include "studies/program/commands/kept_rounds.hpp"
#include "studies/program/commands/told.hpp"
#include "studies/program/engine/engine.hpp"
#include "studies/program/engine/interrupt.hpp"
#include "studies/program/run/run_clock.hpp"
#include "studies/report/record/results_file.hpp"
#include "tests/unit/studies/sample_study.hpp"

namespace dovetail::studies {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

/// A new directory that goes with the test.
class Run : public testing::Test {
 protected:
  void SetUp() override {
    directory_ = fs::temp_directory_path() /
                 ("dovetail_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()) + "_" +
                  std::to_string(::getpid()));
    fs::remove_all(directory_);
    fs::create_directories(directory_);
    std::string text = replaced(study_template("sample"), "max_evaluations = 100", "max_evaluations = 40");
    replace_file(study(), text);
  }
  void TearDown() override { fs::remove_all(directory_); }

  [[nodiscard]] std::string study() const { return (directory_ / "study.toml").string(); }
  [[nodiscard]] fs::path results() const { return directory_ / "out"; }

  int run(bool resume, const RunEngineFactory& factory, int jobs = 1) {
    const RunOptions options{.study = study(), .directory = results().string(), .resume = resume, .jobs = jobs};
    out_.str("");
    err_.str("");
    return run_study(options, {.out = out_, .err = err_}, factory);
  }

  int merged(const MergeOptions& options) {
    const Streams streams{.out = out_, .err = err_};
    return told({}, {}, streams, [&](Teller& teller) { return run_merge(options, teller, streams); });
  }

  fs::path directory_;
  std::ostringstream out_, err_;
};

/// A bowl with its bottom at (10, 3, 9), in place of the physics.
optimizer::Evaluation bowl(std::span<const double> x) {
  optimizer::Evaluation evaluation;
  const double volume =
      1 + std::pow((x[0] - 10) / 30, 2) + std::pow((x[1] - 3) / 13, 2) + std::pow((x[2] - 9) / 1.5, 2);
  evaluation.responses = {
      {"asymptotic_wear_volume_m3", volume * 1e-10}, {"contact_pressure_mean_pa", 100e6}, {"post_width_m", 8e-3}};
  return evaluation;
}

RunEngineFactory counted(int& calls) {
  return [&calls](const Study&) {
    return RunEngine{.evaluate =
                         [&calls](std::span<const double> x) {
                           ++calls;
                           return bowl(x);
                         },
                     .describe = {}};
  };
}

TEST_F(Run, WritesAStudyThatEvaluatesToTheBestDesign) {
  int calls = 0;
  ASSERT_EQ(run(false, counted(calls)), kDone) << err_.str();
  EXPECT_LE(calls, 40);
  const Study best = load_study((results() / "best.toml").string());
  const auto records = optimizer::read_journal(results() / "journal.jsonl").records;
  double least = kInfinity;
  std::vector<double> x;
  for (const auto& record : records)
    if (record.evaluation.responses.at("asymptotic_wear_volume_m3") < least) {
      least = record.evaluation.responses.at("asymptotic_wear_volume_m3");
      x = record.x;
    }
  EXPECT_LT(least, bowl(std::vector<double>{0, 0, 8.5}).responses.at("asymptotic_wear_volume_m3"));
  EXPECT_EQ(optimizer::parameter(best.scene, "geometry.flank_mismatch_um"), x[0]);
  EXPECT_EQ(optimizer::parameter(best.scene, "geometry.flank_crown_um"), x[1]);
  EXPECT_EQ(optimizer::parameter(best.scene, "geometry.neck_width_mm"), x[2]);
  EXPECT_TRUE(fs::exists(results() / "best.dxf"));
  EXPECT_THAT(err_.str(), HasSubstr("evaluation 1/40: "));
  EXPECT_THAT(err_.str(), HasSubstr(" to go"));
}

std::string text_of(const fs::path& file) {
  std::ifstream stream(file);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// Two bowls, of wear and of mass, with bars and a limit.
RunEngineFactory two_bowls(int& barred) {
  return [&barred](const Study&) {
    RunEngine engine{.evaluate =
                         [](std::span<const double> x) {
                           optimizer::Evaluation e = bowl(x);
                           e.responses["mass_kg"] = 0.1 + 0.01 * std::pow((x[0] - 20) / 30, 2);
                           return e;
                         },
                     .describe = {}};
    engine.barred = [&barred, evaluate = engine.evaluate](std::span<const double> x) {
      ++barred;
      optimizer::Evaluation e = evaluate(x);
      e.error_estimates = {{"asymptotic_wear_volume_m3", 1e-12}, {"mass_kg", 1e-4}};
      e.responses["mass_kg"] += 1e-5;  // what a closer look changes is within the bar
      return e;
    };
    engine.piece = [evaluate = engine.evaluate, barred = engine.barred](const Piece& piece) {
      return piece.what == Piece::What::barred ? barred(piece.x) : evaluate(piece.x);
    };
    return engine;
  };
}

std::vector<std::vector<std::string>> table_of(const fs::path& csv) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream lines(text_of(csv));
  for (std::string line; std::getline(lines, line);) {
    rows.emplace_back();
    std::istringstream cells(line + ",");
    for (std::string cell; std::getline(cells, cell, ',');) rows.back().push_back(cell);
  }
  return rows;
}

TEST_F(Run, HandsOverAFront) {
  std::string text = replaced(text_of(study()), "weight = 1\n", "reference = 1.5e-10\n");
  text = replaced(text, "algorithm = \"cobyla\"", "algorithm = \"nsga2\"");
  text = replaced(text, "front_points = 12", "front_points = 4");
  replace_file(study(),
               replaced(text, "population = 0", "population = 8") + "\n[[objective]]\nresponse = \"mass_kg\"\n");
  int barred = 0;
  ASSERT_EQ(run(false, two_bowls(barred)), kDone) << err_.str();
  EXPECT_THAT(out_.str(), testing::AllOf(HasSubstr("front of "), HasSubstr("asymptotic_wear_volume_m3 = 1.5e-10"),
                                         HasSubstr("compromise, nearest to the best of each: evaluation ")));
  const auto rows = table_of(results() / "front.csv");
  const std::vector<std::string>& head = rows.front();
  const auto column = [&](const std::string& name) {
    const auto found = std::ranges::find(head, name);
    EXPECT_NE(found, head.end()) << name;
    return static_cast<std::size_t>(found - head.begin());
  };
  ASSERT_GT(rows.size(), 3U);
  const std::size_t wear = column("asymptotic_wear_volume_m3"), mass = column("mass_kg"), bar = column("mass_kg_bar");
  int with_bars = 0;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    ASSERT_EQ(rows[i].size(), head.size());
    if (i > 1) {
      EXPECT_GT(std::stod(rows[i][wear]), std::stod(rows[i - 1][wear]));
      EXPECT_LT(std::stod(rows[i][mass]), std::stod(rows[i - 1][mass]));
    }
    if (!rows[i][bar].empty()) {
      ++with_bars;
      EXPECT_NEAR(std::stod(rows[i][bar]), 1.1e-4, 1e-9);
    }
    const Study point = load_study((results() / rows[i][column("study")]).string());
    EXPECT_DOUBLE_EQ(optimizer::parameter(point.scene, "geometry.flank_mismatch_um"),
                     std::stod(rows[i][column("geometry.flank_mismatch_um")]));
  }
  EXPECT_EQ(rows[1][column("objective mass_kg")], rows[1][mass]);
  EXPECT_GE(with_bars, 4);
  EXPECT_EQ(with_bars, barred);
  const report::RunRecord record = report::read_results(results() / "results.h5");
  ASSERT_TRUE(record.front);
  EXPECT_EQ(record.front->evaluation.size(), rows.size() - 1);
  EXPECT_EQ(record.front->reference[0], 1.5e-10);
  EXPECT_EQ(record.front->evaluation[static_cast<std::size_t>(record.front->compromise)],
            static_cast<std::int64_t>(record.best.value()));

  // Nothing is computed again, nor different with more processes.
  const std::string csv = text_of(results() / "front.csv"), said = out_.str();
  ASSERT_EQ(run(true, two_bowls(barred)), kDone) << err_.str();
  EXPECT_EQ(barred, with_bars);
  EXPECT_EQ(text_of(results() / "front.csv"), csv);
  fs::remove_all(results());
  ASSERT_EQ(run(false, two_bowls(barred), 3), kDone) << err_.str();
  EXPECT_EQ(out_.str(), said);
  EXPECT_EQ(text_of(results() / "front.csv"), csv);
}

// Every row is of the search, also that of the design which was looked at more closely; what comes near to a number is
// shown as how far it is from it.
TEST_F(Run, ShowsAFrontAsTheSearchSawIt) {
  std::string text = replaced(text_of(study()), "weight = 1\n", "");
  text = replaced(text, "algorithm = \"cobyla\"", "algorithm = \"nsga2\"");
  replace_file(study(), text + "\n[[objective]]\nresponse = \"mass_kg\"\naim = 0.1005\n");
  int barred = 0;
  const RunEngineFactory closer = [&](const Study& study) {
    RunEngine engine = two_bowls(barred)(study);
    engine.describe = [evaluate = engine.evaluate, keys = study.problem.space.keys()](const optimizer::Scene& scene) {
      std::vector<double> x;
      for (const std::string& key : keys) x.push_back(optimizer::parameter(scene, key));
      DescribedDesign seen{.evaluation = evaluate(x), .record = {}};
      for (auto& [name, value] : seen.evaluation.responses) value *= 1.25;
      seen.record.status = "converged";
      return seen;
    };
    return engine;
  };
  ASSERT_EQ(run(false, closer), kDone) << err_.str();
  EXPECT_THAT(out_.str(), HasSubstr("  |mass_kg - 0.1005| from "));
  const auto rows = table_of(results() / "front.csv");
  const auto column = [&](const std::string& name) {
    return static_cast<std::size_t>(std::ranges::find(rows.front(), name) - rows.front().begin());
  };
  const std::size_t distance = column("objective |mass_kg - 0.1005|"), mass = column("mass_kg");
  ASSERT_LT(distance, rows.front().size());
  for (std::size_t i = 1; i < rows.size(); ++i) {
    EXPECT_NEAR(std::stod(rows[i][distance]), std::abs(std::stod(rows[i][mass]) - 0.1005), 1e-15) << i;
    EXPECT_EQ(rows[i][column("objective asymptotic_wear_volume_m3")], rows[i][column("asymptotic_wear_volume_m3")]);
    EXPECT_NEAR(std::stod(rows[i][column("constraint post_width_m:lower")]),
                (4e-3 - std::stod(rows[i][column("post_width_m")])) / 4e-3, 1e-12);
  }
}

// What follows from the variables is in every file that is handed over, and another formula is another study.
TEST_F(Run, HandsOverLinkedKeys) {
  const std::string text = text_of(study()), key = "geometry.shank_width_mm";
  const auto linked = [&](const char* formula) {
    replace_file(study(), text + "\n[[linked]]\nkey = \"" + key + "\"\nvalue = \"" + formula + "\"\n");
  };
  linked("geometry_neck_width_mm + 2.5");
  int calls = 0;
  ASSERT_EQ(run(false, counted(calls)), kDone) << err_.str();
  const Study best = load_study((results() / "best.toml").string());
  EXPECT_NE(optimizer::parameter(best.scene, "geometry.neck_width_mm"), 8.5) << "the start";
  EXPECT_DOUBLE_EQ(optimizer::parameter(best.scene, key),
                   optimizer::parameter(best.scene, "geometry.neck_width_mm") + 2.5);
  EXPECT_THAT(text_of(results() / "best.toml"),
              testing::ContainsRegex("\nshank_width_mm = 11\\.|\nshank_width_mm = 1[0-9]"));
  EXPECT_THAT(out_.str(), HasSubstr("  " + key + " = "));
  const report::RunRecord record = report::read_results(results() / "results.h5");
  EXPECT_EQ(record.provenance.linked.at(key), "geometry_neck_width_mm + 2.5");
  ASSERT_EQ(run(true, counted(calls)), kDone) << err_.str();
  linked("2 * geometry_neck_width_mm - 6");  // the same at the start
  EXPECT_THROW(run(true, counted(calls)), InputError);
}

// Where a link has no value at an end of a range, there is no design there, and nothing is said against the others.
TEST_F(Run, LooksForHopeWhereLinkedKeysHaveValuesAlone) {
  replace_file(study(), text_of(study()) +
                            "\n[[linked]]\nkey = \"geometry.shank_width_mm\"\nvalue = \"11 + 0 * "
                            "sqrt(geometry_neck_width_mm - 8.2)\"\n");
  const RunEngineFactory with_rules = [](const Study& study) {
    RunEngine engine{.evaluate = bowl, .describe = {}};
    engine.rules = [study](std::span<const double> x) {
      if (std::isnan(optimizer::parameter(scene_at(study, x), "geometry.shank_width_mm")))
        throw InputError(
            Violation{.file = {}, .key = "geometry.shank_width_mm", .value = "nan", .allowed = "must be > 0"});
      return std::vector<geometry::Rule>{{.name = "wall", .margin = -0.1, .sentence = "the wall is thin"}};
    };
    return engine;
  };
  EXPECT_EQ(run(false, with_rules), kDone) << err_.str();
}

// Parts of a scan that know nothing of each other are, together, the scan of a whole run.
TEST_F(Run, ComputesItsScanInParts) {
  replace_file(study(), replaced(text_of(study()), "scan_evaluations = 0", "scan_evaluations = 7"));
  int calls = 0;
  ASSERT_EQ(run(false, counted(calls)), kDone) << err_.str();
  const int whole = calls;
  const auto records = [&](const fs::path& in) { return optimizer::read_journal(in / "journal.jsonl").records; };
  const auto of_whole = records(results());
  const auto part = [&](const std::string& text, const std::string& into) {
    out_.str("");
    return run_study({.study = study(), .directory = (directory_ / into).string(), .jobs = 1, .part = text},
                     {.out = out_, .err = err_}, counted(calls));
  };
  MergeOptions merge{.directories = {}, .directory = (directory_ / "merged").string()};
  std::set<std::vector<double>> seen;
  for (const std::string number : {"1", "2", "3"}) {
    calls = 0;
    ASSERT_EQ(part(number + "/3", "part" + number), kDone) << err_.str();
    EXPECT_EQ(calls, number == "1" ? 1 + 3 : 1 + 2);
    EXPECT_THAT(out_.str(), HasSubstr("part " + number + " of 3 of the scan"));
    EXPECT_FALSE(fs::exists(directory_ / ("part" + number) / "best.toml"));
    for (const auto& record : records(directory_ / ("part" + number))) seen.insert(record.x);
    merge.directories.push_back((directory_ / ("part" + number)).string());
  }
  EXPECT_EQ(seen.size(), 8U);
  ASSERT_EQ(merged(merge), kDone);
  calls = 0;
  ASSERT_EQ(run_study({.study = study(), .directory = merge.directory, .resume = true, .jobs = 1},
                      {.out = out_, .err = err_}, counted(calls)),
            kDone);
  EXPECT_EQ(calls, whole - 8);
  EXPECT_EQ(text_of(directory_ / "merged" / "best.toml"), text_of(results() / "best.toml"));
  for (const auto& record : records(directory_ / "merged")) seen.insert(record.x);
  EXPECT_EQ(seen.size(), of_whole.size());
  for (const char* wrong : {"3", "0/3", "4/3", "1/3x", "a/b", "1/", "-1/2"})
    EXPECT_THROW(part(wrong, "none"), InputError) << wrong;
  replace_file(study(), replaced(text_of(study()), "scan_evaluations = 7", "scan_evaluations = 0"));
  EXPECT_THROW(part("1/3", "none"), InputError) << "there is no scan";
}

/// The bowl; it kills its process where the first variable is in a band.
RunEngine deadly() {
  return {.evaluate =
              [](std::span<const double> x) {
                if (x[0] > 18) std::raise(SIGKILL);
                return bowl(x);
              },
          .describe = {}};
}

TEST_F(Run, GivesTheSameBitsWithAnyNumberOfProcesses) {
  replace_file(study(), replaced(text_of(study()), "scan_evaluations = 0", "scan_evaluations = 12"));
  int calls = 0;
  ASSERT_EQ(run(false, counted(calls)), kDone) << err_.str();
  const std::string alone = text_of(results() / "journal.jsonl"), said = out_.str();
  for (const int jobs : {2, 5}) {
    fs::remove_all(results());
    ASSERT_EQ(run(false, counted(calls), jobs), kDone) << err_.str();
    EXPECT_EQ(text_of(results() / "journal.jsonl"), alone) << jobs;
    EXPECT_EQ(out_.str(), said) << jobs;
  }
}

// A crash is one candidate that failed, with the command that does the same again.
TEST_F(Run, SurvivesProcessesThatDie) {
  replace_file(study(), replaced(text_of(study()), "scan_evaluations = 0", "scan_evaluations = 12"));
  ASSERT_EQ(run(
                false, [](const Study&) { return deadly(); }, 2),
            kDone)
      << err_.str();
  int failed = 0;
  for (const auto& record : optimizer::read_journal(results() / "journal.jsonl").records) {
    EXPECT_EQ(record.evaluation.converged(), record.x[0] <= 18);
    if (record.evaluation.converged()) continue;
    ++failed;
    EXPECT_THAT(record.evaluation.status, HasSubstr("worker: ended by signal 9"));
    EXPECT_THAT(record.evaluation.messages.back(), HasSubstr("--set geometry.flank_mismatch_um="));
  }
  EXPECT_GT(failed, 0);
  // Such a run is not finished: what was lost is asked again, and has an answer where nothing kills its process.
  EXPECT_FALSE(fs::exists(results() / "finished.json"));
  int calls = 0;
  ASSERT_EQ(run(true, counted(calls)), kDone) << err_.str();
  EXPECT_GE(calls, failed);
  EXPECT_THAT(out_.str(), HasSubstr(" 0 failed"));
  EXPECT_TRUE(fs::exists(results() / "finished.json"));
}

// An answer of fewer evaluations than there are would take the place of a better one.
TEST_F(Run, IsNotResumedWithFewerEvaluationsThanItHas) {
  int calls = 0;
  ASSERT_EQ(run(false, counted(calls)), kDone) << err_.str();
  const std::string best = text_of(results() / "best.toml"), whole = text_of(study());
  replace_file(study(), replaced(whole, "max_evaluations = 40", "max_evaluations = 3"));
  try {
    run(true, counted(calls));
    FAIL() << "goes on with fewer";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("optimizer.max_evaluations = 3: must be >= "));
  }
  EXPECT_EQ(text_of(results() / "best.toml"), best);
  EXPECT_TRUE(fs::exists(results() / "finished.json"));
  replace_file(study(), whole);
  EXPECT_EQ(run(true, counted(calls)), kDone);
}

/// What a run finds out at its start is kept beside its results.
TEST_F(Run, KeepsTheNoiseFromTheBarOfItsStart) {
  int starts = 0;
  double bar = 3e-12;
  bool unbounded = false;
  const RunEngineFactory with_start = [&](const Study&) {
    RunEngine engine{.evaluate = bowl, .describe = {}};
    engine.start = [&] {
      ++starts;
      optimizer::Evaluation start = bowl(std::vector<double>{10, 3, 9});
      start.error_sources["asymptotic_wear_volume_m3"] = {{"mesh", bar}, {"history", 1e-11}};
      if (unbounded) start.unbounded.emplace_back("asymptotic_wear_volume_m3");
      return start;
    };
    return engine;
  };
  ASSERT_EQ(run(false, with_start), kDone) << err_.str();
  EXPECT_THAT(err_.str(), HasSubstr("noise of the objective, from its error bar at the start: 0.03\n"));
  bar = 5e-12;
  ASSERT_EQ(run(true, with_start), kDone) << err_.str();
  EXPECT_EQ(starts, 1);
  EXPECT_THAT(err_.str(), Not(HasSubstr("noise")));
  // A bar that grows without limit says nothing.
  unbounded = true;
  fs::remove_all(results());
  ASSERT_EQ(run(false, with_start), kDone) << err_.str();
  EXPECT_EQ(starts, 2);
  EXPECT_THAT(err_.str(), HasSubstr("noise of the objective, which has no error bar at the start: 0.02\n"));
  // A damaged file is named, and nothing computed is lost.
  for (const char* text : {"", "{", "{}", "5", "{\"question\": 5}"}) {
    replace_file(results() / "settings.json", text);
    try {
      run(true, with_start);
      ADD_FAILURE() << "accepted: " << text;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), testing::AllOf(HasSubstr("settings.json"), HasSubstr("is damaged"))) << text;
    }
  }
  EXPECT_EQ(starts, 2);
  // One for another study is kept: it belongs to the journal beside it.
  const std::string other = R"({"question": "another", "settings": {}, "noise": 0.1, "accuracy": null})";
  replace_file(results() / "settings.json", other);
  EXPECT_THROW(run(true, with_start), InputError);
  std::ifstream kept(results() / "settings.json");
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(kept), {}), other);
  EXPECT_EQ(starts, 2);
  fs::remove(results() / "settings.json");
  ASSERT_EQ(run(true, with_start), kDone) << err_.str();
  EXPECT_EQ(starts, 3);
}

// Of a front the noisiest objective counts; what all cases wear off together has the noise of what one does.
TEST_F(Run, TakesTheNoiseOfTheNoisiestObjective) {
  const std::string one = "response = \"asymptotic_wear_volume_m3\"\nweight = 1\n";
  const std::string other = "\n[[objective]]\nresponse = \"mass_kg\"\n";
  const std::string text = text_of(study());
  const auto noise = [&](const std::string& objective, const std::string& more) {
    replace_file(study(),
                 replaced(replaced(text, one, objective), "max_evaluations = 40", "max_evaluations = 2") + more);
    fs::remove_all(results());
    const RunEngineFactory with_start = [&](const Study&) {
      RunEngine engine{.evaluate =
                           [](std::span<const double> x) {
                             optimizer::Evaluation e = bowl(x);
                             e.responses["mass_kg"] = 2;
                             e.responses["mission_wear_volume_m3"] = 1e-10;
                             return e;
                           },
                       .describe = {}};
      engine.start = [] {
        optimizer::Evaluation start;
        start.responses = {{"asymptotic_wear_volume_m3", 1e-10}, {"mass_kg", 2}};
        start.error_sources = {{"asymptotic_wear_volume_m3", {{"mesh", 3e-12}}}, {"mass_kg", {{"mesh", 0.02}}}};
        return start;
      };
      return engine;
    };
    static_cast<void>(run(false, with_start));
    const std::string said = err_.str(), words = "at the start: ";
    const std::size_t at = said.find(words);
    return at == std::string::npos ? "" : said.substr(at + words.size(), said.find('\n', at) - at - words.size());
  };
  const std::string wear = "response = \"asymptotic_wear_volume_m3\"\n";
  EXPECT_EQ(noise(wear, ""), "0.03");
  EXPECT_EQ(noise("response = \"mass_kg\"\n", ""), "0.01");
  EXPECT_EQ(noise(wear, other), "0.03");
  EXPECT_EQ(noise("response = \"mass_kg\"\n", "\n[[objective]]\n" + wear), "0.03");
  EXPECT_EQ(noise("response = \"mission_wear_volume_m3\"\n", ""), "0.03");
  // In a sum the wear weighs next to nothing.
  EXPECT_EQ(noise(wear + "weight = 1\nscale = 1\n", other + "weight = 1\nscale = 1\n"), "0.01");
}

// Settings for what is handed over are those of the best design: chosen once, told, and in its file, but not in the
// search's. What the file gives stays.
TEST_F(Run, HandsOverAtSettingsForTheAccuracyAskedFor) {
  std::string text = replaced(study_template("sample"), "max_evaluations = 100", "max_evaluations = 3");
  text = replaced(without(text, "harmonics"), "flank_elements = 24", "flank_elements = 10");
  replace_file(study(), replaced(text, "verify_accuracy = 0\n", "verify_accuracy = 0.2\n"));
  double bar = 0.1;  // of the closer look, over the values
  double edge = 0.05;
  const RunEngineFactory factory = [&](const Study&) {
    const auto describe = [bar, edge](const optimizer::Scene&) {
      DescribedDesign seen{.evaluation = bowl(std::vector<double>{10, 3, 9}), .record = {}};
      for (const auto& [name, value] : seen.evaluation.responses)
        seen.evaluation.error_sources[name] = {{"mesh", bar * value}, {"edge", edge * value}};
      seen.evaluation.model = {{"dofs", 1e4}, {"contact_nodes", 20}, {"jacobians_spent", 9}};
      seen.record.status = "converged";
      return seen;
    };
    return RunEngine{.evaluate = bowl, .describe = describe};
  };
  const auto says_what_was_chosen = [&] {
    const report::RunRecord record = report::read_results(results() / "results.h5");
    EXPECT_THAT(record.best_design->notes,
                testing::Contains(
                    testing::ContainsRegex("The accuracy asked for is reached: .* to 10 % \\(asked: 20 %\\), most of "
                                           "it by mesh; 15 % with what this does not buy.")));
    EXPECT_THAT(record.best_design->notes, Not(testing::Contains(HasSubstr("the search had"))));  // it had the same
    EXPECT_THAT(record.provenance.settings.at("optimizer.verify_accuracy"), HasSubstr("0.2, at the best design "));
    EXPECT_EQ(record.provenance.settings.count("solver.accuracy"), 0U);
    EXPECT_EQ(record.provenance.settings.count("solver.harmonics"), 1U);
    EXPECT_EQ(record.provenance.settings.count("mesh.flank_elements"), 0U);  // it stands in the file
  };
  ASSERT_EQ(run(false, factory), kDone) << err_.str();
  says_what_was_chosen();
  EXPECT_THAT(err_.str(), HasSubstr("settings for the best design"));
  EXPECT_THAT(err_.str(), HasSubstr("10 edges per flank, 3 mm elements beside them, 5 harmonics"));
  EXPECT_TRUE(fs::exists(results() / "best_settings.json"));
  const Study searched = load_study((results() / "study.toml").string());
  const Study best = load_study((results() / "best.toml").string());
  EXPECT_FALSE(searched.given.contains("solver.harmonics"));
  EXPECT_TRUE(best.given.contains("solver.harmonics"));
  EXPECT_EQ(best.scene.mesh.flank_elements, 10);
  ASSERT_EQ(run(true, factory), kDone) << err_.str();
  says_what_was_chosen();
  EXPECT_THAT(err_.str(), Not(HasSubstr("edges per flank")));
  // What the rounds of the choice added to a bar holds for what is recorded, too.
  const fs::path kept = results() / "best_settings.json";
  nlohmann::ordered_json settings = nlohmann::ordered_json::parse(std::ifstream(kept));
  const nlohmann::ordered_json none = settings;
  settings["accuracy"]["raised"] = {{"asymptotic_wear_volume_m3", {{"mesh", 0.25}}}};
  replace_file(kept, settings.dump());
  EXPECT_EQ(run(true, factory), kNotConverged);
  EXPECT_THAT(report::read_results(results() / "results.h5").best_design->notes,
              testing::Contains(HasSubstr("not reached: asymptotic_wear_volume_m3 to 25 %")));
  // Where nothing had a bar, or a response was not resolved, that is said.
  const auto came_to = [&](const nlohmann::ordered_json& response) {
    nlohmann::ordered_json without = none;
    without["accuracy"]["response"] = response;
    without["accuracy"]["relative_bar"] = without["accuracy"]["relative_bar_total"] = nullptr;
    replace_file(kept, without.dump());
    EXPECT_EQ(run(true, factory), kDone) << err_.str();
    return report::read_results(results() / "results.h5").provenance.settings.at("optimizer.verify_accuracy");
  };
  EXPECT_THAT(came_to(nullptr), HasSubstr("no bar says what is reached"));
  EXPECT_THAT(came_to("contact_pressure_max_pa"), HasSubstr("no mesh tried resolves contact_pressure_max_pa"));
  replace_file(kept, none.dump());
  // What is missed there is no answer, be it by a part that no setting buys.
  edge = 1;
  EXPECT_EQ(run(true, factory), kNotConverged);
  EXPECT_THAT(err_.str(), HasSubstr("with all parts of its bar"));
  bar = 0.3;
  EXPECT_EQ(run(true, factory), kNotConverged);
  EXPECT_THAT(err_.str(), HasSubstr("the accuracy asked for is not reached"));
  // A choice that was cut off goes on with the rounds that are kept, which are forgotten when it is made.
  const fs::path rounds = results() / "best_settings_rounds.jsonl";
  EXPECT_FALSE(fs::exists(rounds));
  fs::remove(kept);
  optimizer::Evaluation round = bowl(std::vector<double>{10, 3, 9});
  round.error_sources["asymptotic_wear_volume_m3"] = {{"mesh", 0.123 * 1e-10}};
  round.model = {{"dofs", 1e4}, {"contact_nodes", 20}, {"jacobians_spent", 9}};
  (void)KeptRounds(rounds, settings.at("question")).at(0)(optimizer::settings_of(best.scene), [&] { return round; });
  (void)run(true, factory);
  EXPECT_THAT(err_.str(), HasSubstr("asymptotic_wear_volume_m3 to 12.3 % (asked: 20 %)"));
  EXPECT_FALSE(fs::exists(rounds));
  ASSERT_TRUE(fs::exists(kept));
}

// At a start that cannot be built there is nothing to choose settings by.
TEST_F(Run, ChoosesSettingsInTheMiddleWhereTheStartIsInfeasible) {
  std::string text = replaced(study_template("sample"), "max_evaluations = 100", "max_evaluations = 3");
  text = replaced(without(text, "harmonics"), "flank_elements = 24", "flank_elements = 10");
  text = replaced(replaced(text, "neck_width_mm = 8.5", "neck_width_mm = 12"), "upper = 9.5", "upper = 12");
  text = replaced(text, "accuracy = 0\n", "accuracy = 0.5\n");
  replace_file(study(), text);
  int calls = 0;
  ASSERT_EQ(run(false, counted(calls)), kDone) << err_.str();
  EXPECT_THAT(err_.str(), HasSubstr("modes: infeasible\n"));
  EXPECT_THAT(err_.str(), HasSubstr("settings from the middle of the variables' ranges instead"));
  EXPECT_THAT(err_.str(), HasSubstr("(asked: 50 %)"));
  const report::RunRecord record = report::read_results(results() / "results.h5");
  EXPECT_THAT(record.provenance.settings.at("solver.accuracy"),
              HasSubstr("0.5, at the middle of the variables' ranges reached as far as settings buy it"));
  // What is asked of one response is asked of the settings; with more evaluations a run would go on.
  replace_file(study(), replaced(replaced(text, "upper = 300e6\n", "upper = 300e6\naccuracy = 0.1\n"),
                                 "max_evaluations = 3\n", "max_evaluations = 4\n"));
  EXPECT_THAT([&] { run(true, counted(calls)); },
              testing::ThrowsMessage<InputError>(HasSubstr(
                  "of another study than the one at hand: constraint[0].accuracy = 0.1 (it was not given); ")));
}

// The wear history may say something else of the best design than the search, which does not ask it.
TEST_F(Run, RecordsTheBestDesignAsTheCloserLookHasIt) {
  const RunEngineFactory closer = [](const Study& study) {
    RunEngine engine{.evaluate = bowl, .describe = {}};
    engine.describe = [keys = study.problem.space.keys()](const optimizer::Scene& scene) {
      std::vector<double> x;
      for (const std::string& key : keys) x.push_back(optimizer::parameter(scene, key));
      DescribedDesign seen{.evaluation = bowl(x), .record = {}};
      for (auto& [name, value] : seen.evaluation.responses) value *= name == "asymptotic_wear_volume_m3" ? 3 : 1;
      seen.evaluation.error_estimates = {{"asymptotic_wear_volume_m3", 1e-11}, {"contact_pressure_mean_pa", 1e6}};
      // Of all cases; the record is of the first one.
      seen.evaluation.messages = {"Case a: The worn state was in doubt.", "Case b: The worn state was in doubt."};
      seen.record.status = "converged";
      seen.record.notes = {"No curve was computed."};
      return seen;
    };
    return engine;
  };
  ASSERT_EQ(run(false, closer), kDone) << err_.str();
  const report::RunRecord record = report::read_results(results() / "results.h5");
  const report::EvaluationRecord& best = record.evaluations[*record.best];
  const double found = 3 * bowl(best.x).responses.at("asymptotic_wear_volume_m3");
  EXPECT_DOUBLE_EQ(best.responses.at("asymptotic_wear_volume_m3"), found);
  EXPECT_EQ(best.error_estimates.at("asymptotic_wear_volume_m3"), 1e-11);
  EXPECT_DOUBLE_EQ(record.evaluations.front().responses.at("asymptotic_wear_volume_m3"),
                   3 * bowl(record.evaluations.front().x).responses.at("asymptotic_wear_volume_m3"));
  EXPECT_THAT(
      record.best_design->notes,
      testing::ElementsAre("Case a: The worn state was in doubt.", "Case b: The worn state was in doubt.",
                           HasSubstr("The search, which takes the direct worn state"), "No curve was computed."));
  EXPECT_THAT(out_.str(), HasSubstr(" +- 1e-11 (evaluation"));
  // The search went by its own values: the journal has them.
  for (const auto& line : optimizer::read_journal(results() / "journal.jsonl").records)
    EXPECT_EQ(line.evaluation.responses, bowl(line.x).responses);
}

// Limits on finer meshes refuse the start in all that is told of it, though the closer look finds it within those of
// the search's mesh.
TEST_F(Run, CountsTheStartAsTheSearchDoes) {
  const RunEngineFactory refused = [](const Study& study) {
    RunEngine engine{.evaluate = bowl, .describe = {}};
    engine.finer = [](std::span<const double> x, int) {
      optimizer::Evaluation there = bowl(x);
      there.responses["contact_pressure_mean_pa"] *= 3.3;
      return there;
    };
    engine.describe = [keys = study.problem.space.keys()](const optimizer::Scene& scene) {
      std::vector<double> x;
      for (const std::string& key : keys) x.push_back(optimizer::parameter(scene, key));
      return DescribedDesign{.evaluation = bowl(x), .record = {}};
    };
    return engine;
  };
  EXPECT_EQ(run(false, refused), kNotConverged);
  EXPECT_THAT(out_.str(), HasSubstr("; 0 feasible, 40 break"));
  EXPECT_THAT(err_.str(),
              testing::ContainsRegex("none keeps the upper limit .* \\(candidate 1 comes nearest and misses"));
  const report::RunRecord record = report::read_results(results() / "results.h5");
  for (const report::EvaluationRecord& evaluation : record.evaluations) EXPECT_FALSE(evaluation.feasible);
}

// An answer that the closer look does not confirm is told, and the exit status says so.
TEST_F(Run, FailsWhereTheCloserLookDoesNotConfirmTheBestDesign) {
  const auto look = [](const std::string& status, double pressure) {
    return [=](const Study&) {
      RunEngine engine{.evaluate = bowl, .describe = {}};
      engine.describe = [=](const optimizer::Scene&) {
        DescribedDesign seen{.evaluation = bowl(std::vector<double>{10, 3, 9}), .record = {}};
        seen.evaluation.status = seen.record.status = status;
        seen.evaluation.responses["contact_pressure_mean_pa"] = pressure;
        return seen;
      };
      return engine;
    };
  };
  EXPECT_EQ(run(false, look("converged", 100e6)), kDone) << err_.str();
  fs::remove_all(results());
  EXPECT_EQ(run(false, look("asymptote: gross_sliding", 100e6)), kNotConverged);
  EXPECT_THAT(err_.str(), HasSubstr("looked at with bars and its wear history: asymptote: gross_sliding"));
  fs::remove_all(results());
  EXPECT_EQ(run(false, look("converged", 1e12)), kNotConverged);
  EXPECT_THAT(err_.str(), HasSubstr("looked at with bars and its wear history: breaks a limit"));
}

TEST_F(Run, RefusesAnExistingDirectory) {
  fs::create_directories(results());
  replace_file(results() / "notes.txt", "mine");
  int calls = 0;
  try {
    run(false, counted(calls));
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("exists already; give --resume"));
  }
  EXPECT_EQ(calls, 0);
}

TEST_F(Run, ResumesWithoutComputingAgain) {
  int first = 0;
  // The process dies in the 15th evaluation.
  const RunEngineFactory dying = [&first](const Study&) {
    return RunEngine{.evaluate =
                         [&first](std::span<const double> x) {
                           if (++first == 15) throw std::runtime_error("power cut");
                           return bowl(x);
                         },
                     .describe = {}};
  };
  EXPECT_THROW(run(false, dying), std::runtime_error);
  int second = 0;
  ASSERT_EQ(run(true, counted(second)), kDone) << err_.str();
  const std::string resumed = out_.str();
  fs::remove_all(results());
  int whole = 0;
  ASSERT_EQ(run(false, counted(whole)), kDone);
  EXPECT_EQ(14 + second, whole);
  EXPECT_THAT(resumed, HasSubstr("14 of them stored before"));
}

/// The bowl, with a verification that counts its calls and, at `stop_at`, is interrupted in the middle.
RunEngineFactory verified(int& calls, int stop_at = 0) {
  return [&calls, stop_at](const Study&) {
    RunEngine engine{.evaluate = bowl, .describe = {}};
    engine.verify = [&calls, stop_at](const optimizer::Scene& scene, const optimizer::FinerDesign*,
                                      const wear::Watcher& watcher) {
      if (++calls == stop_at) std::raise(SIGINT);
      report::VerificationRecord record;
      record.status = watcher.stopped() ? "interrupted" : "converged";
      record.search_volume_m3 = 1 + optimizer::parameter(scene, "geometry.neck_width_mm");
      record.search_bar_m3 = kInfinity;
      return record;
    };
    return engine;
  };
}

TEST_F(Run, VerifiesTheBestDesignsOnce) {
  int calls = 0;
  ASSERT_EQ(run(false, verified(calls)), kDone) << err_.str();
  EXPECT_EQ(calls, 3);
  EXPECT_THAT(out_.str(), HasSubstr("by its wear history"));
  const report::RunRecord first = report::read_results(results() / "results.h5");
  ASSERT_EQ(first.verifications.size(), 3U);
  EXPECT_EQ(first.verifications.front().evaluation, static_cast<std::int64_t>(*first.best));
  for (std::size_t i = 1; i < 3; ++i) {
    const auto objective = [&](std::size_t k) {
      return first.evaluations[static_cast<std::size_t>(first.verifications[k].evaluation)].objective;
    };
    EXPECT_LE(objective(i - 1), objective(i));
  }
  ASSERT_EQ(run(true, verified(calls)), kDone) << err_.str();
  EXPECT_EQ(calls, 3) << "resumed runs verify again";
  const report::RunRecord again = report::read_results(results() / "results.h5");
  ASSERT_EQ(again.verifications.size(), 3U);
  EXPECT_EQ(again.verifications[2].search_volume_m3, first.verifications[2].search_volume_m3);
  EXPECT_EQ(again.verifications[2].search_bar_m3, kInfinity);
}

TEST_F(Run, AnInterruptedVerificationGoesOnWhenResumed) {
  install_interrupt_handler();
  int calls = 0;
  ASSERT_EQ(run(false, verified(calls, 2)), kInterrupted) << err_.str();
  EXPECT_EQ(report::read_results(results() / "results.h5").verifications.size(), 1U);
  // A line that the end of the process cut short counts for nothing.
  std::ofstream(results() / "verification.jsonl", std::ios::app) << R"({"fingerprint":"12)";
  calls = 0;
  ASSERT_EQ(run(true, verified(calls)), kDone) << err_.str();
  EXPECT_EQ(calls, 2);
  EXPECT_EQ(report::read_results(results() / "results.h5").verifications.size(), 3U);
  calls = 0;
  ASSERT_EQ(run(true, verified(calls)), kDone) << err_.str();
  EXPECT_EQ(calls, 0);
}

TEST_F(Run, ResumingAnotherStudyIsRefused) {
  int calls = 0;
  ASSERT_EQ(run(false, counted(calls)), kDone);
  std::ifstream stream(study());
  const std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  replace_file(study(), replaced(text, "friction = 0.5", "friction = 0.4"));
  try {
    run(true, counted(calls));
    ADD_FAILURE() << "resumed";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::AllOf(HasSubstr("contact.friction = 0.4 (it was 0.5); give the same --set"),
                                             HasSubstr((results() / "study.toml").string())));
  }
  // What counts for nothing that was computed may change; the study that is kept is the run's.
  const RunOptions kept{.study = (results() / "study.toml").string(),
                        .set = {"title=other"},
                        .directory = results().string(),
                        .resume = true,
                        .jobs = 1};
  EXPECT_EQ(run_study(kept, {.out = out_, .err = err_}, counted(calls)), kDone) << err_.str();
}

TEST_F(Run, CountsTheTimeOfAllItsSessions) {
  int calls = 0;
  ASSERT_EQ(run(false, counted(calls)), kDone);
  const auto seconds = [&] { return report::read_results(results() / "results.h5").seconds; };
  const double first = seconds();
  EXPECT_GT(first, 0);
  EXPECT_GE(seconds_taken(results()), first);
  keep_seconds_taken(results(), 1000);
  const std::string text = text_of(study());
  replace_file(study(), replaced(text, "max_evaluations = 40", "max_evaluations = 42"));
  ASSERT_EQ(run(true, counted(calls)), kDone) << err_.str();
  EXPECT_GT(seconds(), 1000);
  EXPECT_LT(seconds(), 1100);
  EXPECT_GE(seconds_taken(results()), seconds());
  // A part of a scan counts as well, and what is merged of them is their sum.
  const MergeOptions merge{.directories = {results().string(), results().string()},
                           .directory = (directory_ / "merged").string()};
  const double each = seconds_taken(results());
  ASSERT_EQ(merged(merge), kDone);
  EXPECT_EQ(seconds_taken(directory_ / "merged"), 2 * each);
  replace_file(results() / "time.json", "{\"seconds\"");  // damaged
  EXPECT_EQ(seconds_taken(results()), 0);
}

TEST_F(Run, EndsWhateverBecomesOfItsExports) {
  fs::create_directories(results() / "best.dxf");  // no file can take its place
  int calls = 0;
  ASSERT_EQ(run(true, counted(calls)), kDone) << err_.str();
  EXPECT_THAT(err_.str(), HasSubstr("best.dxf: not written: "));
  for (const char* file : {"results.h5", "report.html", "best.toml", "finished.json"})
    EXPECT_TRUE(fs::exists(results() / file)) << file;
}

TEST_F(Run, SaysWhyNothingCouldBeComputed) {
  const RunEngineFactory failing = [](const Study&) {
    return RunEngine{.evaluate =
                         [](std::span<const double>) {
                           optimizer::Evaluation evaluation;
                           evaluation.status = "asymptote: no_asymptote";
                           return evaluation;
                         },
                     .describe = {}};
  };
  EXPECT_EQ(run(false, failing), kNotConverged);
  EXPECT_THAT(out_.str(), HasSubstr("no candidate could be computed"));
  EXPECT_THAT(err_.str(),
              testing::ContainsRegex("none of [0-9]+ evaluations could be computed: asymptote: no_asymptote in"));
  EXPECT_THAT(text_of(results() / "report.html"), HasSubstr("Find out why nothing can be computed"));
}

TEST_F(Run, WithoutAFeasibleDesignNothingIsCalledBest) {
  const RunEngineFactory poor = [](const Study&) {
    return RunEngine{.evaluate =
                         [](std::span<const double> x) {
                           optimizer::Evaluation evaluation = bowl(x);
                           evaluation.responses["post_width_m"] = 1e-3;
                           return evaluation;
                         },
                     .describe = {}};
  };
  EXPECT_EQ(run(false, poor), kNotConverged);
  EXPECT_THAT(err_.str(), HasSubstr("no feasible design was found"));
  EXPECT_FALSE(fs::exists(results() / "best.toml"));
}

// What the command line sets is in everything that the run keeps.
TEST_F(Run, KeepsWhatTheCommandLineSets) {
  int calls = 0;
  RunOptions options{.study = study(),
                     .set = {"optimizer.max_evaluations=7", "contact.friction=0.4", "optimizer.algorithm=scan"},
                     .directory = results().string(),
                     .jobs = 1};
  ASSERT_EQ(run_study(options, {.out = out_, .err = err_}, counted(calls)), kDone) << err_.str();
  EXPECT_EQ(calls, 7);
  for (const char* file : {"study.toml", "best.toml"}) {
    const Study kept = load_study((results() / file).string());
    EXPECT_EQ(kept.scene.contact.friction, 0.4) << file;
    EXPECT_EQ(kept.optimizer.algorithm, optimizer::Algorithm::scan) << file;
  }
  EXPECT_THAT(text_of(results() / "study.toml"), HasSubstr("# Search algorithm."));  // comments stay
  EXPECT_THAT(report::read_results(results() / "results.h5").provenance.study_text, HasSubstr("friction = 0.4"));
  options.set = {"contact.friction=-1"};
  EXPECT_THAT([&] { run_study(options, {.out = out_, .err = err_}, counted(calls)); },
              testing::ThrowsMessage<InputError>(HasSubstr("--set contact.friction=-1: must be")));
}

TEST_F(Run, OfAFinishedRunNothingIsDoneAgain) {
  int calls = 0, described = 0;
  const RunEngineFactory describing = [&](const Study& study) {
    RunEngine engine = counted(calls)(study);
    engine.describe = [&](const optimizer::Scene&) {
      ++described;
      DescribedDesign seen{.evaluation = bowl(std::vector<double>{10, 3, 9}), .record = {}};
      seen.record.status = "converged";
      return seen;
    };
    return engine;
  };
  ASSERT_EQ(run(false, describing), kDone) << err_.str();
  const std::string said = out_.str();
  const int before = calls;
  EXPECT_EQ(described, 2);
  const fs::file_time_type written = fs::last_write_time(results() / "results.h5");
  ASSERT_EQ(run(true, describing), kDone) << err_.str();
  EXPECT_THAT(err_.str(), HasSubstr("this run is finished; nothing is computed again"));
  EXPECT_EQ(out_.str(), said);
  EXPECT_EQ(calls, before);
  EXPECT_EQ(described, 2);
  EXPECT_EQ(fs::last_write_time(results() / "results.h5"), written);
  // In another place it says so.
  const fs::path moved = directory_ / "moved";
  fs::copy(results(), moved, fs::copy_options::recursive);
  out_.str("");
  ASSERT_EQ(run_study({.study = study(), .directory = moved.string(), .resume = true, .jobs = 1},
                      {.out = out_, .err = err_}, describing),
            kDone);
  EXPECT_EQ(described, 2);
  EXPECT_EQ(out_.str(), replaced(said, results().string(), moved.string()));
  // What is damaged is made again.
  const auto whole = fs::file_size(results() / "results.h5");
  fs::resize_file(results() / "results.h5", whole / 2);
  ASSERT_EQ(run(true, describing), kDone) << err_.str();
  EXPECT_EQ(fs::file_size(results() / "results.h5"), whole);
  EXPECT_EQ(calls, before);
  // What is not there any more is made again, and a larger budget is spent.
  fs::remove(results() / "report.html");
  ASSERT_EQ(run(true, describing), kDone) << err_.str();
  EXPECT_EQ(calls, before);
  EXPECT_TRUE(fs::exists(results() / "report.html"));
  replace_file(study(), replaced(text_of(study()), "max_evaluations = 40", "max_evaluations = 45"));
  ASSERT_EQ(run(true, describing), kDone) << err_.str();
  EXPECT_GT(calls, before);
}

TEST_F(Run, BeginsNoEvaluationAfterItsTime) {
  int calls = 0;
  const auto run = [&](bool resume, const RunEngineFactory& factory, int jobs) {
    out_.str("");
    return run_study({.study = study(),
                      .set = {"optimizer.time_limit_s=0.2"},
                      .directory = results().string(),
                      .resume = resume,
                      .jobs = jobs},
                     {.out = out_, .err = err_}, factory);
  };
  const RunEngineFactory slow = [&](const Study& study) {
    RunEngine engine = counted(calls)(study);
    engine.evaluate = [evaluate = engine.evaluate](std::span<const double> x) {
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
      return evaluate(x);
    };
    return engine;
  };
  for (const int jobs : {1, 2}) {
    fs::remove_all(results());
    ASSERT_EQ(run(false, slow, jobs), kDone) << err_.str();
    EXPECT_THAT(out_.str(), HasSubstr("optimizer.time_limit_s = 0.2 is over; --resume goes on"));
    const std::size_t first = optimizer::read_journal(results() / "journal.jsonl").records.size();
    EXPECT_GE(first, 1U);
    EXPECT_LE(first, 7U);
    EXPECT_TRUE(fs::exists(results() / "best.toml"));
    // What is stored costs no time.
    ASSERT_EQ(run(true, slow, jobs), kDone) << err_.str();
    EXPECT_GT(optimizer::read_journal(results() / "journal.jsonl").records.size(), first);
  }
  // So does a part of the scan, which a later call ends.
  fs::remove_all(results());
  replace_file(study(), replaced(text_of(study()), "scan_evaluations = 0", "scan_evaluations = 20"));
  RunOptions part{.study = study(),
                  .set = {"optimizer.time_limit_s=0.2"},
                  .directory = results().string(),
                  .jobs = 1,
                  .part = "1/2"};
  out_.str("");
  ASSERT_EQ(run_study(part, {.out = out_, .err = err_}, slow), kDone);
  EXPECT_THAT(out_.str(), HasSubstr("the time is over in part 1 of 2 of the scan: "));
  EXPECT_THAT(out_.str(), HasSubstr(" of its 11 evaluations are kept in "));
  EXPECT_LT(optimizer::read_journal(results() / "journal.jsonl").records.size(), 11U);
  part.set.clear();
  part.resume = true;
  ASSERT_EQ(run_study(part, {.out = out_, .err = err_}, counted(calls)), kDone);
  EXPECT_EQ(optimizer::read_journal(results() / "journal.jsonl").records.size(), 11U);
}

TEST_F(Run, TellsProgramsAndKeepsQuiet) {
  int calls = 0;
  const fs::path log = directory_ / "log.jsonl";
  const RunOptions options{
      .study = study(), .directory = results().string(), .jobs = 1, .tell = {.quiet = true, .log = log.string()}};
  ASSERT_EQ(run_study(options, {.out = out_, .err = err_}, counted(calls)), kDone);
  EXPECT_EQ(err_.str(), "");
  std::istringstream lines(text_of(log));
  std::vector<nlohmann::json> events;
  for (std::string line; std::getline(lines, line);) events.push_back(nlohmann::json::parse(line));
  ASSERT_GT(events.size(), 3U);
  EXPECT_EQ(events.front().at("event"), "begin");
  EXPECT_EQ(events.front().at("version"), 1);
  EXPECT_EQ(events.back().at("event"), "end");
  EXPECT_EQ(events.back().at("exit_status"), 0);
  int evaluations = 0;
  for (const nlohmann::json& event : events) {
    EXPECT_TRUE(event.at("seconds").is_number());
    if (event.at("event") != "evaluation") continue;
    EXPECT_EQ(event.at("number"), ++evaluations);
    EXPECT_TRUE(event.at("objective").is_number());
  }
  EXPECT_EQ(evaluations, calls);
  RunOptions unwritable = options;
  unwritable.tell.log = (directory_ / "nowhere" / "log.jsonl").string();
  EXPECT_THAT([&] { run_study(unwritable, {.out = out_, .err = err_}, counted(calls)); },
              testing::ThrowsMessage<InputError>(HasSubstr("cannot be written: No such file or directory")));
}

// Which limit, or which rule, and by how much.
TEST_F(Run, NamesWhatDesignsBreak) {
  const RunEngineFactory poor = [](const Study&) {
    return RunEngine{.evaluate =
                         [](std::span<const double> x) {
                           optimizer::Evaluation evaluation = bowl(x);
                           if (x[0] > 1) {
                             evaluation.status = "infeasible";
                             evaluation.responses.clear();
                             evaluation.messages = {"the neck is 0.5 mm too thin"};
                           }
                           evaluation.responses["post_width_m"] = 1e-3;
                           return evaluation;
                         },
                     .describe = {}};
  };
  EXPECT_EQ(run(false, poor), kNotConverged);
  EXPECT_THAT(err_.str(), HasSubstr(", infeasible: breaks post_width_m:lower by 75 % of its limit"));
  EXPECT_THAT(err_.str(), HasSubstr("infeasible: the neck is 0.5 mm too thin"));
  EXPECT_THAT(err_.str(), HasSubstr("nearest to one is evaluation 1: breaks post_width_m:lower by 75 %"));
}

TEST_F(Run, IsComparedWithOthers) {
  int calls = 0;
  ASSERT_EQ(run(false, counted(calls)), kDone) << err_.str();
  const RunEngineFactory dying = [&calls](const Study&) {
    return RunEngine{.evaluate =
                         [n = 0, &calls](std::span<const double> x) mutable {
                           ++calls;
                           if (++n == 5) throw std::runtime_error("power cut");
                           return bowl(x);
                         },
                     .describe = {}};
  };
  fs::create_directories(directory_ / "all");
  fs::rename(results(), directory_ / "all" / "a");
  EXPECT_THROW(run(false, dying), std::runtime_error);
  fs::rename(results(), directory_ / "all" / "b");
  const fs::path csv = directory_ / "runs.csv", json = directory_ / "runs.json";
  const RunsOptions options{.directories = {(directory_ / "all").string()}, .csv = csv.string(), .json = json.string()};
  out_.str("");
  ASSERT_EQ(run_runs(options, {.out = out_, .err = err_}), kDone);
  EXPECT_THAT(out_.str(),
              testing::AllOf(HasSubstr("all/a"), HasSubstr("unfinished"), HasSubstr("geometry.neck_width_mm")));
  const auto listed = [&] {
    const nlohmann::json answer = nlohmann::json::parse(text_of(json));
    EXPECT_EQ(answer.at("version"), 1);
    return answer.at("runs");
  };
  nlohmann::json runs = listed();
  ASSERT_EQ(runs.size(), 2U);
  EXPECT_EQ(runs[1].at("evaluations"), 4);
  EXPECT_EQ(runs[1].at("status"), "unfinished");
  const report::RunRecord record = report::read_results(directory_ / "all" / "a" / "results.h5");
  EXPECT_EQ(runs[0].at("objective"), record.evaluations[*record.best].objective);
  EXPECT_EQ(runs[0].at("best"), *record.best + 1);
  EXPECT_EQ(runs[0].at("variables").at("geometry.neck_width_mm"), record.evaluations[*record.best].x[2]);
  const auto rows = table_of(csv);
  ASSERT_EQ(rows.size(), 3U);
  for (const auto& row : rows) EXPECT_EQ(row.size(), rows.front().size());
  // A damaged one is listed and hides no other.
  for (const char* name : {"results.h5", "journal.jsonl"}) {
    fs::create_directories(directory_ / "all" / "aa");
    replace_file(directory_ / "all" / "aa" / name, "torn");
    replace_file(directory_ / "all" / "aa" / "study.toml", "[torn");
    out_.str("");
    ASSERT_EQ(run_runs(options, {.out = out_, .err = err_}), kDone);
    const nlohmann::json with = listed();
    ASSERT_EQ(with.size(), 3U);
    EXPECT_EQ(with[1].at("status"), "damaged");
    EXPECT_EQ(with[0], runs[0]);
    EXPECT_EQ(with[2], runs[1]);
    EXPECT_THAT(out_.str(), testing::AllOf(HasSubstr("damaged"), HasSubstr("unfinished")));
    fs::remove_all(directory_ / "all" / "aa");
  }
  EXPECT_THROW(run_runs({.directories = {directory_.string()}, .csv = {}, .json = {}}, {.out = out_, .err = err_}),
               InputError);
}

TEST_F(Run, NeedsVariablesAndLeavesNothingWithoutThem) {
  replace_file(study(), study_template("s").substr(0, study_template("s").find("# What the optimiser may change")));
  int calls = 0;
  EXPECT_THROW(run(false, counted(calls)), InputError);
  EXPECT_FALSE(fs::exists(results()));
}

}  // namespace
}  // namespace dovetail::studies
