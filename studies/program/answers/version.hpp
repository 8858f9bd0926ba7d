#pragma once

namespace dovetail::studies {

/// Of the program, "1.2.3".
[[nodiscard]] const char* version();

/// Of the answers in JSON: keys may be added without it, and with another one mean something else.
inline constexpr int kAnswerVersion = 1;

}  // namespace dovetail::studies
