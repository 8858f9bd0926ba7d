#include "core/errors.hpp"

#include <utility>

namespace dovetail {

std::string Violation::sentence() const {
  std::string text;
  if (!file.empty()) {
    text += file;
    if (line > 0) text += ":" + std::to_string(line);
    text += ": ";
  }
  text += key;
  if (!value.empty()) text += " = " + value;
  text += ": " + allowed;
  return text;
}

namespace {
std::string sentences(const std::vector<Violation>& violations) {
  std::string text;
  for (const Violation& violation : violations) {
    if (!text.empty()) text += "\n";
    text += violation.sentence();
  }
  return text;
}
}  // namespace

InputError::InputError(std::vector<Violation> violations)
    : std::runtime_error(sentences(violations)), violations_(std::move(violations)) {}

}  // namespace dovetail
