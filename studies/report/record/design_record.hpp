#pragma once

#include "optimizer/evaluator.hpp"
#include "optimizer/verification.hpp"
#include "studies/report/record/run_record.hpp"

namespace dovetail::report {

/// What make_design_record computes beyond the evaluation.
struct DesignRecordOptions {
  int curve_points = 61;         ///< >= 0, at most, of each response curve; 0: no curves
  double curve_widths = 12;      ///< > 0, half range of the curves in half-power widths of the unworn peak
  int nodal_diameter_modes = 5;  ///< >= 0, modes per nodal diameter; 0: none
  int history_steps = 30;        ///< >= 0, steps of the wear history; 0: none
  int history_profiles = 6;      ///< >= 0, depth profiles kept of the history, first and last included
  bool fields = true;            ///< mesh, displacement and von Mises stress of the preload
  int mode_shapes = 3;           ///< >= 0, with the fields
};

/// Where the contact nodes are, their preload and, as far as they were computed, first rates and worn depths.
[[nodiscard]] ContactRecord contact_record(const optimizer::CandidateResult& result);

/// A design with its curves. What the evaluation computed is copied; response curves (unworn, worn, glued) around the
/// resonance, frequencies over nodal diameters and the wear history are computed; those of stages that were not asked
/// for are left out. Never throws for what a candidate is like: pieces after the stage that failed stay empty, with a
/// sentence in `notes`. Cost at the default sizes: about curve_points warm-started steady states, a
/// sparse factorisation per nodal diameter, and history_steps steady states.
[[nodiscard]] DesignRecord make_design_record(const optimizer::Scene& scene, const optimizer::CandidateResult& result,
                                              const DesignRecordOptions& options = {});

/// Its part on the response curves: adds them to the record, or a note that says why there are none.
void add_curves(const optimizer::Scene& scene, const optimizer::CandidateResult& result,
                const DesignRecordOptions& options, DesignRecord& record);

/// A verification with the places of its nodes, for the record.
[[nodiscard]] VerificationRecord make_verification_record(const optimizer::Verification& verification,
                                                          const optimizer::CandidateModel& model);

}  // namespace dovetail::report
