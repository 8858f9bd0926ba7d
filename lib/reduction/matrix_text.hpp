#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

namespace dovetail::reduction {

/// The text of a matrix file. Throws InputError when it cannot be read.
[[nodiscard]] std::string matrix_file_text(const std::string& path);

/// The words of a matrix file, line by line; blank lines and comments are passed over.
class MatrixText {
 public:
  /// - `text`: outlives this
  /// - `kind`: of file, for messages
  /// - `blanks`: what stands between words
  /// - `comment`: with what a line begins that is none
  MatrixText(std::string path, std::string kind, std::string_view text, std::string_view blanks, char comment)
      : path_(std::move(path)), kind_(std::move(kind)), rest_(text), blanks_(blanks), comment_(comment) {}

  /// Goes to the next line with words; false at the end of the text.
  bool next();
  [[nodiscard]] int line() const { return line_; }  ///< from 1
  /// Words of the line; one more than `kWords` means "too many".
  [[nodiscard]] std::size_t count() const { return count_; }
  [[nodiscard]] std::string_view word(std::size_t i) const { return words_[i]; }

  /// The word as a number. Throws InputError.
  [[nodiscard]] std::int64_t whole(std::size_t word, std::int64_t lower, std::int64_t upper, const char* what) const;
  [[nodiscard]] double real(std::size_t word) const;
  /// Throws InputError unless the line has so many words.
  void require(std::size_t wanted, const char* what) const;

  [[noreturn]] void refuse(int line, const std::string& value, const std::string& allowed) const;

 private:
  static constexpr std::size_t kWords = 20;
  void split(std::string_view line);

  std::string path_, kind_;
  std::string_view rest_, blanks_;
  char comment_;
  int line_ = 0;
  std::size_t count_ = 0;
  std::array<std::string_view, kWords> words_{};
};

/// What a message shows of a file: short and printable.
[[nodiscard]] std::string shown(std::string_view word);

}  // namespace dovetail::reduction
