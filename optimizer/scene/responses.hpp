#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "optimizer/scene/scene.hpp"

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

/// Responses that grow without limit as the scene's mesh becomes finer: the peak of pressure at sharp ends of flanks
/// that are not rough. In space, where no bar is known for rough ones, theirs as well.
[[nodiscard]] std::vector<std::string> responses_without_limit(const Scene& scene);

}  // namespace dovetail::optimizer
