#include "studies/report/record/results_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <bit>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <span>

#include "core/hdf5_file.hpp"
#include "tests/unit/studies/report_sample.hpp"

namespace dovetail::report {
namespace {

namespace fs = std::filesystem;

class ResultsFile : public testing::Test {
 protected:
  ResultsFile() : directory_(fs::temp_directory_path() / ("dovetail_results_" + std::to_string(getpid()))) {
    fs::create_directories(directory_);
  }
  ~ResultsFile() override { fs::remove_all(directory_); }
  [[nodiscard]] fs::path path(const std::string& name = "results.h5") const { return directory_ / name; }

  static std::string refusal(const fs::path& file) {
    try {
      (void)read_results(file);
    } catch (const InputError& error) {
      return error.what();
    }
    return {};
  }

 private:
  fs::path directory_;
};

// Equality bit by bit, so that NaN equals NaN and 0 differs from -0. Structured bindings name every member: a new one
// does not compile until it is compared.
bool same(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}
bool same(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return same(a.x(), b.x()) && same(a.y(), b.y());
}
template <class T>
requires(std::equality_comparable<T> && !std::floating_point<T> && !std::ranges::range<T>) bool same(const T& a,
                                                                                                     const T& b) {
  return a == b;
}
bool same(const optimizer::DesignVariable& a, const optimizer::DesignVariable& b) {
  const auto& [a1, a2, a3, a4, a5] = a;
  const auto& [b1, b2, b3, b4, b5] = b;
  return a1 == b1 && same(a2, b2) && same(a3, b3) && same(a4, b4) && a5 == b5;
}
bool same(const optimizer::ObjectiveTerm& a, const optimizer::ObjectiveTerm& b) {
  const auto& [a1, a2, a3, a4, a5, a6, a7, a8] = a;
  const auto& [b1, b2, b3, b4, b5, b6, b7, b8] = b;
  return a1 == b1 && same(a2, b2) && same(a3, b3) && a4 == b4 && same(a5, b5) && same(a6, b6) && a7 == b7 && a8 == b8;
}
bool same(const optimizer::ResponseConstraint& a, const optimizer::ResponseConstraint& b) {
  const auto& [a1, a2, a3, a4, a5, a6, a7] = a;
  const auto& [b1, b2, b3, b4, b5, b6, b7] = b;
  return a1 == b1 && a2 == b2 && a3 == b3 && same(a4, b4) && a5 == b5 && same(a6, b6) && a7 == b7;
}
bool same(const optimizer::KeyChange& a, const optimizer::KeyChange& b) {
  const auto& [a1, a2, a3] = a;
  const auto& [b1, b2, b3] = b;
  return a1 == b1 && same(a2, b2) && same(a3, b3);
}
bool same(const geometry::Edge& a, const geometry::Edge& b) {
  const auto& [a1, a2, a3, a4, a5, a6] = a;
  const auto& [b1, b2, b3, b4, b5, b6] = b;
  return a1 == b1 && same(a2, b2) && same(a3, b3) && same(a4, b4) && same(a5, b5) && same(a6, b6);
}
bool same(const std::pair<const std::string, double>& a, const std::pair<const std::string, double>& b) {
  return a.first == b.first && same(a.second, b.second);
}
bool same(const fem::Region& a, const fem::Region& b) {
  const auto& [a1, a2, a3, a4] = a;
  const auto& [b1, b2, b3, b4] = b;
  return a1 == b1 && a2 == b2 && same(a3, b3) && a4 == b4;
}
bool same(const FilletRecord& a, const FilletRecord& b);
bool same(const EvaluationRecord& a, const EvaluationRecord& b);

template <std::ranges::range R>
bool all_same(const R& a, const R& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& x, const auto& y) { return same(x, y); });
}
bool same(const FilletRecord& a, const FilletRecord& b) {
  const auto& [a1, a2, a3, a4, a5, a6] = a;
  const auto& [b1, b2, b3, b4, b5, b6] = b;
  return a1 == b1 && all_same(a2, b2) && all_same(a3, b3) && all_same(a4, b4) && same(a5, b5) && same(a6, b6);
}
bool same(const EvaluationRecord& a, const EvaluationRecord& b) {
  const auto& [a1, a2, a3, a4, a5, a6, a7, a8, a9, a10, a11, a12] = a;
  const auto& [b1, b2, b3, b4, b5, b6, b7, b8, b9, b10, b11, b12] = b;
  return all_same(a1, b1) && a2 == b2 && a3 == b3 && a4 == b4 && same(a5, b5) && same(a6, b6) && all_same(a7, b7) &&
         same(a8, b8) && all_same(a9, b9) && all_same(a10, b10) && all_same(a11, b11) && a12 == b12;
}

void expect_same(const ContactRecord& a, const ContactRecord& b) {
  const auto& [a1, a2, a3, a4, a5, a6, a7, a8, a9, a10, a11, a12] = a;
  const auto& [b1, b2, b3, b4, b5, b6, b7, b8, b9, b10, b11, b12] = b;
  EXPECT_EQ(a1, b1);
  EXPECT_EQ(a2, b2);
  EXPECT_TRUE(all_same(a3, b3) && all_same(a4, b4) && all_same(a5, b5) && all_same(a6, b6) && all_same(a7, b7));
  EXPECT_TRUE(all_same(a8, b8) && all_same(a9, b9) && all_same(a10, b10) && all_same(a11, b11) && all_same(a12, b12));
}
void expect_same(const ResponseCurve& a, const ResponseCurve& b) {
  const auto& [a1, a2, a3] = a;
  const auto& [b1, b2, b3] = b;
  EXPECT_TRUE(all_same(a1, b1) && all_same(a2, b2));
  EXPECT_EQ(a3, b3);
}
void expect_same(const NodalDiameterRecord& a, const NodalDiameterRecord& b) {
  const auto& [a1, a2, a3, a4] = a;
  const auto& [b1, b2, b3, b4] = b;
  EXPECT_EQ(a1, b1);
  EXPECT_EQ(a2, b2);
  EXPECT_TRUE(all_same(a3, b3));
  EXPECT_EQ(a4, b4);
}
void expect_same(const HistoryRecord& a, const HistoryRecord& b) {
  const auto& [a1, a2, a3, a4, a5, a6, a7, a8, a9] = a;
  const auto& [b1, b2, b3, b4, b5, b6, b7, b8, b9] = b;
  EXPECT_EQ(a1, b1);
  EXPECT_EQ(a2, b2);
  EXPECT_TRUE(all_same(a3, b3) && all_same(a4, b4) && all_same(a5, b5) && all_same(a6, b6) && all_same(a7, b7));
  EXPECT_EQ(a8, b8);
  EXPECT_TRUE(all_same(a9, b9));
}
void expect_same(const FieldRecord& a, const FieldRecord& b) {
  const auto& [mesh_a, displacement_a, stress_a, nodes_a, cells_a, hertz_a, shapes_a] = a;
  const auto& [mesh_b, displacement_b, stress_b, nodes_b, cells_b, hertz_b, shapes_b] = b;
  EXPECT_EQ(nodes_a, nodes_b);
  EXPECT_EQ(cells_a, cells_b);
  EXPECT_TRUE(all_same(hertz_a, hertz_b) && all_same(shapes_a, shapes_b));
  const auto& [a1, a2, a3, a4, a5] = mesh_a;
  const auto& [b1, b2, b3, b4, b5] = mesh_b;
  EXPECT_EQ(a1, b1);
  // Without nodes the number of rows says nothing, and Eigen compares matrices of one size only.
  EXPECT_EQ(a2.cols(), b2.cols());
  EXPECT_TRUE(all_same(std::span(a2.data(), static_cast<std::size_t>(a2.size())),
                       std::span(b2.data(), static_cast<std::size_t>(b2.size()))));
  EXPECT_EQ(a3, b3);
  EXPECT_EQ(a4, b4);
  EXPECT_TRUE(all_same(a5, b5));
  EXPECT_TRUE(all_same(displacement_a, displacement_b) && all_same(stress_a, stress_b));
}
void expect_same(const DesignRecord& a, const DesignRecord& b) {
  const auto& [a1, a2, a3, a4, a5, a6, a7, a8, a9, a10, a11, a12, a13, a14, a15] = a;
  const auto& [b1, b2, b3, b4, b5, b6, b7, b8, b9, b10, b11, b12, b13, b14, b15] = b;
  EXPECT_EQ(a1, b1);
  EXPECT_TRUE(all_same(a2, b2) && all_same(a3, b3) && all_same(a4, b4));
  EXPECT_TRUE(all_same(a5.blade, b5.blade) && all_same(a5.disk, b5.disk) && all_same(a6, b6));
  expect_same(a7, b7);
  expect_same(a8, b8);
  expect_same(a9, b9);
  expect_same(a10, b10);
  expect_same(a11, b11);
  EXPECT_TRUE(all_same(a12, b12));
  ASSERT_EQ(a13.has_value(), b13.has_value());
  if (a13) expect_same(*a13, *b13);
  expect_same(a14, b14);
  EXPECT_EQ(a15, b15);
}
void expect_same(const Provenance& a, const Provenance& b) {
  const auto& [a1, a2, a3, a4, a5, a6, a7, a8, a9] = a;
  const auto& [b1, b2, b3, b4, b5, b6, b7, b8, b9] = b;
  EXPECT_TRUE(a1 == b1 && a2 == b2 && a3 == b3 && a8 == b8);
  EXPECT_EQ(a4, b4);
  EXPECT_EQ(a5, b5);
  EXPECT_EQ(a6, b6);
  EXPECT_EQ(a7, b7);
  EXPECT_EQ(a9, b9);
}
void expect_same(const VerificationRecord& a, const VerificationRecord& b) {
  const auto& [a1, a2, a3, a4, a5, a6, a7, a8, a9, a10, a11, a12, a13, a14, a15, a16, a17, a18, a19, a20, a21, a22, a23,
               a24, a25, a26, a27, a28] = a;
  const auto& [b1, b2, b3, b4, b5, b6, b7, b8, b9, b10, b11, b12, b13, b14, b15, b16, b17, b18, b19, b20, b21, b22, b23,
               b24, b25, b26, b27, b28] = b;
  EXPECT_TRUE(a1 == b1 && a2 == b2 && a3 == b3 && a4 == b4 && a5 == b5 && a6 == b6 && a7 == b7 && a8 == b8 && a9 == b9);
  EXPECT_TRUE(same(a10, b10) && same(a11, b11) && same(a12, b12) && same(a13, b13) && same(a14, b14) && same(a15, b15));
  EXPECT_TRUE(same(a16, b16) && same(a17, b17) && same(a18, b18) && same(a19, b19) && same(a20, b20) && same(a21, b21));
  EXPECT_EQ(a22, b22);
  EXPECT_EQ(a23, b23);
  EXPECT_TRUE(all_same(a24, b24) && all_same(a25, b25) && all_same(a26, b26) && all_same(a27, b27));
  EXPECT_TRUE(all_same(a28, b28));
}
void expect_same(const FrontRecord& a, const FrontRecord& b) {
  const auto& [a1, a2, a3, a4, a5, a6, a7, a8] = a;
  const auto& [b1, b2, b3, b4, b5, b6, b7, b8] = b;
  EXPECT_EQ(a1, b1);
  EXPECT_EQ(a2, b2);
  EXPECT_TRUE(all_same(a3, b3) && all_same(a4, b4) && all_same(a5, b5) && all_same(a6, b6) && same(a7, b7));
  EXPECT_EQ(a8, b8);
}
void expect_same(const RunRecord& a, const RunRecord& b) {
  const auto& [a1, a2, a3, a4, a5, a6, a7, a8, a9, a10, a11, a12, a13, a14, a15, a16, a17, a18] = a;
  const auto& [b1, b2, b3, b4, b5, b6, b7, b8, b9, b10, b11, b12, b13, b14, b15, b16, b17, b18] = b;
  EXPECT_TRUE(a1 == b1 && a2 == b2 && a3 == b3 && a4 == b4);
  EXPECT_EQ(a6.front, b6.front);
  EXPECT_TRUE(same(a5, b5));
  EXPECT_TRUE(all_same(a6.space.variables(), b6.space.variables()));
  EXPECT_TRUE(all_same(a6.objective, b6.objective));
  EXPECT_TRUE(all_same(a6.constraints, b6.constraints));
  ASSERT_EQ(a6.cases.size(), b6.cases.size());
  for (std::size_t i = 0; i < a6.cases.size(); ++i) {
    EXPECT_TRUE(a6.cases[i].name == b6.cases[i].name && same(a6.cases[i].weight, b6.cases[i].weight));
    EXPECT_EQ(a6.cases[i].sample_of, b6.cases[i].sample_of);
    EXPECT_TRUE(all_same(a6.cases[i].changes, b6.cases[i].changes));
  }
  EXPECT_TRUE(same(a6.quantile, b6.quantile));
  EXPECT_TRUE(all_same(a7, b7));
  EXPECT_EQ(a8, b8);
  EXPECT_EQ(a9, b9);
  EXPECT_EQ(a10, b10);
  ASSERT_EQ(a11.has_value(), b11.has_value());
  if (a11) expect_same(*a11, *b11);
  ASSERT_EQ(a12.has_value(), b12.has_value());
  if (a12) expect_same(*a12, *b12);
  ASSERT_EQ(a13.size(), b13.size());
  for (std::size_t i = 0; i < a13.size(); ++i) expect_same(a13[i], b13[i]);
  ASSERT_EQ(a14.size(), b14.size());
  for (std::size_t i = 0; i < a14.size(); ++i) {
    EXPECT_EQ(a14[i].evaluation, b14[i].evaluation);
    EXPECT_EQ(a14[i].flank_elements, b14[i].flank_elements);
    EXPECT_EQ(a14[i].status, b14[i].status);
    EXPECT_TRUE(all_same(a14[i].constraints, b14[i].constraints));
  }
  ASSERT_EQ(a15.size(), b15.size());
  for (std::size_t i = 0; i < a15.size(); ++i) {
    EXPECT_EQ(a15[i].evaluation, b15[i].evaluation);
    EXPECT_EQ(a15[i].departure, b15[i].departure);
    EXPECT_EQ(a15[i].status, b15[i].status);
    EXPECT_TRUE(same(a15[i].objective, b15[i].objective) && all_same(a15[i].constraints, b15[i].constraints));
  }
  ASSERT_EQ(a16.has_value(), b16.has_value());
  if (a16) expect_same(*a16, *b16);
  expect_same(a17, b17);
  EXPECT_EQ(a18, b18);
}

TEST_F(ResultsFile, ReadsBackEveryBit) {
  const RunRecord record = sample_record();
  write_results(path(), record);
  expect_same(record, read_results(path()));
}

TEST_F(ResultsFile, KeepsCases) {
  RunRecord record = sample_record();
  record.problem.cases = {{.name = "cruise", .weight = 4, .changes = {}},
                          {.name = "climb/1",
                           .changes = {{"loading.tip_force_n", 3, 0}, {"contact.friction", 0, 0.6}},
                           .sample_of = "climb"}};
  record.problem.objective[0].over = "mean";
  record.problem.objective[0].target = 0.1;
  record.problem.quantile = 0.9;
  write_results(path(), record);
  expect_same(record, read_results(path()));
}

TEST_F(ResultsFile, KeepsAFrontAndRefusesOneThatCannotBe) {
  const RunRecord record = sample_front();
  write_results(path(), record);
  expect_same(record, read_results(path()));
  for (const auto& spoil :
       {+[](FrontRecord& front) { front.evaluation[0] = 4; }, +[](FrontRecord& front) { front.compromise = 2; },
        +[](FrontRecord& front) { front.bars.pop_back(); }, +[](FrontRecord& front) { front.ideal.pop_back(); }}) {
    RunRecord wrong = record;
    spoil(*wrong.front);
    EXPECT_THROW(write_results(path(), wrong), InputError);
  }
}

TEST_F(ResultsFile, KeepsARunWithoutAnything) {
  const RunRecord record;
  write_results(path(), record);
  expect_same(record, read_results(path()));
}

TEST_F(ResultsFile, KeepsADesignWithoutPieces) {
  RunRecord record = sample_record();
  record.best_design = DesignRecord{};
  record.baseline_design.reset();
  record.best.reset();
  record.least_broken = 2;
  write_results(path(), record);
  expect_same(record, read_results(path()));
}

TEST_F(ResultsFile, ReplacesAnOlderFileAndLeavesNothingBeside) {
  write_results(path(), RunRecord{});
  write_results(path(), sample_record());
  EXPECT_EQ(read_results(path()).name, "sample");
  EXPECT_EQ(std::distance(fs::directory_iterator(path().parent_path()), fs::directory_iterator{}), 1);
}

TEST_F(ResultsFile, RefusesAForeignFile) {
  {
    hdf5::File::create(path("model.h5").string()).write_attribute("/", "format", std::string("dovetail-reduced-model"));
  }
  EXPECT_THAT(refusal(path("model.h5")), testing::HasSubstr("no results file"));
  std::ofstream(path("text.h5")) << "not HDF5 at all\n";
  EXPECT_THAT(refusal(path("text.h5")), testing::HasSubstr("text.h5"));
  EXPECT_THAT(refusal(path("missing.h5")), testing::HasSubstr("missing.h5"));
}

TEST_F(ResultsFile, RefusesANewerVersion) {
  {
    hdf5::File file = hdf5::File::create(path().string());
    file.write_attribute("/", "format", std::string("dovetail-results"));
    file.write_attribute("/", "version", std::int64_t{2});
  }
  EXPECT_THAT(refusal(path()), testing::HasSubstr("another version"));
}

TEST_F(ResultsFile, RefusesATruncatedFileWhereverItEnds) {
  write_results(path(), sample_record());
  std::ifstream in(path(), std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(in)), {});
  for (const double fraction : {0.02, 0.3, 0.6, 0.9, 0.999}) {
    std::ofstream(path("cut.h5"), std::ios::binary | std::ios::trunc)
        << bytes.substr(0, static_cast<std::size_t>(fraction * static_cast<double>(bytes.size())));
    EXPECT_FALSE(refusal(path("cut.h5")).empty()) << "cut at " << fraction;
  }
}

TEST_F(ResultsFile, RefusesListsOfDifferentLengths) {
  RunRecord record = sample_record();
  record.best_design->unworn.amplitude_m.pop_back();
  write_results(path(), record);
  EXPECT_THAT(refusal(path()), testing::HasSubstr("response curves"));

  record = sample_record();
  record.best_design->contact.flank.front() = 7;
  write_results(path(), record);
  EXPECT_THAT(refusal(path()), testing::HasSubstr("flank_names"));

  record = sample_record();
  record.best_design->fields.mesh.connectivity[3] = 6;
  write_results(path(), record);
  EXPECT_THAT(refusal(path()), testing::HasSubstr("indices of nodes"));
}

TEST_F(ResultsFile, RefusesToWriteAnEvaluationOfAnotherProblem) {
  RunRecord record = sample_record();
  record.evaluations[1].x.pop_back();
  EXPECT_THROW(write_results(path(), record), InputError);
  EXPECT_FALSE(fs::exists(path()));
}

TEST_F(ResultsFile, NamesAPlaceThatCannotBeWritten) {
  EXPECT_THROW(write_results(path() / "nowhere" / "results.h5", sample_record()), InputError);
}

}  // namespace
}  // namespace dovetail::report
