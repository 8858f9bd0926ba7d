#pragma once

#include <span>
#include <string_view>

namespace dovetail::optimizer {

/// One scalar an evaluation may answer with: usable as objective or in a constraint.
struct ResponseName {
  std::string_view name;  ///< with its SI unit
  std::string_view unit;  ///< "" when dimensionless
  std::string_view help;  ///< one sentence
};

/// All responses, in the order of the reports. An evaluation may leave some out, never add others.
[[nodiscard]] std::span<const ResponseName> response_names();

/// The entry of that name, or nullptr.
[[nodiscard]] const ResponseName* find_response(std::string_view name);

}  // namespace dovetail::optimizer
