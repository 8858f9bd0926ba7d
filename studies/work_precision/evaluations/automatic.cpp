#include "studies/work_precision/evaluations/automatic.hpp"

#include <fmt/format.h>

#include "studies/program/engine/settled_study.hpp"
#include "studies/ready_study/processor_time.hpp"

namespace dovetail::work_precision {
namespace {

/// The study as if its file gave nothing that an accuracy chooses.
studies::Study asking(studies::Study study, double accuracy) {
  study.scene.solver.accuracy = accuracy;
  const optimizer::Scene scene = study.scene;
  std::erase_if(study.given, [&](const std::string& key) { return optimizer::buys_accuracy(scene, key); });
  return study;
}

}  // namespace

AutomaticChoice choose(MeasuredDesign& design, double accuracy, double limit) {
  AutomaticChoice choice{.asked = accuracy};
  studies::Study study = asking(design.study(), accuracy);
  const WholeSetting own = whole_setting(study.scene);
  const double begin = ready_study::processor_seconds();
  bool given_up = false;
  const auto settled = studies::settle(study, studies::accuracy_goal(study), [&](const optimizer::SettingsTried&) {
    given_up = limit > 0 && ready_study::processor_seconds() - begin > limit;
    return !given_up;
  });
  const optimizer::Settings& settings = settled->settings;
  choice.rounds = settled->rounds;
  choice.status = given_up ? fmt::format("given up after {:.0f} s", limit) : to_string(settled->status);
  choice.seconds = ready_study::processor_seconds() - begin;
  for (const optimizer::SettingsTried& tried : choice.rounds)
    if (tried.settings == settings && tried.by) {
      choice.most_by = tried.by->response + " by " + tried.by->source;
      choice.relative_bar = tried.by->relative;
    }
  choice.point.label = fmt::format("{:g} %", 100 * accuracy);
  choice.point.run = design(with_choice(own, design.study().scene, settings));
  return choice;
}

}  // namespace dovetail::work_precision
