#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/replace_file.hpp"
#include "studies/paper_sequence/figures.hpp"
#include "studies/paper_sequence/findings.hpp"
#include "studies/paper_sequence/page.hpp"

namespace dovetail::paper_sequence {
namespace {

using Json = nlohmann::ordered_json;

std::string column(const report::PlotAxis& axis) {
  return axis.unit.empty() ? axis.label : axis.label + " (" + axis.unit + ")";
}

/// One row per point: line, x, y.
std::string csv(const report::Plot& plot) {
  std::string text = fmt::format("\"line\",\"{}\",\"{}\"\n", column(plot.x), column(plot.y));
  for (std::size_t l = 0; l < plot.lines.size(); ++l) {
    const report::PlotLine& line = plot.lines[l];
    const std::string name = line.name.empty() ? std::to_string(l + 1) : line.name;
    for (std::size_t i = 0; i < std::min(line.x.size(), line.y.size()); ++i)
      text += fmt::format("\"{}\",{:.12g},{}\n", name, line.x[i],
                          std::isfinite(line.y[i]) ? fmt::format("{:.12g}", line.y[i]) : "");
  }
  return text;
}

/// One row per contact node: flank, place along the slot and from the neck side, value.
std::string csv(const report::FlankMap& map) {
  std::string text = fmt::format("\"flank\",\"along the slot (mm)\",\"from the neck side (mm)\",\"{} ({})\"\n",
                                 map.quantity, map.unit.symbol);
  for (const report::FlankPanel& panel : map.panels)
    for (std::size_t i = 0; i < panel.values.size(); ++i)
      text += fmt::format("\"{}\",{:.12g},{:.12g},{:.12g}\n", panel.name, panel.across[i] / 1e-3, panel.along[i] / 1e-3,
                          panel.values[i] / map.unit.si);
  return text;
}

Json findings_json(const std::vector<Finding>& all) {
  Json list = Json::array();
  for (const Finding& f : all)
    list.push_back(
        {{"key", f.key}, {"verdict", to_string(f.verdict)}, {"paper", f.paper}, {"here", f.here}, {"why", f.why}});
  return list;
}

Json results_json(const Results& r) {
  Json json{{"quick", r.quick},
            {"seconds", r.seconds},
            {"resonance_hz", r.resonance_hz},
            {"resonance_amplitude_m", r.resonance_m},
            {"glued_hz", r.glued_hz},
            {"glued_amplitude_m", r.glued_m},
            {"asymptotic_volume_m3", r.asymptote_volume_m3},
            {"certificate", r.certificate},
            {"failures", r.failures},
            {"frequency_hz", r.frequency_hz},
            {"glued_response_m", r.glued_amplitude_m}};
  const report::ContactRecord& contact = r.design.contact;
  json["contact"] = {{"flank", contact.flank},
                     {"along_m", contact.along_m},
                     {"across_m", contact.across_m},
                     {"area_m2", contact.area_m2},
                     {"preload_pressure_pa", contact.preload_pressure_pa},
                     {"first_rate_m_per_cycle", contact.wear_rate_m_per_cycle},
                     {"asymptotic_depth_m", contact.depth_m}};
  const report::NodalDiameterRecord& diameters = r.design.nodal_diameters;
  json["nodal_diameters"] = {{"nodal_diameter", diameters.nodal_diameter},
                             {"modes", diameters.modes},
                             {"frequency_hz", diameters.frequency_hz}};
  json["states"] = Json::array();
  for (const WornState& state : r.states)
    json["states"].push_back({{"cycles", std::isfinite(state.cycles) ? Json(state.cycles) : Json()},
                              {"depth_m", state.depth_m},
                              {"amplitude_m", state.curve.amplitude_m},
                              {"power_w", state.curve.power_w},
                              {"peak_hz", state.peak_found ? Json(state.peak_hz) : Json()},
                              {"peak_amplitude_m", state.peak_found ? Json(state.peak_m) : Json()},
                              {"amplitude_at_unworn_resonance_m", state.amplitude_m}});
  const History& h = r.history;
  json["history"] = {{"end", h.end},
                     {"cycles", h.cycles},
                     {"volume_m3", h.volume_m3},
                     {"amplitude_m", h.amplitude_m},
                     {"depth_m", h.depth_m},
                     {"rate_m_per_cycle", h.rate_m_per_cycle},
                     {"solves", h.solves},
                     {"jacobians", h.jacobians}};
  json["unequal_flanks"] = {{"degrees", r.unequal_flanks_degrees}, {"volume_m3", r.unequal_flanks_volume_m3}};
  json["convergence"] = Json::array();
  for (const ConvergenceRow& row : r.convergence)
    json["convergence"].push_back({{"kind", row.kind},
                                   {"setting", row.setting},
                                   {"reference", row.reference},
                                   {"status", row.status},
                                   {"frequency_hz", row.frequency_hz},
                                   {"pressure_mean_pa", row.pressure_mean_pa},
                                   {"pressure_max_pa", row.pressure_max_pa},
                                   {"dissipated_energy_j", row.energy_j},
                                   {"asymptotic_wear_volume_m3", row.volume_m3},
                                   {"seconds", row.seconds}});
  return json;
}

}  // namespace

void write(const std::filesystem::path& folder, const Results& results) {
  std::error_code ignored;  // what is missing is named when a file cannot be written
  std::filesystem::create_directories(folder, ignored);
  for (const Figure& figure : figures(results))
    replace_file(folder / (figure.key + ".csv"), figure.map ? csv(*figure.map) : csv(figure.plot));
  replace_file(folder / "findings.json", findings_json(findings(results)).dump(1) + "\n");
  replace_file(folder / "results.json", results_json(results).dump() + "\n");
  replace_file(folder / "report.html", page_html(results));
}

}  // namespace dovetail::paper_sequence
