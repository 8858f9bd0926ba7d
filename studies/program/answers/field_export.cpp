#include "studies/program/answers/field_export.hpp"

#include <fmt/format.h>

#include <span>

#include "core/options.hpp"
#include "core/replace_file.hpp"
#include "geometry/exports/vtu.hpp"
#include "studies/program/study_file/refusal.hpp"
#include "studies/report/words/html.hpp"

namespace dovetail::studies {
namespace {

Eigen::MatrixXd columns_of(std::span<const double> values, Eigen::Index components) {
  return Eigen::Map<const Eigen::MatrixXd>(values.data(), components,
                                           static_cast<Eigen::Index>(values.size()) / components);
}

/// Values of the contact nodes on the mesh.
geometry::MeshField on_flanks(std::string name, std::span<const double> values, const report::FieldRecord& fields) {
  geometry::MeshField field{.name = std::move(name), .values = Eigen::MatrixXd::Zero(1, fields.mesh.node_count())};
  for (std::size_t i = 0; i < fields.flank_nodes.size(); ++i)
    field.values(0, fields.flank_nodes[i]) = values[static_cast<std::size_t>(fields.flank_cells[i])];
  return field;
}

}  // namespace

void export_fields(const report::DesignRecord& design, const std::filesystem::path& file) {
  const report::FieldRecord& fields = design.fields;
  const Eigen::Index dimensions = fields.mesh.dimensions();
  std::vector<geometry::MeshField> point_fields{
      {.name = "displacement_m", .values = columns_of(fields.displacement_m, dimensions)},
      {.name = "von_mises_pa", .values = columns_of(fields.von_mises_pa, 1)}};
  const report::ContactRecord& contact = design.contact;
  for (const auto& [name, values] : {std::pair{"contact_pressure_pa", &contact.preload_pressure_pa},
                                     {"slip_m_per_cycle", &contact.slip_m_per_cycle},
                                     {"wear_depth_m", &contact.depth_m}})
    if (!values->empty() && !fields.flank_nodes.empty()) point_fields.push_back(on_flanks(name, *values, fields));
  const std::size_t modes = fields.mode_frequency_hz.size();
  for (std::size_t m = 0; m < modes; ++m) {
    const std::size_t size = fields.mode_shapes.size() / modes;
    point_fields.push_back({.name = fmt::format("mode_{}", m + 1),
                            .values = columns_of(std::span(fields.mode_shapes).subspan(m * size, size), dimensions)});
  }
  std::map<std::string, std::vector<double>> constants;
  if (modes > 0) constants["mode_frequency_hz"] = fields.mode_frequency_hz;
  geometry::write_vtu(file, fields.mesh, point_fields, {}, constants);
}

void export_history(const report::DesignRecord& design, const std::filesystem::path& file) {
  if (!design.history || design.history->profile_states.empty() || design.fields.flank_nodes.empty())
    refuse("pvd", optimizer::converged(design.status) &&
                          std::ranges::all_of(design.contact.depth_m, [](double d) { return d == 0; })
                      ? "the joint does not wear: there is no history to write; --format vtu writes its fields"
                      : "there is no wear history of this design: it is " + design.status);
  const report::HistoryRecord& history = *design.history;
  const std::size_t nodes = design.contact.flank.size();
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n"
      "<Collection>\n";
  for (std::size_t k = 0; k < history.profile_states.size(); ++k) {
    const std::string name = fmt::format("{}_{:03}.vtu", file.stem().string(), k);
    const geometry::MeshField depth =
        on_flanks("wear_depth_m", std::span(history.profile_depth_m).subspan(k * nodes, nodes), design.fields);
    geometry::write_vtu(file.parent_path() / name, design.fields.mesh, std::span(&depth, 1));
    text += fmt::format("<DataSet timestep=\"{}\" group=\"\" part=\"0\" file=\"{}\"/>\n",
                        shortest(history.cycles[static_cast<std::size_t>(history.profile_states[k])]),
                        report::escape(name));
  }
  replace_file(file, text + "</Collection>\n</VTKFile>\n");
}

}  // namespace dovetail::studies
