#pragma once

#include <Eigen/Core>
#include <string>
#include <variant>
#include <vector>

#include "optimizer/journal/record_fields.hpp"
#include "studies/program/engine/loaded_model.hpp"
#include "studies/program/questions/wear_options.hpp"
#include "wear/history/history.hpp"

namespace dovetail::optimizer {

/// What --resume needs besides the states.
template <>
inline constexpr auto kFields<wear::StepMemory> =
    std::tuple{RecordField{"next_step_cycles", &wear::StepMemory::step},
               RecordField{"penetration_m", &wear::StepMemory::penetration},
               RecordField{"no_wear_m_per_cycle", &wear::StepMemory::no_wear},
               RecordField{"finish_below", &wear::StepMemory::finish_below},
               RecordField{"recovering", &wear::StepMemory::recovering},
               RecordField{"jumps", &wear::StepMemory::jumps},
               RecordField{"factored_displacement_m", &wear::StepMemory::factored_displacement},
               RecordField{"factored_depth_m", &wear::StepMemory::factored_depth},
               RecordField{"factored_stage_cycles", &wear::StepMemory::factored_cycles}};

}  // namespace dovetail::optimizer

namespace dovetail::studies {

/// One thing that a history and one that goes on with it share: the model, the excitation, or a setting that moves the
/// result beyond the error of its steps.
struct IdentityEntry {
  std::string key;
  std::variant<std::string, double> value;

  bool operator==(const IdentityEntry&) const = default;
};

/// "model" (a checksum of its matrices, forces and contact data), "integrator", "follow", "frequency_hz", "harmonics",
/// "samples", pseudo-penalties and "slip_return". `hz` is where the excitation begins.
[[nodiscard]] std::vector<IdentityEntry> history_identity(const WearOptions& options, const LoadedModel& loaded,
                                                          double hz);

/// FNV-1a of the bytes of all numbers in a reduced model that a periodic solution and its wear depend on, hexadecimal.
[[nodiscard]] std::string checksum(const reduction::ReducedModel& model);

/// A history as `dovetail wear --json` wrote it, with what resuming needs.
struct StoredHistory {
  wear::History history;  ///< of `steady` only the displacement, of the last state
  std::vector<IdentityEntry> identity;
  double frequency_hz = 0;  ///< where its excitation began
  double tolerance = 0;
  double increment = 0;    ///< m; 0: an implicit one
  double depth_scale = 0;  ///< m; 0: not computed
};

/// Throws InputError for a file that is no complete answer of `wear --method history`, or one of other contact nodes.
[[nodiscard]] StoredHistory read_history(const std::string& file, Eigen::Index nodes);

/// Throws InputError, one sentence per entry, when the stored history is not one of `wanted`.
void check_identity(const StoredHistory& stored, const std::vector<IdentityEntry>& wanted, const std::string& file);

}  // namespace dovetail::studies
