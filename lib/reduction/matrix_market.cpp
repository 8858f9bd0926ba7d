#include "reduction/matrix_market.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string_view>
#include <vector>

#include "core/errors.hpp"
#include "core/options.hpp"
#include "core/replace_file.hpp"
#include "reduction/params.hpp"

namespace dovetail::reduction {

namespace {

constexpr std::int64_t kLargest = ModelFileParams{}.largest;

/// The words of a text, line by line; blank lines and comments are passed over.
class Lines {
 public:
  explicit Lines(std::string_view text) : rest_(text) {}

  /// Goes to the next line with words; false at the end of the text.
  bool next() {
    while (!rest_.empty()) {
      const std::size_t end = rest_.find('\n');
      std::string_view line = rest_.substr(0, end);
      rest_ = end == std::string_view::npos ? std::string_view() : rest_.substr(end + 1);
      ++number_;
      split(line);
      if (count_ > 0 && words_[0][0] != '%') return true;
    }
    return false;
  }
  [[nodiscard]] int number() const { return number_; }
  /// Words of the line; one more than `kWords` means "too many".
  [[nodiscard]] std::size_t count() const { return count_; }
  [[nodiscard]] std::string_view word(std::size_t i) const { return words_[i]; }

 private:
  static constexpr std::size_t kWords = 4;
  void split(std::string_view line) {
    count_ = 0;
    const char* const blanks = " \t\r\f\v";
    for (std::size_t begin = line.find_first_not_of(blanks); begin != std::string_view::npos && count_ < kWords;) {
      const std::size_t end = std::min(line.find_first_of(blanks, begin), line.size());
      words_[count_++] = line.substr(begin, end - begin);
      begin = line.find_first_not_of(blanks, end);
    }
  }

  std::string_view rest_;
  int number_ = 0;
  std::size_t count_ = 0;
  std::array<std::string_view, kWords> words_{};
};

/// What a message shows of the file: short and printable.
std::string shown(std::string_view word) {
  std::string text(word.substr(0, 40));
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 0x20 || static_cast<unsigned char>(c) >= 0x7f) c = '?';
  return text;
}

class MatrixReader {
 public:
  MatrixReader(const std::string& path, const std::string& text)
      : path_(path), text_(text), lines_(std::string_view(text).substr(std::min(text.find('\n'), text.size()))) {}

  Eigen::MatrixXd read() {
    header();
    size();
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(rows_, columns_);
    if (coordinate_)
      coordinates(matrix);
    else
      array(matrix);
    if (lines_.next())
      refuse(lines_.number(), shown(lines_.word(0)), "must be the end of the file: all entries are read");
    return matrix;
  }

 private:
  [[noreturn]] void refuse(int line, const std::string& value, const std::string& allowed) const {
    throw InputError({.file = path_, .line = line, .key = "Matrix Market", .value = value, .allowed = allowed});
  }

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
      refuse(1, shown(text_.substr(0, text_.find('\n'))),
             "the first line must be %%MatrixMarket matrix coordinate real symmetric, or alike");
    if (words.size() != 5 || words[1] != "matrix")
      refuse(1, shown(line), "must be %%MatrixMarket matrix and three words: format, field and symmetry");
    const auto one_of = [&](const std::string& word, const char* first, const char* second) {
      if (word != first && word != second) refuse(1, shown(word), std::string("must be ") + first + " or " + second);
      return word == first;
    };
    coordinate_ = one_of(words[2], "coordinate", "array");
    if (words[3] != "double") one_of(words[3], "real", "integer");
    symmetric_ = one_of(words[4], "symmetric", "general");
  }

  std::int64_t whole(std::size_t word, std::int64_t lower, std::int64_t upper, const char* what) {
    const std::string_view text = lines_.word(word);
    std::int64_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size() || value < lower || value > upper)
      refuse(lines_.number(), shown(text),
             std::string("must be ") + what + ", a whole number from " + std::to_string(lower) + " to " +
                 std::to_string(upper));
    return value;
  }

  double real(std::size_t word) {
    std::string_view text = lines_.word(word);
    if (text.starts_with('+')) text.remove_prefix(1);
    // Fortran writes exponents of double precision with a D.
    std::string plain(text);
    std::replace_if(
        plain.begin(), plain.end(), [](char c) { return c == 'D' || c == 'd'; }, 'e');
    double value = 0;
    const auto [end, error] = std::from_chars(plain.data(), plain.data() + plain.size(), value);
    const bool tiny = error == std::errc::result_out_of_range && std::abs(std::strtod(plain.c_str(), nullptr)) < 1;
    if (tiny) value = std::strtod(plain.c_str(), nullptr);
    if ((error != std::errc{} && !tiny) || end != plain.data() + plain.size() || !std::isfinite(value))
      refuse(lines_.number(), shown(lines_.word(word)), "must be a finite number");
    return value;
  }

  void words(std::size_t wanted, const char* what) {
    if (lines_.count() != wanted)
      refuse(lines_.number(), std::to_string(lines_.count()) + (lines_.count() > 3 ? " or more words" : " words"),
             std::string("must be ") + what);
  }

  void size() {
    if (!lines_.next()) refuse(0, "", "the file ends before the line with the size");
    words(coordinate_ ? 3 : 2, coordinate_ ? "rows, columns and number of entries" : "rows and columns");
    rows_ = whole(0, 0, kLargest, "the number of rows");
    columns_ = whole(1, 0, kLargest, "the number of columns");
    if (symmetric_ && rows_ != columns_)
      refuse(lines_.number(), std::to_string(rows_) + " x " + std::to_string(columns_),
             "must be square: it is symmetric");
    const std::int64_t all = symmetric_ ? rows_ * (rows_ + 1) / 2 : rows_ * columns_;
    entries_ = coordinate_ ? whole(2, 0, all, "the number of entries") : all;
  }

  void next_entry(std::int64_t read) {
    if (!lines_.next())
      refuse(lines_.number(), std::to_string(read) + " entries",
             "must be " + std::to_string(entries_) + " entries, but the file ends here");
  }

  void coordinates(Eigen::MatrixXd& matrix) {
    std::vector<bool> seen(static_cast<std::size_t>(rows_ * columns_), false);
    for (std::int64_t k = 0; k < entries_; ++k) {
      next_entry(k);
      words(3, "row, column and value");
      std::int64_t row = whole(0, 1, rows_, "a row") - 1, column = whole(1, 1, columns_, "a column") - 1;
      if (symmetric_ && row < column) std::swap(row, column);
      const auto place = static_cast<std::size_t>(row + rows_ * column);
      if (seen[place])
        refuse(
            lines_.number(), std::string(lines_.word(0)) + " " + std::string(lines_.word(1)),
            symmetric_ ? "must be an entry not listed before, here or mirrored" : "must be an entry not listed before");
      seen[place] = true;
      matrix(row, column) = real(2);
      if (symmetric_) matrix(column, row) = matrix(row, column);
    }
  }

  void array(Eigen::MatrixXd& matrix) {
    std::int64_t read = 0;
    for (std::int64_t column = 0; column < columns_; ++column)
      for (std::int64_t row = symmetric_ ? column : 0; row < rows_; ++row) {
        next_entry(read++);
        words(1, "one value");
        matrix(row, column) = real(0);
        if (symmetric_) matrix(column, row) = matrix(row, column);
      }
  }

  const std::string& path_;
  const std::string& text_;
  Lines lines_;
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
  const auto refuse = [&](const std::string& why) {
    throw InputError(Violation{.file = {}, .key = path, .value = {}, .allowed = "cannot be read: " + why});
  };
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) refuse("it is a directory");
  errno = 0;
  std::ifstream stream(path, std::ios::binary);
  if (!stream) refuse(errno != 0 ? std::strerror(errno) : "it does not open");
  const std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  if (stream.bad()) refuse("reading failed");
  return MatrixReader(path, text).read();
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
