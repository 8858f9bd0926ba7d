#pragma once

#include <string>
#include <string_view>

namespace dovetail::studies {

/// What no option table says: sections of a study file, and keys of its variables, objectives, limits, cases and
/// uncertain numbers.
struct KeyWords {
  std::string_view path;       ///< "scene", "variable.lower"
  std::string_view words;      ///< a sentence
  std::string_view unit = {};  ///< of a number that its key does not name
};

/// Empty words for a path that is not among them.
[[nodiscard]] KeyWords key_words(std::string_view path);

/// Unit a key ends with, for people: "mm" of neck_width_mm, "" when the key is a pure number.
[[nodiscard]] std::string unit_of_key(std::string_view key);

}  // namespace dovetail::studies
