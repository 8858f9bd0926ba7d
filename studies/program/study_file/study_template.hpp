#pragma once

#include <string>
#include <string_view>

namespace dovetail::studies {

/// A commented study to start from: every key with its meaning, unit, range and default, made from the option tables.
/// It reads without a complaint, evaluates and may be run.
[[nodiscard]] std::string study_template(const std::string& title);

/// A sentence of an option table as a text of its own: with a capital letter.
[[nodiscard]] std::string capitalised(std::string_view help);

/// Unit a key ends with, for people: "mm" of neck_width_mm, "" when the key is a pure number.
[[nodiscard]] std::string unit_of_key(std::string_view key);

}  // namespace dovetail::studies
