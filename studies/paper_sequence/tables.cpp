#include <cmath>

#include "optimizer/journal/record_json.hpp"
#include "studies/paper_sequence/figures.hpp"
#include "studies/paper_sequence/findings.hpp"
#include "studies/paper_sequence/page.hpp"
#include "studies/ready_study/program.hpp"

namespace dovetail::optimizer {

using ConvergenceRow = paper_sequence::ConvergenceRow;
using paper_sequence::History;

template <>
inline constexpr auto kFields<ConvergenceRow> =
    std::tuple{RecordField{"kind", &ConvergenceRow::kind},
               RecordField{"setting", &ConvergenceRow::setting},
               RecordField{"reference", &ConvergenceRow::reference},
               RecordField{"status", &ConvergenceRow::status},
               RecordField{"frequency_hz", &ConvergenceRow::frequency_hz},
               RecordField{"pressure_mean_pa", &ConvergenceRow::pressure_mean_pa},
               RecordField{"pressure_max_pa", &ConvergenceRow::pressure_max_pa},
               RecordField{"dissipated_energy_j", &ConvergenceRow::energy_j},
               RecordField{"asymptotic_wear_volume_m3", &ConvergenceRow::volume_m3},
               RecordField{"seconds", &ConvergenceRow::seconds}};

template <>
inline constexpr auto kFields<History> = std::tuple{RecordField{"end", &History::end},
                                                    RecordField{"cycles", &History::cycles},
                                                    RecordField{"volume_m3", &History::volume_m3},
                                                    RecordField{"amplitude_m", &History::amplitude_m},
                                                    RecordField{"depth_m", &History::depth_m},
                                                    RecordField{"rate_m_per_cycle", &History::rate_m_per_cycle},
                                                    RecordField{"solves", &History::solves},
                                                    RecordField{"jacobians", &History::jacobians}};

}  // namespace dovetail::optimizer

namespace dovetail::paper_sequence {
namespace {

using Json = nlohmann::ordered_json;

Json findings_json(const std::vector<Finding>& all) {
  Json list = Json::array();
  for (const Finding& f : all)
    list.push_back(
        {{"key", f.key}, {"verdict", to_string(f.verdict)}, {"paper", f.paper}, {"here", f.here}, {"why", f.why}});
  return list;
}

Json results_json(const Results& r) {
  Json json{{"quick", r.made.quick},
            {"seconds", r.made.seconds},
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
  json["history"] = optimizer::json_value<Json>(r.history);
  json["unequal_flanks"] = {{"degrees", r.unequal_flanks_degrees}, {"volume_m3", r.unequal_flanks_volume_m3}};
  json["convergence"] = optimizer::json_value<Json>(r.convergence);
  return json;
}

}  // namespace

void write(const std::filesystem::path& folder, const Results& results) {
  std::vector<std::pair<std::string, std::string>> files;
  for (const auto& [key, figure] : figures(results)) files.emplace_back(key + ".csv", figure_csv(figure));
  files.emplace_back("findings.json", findings_json(findings(results)).dump(1) + "\n");
  files.emplace_back("results.json", results_json(results).dump() + "\n");
  files.emplace_back("report.html", page_html(results));
  ready_study::write(folder, files);
}

}  // namespace dovetail::paper_sequence
