#pragma once

#include <optional>
#include <string>
#include <vector>

#include "studies/program/engine/loaded_model.hpp"

namespace dovetail::studies {

/// The relative accuracy of amplitudes that `auto` has to reach; that of energies and wear is ten times as large.
[[nodiscard]] double accuracy(const SolverChoice& solver);

/// Chooses what `solver` leaves to be automatic for a response at these frequencies and writes it to
/// loaded.joint.options. Returns how the choice ended (see quality::AutomaticSettings), or nothing when nothing was to
/// be chosen.
std::optional<Status> choose_truncation(LoadedModel& loaded, const std::vector<double>& hz, const SolverChoice& solver);

/// One sentence about a choice that did not reach the accuracy.
[[nodiscard]] std::string truncation_complaint(Status status, const steady::Options& reached,
                                               const SolverChoice& solver);

}  // namespace dovetail::studies
