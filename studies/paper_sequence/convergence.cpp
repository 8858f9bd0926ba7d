#include "studies/paper_sequence/convergence.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "optimizer/candidate/stopwatch.hpp"
#include "optimizer/evaluator.hpp"
#include "studies/report/words/table.hpp"
#include "studies/report/words/units.hpp"
#include "wear/asymptote/asymptote.hpp"

namespace dovetail::paper_sequence {
namespace {

int divided(int count, double factor, int least) {
  return std::max(least, static_cast<int>(std::lround(count / factor)));
}

/// Every element larger by `factor`.
optimizer::Scene coarser(optimizer::Scene scene, double factor) {
  scene.mesh.flank_elements = divided(scene.mesh.flank_elements, factor, 2);
  scene.mesh.aerofoil_elements = divided(scene.mesh.aerofoil_elements, factor, 2);
  scene.mesh.fillet_fraction = std::min(1.0, scene.mesh.fillet_fraction * factor);
  scene.mesh.bulk_size *= factor;
  geometry::SolidSizes& along = scene.solid_mesh;
  along.slot_elements = divided(along.slot_elements, factor, 2);
  // 0 stands for as many as the mesh has.
  if (along.contact_slot_elements > 0)
    along.contact_slot_elements = std::min(divided(along.contact_slot_elements, factor, 1), along.slot_elements);
  if (along.contact_flank_elements > 0)
    along.contact_flank_elements =
        std::min(divided(along.contact_flank_elements, factor, 1), scene.mesh.flank_elements);
  return scene;
}

/// The levels with the study's own among them, ascending.
std::vector<int> with_own(std::vector<int> levels, int own) {
  if (std::find(levels.begin(), levels.end(), own) == levels.end()) levels.push_back(own);
  std::sort(levels.begin(), levels.end());
  return levels;
}

class Convergence {
 public:
  Convergence(const optimizer::Scene& scene, const ConvergenceOptions& options) : scene_(scene), options_(options) {}

  std::vector<ConvergenceRow> run() {
    for (const double factor : options_.mesh_factors) over_mesh(factor);
    for (const int modes : with_own(options_.modes, scene_.solver.modes))
      over_solver(Refined::modes, &optimizer::SolverSettings::modes, modes);
    for (const int harmonics : with_own(options_.harmonics, scene_.solver.harmonics))
      over_solver(Refined::harmonics, &optimizer::SolverSettings::harmonics, harmonics);
    for (const int samples : with_own(options_.samples, scene_.solver.samples))
      over_solver(Refined::samples, &optimizer::SolverSettings::samples, samples);
    return std::move(rows_);
  }

 private:
  void say(const std::string& what) const {
    if (options_.progress) options_.progress("convergence: " + what);
  }

  void over_mesh(double factor) {
    const optimizer::Scene scene = coarser(scene_, factor);
    const bool own = factor == 1;
    say(fmt::format("element sizes x {:g}", factor));
    optimizer::Stopwatch watch;
    const optimizer::CandidateModel model = optimizer::ModelBuilder(scene).build(scene);
    std::string setting = fmt::format("{} elements along a flank", scene.mesh.flank_elements);
    if (model.mesh.sector.mesh.dimensions() == 3)
      setting += fmt::format(", {} along the slot", scene.solid_mesh.slot_elements);
    if (model.sizes.contains("dofs")) setting += fmt::format(", {:.0f} unknowns", model.sizes.at("dofs"));
    add({.kind = Refined::mesh, .setting = setting, .reference = own}, model, scene, watch);
    if (own) own_ = model;
  }

  /// A setting of the solver; the number of modes takes a model of its own, the others the study's.
  void over_solver(Refined kind, int optimizer::SolverSettings::*setting, int value) {
    optimizer::Scene scene = scene_;
    scene.solver.*setting = value;
    say(fmt::format("{} {}", value, to_string(kind)));
    optimizer::Stopwatch watch;
    add({.kind = kind, .setting = std::to_string(value), .reference = value == scene_.solver.*setting},
        kind == Refined::modes ? optimizer::ModelBuilder(scene).build(scene) : own_model(), scene, watch);
  }

  const optimizer::CandidateModel& own_model() {
    if (!own_) own_ = optimizer::ModelBuilder(scene_).build(scene_);
    return *own_;
  }

  void add(ConvergenceRow row, const optimizer::CandidateModel& model, const optimizer::Scene& scene,
           optimizer::Stopwatch& watch) {
    row.status = model.converged() ? measure(row, model, scene) : model.status;
    row.seconds = watch.lap();
    rows_.push_back(std::move(row));
  }

  static std::string measure(ConvergenceRow& row, optimizer::CandidateModel model, const optimizer::Scene& scene) {
    optimizer::fit_contact(scene, {}, model);
    if (!model.converged()) return model.status;
    const Eigen::VectorXd& pressure = model.preload.pressure;
    const Eigen::VectorXd& area = model.cells.area;
    row.pressure_mean_pa = pressure.dot(area) / area.sum();
    row.pressure_max_pa = pressure.maxCoeff();
    const steady::Options steady = optimizer::steady_options(scene.solver);
    const double glued = model.glued_frequencies(scene.loading.mode - 1);
    const paths::Resonance unworn = paths::resonance({model.condensed, {}, steady}, glued);
    if (unworn.status != Status::converged) return optimizer::failed_at("resonance", unworn.status);
    row.frequency_hz = unworn.omega / (2 * std::numbers::pi);
    row.energy_j = unworn.state.friction_energy;
    const wear::Asymptote found = wear::asymptote({model.condensed, {}, steady}, unworn.omega,
                                                  {.arbitration = wear::Arbitration::unsettled}, &unworn.state);
    row.volume_m3 = found.worn_volume;
    return found.verdict == wear::Verdict::asymptote ? optimizer::status_of(optimizer::Outcome::converged)
                                                     : std::string(to_string(found.verdict));
  }

  const optimizer::Scene& scene_;
  const ConvergenceOptions& options_;
  std::optional<optimizer::CandidateModel> own_;
  std::vector<ConvergenceRow> rows_;
};

/// A quantity of the table: what it is, its unit and digits.
struct Shown {
  const char* heading;
  double ConvergenceRow::*value;
  report::Unit unit;
  int digits = 4;
};
const std::array<Shown, 5> kShown{{{"resonance", &ConvergenceRow::frequency_hz, {"Hz", 1}, 7},
                                   {"mean pressure", &ConvergenceRow::pressure_mean_pa, {"MPa", 1e6}},
                                   {"largest pressure", &ConvergenceRow::pressure_max_pa, {"MPa", 1e6}},
                                   {"dissipated energy", &ConvergenceRow::energy_j, {"mJ", 1e-3}},
                                   {"worn volume", &ConvergenceRow::volume_m3, {"mm\u00b3", 1e-9}}}};

/// Against the reference's value.
std::string change(double value, double reference) {
  return value == reference && reference > 0 ? "0" : report::per_cent(value, reference);
}

}  // namespace

std::vector<ConvergenceRow> convergence(const optimizer::Scene& scene, const ConvergenceOptions& options) {
  return Convergence(scene, options).run();
}

std::string convergence_table(const std::vector<ConvergenceRow>& rows) {
  if (rows.empty()) return {};
  report::Table table{.columns = {{"what changes", true}, {"setting", true}}, .rows = {}, .named_rows = false};
  for (const Shown& shown : kShown) table.columns.push_back({shown.heading});
  table.columns.push_back({"time (s)"});
  for (const ConvergenceRow& row : rows) {
    const auto own = std::find_if(rows.begin(), rows.end(), [&](const ConvergenceRow& other) {
      return other.kind == row.kind && other.reference;
    });
    report::Row line{.cells = {std::string(to_string(row.kind)), row.setting}, .style = row.reference ? "aim" : ""};
    for (const Shown& shown : kShown) {
      const double value = row.*shown.value;
      // Where no resonance was found nothing is known, where no state at rest was all but the volume.
      const bool known = optimizer::converged(row.status) || (row.frequency_hz != 0 && &shown != &kShown.back());
      line.cells.emplace_back(!known ? row.status
                              : row.reference || own == rows.end()
                                  ? report::significant(value / shown.unit.si, shown.digits) + " " + shown.unit.symbol
                                  : change(value, (*own).*shown.value));
    }
    line.cells.emplace_back(report::significant(row.seconds, 2));
    table.rows.push_back(std::move(line));
  }
  return table_html(table);
}

}  // namespace dovetail::paper_sequence
