#include "reduction/matrix_market.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>
#include <string_view>
#include <utility>
#include <vector>

#include "core/options.hpp"
#include "core/replace_file.hpp"
#include "reduction/matrix_text.hpp"
#include "reduction/params.hpp"

namespace dovetail::reduction {

namespace {

/// A matrix as it is filled: all of it.
class Dense {
 public:
  static constexpr std::int64_t kLargest = ModelFileParams{}.largest;

  void begin(std::int64_t rows, std::int64_t columns, bool coordinate) {
    matrix_ = Eigen::MatrixXd::Zero(rows, columns);
    if (coordinate) seen_.assign(static_cast<std::size_t>(rows * columns), false);
  }
  /// @return false for an entry that was there before
  bool add(std::int64_t row, std::int64_t column, double value, int /*line*/) {
    matrix_(row, column) = value;
    if (seen_.empty()) return true;
    const auto place = static_cast<std::size_t>(row + matrix_.rows() * column);
    const bool is_new = !seen_[place];
    seen_[place] = true;
    return is_new;
  }
  void mirror() { matrix_.triangularView<Eigen::StrictlyUpper>() = matrix_.transpose(); }
  [[nodiscard]] Eigen::MatrixXd take() { return std::move(matrix_); }

 private:
  Eigen::MatrixXd matrix_;
  std::vector<bool> seen_;
};

/// Its entries alone; whether one is listed twice is for others to find.
class Entries {
 public:
  static constexpr std::int64_t kLargest = std::numeric_limits<int>::max();

  void begin(std::int64_t rows, std::int64_t columns, bool /*coordinate*/) {
    result_.rows = rows;
    result_.columns = columns;
  }
  bool add(std::int64_t row, std::int64_t column, double value, int line) {
    result_.entries.push_back({row, column, value, line});
    return true;
  }
  void mirror() {}
  [[nodiscard]] MatrixEntries take() { return std::move(result_); }

 private:
  MatrixEntries result_;
};

/// Fills a Dense, or Entries.
template <class Matrix>
class MatrixReader {
 public:
  MatrixReader(const std::string& path, const std::string& text)
      : text_(text),
        lines_(path, "Matrix Market", std::string_view(text).substr(std::min(text.find('\n'), text.size())),
               " \t\r\f\v", '%') {}

  auto read() {
    header();
    size();
    matrix_.begin(rows_, columns_, coordinate_);
    if (coordinate_)
      coordinates();
    else
      array();
    if (lines_.next())
      lines_.refuse(lines_.line(), shown(lines_.word(0)), "must be the end of the file: all entries are read");
    if (symmetric_) matrix_.mirror();
    return matrix_.take();
  }

 private:
  void header() {
    std::string line = text_.substr(0, text_.find('\n'));
    std::transform(line.begin(), line.end(), line.begin(),
                   [](char c) { return 'A' <= c && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    std::vector<std::string> words;
    for (std::size_t at = 0; (at = line.find_first_not_of(" \t\r", at)) != std::string::npos && words.size() < 6;) {
      const std::size_t end = std::min(line.find_first_of(" \t\r", at), line.size());
      words.push_back(line.substr(at, end - at));
      at = end;
    }
    if (words.empty() || words[0] != "%%matrixmarket")
      lines_.refuse(1, shown(text_.substr(0, text_.find('\n'))),
                    "the first line must be %%MatrixMarket matrix coordinate real symmetric, or alike");
    if (words.size() != 5 || words[1] != "matrix")
      lines_.refuse(1, shown(line), "must be %%MatrixMarket matrix and three words: format, field and symmetry");
    const auto one_of = [&](const std::string& word, const char* first, const char* second) {
      if (word != first && word != second)
        lines_.refuse(1, shown(word), std::string("must be ") + first + " or " + second);
      return word == first;
    };
    coordinate_ = one_of(words[2], "coordinate", "array");
    if (words[3] != "double") one_of(words[3], "real", "integer");
    symmetric_ = one_of(words[4], "symmetric", "general");
  }

  void size() {
    if (!lines_.next()) lines_.refuse(0, "", "the file ends before the line with the size");
    lines_.require(coordinate_ ? 3 : 2, coordinate_ ? "rows, columns and number of entries" : "rows and columns");
    rows_ = lines_.whole(0, 0, Matrix::kLargest, "the number of rows");
    columns_ = lines_.whole(1, 0, Matrix::kLargest, "the number of columns");
    if (symmetric_ && rows_ != columns_)
      lines_.refuse(lines_.line(), std::to_string(rows_) + " x " + std::to_string(columns_),
                    "must be square: it is symmetric");
    const std::int64_t all = symmetric_ ? rows_ * (rows_ + 1) / 2 : rows_ * columns_;
    entries_ = coordinate_ ? lines_.whole(2, 0, all, "the number of entries") : all;
  }

  void next_entry(std::int64_t read) {
    if (!lines_.next())
      lines_.refuse(lines_.line(), std::to_string(read) + " entries",
                    "must be " + std::to_string(entries_) + " entries, but the file ends here");
  }

  void coordinates() {
    for (std::int64_t k = 0; k < entries_; ++k) {
      next_entry(k);
      lines_.require(3, "row, column and value");
      std::int64_t row = lines_.whole(0, 1, rows_, "a row") - 1, column = lines_.whole(1, 1, columns_, "a column") - 1;
      if (symmetric_ && row < column) std::swap(row, column);
      if (!matrix_.add(row, column, lines_.real(2), lines_.line()))
        lines_.refuse(
            lines_.line(), std::string(lines_.word(0)) + " " + std::string(lines_.word(1)),
            symmetric_ ? "must be an entry not listed before, here or mirrored" : "must be an entry not listed before");
    }
  }

  void array() {
    std::int64_t read = 0;
    for (std::int64_t column = 0; column < columns_; ++column)
      for (std::int64_t row = symmetric_ ? column : 0; row < rows_; ++row) {
        next_entry(read++);
        lines_.require(1, "one value");
        matrix_.add(row, column, lines_.real(0), lines_.line());
      }
  }

  const std::string& text_;
  MatrixText lines_;
  Matrix matrix_;
  bool coordinate_ = false, symmetric_ = false;
  std::int64_t rows_ = 0, columns_ = 0, entries_ = 0;
};

bool is_zero(double value) {
  return std::bit_cast<std::uint64_t>(value) == 0;  // the zero with a minus sign is listed
}

bool same_bits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

}  // namespace

Eigen::MatrixXd read_matrix_market(const std::string& path) {
  const std::string text = matrix_file_text(path);
  return MatrixReader<Dense>(path, text).read();
}

MatrixEntries read_matrix_market_entries(const std::string& path, const std::string& text) {
  return MatrixReader<Entries>(path, text).read();
}

void write_matrix_market(const std::string& path, const Eigen::MatrixXd& matrix, const std::string& comment) {
  const Eigen::Index rows = matrix.rows(), columns = matrix.cols();
  bool symmetric = rows == columns;
  for (Eigen::Index j = 0; j < columns && symmetric; ++j)
    for (Eigen::Index i = 0; i < j && symmetric; ++i) symmetric = same_bits(matrix(i, j), matrix(j, i));
  std::string entries;
  Eigen::Index count = 0;
  for (Eigen::Index j = 0; j < columns; ++j)
    for (Eigen::Index i = symmetric ? j : 0; i < rows; ++i) {
      if (is_zero(matrix(i, j))) continue;
      entries += std::to_string(i + 1) + " " + std::to_string(j + 1) + " " + shortest(matrix(i, j)) + "\n";
      ++count;
    }
  std::string text =
      std::string("%%MatrixMarket matrix coordinate real ") + (symmetric ? "symmetric" : "general") + "\n";
  text += "% " + comment + "\n";
  text += std::to_string(rows) + " " + std::to_string(columns) + " " + std::to_string(count) + "\n";
  replace_file(path, text + entries);
}

}  // namespace dovetail::reduction
