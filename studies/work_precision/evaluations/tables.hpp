#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "studies/work_precision/evaluations/points.hpp"

namespace dovetail::work_precision {

/// Every point as one row, the references first: settings, status, seconds by stage, responses and their errors.
/// Numbers with 17 digits, empty where there is none.
[[nodiscard]] std::string evaluations_csv(const std::vector<WholeDiagram>& diagrams);

/// The same with fronts, choices and what they compare to.
[[nodiscard]] nlohmann::ordered_json evaluations_json(const std::vector<WholeDiagram>& diagrams);

}  // namespace dovetail::work_precision
