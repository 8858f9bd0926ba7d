#pragma once

#include <string>
#include <vector>

#include "optimizer/scene/scene.hpp"
#include "studies/ready_study/program.hpp"
#include "studies/report/record/run_record.hpp"

namespace dovetail::skewed_slot {

using report::Numbers;

/// The joint after spin-up with one angle between slot and axis.
struct Joint {
  double skew_deg = 0;
  std::string status = {};             ///< of its model, see optimizer::Outcome
  report::ContactRecord contact = {};  ///< places, areas and pressures
  Numbers slip_m = {};                 ///< [Nc] length of the slip of the spin-up
  double pressure_max_pa = 0, pressure_mean_pa = 0, slip_max_m = 0;
  double interior_pressure_max_pa = 0;  ///< without the outermost lines of nodes, which stand for sharp edges
  double seconds = 0;
};

/// Wear of one of the joints, as the evaluator finds it.
struct Wear {
  double skew_deg = 0;
  std::string status = {};
  double resonance_hz = 0, peak_amplitude_m = 0, volume_m3 = 0, depth_m = 0, seconds = 0;
};

struct Results {
  ready_study::Made made = {};
  optimizer::Scene scene = {};
  std::vector<Joint> joints = {};  ///< by angle, the straight slot first
  std::vector<Wear> wear = {};     ///< of the straight and the most skewed slot
};

/// page, tables and JSON.
void write(const std::string& folder, const Results& results);

}  // namespace dovetail::skewed_slot
