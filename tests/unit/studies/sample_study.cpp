#include "tests/unit/studies/sample_study.hpp"

#include <gtest/gtest.h>

#include <sstream>

#include "studies/program/study_file/study.hpp"

namespace dovetail::studies {

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << "no '" << from << "' in the study";
  if (at != std::string::npos) text.replace(at, from.size(), to);
  return text;
}

std::string without(const std::string& text, const std::string& start) {
  std::istringstream lines(text);
  std::string kept;
  bool found = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with(start))
      found = true;
    else
      kept += line + "\n";
  }
  EXPECT_TRUE(found) << "no line starts with '" << start << "'";
  return kept;
}

std::string complaints(const std::string& text) {
  try {
    (void)read_study(parse_document(text, "s.toml"));
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

}  // namespace dovetail::studies
