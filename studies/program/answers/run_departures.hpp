#pragma once

#include <string>
#include <vector>

#include "studies/program/answers/run_output.hpp"
#include "studies/program/engine/interrupt.hpp"

namespace dovetail::studies {

/// How far the best design and the start hold where something is other than the study says. What was computed before,
/// for that fingerprint, is taken from departures.jsonl.
[[nodiscard]] std::vector<report::DepartureRecord> departures_of(const RunSite& site,
                                                                 const optimizer::OptimizationResult& result,
                                                                 const std::string& fingerprint,
                                                                 const OrderlyInterrupt& interrupt);

}  // namespace dovetail::studies
