#pragma once

#include <nlohmann/json_fwd.hpp>

#include "optimizer/accuracy/choice.hpp"

namespace dovetail::studies {

/// {"status", "settings":{KEY: value}, "response", "source", "relative_bar", "asked", "not_held", "raised":{RESPONSE:
/// {SOURCE: part of its bar over the value}}, "rounds":[{"settings", "status", "response", "source", "relative_bar",
/// "asked", "operations", "out_of_line"}], "one_more_digit":{"settings", "times_as_long"}}: what was chosen for the
/// scene in the file's units, the response that comes closest to the bar it may have or passes it, and what leaves most
/// of that. What is not known is null.
[[nodiscard]] nlohmann::ordered_json accuracy_json(const optimizer::Scene& scene,
                                                   const optimizer::SettingsChoice& choice);

}  // namespace dovetail::studies
