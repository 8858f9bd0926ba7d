#include "studies/report/record/results_file.hpp"

#include "studies/report/record/results_archive.hpp"

namespace dovetail::report {

namespace {

constexpr const char* kFormat = "dovetail-results";
constexpr std::int64_t kVersion = 1;

void require_format(const hdf5::File& file, const Archive& archive) {
  const std::string format = file.has_attribute("/", "format") ? file.string_attribute("/", "format") : "";
  if (format != kFormat)
    archive.refuse("format", format, "must be \"dovetail-results\": this is no results file of dovetail");
  const std::int64_t version = file.integer_attribute("/", "version");
  if (version < 1 || version > kVersion)
    archive.refuse("version", std::to_string(version),
                   "must be " + std::to_string(kVersion) + ": the file was written by another version of dovetail");
}

}  // namespace

void Archive::require_nodes(const std::string& group, const Wholes& flank, const Texts& flank_names,
                            std::initializer_list<const Numbers*> lists) const {
  for (const Numbers* list : lists)
    if (!list->empty()) require_size(group, list->size(), flank.size());
  for (const std::int64_t index : flank)
    if (index < 0 || index >= static_cast<std::int64_t>(flank_names.size()))
      refuse(group + "/flank", std::to_string(index), "must be indices of flank_names");
}

void Archive::require_consistent(const std::string& group, const DesignRecord& design) const {
  const ContactRecord& c = design.contact;
  require_nodes(group + "/contact", c.flank, c.flank_names,
                {&c.along_m, &c.across_m, &c.x_m, &c.y_m, &c.area_m2, &c.gap_m, &c.preload_pressure_pa,
                 &c.wear_rate_m_per_cycle, &c.slip_m_per_cycle, &c.depth_m});
  if (!c.flank.empty() && c.along_m.empty()) refuse(group + "/contact/along_m", {}, "must not be empty");
  for (const ResponseCurve* curve : {&design.unworn, &design.worn, &design.glued}) {
    require_size(group + " (response curves)", curve->amplitude_m.size(), curve->frequency_hz.size());
    require_size(group + " (response curves)", curve->status.size(), curve->frequency_hz.size());
  }
  const NodalDiameterRecord& n = design.nodal_diameters;
  require_size(group + "/nodal_diameters/status", n.status.size(), n.nodal_diameter.size());
  require_size(group + "/nodal_diameters/frequency_hz", n.frequency_hz.size(),
               static_cast<std::size_t>(n.modes) * n.nodal_diameter.size());
  if (design.history)
    require_size(group + "/history/profile_depth_m", design.history->profile_depth_m.size(),
                 design.history->profile_states.size() * c.flank.size());
  const FieldRecord& fields = design.fields;
  const auto nodes = static_cast<std::size_t>(fields.mesh.node_count());
  if (!fields.displacement_m.empty())
    require_size(group + "/fields/displacement_m", fields.displacement_m.size(),
                 static_cast<std::size_t>(fields.mesh.dimensions()) * nodes);
  if (!fields.von_mises_pa.empty()) require_size(group + "/fields/von_mises_pa", fields.von_mises_pa.size(), nodes);
  require_size(group + "/fields/flank_cells", fields.flank_cells.size(), fields.flank_nodes.size());
  const auto require_below = [&](const std::string& name, const Wholes& indices, std::size_t count) {
    for (const std::int64_t index : indices)
      if (index < 0 || index >= static_cast<std::int64_t>(count))
        refuse(group + name, std::to_string(index), "must be an index below " + std::to_string(count));
  };
  require_below("/fields/flank_nodes", fields.flank_nodes, nodes);
  require_below("/fields/flank_cells", fields.flank_cells, c.flank.size());
  require_size(group + "/fields/mode_shapes", fields.mode_shapes.size(),
               fields.mode_frequency_hz.size() * static_cast<std::size_t>(fields.mesh.dimensions()) * nodes);
}

void Archive::require_consistent(const std::string& group, const VerificationRecord& record) const {
  require_size(group + "/along_m", record.along_m.size(), record.flank.size());
  require_nodes(group, record.flank, record.flank_names,
                {&record.across_m, &record.search_profile_m, &record.direct_profile_m, &record.history_profile_m});
}

void Archive::require_consistent(const std::string& /*group*/, const RunRecord& record) const {
  const std::size_t variables = record.problem.space.size(), limits = constraint_names(record.problem).size();
  for (const EvaluationRecord& evaluation : record.evaluations) {
    require_size("/evaluations/x", evaluation.x.size(), variables);
    require_size("/evaluations/constraints", evaluation.constraints.size(), limits);
  }
  const auto require_index = [&](const std::string& name, std::int64_t index, const std::string& allowed) {
    if (index < 0 || index >= static_cast<std::int64_t>(record.evaluations.size()))
      refuse(name, std::to_string(index), allowed);
  };
  for (const auto& [name, index] :
       {std::pair{"best", record.best}, {"least_broken", record.least_broken}, {"baseline", record.baseline}})
    if (index) require_index(name, static_cast<std::int64_t>(*index), "must be the index of an evaluation, or -1");
  for (const VerificationRecord& v : record.verifications)
    require_index("/verifications, evaluation", v.evaluation, "must be the index of an evaluation");
  for (const DepartureRecord& departure : record.departures)
    require_index("/departures, evaluation", departure.evaluation, "must be the index of an evaluation");
  if (record.front) {
    const FrontRecord& front = *record.front;
    for (const std::int64_t point : front.evaluation)
      require_index("/front/evaluation", point, "must be the index of an evaluation");
    for (const Numbers* table : {&front.values, &front.bars})
      require_size("/front", table->size(), front.columns() * front.evaluation.size());
    for (const Numbers* list : {&front.ideal, &front.reference}) require_size("/front", list->size(), front.columns());
    if (front.compromise < 0 || front.compromise >= static_cast<std::int64_t>(front.evaluation.size()))
      refuse("/front, compromise", std::to_string(front.compromise), "must be the index of a point");
  }
  for (const FinerRecord& check : record.finer)
    require_index("/finer, evaluation", check.evaluation, "must be the index of an evaluation");
}

void write_results(const std::filesystem::path& path, const RunRecord& record) {
  hdf5::write_and_rename(path.string(), [copy = record](hdf5::File& file) mutable {
    file.write_attribute("/", "format", std::string(kFormat));
    file.write_attribute("/", "version", kVersion);
    Archive archive(file);
    archive.require_consistent("", copy);
    archive.exchange("", "", copy);
  });
}

RunRecord read_results(const std::filesystem::path& path) {
  const hdf5::File file = hdf5::File::open(path.string());
  Archive archive(file);
  require_format(file, archive);
  RunRecord record;
  archive.exchange("", "", record);
  return record;
}

}  // namespace dovetail::report
