#pragma once

#include <filesystem>

#include "studies/report/record/run_record.hpp"

namespace dovetail::report {

/// The results file (HDF5), written beside its place and renamed. Numbers read back bit by bit. Names carry SI units;
/// values of design variables are in the units their keys name.
///
///   / attributes      format "dovetail-results", version 1, name, title, status, message, seconds,
///                     best, least_broken, baseline (index of an evaluation, -1: none)
///   /provenance       attributes program_version, date_utc, compiler, study_file; study_text, library_names,
///                     library_versions, option_names, option_values, setting_names, setting_values
///   /problem          variables {key, lower, upper, start}, objective {response, weight, scale, absolute},
///                     constraints {response, lower, upper, has_lower, has_upper, scale, absolute}, constraint_names
///   /evaluations      [E] x [E,n], phase, status, feasible, objective, violation, constraints [E,C], seconds;
///                     responses, error_estimates and rules {names [R], values [E,R], present [E,R]};
///                     messages {evaluation, text}
///   /best, /baseline  a design each, when there is one: parameters, responses, error_estimates {names, values};
///                     profile/{blade, disk, finished_blade} {name, start_m [.,2], end_m [.,2], center_m [.,2],
///                     radius_m, sweep_rad}; contact/...; unworn, worn, glued {frequency_hz, amplitude_m, status};
///                     nodal_diameters/...; fillets/{0, 1, ...}/...; history/...; mesh/...; fields/...; notes
///   /verifications    {0, 1, ...} of the best designs, best first: profiles [Nc] of the direct method at the settings
///                     of the search and at finer ones and of the history, and attributes with the numbers of each
///
/// Throws InputError when the file cannot be written.
void write_results(const std::filesystem::path& path, const RunRecord& record);

/// Reads what write_results wrote. Throws InputError, one sentence, for a file that is missing, foreign, newer,
/// truncated or inconsistent.
[[nodiscard]] RunRecord read_results(const std::filesystem::path& path);

}  // namespace dovetail::report
