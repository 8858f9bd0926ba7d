#include "reduction/matrix_text.hpp"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "core/errors.hpp"

namespace dovetail::reduction {

std::string matrix_file_text(const std::string& path) {
  const auto refuse = [&](const std::string& why) {
    throw InputError(Violation{.file = {}, .key = path, .value = {}, .allowed = "cannot be read: " + why});
  };
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) refuse("it is a directory");
  errno = 0;
  std::ifstream stream(path, std::ios::binary);
  if (!stream) refuse(errno != 0 ? std::strerror(errno) : "it does not open");
  std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  if (stream.bad()) refuse("reading failed");
  return text;
}

std::string shown(std::string_view word) {
  std::string text(word.substr(0, 40));
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 0x20 || static_cast<unsigned char>(c) >= 0x7f) c = '?';
  return text;
}

bool MatrixText::next() {
  while (!rest_.empty()) {
    const std::size_t end = rest_.find('\n');
    const std::string_view line = rest_.substr(0, end);
    rest_ = end == std::string_view::npos ? std::string_view() : rest_.substr(end + 1);
    ++line_;
    split(line);
    if (count_ > 0 && words_[0][0] != comment_) return true;
  }
  return false;
}

void MatrixText::split(std::string_view line) {
  count_ = 0;
  for (std::size_t begin = line.find_first_not_of(blanks_); begin != std::string_view::npos && count_ < kWords;) {
    const std::size_t end = std::min(line.find_first_of(blanks_, begin), line.size());
    words_[count_++] = line.substr(begin, end - begin);
    begin = line.find_first_not_of(blanks_, end);
  }
}

std::int64_t MatrixText::whole(std::size_t word, std::int64_t lower, std::int64_t upper, const char* what) const {
  const std::string_view text = words_[word];
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || value < lower || value > upper)
    refuse(line_, shown(text),
           std::string("must be ") + what + ", a whole number from " + std::to_string(lower) + " to " +
               std::to_string(upper));
  return value;
}

double MatrixText::real(std::size_t word) const {
  std::string_view text = words_[word];
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
    refuse(line_, shown(words_[word]), "must be a finite number");
  return value;
}

void MatrixText::require(std::size_t wanted, const char* what) const {
  if (count_ != wanted)
    refuse(line_, std::to_string(count_) + (count_ > wanted ? " or more words" : " words"),
           std::string("must be ") + what);
}

void MatrixText::refuse(int line, const std::string& value, const std::string& allowed) const {
  throw InputError({.file = path_, .line = line, .key = kind_, .value = value, .allowed = allowed});
}

}  // namespace dovetail::reduction
