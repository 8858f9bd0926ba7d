#pragma once

#include <vector>

#include "studies/work_precision/evaluations/setting.hpp"

namespace dovetail::work_precision {

/// Values of each knob, coarse to fine. Those of the mesh are edges over the file's.
struct Ladders {
  std::vector<double> mesh = {};
  std::vector<double> beside = {};  ///< over those along the flanks
  std::vector<int> harmonics = {}, samples = {}, modes = {};
  std::vector<double> resonance_tolerance = {}, tolerance = {};
};

/// What is measured of one design.
struct EvaluationPlan {
  double coarser = 1;  ///< elements of the file's mesh are so much larger throughout
  Ladders alone = {};  ///< each knob by itself, others as in the file
  Ladders joint = {};  ///< from which combinations are drawn, and on which the descent goes
  int combinations = 0;
  int seed = 1;                    ///< of the combinations
  int descent = 0;                 ///< evaluations for each accuracy at most
  std::vector<double> asked = {};  ///< accuracies for the automatic choice
  double choice_limit = 0;         ///< s, of a choice: after the round that goes beyond it is given up; 0: none
  WholeSetting finest = {}, check = {};
  int wear_steps = 40;  ///< of the paper's history, down to the depth of the reference
  int repetitions = 3;  ///< of what is compared in the end
};

/// Of the section: its own design, or one of those that are drawn, for which single knobs are coarser.
[[nodiscard]] EvaluationPlan section_plan(bool quick, bool own_design);
/// Of the sector in space.
[[nodiscard]] EvaluationPlan sector_plan(bool quick);

}  // namespace dovetail::work_precision
