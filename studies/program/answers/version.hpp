#pragma once

namespace dovetail::studies {

/// Of the program, "1.2.3".
[[nodiscard]] const char* version();

}  // namespace dovetail::studies
