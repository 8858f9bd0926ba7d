#pragma once

#include <string>
#include <vector>

#include "studies/program/engine/interrupt.hpp"
#include "studies/program/run/run_output.hpp"

namespace dovetail::studies {

/// How far the best design and the start hold where something is other than the study says. What was computed before,
/// for that fingerprint, is taken from departures.jsonl.
[[nodiscard]] std::vector<report::DepartureRecord> departures_of(const RunSite& site,
                                                                 const optimizer::OptimizationResult& result,
                                                                 const std::string& fingerprint,
                                                                 const OrderlyInterrupt& interrupt);

}  // namespace dovetail::studies
