#include "studies/paper_sequence/convergence.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "optimizer/candidate/stopwatch.hpp"
#include "optimizer/evaluator.hpp"
#include "studies/report/pages/html.hpp"
#include "studies/report/pages/units.hpp"
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
    for (const int modes : with_own(options_.modes, scene_.solver.modes)) over_modes(modes);
    for (const int harmonics : with_own(options_.harmonics, scene_.solver.harmonics)) over_harmonics(harmonics);
    for (const int samples : with_own(options_.samples, scene_.solver.samples)) over_samples(samples);
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
    add({.kind = "mesh", .setting = setting, .reference = own}, model, scene, watch);
    if (own) own_ = model;
  }

  void over_modes(int modes) {
    optimizer::Scene scene = scene_;
    scene.solver.modes = modes;
    const bool own = modes == scene_.solver.modes;
    say(fmt::format("{} modes", modes));
    optimizer::Stopwatch watch;
    const optimizer::CandidateModel model = optimizer::ModelBuilder(scene).build(scene);
    add({.kind = "modes", .setting = std::to_string(modes), .reference = own}, model, scene, watch);
    if (own) own_ = model;
  }

  void over_harmonics(int harmonics) {
    optimizer::Scene scene = scene_;
    scene.solver.harmonics = harmonics;
    say(fmt::format("{} harmonics", harmonics));
    optimizer::Stopwatch watch;
    add({.kind = "harmonics", .setting = std::to_string(harmonics), .reference = harmonics == scene_.solver.harmonics},
        own_model(), scene, watch);
  }

  void over_samples(int samples) {
    optimizer::Scene scene = scene_;
    scene.solver.samples = samples;
    say(fmt::format("{} samples", samples));
    optimizer::Stopwatch watch;
    add({.kind = "samples", .setting = std::to_string(samples), .reference = samples == scene_.solver.samples},
        own_model(), scene, watch);
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
    const double glued = model.reduction.glued_frequencies(scene.loading.mode - 1);
    const paths::Resonance unworn = paths::resonance({model.condensed, {}, steady}, glued);
    if (unworn.status != Status::converged) return "resonance: " + std::string(to_string(unworn.status));
    row.frequency_hz = unworn.omega / (2 * std::numbers::pi);
    row.energy_j = unworn.state.friction_energy;
    const wear::Asymptote found =
        wear::asymptote({model.condensed, {}, steady}, unworn.omega, {.arbitration = "unsettled"}, &unworn.state);
    row.volume_m3 = found.worn_volume;
    return found.verdict == wear::Verdict::asymptote ? "converged" : std::string(wear::to_string(found.verdict));
  }

  const optimizer::Scene& scene_;
  const ConvergenceOptions& options_;
  std::optional<optimizer::CandidateModel> own_;
  std::vector<ConvergenceRow> rows_;
};

/// "+0.12 %" against the reference's value.
std::string change(double value, double reference) {
  if (!std::isfinite(value) || !(reference > 0)) return "\u2013";
  const double per_cent = 100 * (value / reference - 1);
  if (per_cent == 0) return "0";
  return (per_cent > 0 ? "+" : "") + report::significant(per_cent, 2) + "\u00a0%";
}

}  // namespace

std::vector<ConvergenceRow> convergence(const optimizer::Scene& scene, const ConvergenceOptions& options) {
  return Convergence(scene, options).run();
}

std::string convergence_table(const std::vector<ConvergenceRow>& rows) {
  std::string text =
      "<div class=\"scroll\"><table><thead><tr><th class=\"text\">what changes</th><th class=\"text\">setting</th>"
      "<th>resonance</th><th>mean pressure</th><th>largest pressure</th><th>dissipated energy</th><th>worn volume</th>"
      "<th>time (s)</th></tr></thead><tbody>\n";
  for (const ConvergenceRow& row : rows) {
    const auto own = std::find_if(rows.begin(), rows.end(), [&](const ConvergenceRow& other) {
      return other.kind == row.kind && other.reference;
    });
    text += fmt::format("<tr{}><td class=\"text\">{}</td><td class=\"text\">{}</td>",
                        row.reference ? " class=\"aim\"" : "", row.kind, report::escape(row.setting));
    if (row.status != "converged" && row.frequency_hz == 0) {
      text += "<td colspan=\"5\">" + report::escape(row.status) + "</td>";
    } else if (row.reference || own == rows.end()) {
      text += fmt::format("<td>{} Hz</td><td>{} MPa</td><td>{} MPa</td><td>{} mJ</td><td>{} mm\u00b3</td>",
                          report::significant(row.frequency_hz, 7), report::significant(row.pressure_mean_pa / 1e6, 4),
                          report::significant(row.pressure_max_pa / 1e6, 4),
                          report::significant(row.energy_j / 1e-3, 4), report::significant(row.volume_m3 / 1e-9, 4));
    } else {
      text +=
          fmt::format("<td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td>",
                      change(row.frequency_hz, own->frequency_hz), change(row.pressure_mean_pa, own->pressure_mean_pa),
                      change(row.pressure_max_pa, own->pressure_max_pa), change(row.energy_j, own->energy_j),
                      row.status == "converged" ? change(row.volume_m3, own->volume_m3) : report::escape(row.status));
    }
    text += fmt::format("<td>{}</td></tr>\n", report::significant(row.seconds, 2));
  }
  return text + "</tbody></table></div>\n";
}

}  // namespace dovetail::paper_sequence
