// The direct worn state against histories, and what each costs on one core:
//   build/tests/benchmarks/wear_benchmark [SCENE]...
// Scenes: section, crowned, mismatch (plane dovetails of the quickstart), block, punch, lift_off, space, and times (of
// models of 60 and 100 nodes), and, when asked for, many (what an asymptote costs with 100 to 1000 nodes in space).
// Errors are those of the largest depth and of the volume against an explicit history of
// increments of 0.25 % and 0.125 % of the depth, not finished by release, extrapolated to zero step. Processor times,
// medians of three runs; of histories, one.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "numerics/process.hpp"
#include "paths/frequency_response.hpp"
#include "paths/resonance.hpp"
#include "studies/program/engine/loaded_model.hpp"
#include "studies/ready_study/processor_time.hpp"
#include "studies/work_precision/contact_patch.hpp"
#include "tests/verification/wear/verdict_scenes.hpp"
#include "wear/asymptote/asymptote.hpp"
#include "wear/history/history.hpp"
#include "wear/measures.hpp"

namespace dovetail {
namespace {

using ready_study::median_seconds;
using ready_study::processor_seconds;

const steady::Options kSettings{.harmonics = 3, .samples = 128};

struct Scene {
  steady::Joint joint;
  double omega = 1.0;
};

Scene plain(const reduction::ReducedModel& model) {
  return {.joint = {std::make_shared<const dynamics::CondensedModel>(model), {}, kSettings}};
}

Scene dovetail(const std::vector<std::string>& changes) {
  const studies::LoadedModel loaded = studies::load_model(QUICKSTART, changes, {});
  const paths::Resonance unworn = paths::resonance(loaded.joint, loaded.glued_omega);
  return {.joint = loaded.joint.with(kSettings), .omega = unworn.omega};
}

Scene scene(const std::string& name) {
  using namespace wear::scenes;
  if (name == "section") return dovetail({});
  if (name == "crowned") return dovetail({"geometry.flank_crown_um=5"});
  if (name == "mismatch") return dovetail({"geometry.flank_mismatch_um=10"});
  if (name == "block") return plain(block(random_block(2)));
  if (name == "punch") return plain(punch({.nodes = 61, .offset = 0.013, .tilt = 0.02}));
  if (name == "lift_off") return plain(verdict_model(Family::breathing, 9));
  return plain(space_punch({.side = 9, .first_load = 0.4, .second_load = 0.3}));
}

wear::AsymptoteOptions direct_options() {
  wear::AsymptoteOptions options;
  options.rate_threshold = 0.0;
  return options;
}

double error(const Eigen::VectorXd& depth, const Eigen::VectorXd& reference) {
  return (depth - reference).cwiseAbs().maxCoeff() / reference.maxCoeff();
}

void compare(const std::string& name) {
  const Scene at = scene(name);
  wear::Asymptote direct;
  const double direct_time =
      median_seconds([&] { direct = wear::asymptote(at.joint, at.omega, direct_options()); }, 0.0);
  wear::AsymptoteOptions alone = direct_options();
  alone.arbitration = wear::Arbitration::never;
  alone.certify_finer = false;
  wear::Asymptote released;
  const double released_time = median_seconds([&] { released = wear::asymptote(at.joint, at.omega, alone); }, 0.0);
  if (direct.verdict != wear::Verdict::asymptote || direct.largest_depth == 0.0) {
    std::printf("%-9s %s, nothing to compare\n", name.c_str(), std::string(wear::to_string(direct.verdict)).c_str());
    return;
  }
  const auto run = [&](double share) {
    return wear::history(at.joint, {.omega = at.omega},
                         {.increment = share * direct.largest_depth,
                          .steps = 20000,
                          .rate_fraction = 1e-6,
                          .rate_threshold = 0.0,
                          .finish = false});
  };
  const double before = processor_seconds();
  const wear::History usual = run(0.005);
  const double history_time = processor_seconds() - before;
  const wear::History fine = run(0.0025), finest = run(0.00125);
  const Eigen::VectorXd reference = 2.0 * finest.final_depth - fine.final_depth;
  const double volume = wear::worn_volume(at.joint.model->contact(), reference);

  const double start = processor_seconds();
  wear::HistoryOptions large_steps = wear::HistoryOptions::implicit();
  large_steps.rate_fraction = 1e-4;
  large_steps.rate_threshold = 0.0;
  const wear::History implicit = wear::history(at.joint, {.omega = at.omega}, large_steps);
  const double implicit_time = processor_seconds() - start;
  std::printf(
      "%-9s %5ld %-8s %-11s %9.1e %9.1e %9.1e | %5d %5d %6d %7.1f | %7.3f %7.3f %7.2f %7.1f | %9.1e %9.1e %5d %6.1f "
      "%7.3f\n",
      name.c_str(), static_cast<long>(at.joint.model->nodes()), to_string(direct.decided_by).data(),
      to_string(direct.doubt).data(), error(direct.depth, reference), std::abs(direct.worn_volume / volume - 1.0),
      error(finest.final_depth, reference), released.jacobians, direct.jacobians, usual.jacobians,
      static_cast<double>(usual.jacobians) / direct.jacobians, released_time, direct_time, history_time,
      history_time / direct_time, error(implicit.final_depth, reference),
      std::abs(implicit.final_volume / volume - 1.0), implicit.jacobians,
      static_cast<double>(usual.jacobians) / implicit.jacobians, implicit_time);
  std::fflush(stdout);
}

void times() {
  const steady::Options steady{.harmonics = 3, .samples = 128};
  for (const Eigen::Index tangential : {1, 2}) {
    const Eigen::Index nodes = tangential == 1 ? 60 : 100;
    const auto model = std::make_shared<const dynamics::CondensedModel>(
        work_precision::contact_patch({.nodes = nodes, .tangential = tangential}));
    const double omega = work_precision::kPatchFrequency;
    for (const wear::Arbitration arbitration :
         {wear::Arbitration::never, wear::Arbitration::unsettled, wear::Arbitration::automatic}) {
      wear::AsymptoteOptions options = direct_options();
      options.arbitration = arbitration;
      wear::Asymptote worn;
      const double seconds = median_seconds([&] { worn = wear::asymptote({model, {}, steady}, omega, options); }, 0.0);
      std::printf(
          "%3ld nodes, %ld directions, arbitration %-9s: asymptote %.3f s, %s, %d Jacobians, %d solves, doubt '%s' "
          "(aim %s)\n",
          static_cast<long>(nodes), static_cast<long>(tangential + 1), to_string(arbitration).data(), seconds,
          std::string(wear::to_string(worn.verdict)).c_str(), worn.jacobians, worn.solves, to_string(worn.doubt).data(),
          tangential == 1 ? "0.2 s" : "1 s");
      std::fflush(stdout);
    }
    if (tangential == 2) continue;
    wear::AsymptoteOptions alone = direct_options();
    alone.arbitration = wear::Arbitration::never;
    const wear::Asymptote worn = wear::asymptote({model, {}, steady}, omega, alone);
    int jacobians = 0;
    const auto history_with_curves = [&] {
      const wear::History run =
          wear::history({model, {}, steady}, {.omega = omega},
                        {.increment = 0.02 * worn.largest_depth, .steps = 50, .rate_threshold = 0.0, .finish = false});
      jacobians = run.jacobians;
      std::vector<double> omegas;
      for (int i = 0; i < 60; ++i) omegas.push_back(0.8 + 0.4 * i / 59.0);
      const Eigen::Index states = run.cycles.size();
      for (int k = 0; k < 10; ++k)
        for (const steady::State& point : paths::frequency_response(
                 {model, {.wear_depth = run.depth.row(k * (states - 1) / 9).transpose()}, steady}, omegas))
          jacobians += point.iterations;
    };
    const double seconds = median_seconds(history_with_curves, 0.0, 1);
    std::printf("%3ld nodes, 50 steps and 10 curves of 60 points: %.2f s, %d Jacobians (aim 10 s)\n",
                static_cast<long>(nodes), seconds, jacobians);
  }
}

void many() {
  for (const Eigen::Index nodes : {100, 200, 300, 500, 1000}) {
    const auto model =
        std::make_shared<const dynamics::CondensedModel>(work_precision::contact_patch({.nodes = nodes}));
    wear::AsymptoteOptions options = direct_options();
    options.arbitration = wear::Arbitration::never;
    wear::Asymptote worn;
    const double seconds = median_seconds(
        [&] {
          worn = wear::asymptote({model, {}, kSettings}, work_precision::kPatchFrequency, options);
        },
        0.0, 1);
    const auto slips = std::ranges::count_if(worn.unworn.nodes, [](const steady::NodeSummary& n) { return !n.stuck; });
    std::printf("%4ld nodes, %4ld of them not stuck: asymptote %.2f s, %s, %d Jacobians, %d solves\n",
                static_cast<long>(nodes), static_cast<long>(slips), seconds,
                std::string(wear::to_string(worn.verdict)).c_str(), worn.jacobians, worn.solves);
    std::fflush(stdout);
  }
}

}  // namespace
}  // namespace dovetail

int main(int count, char** arguments) {
  std::vector<std::string> names(arguments + 1, arguments + count);
  if (names.empty()) names = {"section", "crowned", "mismatch", "block", "punch", "lift_off", "space", "times"};
  dovetail::numerics::prepare_process(arguments);
  std::printf(
      "scene     nodes decided  doubt       profile    volume      step | Jacobians: released, answer, 0.5 %% history, "
      "ratio | "
      "s: released, answer, history, ratio | implicit: profile, volume, Jacobians, ratio, s\n");
  for (const std::string& name : names) {
    if (name == "times")
      dovetail::times();
    else if (name == "many")
      dovetail::many();
    else
      dovetail::compare(name);
  }
}
