#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "fem/mesh.hpp"
#include "geometry/profile/profile.hpp"
#include "optimizer/problem/problem.hpp"
#include "optimizer/search/run.hpp"

namespace dovetail::report {

using Numbers = std::vector<double>;

/// The contact nodes of one design, flank by flank, in space line by line along the slot, from the neck side to the
/// root side; all lists have Nc entries.
struct ContactRecord {
  std::vector<std::string> flank_names;  ///< "left", "right"
  std::vector<std::int64_t> flank;       ///< index into flank_names
  Numbers along_m;                       ///< along the flank from its neck-side node
  Numbers across_m;  ///< along the slot from its middle, of the line's neck-side node; in the plane zero or empty
  Numbers x_m, y_m;
  Numbers area_m2;
  Numbers gap_m;  ///< initial, unloaded
  Numbers preload_pressure_pa;
  Numbers wear_rate_m_per_cycle;  ///< of the unworn state at the unworn resonance
  Numbers slip_m_per_cycle;       ///< path under load of that state
  Numbers depth_m;                ///< asymptotic wear depth, both surfaces together
};

/// Amplitude of the aerofoil tip over the excitation frequency; three lists of one length. Where `status` is not
/// "converged" the amplitude is NaN.
struct ResponseCurve {
  Numbers frequency_hz, amplitude_m;
  std::vector<std::string> status;
};

/// Natural frequencies of the glued bladed disk at speed over its nodal diameters.
struct NodalDiameterRecord {
  std::vector<std::int64_t> nodal_diameter;  ///< [D]
  std::int64_t modes = 0;                    ///< M
  Numbers frequency_hz;                      ///< [D, M] row by row, ascending in a row; negative: unstable
  std::vector<std::string> status;           ///< [D]
};

/// Largest von Mises stress over one period of the unworn resonance at the nodes of the fillets of one body.
struct FilletRecord {
  std::string name;  ///< "blade" or "disk"
  Numbers x_m, y_m;  ///< nodes
  Numbers von_mises_pa;
  double aggregate_pa = 0, maximum_pa = 0;
};

/// Wear over cycles; lists of S states, state 0 unworn.
struct HistoryRecord {
  std::string status, end;  ///< of wear::History
  Numbers cycles, worn_volume_m3, depth_max_m, amplitude_m, frequency_hz;
  std::vector<std::int64_t> profile_states;  ///< [P] states whose depths are kept
  Numbers profile_depth_m;                   ///< [P, Nc] row by row
};

/// The mesh of the section and nodal fields on it; without elements: not kept.
struct FieldRecord {
  fem::Mesh mesh;
  Numbers displacement_m;                      ///< [n, d] of the preload (spin-up)
  Numbers von_mises_pa;                        ///< [n] of the preload
  std::vector<std::int64_t> flank_nodes = {};  ///< [K] nodes of the mesh on the flanks, of blade and disk
  std::vector<std::int64_t> flank_cells = {};  ///< [K] the contact node that is a cell there
  Numbers mode_frequency_hz = {};  ///< [M] natural frequencies of the joint at speed with stuck rigid flanks
  Numbers mode_shapes = {};        ///< [M, n d] their shapes row by row, the longest displacement 1
};

/// Everything shown or exported of one design. Pieces that could not be computed are empty; `notes` says why.
struct DesignRecord {
  std::string status;                             ///< of its evaluation
  std::map<std::string, double> parameters;       ///< KEY as for --set -> value in the study file's unit
  std::map<std::string, double> responses;        ///< name with SI unit -> value
  std::map<std::string, double> error_estimates;  ///< response -> error bar, SI
  geometry::Profile profile;                      ///< nominal section, m
  geometry::Chain finished_blade;                 ///< the blade with the form of its flanks
  ContactRecord contact;
  ResponseCurve unworn, worn;  ///< with friction
  ResponseCurve glued;         ///< the linear model without contact, same force and damping
  NodalDiameterRecord nodal_diameters;
  std::vector<FilletRecord> fillets;
  std::optional<HistoryRecord> history;
  FieldRecord fields;
  std::vector<std::string> notes;  ///< sentences for people
};

/// One candidate of the run.
struct EvaluationRecord {
  Numbers x;  ///< design-space order, file units
  std::string phase;
  std::string status;  ///< of the evaluation
  bool feasible = false;
  double objective = 0;  ///< NaN unless computed
  double violation = 0;  ///< sum of what constraints and rules are broken by
  Numbers constraints;   ///< c in the order of constraint_names, NaN unless computed
  double seconds = 0;
  std::map<std::string, double> responses;
  std::map<std::string, double> error_estimates;
  std::map<std::string, double> rules;  ///< geometric rule without its prefix -> c, kept when <= 0
  std::vector<std::string> messages;
};

/// One of the best designs with its wear by the full history, at the settings it was searched with, and directly at
/// finer ones (`direct_`, `flank_elements`, `harmonics`, `samples`); see optimizer::Verification.
struct VerificationRecord {
  std::int64_t evaluation = 0;  ///< index of the candidate
  std::string status, follow;
  std::string load_case;  ///< empty where the study has none
  std::int64_t flank_elements = 0, harmonics = 0, samples = 0, direct_solves = 0, history_solves = 0;
  double frequency_hz = 0, search_volume_m3 = 0, search_bar_m3 = 0, search_depth_m = 0;
  double direct_volume_m3 = 0, direct_depth_m = 0, history_volume_m3 = 0, history_depth_m = 0;
  double history_bar_m3 = 0, profile_difference = 0, cycles = 0, seconds = 0;
  std::vector<std::string> flank_names;
  std::vector<std::int64_t> flank;                                ///< [Nc]
  Numbers along_m;                                                ///< [Nc]
  Numbers across_m;                                               ///< [Nc] along the slot; zero or empty in the plane
  Numbers search_profile_m, direct_profile_m, history_profile_m;  ///< [Nc] or empty

  /// Whether the history came to an end, so that its numbers say something; whether the finer mesh has an answer.
  [[nodiscard]] bool history_known() const { return !history_profile_m.empty(); }
  [[nodiscard]] bool finer_known() const { return !direct_profile_m.empty(); }
  /// The status in words. Within a bar as large as the value anything lies.
  [[nodiscard]] std::string agreement() const;
};

/// The nodes of a flank on the line from its neck to its root side on which `values` are largest, in the order of the
/// record: all of them in the plane. Empty when the flank has no node.
[[nodiscard]] std::vector<std::size_t> worst_line(const std::vector<std::int64_t>& flanks, const Numbers& across,
                                                  const Numbers& values, std::int64_t flank);

/// What several objectives came to that were wanted each for itself; see optimizer::Front. Values are those of the
/// search, of what the objectives are about, in SI and as it is, also where more is better.
struct FrontRecord {
  std::vector<std::string> objectives;   ///< [O] responses, or in bars how far they are from their aim; where cases
                                         ///< count in another way than by the worst with "@" and that
  std::vector<std::int64_t> evaluation;  ///< [P] index of the candidate of every point
  Numbers values;                        ///< [P, O] row by row
  Numbers bars;                          ///< [P, O] NaN where none were asked, or there are none
  Numbers ideal, reference;              ///< [O]
  double hypervolume = 0;                ///< in the product of the units
  std::int64_t compromise = 0;           ///< index of a point

  [[nodiscard]] std::size_t columns() const { return objectives.size(); }
  [[nodiscard]] double value(std::size_t point, std::size_t objective) const {
    return values[point * columns() + objective];
  }
  [[nodiscard]] double bar(std::size_t point, std::size_t objective) const {
    return bars[point * columns() + objective];
  }
};

/// With what the results were made.
struct Provenance {
  std::string program_version;
  std::string date_utc;  ///< ISO 8601, when the record was made
  std::string compiler;
  std::map<std::string, std::string> libraries;    ///< name -> version
  std::map<std::string, std::string> options;      ///< of the optimiser, key -> value as text
  std::map<std::string, std::string> settings;     ///< chosen for an accuracy, key -> value as text
  std::map<std::string, std::string> linked = {};  ///< key of the study file -> formula of the design variables
  std::string study_file, study_text;              ///< name and verbatim content
};

/// How a candidate keeps its limits on a finer mesh; see optimizer::FinerCheck.
struct FinerRecord {
  std::int64_t evaluation = 0;  ///< index of the candidate
  std::int64_t flank_elements = 0;
  std::string status;   ///< of the evaluation there
  Numbers constraints;  ///< c in the order of constraint_names, NaN unless computed
};

/// What becomes of a design where something is other than its study says; see optimizer::usual_departures.
struct DepartureRecord {
  std::int64_t evaluation = 0;  ///< index of the candidate
  std::string departure;        ///< its name
  std::string status;           ///< of the evaluation there
  double objective = 0;         ///< NaN unless computed
  Numbers constraints;          ///< c in the order of constraint_names, NaN unless computed
};

/// A finished or interrupted run with everything its report shows.
struct RunRecord {
  std::string name, title;
  std::string status;  ///< of optimizer::OptimizationResult
  std::string message;
  double seconds = 0;  ///< of the last call
  optimizer::Problem problem;
  std::vector<EvaluationRecord> evaluations;
  std::optional<std::size_t> best;          ///< index of the best feasible evaluation
  std::optional<std::size_t> least_broken;  ///< without `best`
  std::optional<std::size_t> baseline;      ///< index of the start
  std::optional<DesignRecord> best_design, baseline_design;
  std::vector<VerificationRecord> verifications;  ///< of the best designs, best first
  std::vector<FinerRecord> finer;                 ///< in the order asked for; the best design is among them
  std::vector<DepartureRecord> departures;        ///< of the start and the best design
  std::optional<FrontRecord> front;               ///< of which `best` is the compromise
  Provenance provenance;
  std::string wear_law;  ///< its name; empty in older records: the law that is used by default
};

/// The part of a record that follows from the run alone: problem, evaluations, best, baseline (the start), status,
/// options and provenance with today's date. Left for the caller: name, title, seconds, version, study text, designs.
[[nodiscard]] RunRecord record_run(const optimizer::Problem& problem, const optimizer::OptimizerOptions& options,
                                   const optimizer::OptimizationResult& result);

/// Compiler and versions of the libraries this program is built with and the current date; version and study empty.
[[nodiscard]] Provenance provenance();

}  // namespace dovetail::report
