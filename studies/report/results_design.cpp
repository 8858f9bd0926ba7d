// Every piece of a design by its place in the results file.
#include "studies/report/results_archive.hpp"

namespace dovetail::report {

namespace {

template <class Archive, class Contact>
void contact_nodes(Archive& archive, const std::string& group, Contact& contact) {
  archive.texts(group + "/flank_names", contact.flank_names);
  archive.wholes(group + "/flank", contact.flank);
  archive.numbers(group + "/along_m", contact.along_m);
  archive.later_numbers(group + "/across_m", contact.across_m);
  archive.numbers(group + "/x_m", contact.x_m);
  archive.numbers(group + "/y_m", contact.y_m);
  archive.numbers(group + "/area_m2", contact.area_m2);
  archive.numbers(group + "/gap_m", contact.gap_m);
  archive.numbers(group + "/preload_pressure_pa", contact.preload_pressure_pa);
  archive.numbers(group + "/wear_rate_m_per_cycle", contact.wear_rate_m_per_cycle);
  archive.numbers(group + "/depth_m", contact.depth_m);
}

template <class Archive, class Curve>
void curve(Archive& archive, const std::string& group, Curve& values) {
  archive.numbers(group + "/frequency_hz", values.frequency_hz);
  archive.numbers(group + "/amplitude_m", values.amplitude_m);
  archive.texts(group + "/status", values.status);
}

template <class Archive, class Record>
void nodal_diameters(Archive& archive, const std::string& group, Record& record) {
  archive.wholes(group + "/nodal_diameter", record.nodal_diameter);
  archive.whole(group, "modes", record.modes);
  archive.table(group + "/frequency_hz", record.frequency_hz, static_cast<std::size_t>(record.modes));
  archive.texts(group + "/status", record.status);
}

template <class Archive, class Fillet>
void fillet(Archive& archive, const std::string& group, Fillet& record) {
  archive.numbers(group + "/x_m", record.x_m);
  archive.numbers(group + "/y_m", record.y_m);
  archive.numbers(group + "/von_mises_pa", record.von_mises_pa);
  archive.text(group, "name", record.name);
  archive.number(group, "aggregate_pa", record.aggregate_pa);
  archive.number(group, "maximum_pa", record.maximum_pa);
}

template <class Archive, class History>
void history(Archive& archive, const std::string& group, History& record, std::size_t contact_nodes) {
  archive.numbers(group + "/cycles", record.cycles);
  archive.numbers(group + "/worn_volume_m3", record.worn_volume_m3);
  archive.numbers(group + "/depth_max_m", record.depth_max_m);
  archive.numbers(group + "/amplitude_m", record.amplitude_m);
  archive.numbers(group + "/frequency_hz", record.frequency_hz);
  archive.wholes(group + "/profile_states", record.profile_states);
  archive.table(group + "/profile_depth_m", record.profile_depth_m, contact_nodes);
  archive.text(group, "status", record.status);
  archive.text(group, "end", record.end);
}

template <class Archive, class Design>
void pieces(Archive& archive, const std::string& group, Design& design) {
  archive.values(group + "/parameters", design.parameters);
  archive.values(group + "/responses", design.responses);
  archive.values(group + "/error_estimates", design.error_estimates);
  archive.text(group, "status", design.status);
  archive.chain(group + "/profile/blade", design.profile.blade);
  archive.chain(group + "/profile/disk", design.profile.disk);
  archive.chain(group + "/profile/finished_blade", design.finished_blade);
  contact_nodes(archive, group + "/contact", design.contact);
  curve(archive, group + "/unworn", design.unworn);
  curve(archive, group + "/worn", design.worn);
  curve(archive, group + "/glued", design.glued);
  nodal_diameters(archive, group + "/nodal_diameters", design.nodal_diameters);
  archive.records(group + "/fillets", design.fillets,
                  [&](const std::string& path, auto& record) { fillet(archive, path, record); });
  archive.optional(group + "/history", design.history,
                   [&](auto& record) { history(archive, group + "/history", record, design.contact.flank.size()); });
  archive.mesh(group + "/mesh", design.fields.mesh);
  archive.table(group + "/fields/displacement_m", design.fields.displacement_m,
                static_cast<std::size_t>(design.fields.mesh.dimensions()));
  archive.numbers(group + "/fields/von_mises_pa", design.fields.von_mises_pa);
  archive.texts(group + "/notes", design.notes);
}

template <class Archive, class Record>
void verification(Archive& archive, const std::string& group, Record& record) {
  archive.group(group);
  archive.texts(group + "/flank_names", record.flank_names);
  archive.wholes(group + "/flank", record.flank);
  archive.numbers(group + "/along_m", record.along_m);
  archive.later_numbers(group + "/across_m", record.across_m);
  archive.numbers(group + "/search_profile_m", record.search_profile_m);
  archive.numbers(group + "/direct_profile_m", record.direct_profile_m);
  archive.numbers(group + "/history_profile_m", record.history_profile_m);
  archive.text(group, "status", record.status);
  archive.text(group, "follow", record.follow);
  archive.whole(group, "evaluation", record.evaluation);
  archive.whole(group, "flank_elements", record.flank_elements);
  archive.whole(group, "harmonics", record.harmonics);
  archive.whole(group, "samples", record.samples);
  archive.whole(group, "direct_solves", record.direct_solves);
  archive.whole(group, "history_solves", record.history_solves);
  archive.number(group, "frequency_hz", record.frequency_hz);
  archive.number(group, "search_volume_m3", record.search_volume_m3);
  archive.number(group, "search_bar_m3", record.search_bar_m3);
  archive.number(group, "search_depth_m", record.search_depth_m);
  archive.number(group, "direct_volume_m3", record.direct_volume_m3);
  archive.number(group, "direct_depth_m", record.direct_depth_m);
  archive.number(group, "history_volume_m3", record.history_volume_m3);
  archive.number(group, "history_depth_m", record.history_depth_m);
  archive.number(group, "history_bar_m3", record.history_bar_m3);
  archive.number(group, "profile_difference", record.profile_difference);
  archive.number(group, "cycles", record.cycles);
  archive.number(group, "seconds", record.seconds);
}

template <class Archive, class Record>
void finer(Archive& archive, const std::string& group, Record& record) {
  archive.group(group);
  archive.whole(group, "evaluation", record.evaluation);
  archive.whole(group, "flank_elements", record.flank_elements);
  archive.text(group, "status", record.status);
  archive.numbers(group + "/constraints", record.constraints);
}

/// A list of the design that may be empty but not of another length.
void require_list(const Reader& reader, const std::string& path, std::size_t found, std::size_t expected) {
  if (found != 0) reader.require_size(path, found, expected);
}

void require_consistent(const Reader& reader, const std::string& group, const DesignRecord& design) {
  const ContactRecord& c = design.contact;
  for (const Numbers* list : {&c.along_m, &c.across_m, &c.x_m, &c.y_m, &c.area_m2, &c.gap_m, &c.preload_pressure_pa,
                              &c.wear_rate_m_per_cycle, &c.depth_m})
    require_list(reader, group + "/contact", list->size(), c.flank.size());
  if (!c.flank.empty() && c.along_m.empty()) reader.refuse(group + "/contact/along_m", {}, "must not be empty");
  for (const std::int64_t flank : c.flank)
    if (flank < 0 || flank >= static_cast<std::int64_t>(c.flank_names.size()))
      reader.refuse(group + "/contact/flank", std::to_string(flank), "must be indices of flank_names");
  for (const ResponseCurve* curve : {&design.unworn, &design.worn, &design.glued}) {
    reader.require_size(group + " (response curves)", curve->amplitude_m.size(), curve->frequency_hz.size());
    reader.require_size(group + " (response curves)", curve->status.size(), curve->frequency_hz.size());
  }
  const NodalDiameterRecord& n = design.nodal_diameters;
  reader.require_size(group + "/nodal_diameters/status", n.status.size(), n.nodal_diameter.size());
  reader.require_size(group + "/nodal_diameters/frequency_hz", n.frequency_hz.size(),
                      static_cast<std::size_t>(n.modes) * n.nodal_diameter.size());
  const auto nodes = static_cast<std::size_t>(design.fields.mesh.node_count());
  require_list(reader, group + "/fields/displacement_m", design.fields.displacement_m.size(),
               static_cast<std::size_t>(design.fields.mesh.dimensions()) * nodes);
  require_list(reader, group + "/fields/von_mises_pa", design.fields.von_mises_pa.size(), nodes);
}

}  // namespace

void exchange(Writer& writer, const std::string& group, const DesignRecord& design) {
  pieces(writer, group, design);
}

void exchange(const Reader& reader, const std::string& group, DesignRecord& design) {
  pieces(reader, group, design);
  require_consistent(reader, group, design);
}

void exchange(Writer& writer, const std::string& group, const FinerRecord& record) {
  finer(writer, group, record);
}

void exchange(const Reader& reader, const std::string& group, FinerRecord& record) {
  finer(reader, group, record);
}

void exchange(Writer& writer, const std::string& group, const VerificationRecord& record) {
  verification(writer, group, record);
}

void exchange(const Reader& reader, const std::string& group, VerificationRecord& record) {
  verification(reader, group, record);
  const std::size_t nodes = record.flank.size();
  reader.require_size(group + "/along_m", record.along_m.size(), nodes);
  for (const Numbers* list :
       {&record.across_m, &record.search_profile_m, &record.direct_profile_m, &record.history_profile_m})
    require_list(reader, group, list->size(), nodes);
  for (const std::int64_t flank : record.flank)
    if (flank < 0 || flank >= static_cast<std::int64_t>(record.flank_names.size()))
      reader.refuse(group + "/flank", std::to_string(flank), "must be indices of flank_names");
}

}  // namespace dovetail::report
