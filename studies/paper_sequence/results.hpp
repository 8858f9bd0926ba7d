#pragma once

#include <string>
#include <vector>

#include "optimizer/scene/scene.hpp"
#include "studies/paper_sequence/convergence.hpp"
#include "studies/ready_study/program.hpp"
#include "studies/report/plots/report_plots.hpp"
#include "studies/report/record/run_record.hpp"

namespace dovetail::paper_sequence {

using report::Numbers;

/// A response with friction over the frequencies of the study; NaN where a point did not converge.
struct Curve {
  Numbers amplitude_m;  ///< of the aerofoil's tip
  Numbers power_w;      ///< dissipated by friction, average over a period
};

/// The joint after some wear, as it answers.
struct WornState {
  double cycles = 0;     ///< infinite: at the asymptote
  Numbers depth_m = {};  ///< [Nc]
  Curve curve = {};
  bool peak_found = false;
  double peak_hz = 0, peak_m = 0;  ///< the resonance
  double amplitude_m = 0;          ///< at the unworn resonance
};

/// Wear over cycles at the unworn resonance; S states, the first unworn.
struct History {
  std::string end;  ///< why it ended
  Numbers cycles, volume_m3, amplitude_m;
  std::vector<Numbers> depth_m, rate_m_per_cycle;  ///< [S][Nc]
  int solves = 0, jacobians = 0;
};

/// Everything the study computed, SI.
struct Results {
  ready_study::Made made;
  optimizer::Scene scene;
  report::DesignRecord design;  ///< contact nodes with preload, first rates and final depths; nodal diameters
  double resonance_hz = 0, resonance_m = 0;
  double glued_hz = 0, glued_m = 0;  ///< peak of the linear model
  Numbers frequency_hz, glued_amplitude_m;
  std::vector<WornState> states;  ///< unworn first, asymptote last
  History history;
  double asymptote_volume_m3 = 0;           ///< found directly
  double certificate = 0;                   ///< largest rate the asymptote leaves over the unworn one
  double resonance_wear_ratio = 0;          ///< largest rate of the history's last state over the first largest one
  Numbers unequal_flanks_volume_m3;         ///< worn off the left and right flank when their angles differ; or empty
  double unequal_flanks_degrees = 0;        ///< by how much
  std::vector<ConvergenceRow> convergence;  ///< empty when not asked for
  std::vector<std::string> failures;        ///< what did not converge, in sentences

  /// Contact nodes lie along the slot, too.
  [[nodiscard]] bool in_space() const { return report::in_space(design.contact); }
};

/// Rates, depths and volumes of one flank.
[[nodiscard]] Numbers of_flank(const report::ContactRecord& contact, const Numbers& values, std::int64_t flank);

}  // namespace dovetail::paper_sequence
