#include "studies/work_precision/evaluations/plan.hpp"

namespace dovetail::work_precision {

namespace {

EvaluationPlan quick_section(bool own_design) {
  EvaluationPlan plan{.coarser = 3};
  plan.alone = {.mesh = {0.75, 1}, .harmonics = {1, 3}};
  if (own_design)
    plan.alone = {.mesh = {0.75, 1, 1.5},
                  .harmonics = {1, 3, 5},
                  .samples = {32, 64},
                  .modes = {4, 8},
                  .resonance_tolerance = {1e-4, 1e-7},
                  .tolerance = {1e-3, 1e-9}};
  plan.joint = {.mesh = {0.75, 1, 1.25},
                .beside = {1},
                .harmonics = {1, 3},
                .samples = {32, 64},
                .modes = {4, 8},
                .resonance_tolerance = {1e-7},
                .tolerance = {1e-9}};
  plan.combinations = own_design ? 4 : 2;
  plan.descent = 2;
  plan.asked = {0.3};
  plan.choice_limit = 10;
  plan.finest = {.mesh = 2, .harmonics = 7, .samples = 128, .modes = 20};
  plan.check = {.mesh = 1.75, .harmonics = 5, .samples = 192, .modes = 16};
  plan.wear_steps = 8;
  plan.repetitions = 1;
  return plan;
}

}  // namespace

EvaluationPlan section_plan(bool quick, bool own_design) {
  if (quick) return quick_section(own_design);
  EvaluationPlan plan;
  plan.alone = {.mesh = {0.5, 1, 2}, .harmonics = {1, 5, 9}, .samples = {64, 256}, .modes = {6, 30}};
  if (own_design)
    plan.alone = {.mesh = {0.333, 0.5, 0.667, 1, 1.333, 2, 2.667, 4},
                  .beside = {0.25, 0.5, 2},
                  .harmonics = {1, 2, 3, 5, 7, 11, 15},
                  .samples = {32, 64, 96, 128, 256, 512},
                  .modes = {3, 4, 6, 8, 12, 20, 40},
                  .resonance_tolerance = {1e-4, 1e-5, 1e-6, 1e-7, 1e-8},
                  .tolerance = {1e-3, 1e-5, 1e-7, 1e-9, 1e-11}};
  plan.joint = {.mesh = {0.5, 0.667, 0.833, 1, 1.333, 1.667, 2, 2.667, 3.333},
                .beside = {0.354, 0.5, 0.707, 1},
                .harmonics = {1, 3, 5, 7, 9, 11, 15},
                .samples = {48, 64, 96, 128, 192, 256, 384},
                .modes = {3, 4, 6, 8, 12, 16, 20},
                .resonance_tolerance = {1e-5, 1e-6, 1e-7},
                .tolerance = {1e-5, 1e-7, 1e-9}};
  plan.combinations = own_design ? 40 : 24;
  plan.descent = 14;
  plan.asked = {0.05, 0.02, 0.01};
  plan.choice_limit = 240;
  plan.finest = {.mesh = 5.333, .harmonics = 15, .samples = 512, .modes = 60};
  plan.check = {.mesh = 4, .harmonics = 19, .samples = 384, .modes = 45};
  return plan;
}

EvaluationPlan sector_plan(bool quick) {
  EvaluationPlan plan;
  plan.coarser = quick ? 2 : 1;
  plan.alone = {.mesh = {0.5, 0.667, 0.833, 1, 1.2},
                .harmonics = {1, 3, 5},
                .samples = {64, 128, 256},
                .modes = {6, 20},
                .resonance_tolerance = {1e-5, 1e-7}};
  plan.joint = {.mesh = {0.5, 0.667, 0.833, 1, 1.25},
                .beside = {1},
                .harmonics = {1, 3, 5},
                .samples = {64, 96, 128},
                .modes = {6, 10, 20},
                .resonance_tolerance = {1e-5, 1e-7},
                .tolerance = {1e-7, 1e-9}};
  plan.combinations = 8;
  plan.descent = 4;
  plan.asked = {0.05};
  plan.choice_limit = 600;
  plan.finest = {.mesh = 1.5, .harmonics = 5, .samples = 256, .modes = 40};
  plan.check = {.mesh = 1.3, .harmonics = 7, .samples = 192, .modes = 30};
  plan.repetitions = 1;
  if (!quick) return plan;
  plan.alone = {.mesh = {0.8, 1}, .harmonics = {1, 3}};
  plan.combinations = 2;
  plan.descent = 0;
  plan.asked = {};
  plan.finest = {.mesh = 1.3, .harmonics = 5, .samples = 128, .modes = 20};
  plan.check = {.mesh = 1.2, .harmonics = 3, .samples = 192, .modes = 16};
  plan.wear_steps = 8;
  return plan;
}

}  // namespace dovetail::work_precision
