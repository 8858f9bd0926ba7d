#pragma once

#include <string>

#include "studies/work_precision/evaluations/points.hpp"

namespace dovetail::work_precision {

// Sentences for people, computed from the points.

/// How fast a choice is beside the cheapest setting known, at the accuracy asked for and at its true error, and which
/// of its knobs are finer or coarser than there.
[[nodiscard]] std::string choice_verdict(const WholeDiagram& diagram, const AutomaticChoice& choice);

/// What the paper's settings err and take beside the program's choices.
[[nodiscard]] std::string paper_verdict(const WholeDiagram& diagram);

/// How well the references agree, on which response they do worst, and how many points failed.
[[nodiscard]] std::string reference_verdict(const WholeDiagram& diagram);

/// "1.5 %", of an error.
[[nodiscard]] std::string error_words(double error);

}  // namespace dovetail::work_precision
