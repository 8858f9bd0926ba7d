#include "reduction/matrix_market.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <bit>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>

#include "core/errors.hpp"

namespace dovetail::reduction {
namespace {

using testing::HasSubstr;

class MatrixMarket : public testing::Test {
 protected:
  void SetUp() override {
    path_ = (std::filesystem::temp_directory_path() /
             ("dovetail_" + std::to_string(getpid()) + "_" +
              testing::UnitTest::GetInstance()->current_test_info()->name() + ".mtx"))
                .string();
  }
  void TearDown() override { std::filesystem::remove(path_); }

  Eigen::MatrixXd reading(const std::string& text) const {
    std::ofstream(path_, std::ios::binary) << text;
    return read_matrix_market(path_);
  }
  std::string refusal(const std::string& text) const {
    try {
      (void)reading(text);
      return {};
    } catch (const InputError& error) {
      EXPECT_EQ(error.violations().size(), 1U);
      return error.what();
    }
  }

  std::string path_;
};

TEST_F(MatrixMarket, ReadsEachOfItsForms) {
  const Eigen::MatrixXd wanted = (Eigen::MatrixXd(2, 2) << 1, 2.5, 2.5, -3e-4).finished();
  EXPECT_EQ(reading("%%MatrixMarket matrix coordinate real general\n2 2 4\n1 1 1\n2 1 2.5\n1 2 2.5\n2 2 -3e-4\n"),
            wanted);
  EXPECT_EQ(reading("%%MatrixMarket matrix coordinate real symmetric\n2 2 3\n1 1 1\n2 1 2.5\n2 2 -3e-4"), wanted);
  EXPECT_EQ(reading("%%MatrixMarket matrix coordinate real symmetric\n2 2 3\n1 1 1\n1 2 2.5\n2 2 -3e-4"), wanted);
  EXPECT_EQ(reading("%%MatrixMarket matrix array real general\n2 2\n1\n2.5\n2.5\n-3e-4\n"), wanted);
  EXPECT_EQ(reading("%%MatrixMarket matrix array double symmetric\n2 2\n1\n2.5\n-3e-4\n"), wanted);
  EXPECT_EQ(reading("%%matrixmarket MATRIX Coordinate Integer General\n2 3 1\n2 3 -7\n"),
            (Eigen::MatrixXd(2, 3) << 0, 0, 0, 0, 0, -7).finished());
}

TEST_F(MatrixMarket, ReadsCommentsBlankLinesAndTheNumbersOfFortranAndWindows) {
  EXPECT_EQ(reading("%%MatrixMarket matrix coordinate real general\r\n% by hand\r\n\r\n  1 2 2\r\n%\r\n"
                    "1 1 +1.5D+02\r\n\t1  2   .5\r\n\n"),
            (Eigen::MatrixXd(1, 2) << 150, 0.5).finished());
}

TEST_F(MatrixMarket, EntriesNotListedAreZero) {
  EXPECT_EQ(reading("%%MatrixMarket matrix coordinate real symmetric\n3 3 0\n"), Eigen::MatrixXd::Zero(3, 3));
}

TEST_F(MatrixMarket, ReturnsWhatWasWrittenToTheLastBit) {
  Eigen::MatrixXd general = Eigen::MatrixXd::Random(7, 7) * 1e9;
  general(0, 1) = 1.0 / 3.0;
  general(2, 3) = std::numeric_limits<double>::denorm_min();
  general(3, 2) = std::numeric_limits<double>::max();
  general(4, 4) = -0.0;
  general(5, 5) = 0;
  const Eigen::MatrixXd symmetric = general + general.transpose();
  for (const Eigen::MatrixXd& matrix : {general, symmetric}) {
    write_matrix_market(path_, matrix, "test");
    const Eigen::MatrixXd read = read_matrix_market(path_);
    ASSERT_EQ(read.rows(), 7);
    for (Eigen::Index i = 0; i < matrix.size(); ++i)
      EXPECT_EQ(std::bit_cast<std::uint64_t>(read(i)), std::bit_cast<std::uint64_t>(matrix(i))) << i;
  }
}

TEST_F(MatrixMarket, RefusesEachFlawInOneSentenceWithItsLine) {
  const std::string general = "%%MatrixMarket matrix coordinate real general\n";
  const std::string symmetric = "%%MatrixMarket matrix coordinate real symmetric\n";
  const std::string array = "%%MatrixMarket matrix array real general\n";
  EXPECT_THAT(refusal(""), HasSubstr("the first line must be %%MatrixMarket matrix coordinate real symmetric"));
  EXPECT_THAT(refusal("1 1 1\n"), HasSubstr(":1: Matrix Market = 1 1 1: the first line must be"));
  EXPECT_THAT(refusal("%%MatrixMarket vector coordinate real general\n"), HasSubstr("matrix and three words"));
  EXPECT_THAT(refusal("%%MatrixMarket matrix coordinate complex general\n1 1 0"),
              HasSubstr(":1: Matrix Market = complex: must be real or integer"));
  EXPECT_THAT(refusal("%%MatrixMarket matrix coordinate pattern general\n1 1 0"), HasSubstr("= pattern: must be real"));
  EXPECT_THAT(refusal("%%MatrixMarket matrix coordinate real skew-symmetric\n1 1 0"),
              HasSubstr("= skew-symmetric: must be symmetric or general"));
  EXPECT_THAT(refusal(general), HasSubstr("ends before the line with the size"));
  EXPECT_THAT(refusal(general + "2 2\n"), HasSubstr(":2: Matrix Market = 2 words: must be rows, columns and number"));
  EXPECT_THAT(refusal(general + "-2 2 0\n"), HasSubstr("= -2: must be the number of rows"));
  EXPECT_THAT(refusal(general + "99999 2 0\n"), HasSubstr("from 0 to 20000"));
  EXPECT_THAT(refusal(general + "2 2 5\n"),
              HasSubstr("= 5: must be the number of entries, a whole number from 0 to 4"));
  EXPECT_THAT(refusal(symmetric + "2 3 0\n"), HasSubstr("= 2 x 3: must be square"));
  EXPECT_THAT(refusal(general + "2 2 2\n1 1 1\n"), HasSubstr("= 1 entries: must be 2 entries, but the file ends here"));
  EXPECT_THAT(refusal(general + "2 2 1\n1 1 1\n2 2 1\n"), HasSubstr(":4: Matrix Market = 2: must be the end"));
  EXPECT_THAT(refusal(general + "2 2 1\n0 1 1\n"), HasSubstr(":3: Matrix Market = 0: must be a row, a whole number"));
  EXPECT_THAT(refusal(general + "2 2 1\n1 3 1\n"), HasSubstr("= 3: must be a column, a whole number from 1 to 2"));
  EXPECT_THAT(refusal(general + "2 2 1\n1.5 1 1\n"), HasSubstr("= 1.5: must be a row"));
  EXPECT_THAT(refusal(general + "2 2 1\n1 1 nan\n"), HasSubstr("= nan: must be a finite number"));
  EXPECT_THAT(refusal(general + "2 2 1\n1 1 1e999\n"), HasSubstr("= 1e999: must be a finite number"));
  EXPECT_THAT(refusal(general + "2 2 1\n1 1 1x\n"), HasSubstr("= 1x: must be a finite number"));
  EXPECT_THAT(refusal(general + "2 2 1\n1 1\n"), HasSubstr("= 2 words: must be row, column and value"));
  EXPECT_THAT(refusal(general + "2 2 1\n1 1 1 1\n"), HasSubstr("= 4 or more words: must be row, column and value"));
  EXPECT_THAT(refusal(general + "2 2 2\n1 2 1\n1 2 1\n"), HasSubstr(":4: Matrix Market = 1 2: must be an entry not"));
  EXPECT_THAT(refusal(symmetric + "2 2 2\n1 2 1\n2 1 1\n"), HasSubstr("not listed before, here or mirrored"));
  EXPECT_THAT(refusal(array + "2 2\n1\n2\n3\n"), HasSubstr("= 3 entries: must be 4 entries"));
  EXPECT_THAT(refusal(array + "1 1\n1 2\n"), HasSubstr("must be one value"));
}

TEST_F(MatrixMarket, NamesAFileThatCannotBeRead) {
  EXPECT_THROW((void)read_matrix_market(path_ + ".missing"), InputError);
  EXPECT_THROW((void)read_matrix_market(std::filesystem::temp_directory_path().string()), InputError);
}

}  // namespace
}  // namespace dovetail::reduction
