#include "studies/work_precision/diagrams.hpp"

#include <fmt/format.h>

#include "studies/work_precision/subjects.hpp"

namespace dovetail::work_precision {
namespace {

template <class Value, class Change>
std::vector<Planned> vary(const Setting& base, const std::vector<Value>& values, const std::string& label,
                          Change&& change) {
  std::vector<Planned> plan;
  for (const Value& value : values) {
    plan.push_back({.label = fmt::format(fmt::runtime(label), value), .setting = base});
    change(plan.back().setting, value);
  }
  return plan;
}

// The sweeps every model has: harmonics, samples, pseudo-penalty and solver.
class Sweeps {
 public:
  Sweeps(const Subject& subject, const Setting& defaults, const DiagramOptions& options, Diagram& diagram)
      : subject_(subject), defaults_(defaults), options_(options), diagram_(diagram) {}

  void harmonics(const std::vector<int>& values) {
    begin({.key = SweepKey::harmonics, .title = "Harmonics", .refines = true});
    line("", vary(defaults_, values, "H = {}", [](Setting& s, int h) { s.harmonics = h; }));
  }

  void samples(const std::vector<int>& values, bool both_returns) {
    begin({.key = SweepKey::samples, .title = "Samples per period", .refines = true});
    const auto set = [](Setting& s, int n) { s.samples = n; };
    line(both_returns ? "second-order slip return" : "", vary(defaults_, values, "N = {}", set));
    if (!both_returns) return;
    Setting first = defaults_;
    first.slip_return = contact::SlipReturn::first_order;
    line("first-order slip return", vary(first, values, "N = {}", set));
  }

  void penalty(const std::vector<double>& ratios) {
    begin({.key = SweepKey::penalty, .title = "Pseudo-penalty: ratio to the automatic one"});
    Setting alone = defaults_;
    alone.cascade = false;
    line("", vary(alone, ratios, "{:g} eps", [](Setting& s, double ratio) { s.penalty = ratio; }));
  }

  void solver(const std::vector<int>& harmonics, const std::vector<int>& by_differences) {
    begin({.key = SweepKey::solver, .title = "Solver, over harmonics"});
    const auto set = [](Setting& s, int h) { s.harmonics = h; };
    line("auto: Newton and fall-backs", vary(defaults_, harmonics, "H = {}", set));
    Setting powell = defaults_;
    powell.cascade = false;
    powell.solver = steady::Solver::powell;
    line("hybrid Powell, exact Jacobian", vary(powell, harmonics, "H = {}", set));
    powell.solver = steady::Solver::powell_fd;
    line("hybrid Powell, finite differences", vary(powell, by_differences, "H = {}", set));
  }

  void modes(const std::vector<int>& values) {
    begin({.key = SweepKey::modes, .title = "Modes of the reduction", .with_model_time = true, .refines = true});
    line("", vary(defaults_, values, "{} modes", [](Setting& s, int m) { s.modes = m; }));
  }

  void mesh(const std::vector<int>& values) {
    begin({.key = SweepKey::mesh,
           .title = "Mesh: element edges along a flank",
           .with_model_time = true,
           .refines = true});
    line("", vary(defaults_, values, "{} edges", [](Setting& s, int n) { s.flank_elements = n; }));
  }

 private:
  void begin(Sweep sweep) {
    diagram_.sweeps.push_back(std::move(sweep));
    if (options_.progress) options_.progress(diagram_.title + ": " + diagram_.sweeps.back().title);
  }
  void line(const std::string& name, const std::vector<Planned>& plan) {
    diagram_.sweeps.back().lines.push_back(compute(subject_, name, plan, defaults_));
  }

  const Subject& subject_;
  const Setting& defaults_;
  const DiagramOptions& options_;
  Diagram& diagram_;
};

// Finer in all but what `base` fixes; the check is fine in another way: fewer harmonics, another eps and slip return.
Reference contact_reference(const Subject& subject, Setting base, int harmonics, int samples, int modes) {
  base.harmonics = harmonics;
  base.samples = samples;
  base.modes = modes;
  base.slip_return = contact::SlipReturn::second_order;
  Setting check = base;
  check.harmonics = 2 * harmonics / 3;
  check.samples = samples / 2;
  check.penalty = 0.5;
  check.modes = 3 * modes / 4;
  return refer(subject, base, check);
}

}  // namespace

Diagram patch_diagram(const DiagramOptions& options) {
  const bool quick = options.quick;
  const PatchOptions patch{.nodes = quick ? 4 : 12, .modes = 12, .held = 0.25, .load = 0.03};
  const Subject subject = patch_subject(patch, quick ? 0 : 0.3);
  const Setting defaults;
  Diagram diagram{.key = "patch",
                  .title = "Reduced model",
                  .description = fmt::format("{} contact nodes of three directions and {} modes; nodes stick, slip and "
                                             "lift off at the resonance.",
                                             patch.nodes, patch.modes)};
  if (options.progress) options.progress(diagram.title + ": reference");
  diagram.reference = contact_reference(subject, defaults, quick ? 12 : 30, quick ? 512 : 2048, defaults.modes);
  Sweeps sweeps(subject, defaults, options, diagram);
  if (quick) {
    sweeps.harmonics({1, 5, 9});
    sweeps.samples({32, 128, 512}, true);
    sweeps.penalty({0.001, 1, 1000});
    sweeps.solver({1, 5}, {1});
  } else {
    sweeps.harmonics({1, 2, 3, 5, 7, 9, 13, 19});
    sweeps.samples({16, 32, 64, 128, 256, 512, 1024}, true);
    sweeps.penalty({0.001, 0.01, 0.1, 0.3, 1, 3, 10, 100, 1000});
    sweeps.solver({1, 3, 5, 9}, {1, 3, 5});
  }
  judge(diagram);
  return diagram;
}

Diagram scene_diagram(const DiagramOptions& options) {
  const bool quick = options.quick;
  const Subject subject = scene_subject(options.study_file, quick ? 0 : 0.5);
  Setting defaults;
  if (quick) {
    defaults.flank_elements = 8;
    defaults.modes = 10;
  }
  Diagram diagram{
      .key = "scene",
      .title = "Quickstart scene",
      .description = fmt::format("The section of studies/quickstart with {} element edges along each flank, "
                                 "from its mesh to the unworn resonance.",
                                 defaults.flank_elements)};
  if (options.progress) options.progress(diagram.title + ": reference");
  diagram.reference = contact_reference(subject, defaults, quick ? 11 : 15, quick ? 256 : 1024, quick ? 16 : 80);
  Setting fine = diagram.reference.run.setting, check = fine;
  fine.harmonics = quick ? 4 : 7;
  check.harmonics = quick ? 3 : 9;
  fine.samples = quick ? 128 : 1024;
  check.samples = quick ? 128 : 512;
  fine.modes = quick ? 16 : 60;
  check.modes = quick ? 12 : 40;
  fine.flank_elements = quick ? 12 : 96;
  check.flank_elements = quick ? 10 : 64;
  diagram.mesh_reference = refer(subject, fine, check);
  Sweeps sweeps(subject, defaults, options, diagram);
  if (quick) {
    sweeps.harmonics({1, 5});
    sweeps.samples({64, 128}, false);
    sweeps.penalty({0.001, 1, 1000});
    sweeps.solver({1, 5}, {});
    sweeps.modes({6, 10});
    sweeps.mesh({6, 8, 10});
  } else {
    sweeps.harmonics({1, 2, 3, 5, 7, 9});
    sweeps.samples({16, 32, 64, 128, 256, 512}, true);
    sweeps.penalty({0.001, 0.01, 0.1, 1, 10, 100, 1000});
    sweeps.solver({1, 3, 5}, {1});
    sweeps.modes({5, 10, 20, 40, 60});
    sweeps.mesh({6, 8, 12, 16, 24, 32, 48, 64});
  }
  judge(diagram);
  return diagram;
}

}  // namespace dovetail::work_precision
