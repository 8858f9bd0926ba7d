#include "studies/report/record/design_record.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "fem/diameter_frequencies.hpp"
#include "fem/element.hpp"
#include "fem/flank_trace.hpp"
#include "fem/stress.hpp"
#include "geometry/profile/flank_form.hpp"
#include "wear/history/history.hpp"

namespace dovetail::report {

namespace {

using optimizer::CandidateModel;
using optimizer::CandidateResult;
using optimizer::Scene;
using optimizer::Stage;

Numbers list(const Eigen::Ref<const Eigen::VectorXd>& values) {
  return {values.data(), values.data() + values.size()};
}

/// Where the contact nodes are.
ContactRecord contact_places(const CandidateModel& model) {
  const fem::ContactCells& cells = model.cells;
  ContactRecord record;
  for (const fem::Flank& flank : model.mesh.sector.flanks) record.flank_names.push_back(flank.name);
  for (Eigen::Index i = 0; i < cells.count(); ++i) {
    const fem::Flank& flank = model.mesh.sector.flanks[static_cast<std::size_t>(cells.flank(i))];
    const Eigen::VectorXd neck_side = flank.position.col(0);
    const Eigen::VectorXd slot = flank.position.col(flank.contact_count() - flank.grid[0]) - neck_side;
    const Eigen::VectorXd root = flank.position.col(flank.grid[0] - 1) - neck_side;
    // Oblique coordinates: across and along a skewed slot are not at right angles.
    Eigen::MatrixXd directions(root.size(), slot.norm() > 0 ? 2 : 1);
    directions.col(0) = root.normalized();
    if (slot.norm() > 0) directions.col(1) = slot.normalized();
    const Eigen::VectorXd place =
        directions.colPivHouseholderQr().solve(Eigen::VectorXd(cells.position.col(i) - neck_side));
    record.flank.push_back(cells.flank(i));
    record.along_m.push_back(place(0));
    record.across_m.push_back(place.size() > 1 ? place(1) - slot.norm() / 2 : 0);
    record.x_m.push_back(cells.position(0, i));
    record.y_m.push_back(cells.position(1, i));
  }
  return record;
}

void add_nodal_diameters(const Scene& scene, const CandidateModel& model, const DesignRecordOptions& options,
                         DesignRecord& record) {
  if (options.nodal_diameter_modes < 1) return;
  const reduction::InterfaceStiffness interface = optimizer::interface_of(scene.contact);
  fem::DiameterOptions diameters{.modes = {.count = options.nodal_diameter_modes}, .tolerance = 1e-5};
  if (!interface.rigid())
    diameters.contact_flexibility = reduction::spring_flexibility(interface, model.matrices.shared->system.contact.area,
                                                                  model.matrices.shared->system.full.dimensions);
  const fem::NodalDiameterFrequencies found =
      fem::nodal_diameter_frequencies(model.mesh.sector, model.matrices.stiffness(),
                                      model.matrices.shared->system.full.mass, fem::BoreSupport::tangential, diameters);
  NodalDiameterRecord& out = record.nodal_diameters;
  out.nodal_diameter.assign(found.nodal_diameters.begin(), found.nodal_diameters.end());
  out.modes = found.frequency.cols();
  for (Eigen::Index d = 0; d < found.frequency.rows(); ++d)
    for (Eigen::Index m = 0; m < found.frequency.cols(); ++m) out.frequency_hz.push_back(found.frequency(d, m));
  for (const Status status : found.status) out.status.emplace_back(to_string(status));
}

void add_fillet(const std::string& name, const fem::Mesh& mesh, const std::vector<int>& nodes,
                const std::optional<optimizer::FilletStress>& stress, DesignRecord& record) {
  if (!stress) return;
  FilletRecord fillet{.name = name,
                      .x_m = {},
                      .y_m = {},
                      .von_mises_pa = list(stress->nodal),
                      .aggregate_pa = stress->aggregate,
                      .maximum_pa = stress->maximum};
  for (const int node : nodes) {
    fillet.x_m.push_back(mesh.nodes(0, node));
    fillet.y_m.push_back(mesh.nodes(1, node));
  }
  record.fillets.push_back(std::move(fillet));
}

/// Mesh, displacement and von Mises stress of the preload.
FieldRecord preload_fields(const Scene& scene, const CandidateModel& model) {
  const fem::Mesh& mesh = model.mesh.sector.mesh;
  const Eigen::VectorXd independent =
      model.reduction.recovery.apply(model.preload.full_displacement, model.preload.force);
  const Eigen::VectorXd displacement = model.matrices.shared->system.constraints.transformation * independent;
  std::vector<int> nodes(static_cast<std::size_t>(mesh.node_count()));
  std::iota(nodes.begin(), nodes.end(), 0);
  const std::vector<fem::Material> bodies = optimizer::materials(scene);
  const Eigen::VectorXd stress = fem::nodal_stress_operator(mesh, bodies, nodes) * displacement;
  std::vector<double> poisson(nodes.size(), 0.0);
  for (int e = 0; e < mesh.element_count(); ++e) {
    const fem::Region& region = mesh.region_of(e);
    for (const int node : mesh.element(e))
      poisson[static_cast<std::size_t>(node)] =
          region.plane_stress ? 0.0 : bodies[static_cast<std::size_t>(region.body)].poisson_ratio;
  }
  FieldRecord fields{.mesh = mesh, .displacement_m = list(displacement), .von_mises_pa = {}};
  const Eigen::Index components = fem::stress_components(mesh.kind);
  for (Eigen::Index i = 0; i < mesh.nodes.cols(); ++i)
    fields.von_mises_pa.push_back(
        fem::von_mises(stress.segment(components * i, components), poisson[static_cast<std::size_t>(i)]));
  return fields;
}

/// Which contact node is a cell where a node of the mesh lies on a flank.
void add_flank_nodes(const CandidateModel& model, FieldRecord& fields) {
  const std::vector<fem::CellStrip> strips = model.cells.strips();
  const auto part = [](const std::vector<double>& ends, double place) {
    const auto above = std::upper_bound(ends.begin(), ends.end(), place) - ends.begin();
    return static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(above - 1, 0, std::ssize(ends) - 2));
  };
  std::size_t first_strip = 0;
  for (std::size_t f = 0; f < model.mesh.sector.flanks.size(); ++f) {
    const fem::Flank& flank = model.mesh.sector.flanks[f];
    const std::vector<double>& along = model.cells.flanks[f].along;
    const fem::TraceLines lines = fem::trace_lines(flank);
    const Eigen::SparseMatrix<double, Eigen::RowMajor> nearest(flank.interpolation);
    for (std::size_t pair = 0; pair < flank.pairs.size(); ++pair) {
      Eigen::Index node = 0;
      double most = 0;
      for (Eigen::SparseMatrix<double, Eigen::RowMajor>::InnerIterator it(nearest, static_cast<Eigen::Index>(pair)); it;
           ++it)
        if (it.value() > most) {
          most = it.value();
          node = it.col();
        }
      const auto i = static_cast<std::size_t>(node % flank.grid[0]), j = static_cast<std::size_t>(node / flank.grid[0]);
      const fem::CellStrip& strip = strips[first_strip + part(along, lines.along[j])];
      for (const int mesh_node : flank.pairs[pair]) {
        fields.flank_nodes.push_back(mesh_node);
        fields.flank_cells.push_back(static_cast<std::int64_t>(strip.first + part(strip.ends, lines.across[i])));
      }
    }
    first_strip += along.size() - 1;
  }
}

/// The lowest natural modes with the flanks stuck: one reduced coordinate each, and the forces that hold the flanks.
void add_modes(const CandidateModel& model, int count, FieldRecord& fields) {
  const reduction::ReducedModel& reduced = model.reduction.model;
  const Eigen::Index held = reduced.contact.count() * reduced.contact.directions();
  const Eigen::Index modes = std::min<Eigen::Index>(count, model.reduction.glued_frequencies.size());
  const Eigen::MatrixXd coordinates = Eigen::MatrixXd::Identity(reduced.size(), held + modes).rightCols(modes);
  const Eigen::MatrixXd forces = -reduced.stiffness.block(0, held, held, modes);
  const Eigen::MatrixXd shapes =
      model.matrices.shared->system.constraints.transformation * model.reduction.recovery.apply(coordinates, forces, 0);
  for (Eigen::Index m = 0; m < modes; ++m) {
    const auto at_nodes = shapes.col(m).reshaped(fields.mesh.dimensions(), fields.mesh.node_count());
    const Numbers shape = list(shapes.col(m) / at_nodes.colwise().norm().maxCoeff());
    fields.mode_shapes.insert(fields.mode_shapes.end(), shape.begin(), shape.end());
    fields.mode_frequency_hz.push_back(model.reduction.glued_frequencies(m) / (2 * std::numbers::pi));
  }
}

/// States whose depths are kept: evenly over the history, first and last included.
std::vector<std::int64_t> chosen_states(Eigen::Index states, int wanted) {
  std::vector<std::int64_t> chosen;
  const Eigen::Index count = std::min<Eigen::Index>(states, wanted);
  for (Eigen::Index i = 0; i < count; ++i)
    chosen.push_back(count == 1 ? states - 1 : (i * (states - 1) + (count - 1) / 2) / (count - 1));
  return chosen;
}

void add_history(const Scene& scene, const CandidateResult& result, const DesignRecordOptions& options,
                 DesignRecord& record) {
  if (options.history_steps < 1) return;
  if (!result.asymptote || !(result.asymptote->largest_depth > 0)) {
    record.notes.push_back("No wear history was computed: there is no asymptotic wear depth to reach.");
    return;
  }
  wear::HistoryOptions history_options;
  history_options.steps = options.history_steps;
  // The fastest node is not always the one that ends deepest, so the steps add up to a little more than the depth.
  history_options.increment = 1.25 * result.asymptote->largest_depth / options.history_steps;
  const wear::History history = wear::history({result.model.condensed, {}, optimizer::steady_options(scene.solver)},
                                              {.omega = result.unworn->omega}, history_options);
  HistoryRecord out{.status = std::string(to_string(history.status)),
                    .end = std::string(to_string(history.end)),
                    .cycles = list(history.cycles),
                    .worn_volume_m3 = list(history.worn_volume),
                    .depth_max_m = {},
                    .amplitude_m = list(history.amplitude),
                    .frequency_hz = list(history.frequency / (2 * std::numbers::pi)),
                    .profile_states = chosen_states(history.cycles.size(), options.history_profiles),
                    .profile_depth_m = {}};
  for (Eigen::Index s = 0; s < history.depth.rows(); ++s) out.depth_max_m.push_back(history.depth.row(s).maxCoeff());
  for (const std::int64_t state : out.profile_states)
    for (Eigen::Index i = 0; i < history.depth.cols(); ++i) out.profile_depth_m.push_back(history.depth(state, i));
  record.history = std::move(out);
}

}  // namespace

ContactRecord contact_record(const CandidateResult& result) {
  const fem::ContactCells& surface = result.model.cells;
  ContactRecord record = contact_places(result.model);
  record.area_m2 = list(surface.area);
  record.gap_m = list(surface.gap);
  record.preload_pressure_pa = list(result.model.preload.pressure);
  if (result.unworn)
    for (const steady::NodeSummary& node : result.unworn->state.nodes)
      record.slip_m_per_cycle.push_back(node.slip_distance);
  if (result.asymptote) {
    record.wear_rate_m_per_cycle = list(result.asymptote->unworn_rate);
    record.depth_m = list(result.asymptote->depth);
  }
  return record;
}

DesignRecord make_design_record(const Scene& scene, const CandidateResult& result, const DesignRecordOptions& options) {
  DesignRecord record;
  record.status = result.evaluation.status;
  record.parameters = result.evaluation.parameters;
  record.responses = result.evaluation.responses;
  record.error_estimates = result.evaluation.error_estimates;
  try {
    record.profile = geometry::build_profile(scene.geometry);
    record.finished_blade = geometry::finished_blade(scene.geometry);
  } catch (const InputError& error) {
    record.notes.push_back(std::string("The section cannot be drawn: ") + error.what() + ".");
  }
  const CandidateModel& model = result.model;
  if (!model.converged()) {
    record.notes.push_back("This design could not be computed (" + model.status + "), so it has no curves.");
    return record;
  }
  record.contact = contact_record(result);
  const fem::SectorMesh& sector = model.mesh.sector;
  add_fillet("blade", sector.mesh, sector.blade_fillet_nodes, result.blade_fillet, record);
  add_fillet("disk", sector.mesh, sector.disk_fillet_nodes, result.disk_fillet, record);
  if (options.fields) {
    record.fields = preload_fields(scene, model);
    add_flank_nodes(model, record.fields);
    add_modes(model, options.mode_shapes, record.fields);
  }
  const auto asked = [&result](Stage stage) {
    return !result.evaluation.converged() || !result.stage || *result.stage >= stage;
  };
  if (asked(Stage::unworn)) {
    add_curves(scene, result, options, record);
    add_nodal_diameters(scene, model, options, record);
  }
  if (asked(Stage::worn_state)) add_history(scene, result, options, record);
  if (!asked(Stage::worn_resonance))
    record.notes.push_back(fmt::format(
        "The study names no response of {}, so it was not computed; [optimizer] responses = \"all\" computes all.",
        asked(Stage::unworn) ? "the worn joint" : "the vibrating joint"));
  return record;
}

VerificationRecord make_verification_record(const optimizer::Verification& v, const CandidateModel& model) {
  VerificationRecord record;
  record.status = v.status;
  record.follow = to_string(v.follow);
  record.flank_elements = v.flank_elements;
  record.harmonics = v.harmonics;
  record.samples = v.samples;
  record.direct_solves = v.direct_solves;
  record.history_solves = v.history_solves;
  record.frequency_hz = v.frequency_hz;
  record.search_volume_m3 = v.search_volume;
  record.search_bar_m3 = v.search_bar;
  record.search_depth_m = v.search_depth;
  record.direct_volume_m3 = v.direct_volume;
  record.direct_depth_m = v.direct_depth;
  record.history_volume_m3 = v.history_volume;
  record.history_depth_m = v.history_depth;
  record.history_bar_m3 = v.history_bar;
  record.profile_difference = v.profile_difference;
  record.cycles = v.cycles;
  record.seconds = v.seconds;
  if (!model.converged()) return record;
  const ContactRecord places = contact_places(model);
  record.flank_names = places.flank_names;
  record.flank = places.flank;
  record.along_m = places.along_m;
  record.across_m = places.across_m;
  record.search_profile_m = list(v.search_profile);
  record.direct_profile_m = list(v.direct_profile);
  record.history_profile_m = list(v.history_profile);
  return record;
}

}  // namespace dovetail::report
