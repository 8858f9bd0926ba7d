// The page of the study, its tables and its JSON.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "optimizer/journal/record_json.hpp"
#include "studies/ready_study/program.hpp"
#include "studies/report/pages/page.hpp"
#include "studies/report/plots/report_plots.hpp"
#include "studies/report/words/table.hpp"
#include "studies/report/words/units.hpp"
#include "studies/skewed_slot/results.hpp"
#include "studies/skewed_slot/texts.hpp"

namespace dovetail::optimizer {

using skewed_slot::Joint;

/// Besides its contact.
template <>
inline constexpr auto kFields<Joint> =
    std::tuple{RecordField{"skew_deg", &Joint::skew_deg},
               RecordField{"status", &Joint::status},
               RecordField{"pressure_mean_pa", &Joint::pressure_mean_pa},
               RecordField{"pressure_max_pa", &Joint::pressure_max_pa},
               RecordField{"interior_pressure_max_pa", &Joint::interior_pressure_max_pa},
               RecordField{"slip_max_m", &Joint::slip_max_m},
               RecordField{"slip_m", &Joint::slip_m},
               RecordField{"seconds", &Joint::seconds}};

template <>
inline constexpr auto kFields<skewed_slot::Wear> =
    std::tuple{RecordField{"skew_deg", &skewed_slot::Wear::skew_deg},
               RecordField{"status", &skewed_slot::Wear::status},
               RecordField{"resonance_hz", &skewed_slot::Wear::resonance_hz},
               RecordField{"peak_amplitude_m", &skewed_slot::Wear::peak_amplitude_m},
               RecordField{"asymptotic_wear_volume_m3", &skewed_slot::Wear::volume_m3},
               RecordField{"asymptotic_wear_depth_max_m", &skewed_slot::Wear::depth_m},
               RecordField{"seconds", &skewed_slot::Wear::seconds}};

}  // namespace dovetail::optimizer

namespace dovetail::skewed_slot {
namespace {

using report::FlankMap;
using report::Plot;
using report::significant;
using Json = nlohmann::ordered_json;

bool good(const Joint& joint) {
  return optimizer::converged(joint.status);
}

std::string degrees(double angle) {
  return angle == 0 ? "straight slot" : fmt::format("{:g}\u00b0 skew", angle);
}

std::string angle(double degrees) {
  return fmt::format("{:g}\u00b0", degrees);
}

/// Of each joint, over the angle; of several quantities the first two in colours of their own, the third dashed.
Plot over_angle(const Results& r, Plot plot, const std::vector<std::pair<std::string, double Joint::*>>& quantities,
                double si) {
  plot.x = {.label = "skew", .unit = "degrees"};
  plot.y.from_zero = true;
  constexpr std::array kRoles{report::Role::after, report::Role::bad, report::Role::before};
  for (std::size_t q = 0; q < quantities.size(); ++q) {
    report::Series series{.name = quantities[q].first,
                          .role = kRoles[q],
                          .stroke = q == 2 ? report::Stroke::dashed : report::Stroke::solid,
                          .mark = report::Mark::dot};
    for (const Joint& joint : r.joints)
      series.add(joint.skew_deg, good(joint) ? joint.*(quantities[q].second) / si : std::nan(""));
    plot.series.push_back(std::move(series));
  }
  return plot;
}

std::string ratio(double skewed, double straight) {
  return straight > 0 ? significant(skewed / straight, 3) : "\u2013";
}

std::string lead(const Results& r) {
  const Joint &straight = r.joints.front(), &last = r.joints.back();
  if (!good(straight) || !good(last)) return "The joints could not be computed";
  return fmt::format(
      "A slot skewed by {:g} degrees carries {} times the largest pressure of a straight one and slips {} times as far "
      "in the spin-up",
      last.skew_deg, ratio(last.pressure_max_pa, straight.pressure_max_pa),
      ratio(last.slip_max_m, straight.slip_max_m));
}

std::string joint_table(const Results& r) {
  report::Table table{.columns = {{"skew"},
                                  {"mean pressure (MPa)"},
                                  {"largest (MPa)"},
                                  {"largest inside (MPa)"},
                                  {"largest slip (\u00b5m)"},
                                  {"time (s)"},
                                  {"status", true}},
                      .rows = {},
                      .named_rows = false};
  for (const Joint& j : r.joints)
    table.rows.push_back({{angle(j.skew_deg), significant(j.pressure_mean_pa / 1e6, 4),
                           significant(j.pressure_max_pa / 1e6, 4), significant(j.interior_pressure_max_pa / 1e6, 4),
                           significant(j.slip_max_m / 1e-6, 4), significant(j.seconds, 3), j.status}});
  return table_html(table);
}

std::string wear_table(const Results& r) {
  if (r.wear.empty()) return {};
  report::Table table{.columns = {{"skew"},
                                  {"resonance (Hz)"},
                                  {"amplitude (mm)"},
                                  {"worn volume (mm\u00b3)"},
                                  {"largest depth (\u00b5m)"},
                                  {"time (s)"},
                                  {"status", true}},
                      .rows = {},
                      .named_rows = false};
  for (const Wear& w : r.wear)
    table.rows.push_back(
        {{angle(w.skew_deg), significant(w.resonance_hz, 6), significant(w.peak_amplitude_m / 1e-3, 4),
          significant(w.volume_m3 / 1e-9, 3), significant(w.depth_m / 1e-6, 3), significant(w.seconds, 3), w.status}});
  return table_html(table);
}

/// The straight and the most skewed slot on one scale of colours.
void add_maps(const Results& r, const Numbers& (*values)(const Joint&), const FlankMap& look,
              std::vector<report::Figure>& maps) {
  const std::array<const Joint*, 2> joints{&r.joints.front(), &r.joints.back()};
  for (const Joint* joint : joints) {
    FlankMap map = look;
    map.title += ", " + degrees(joint->skew_deg);
    map.panels = report::flank_panels(joint->contact, values(*joint));
    map.full_scale = std::max(report::largest(values(*joints[0])), report::largest(values(*joints[1])));
    maps.emplace_back(std::move(map));
  }
}

std::vector<report::Figure> maps(const Results& r) {
  std::vector<report::Figure> all;
  add_maps(
      r, [](const Joint& joint) -> const Numbers& { return joint.contact.preload_pressure_pa; },
      {.title = "Pressure", .quantity = "pressure", .unit = {.symbol = "MPa", .si = 1e6}}, all);
  add_maps(
      r, [](const Joint& joint) -> const Numbers& { return joint.slip_m; },
      {.title = "Slip", .quantity = "slip", .unit = {.symbol = "\u00b5m", .si = 1e-6}}, all);
  return all;
}

Plot pressure_plot(const Results& r) {
  return over_angle(
      r,
      {.title = "Pressure over skew",
       .description = "After spin-up. Edges are sharp, so the largest pressure grows with a finer mesh; inside "
                      "leaves the outermost nodes out.",
       .y = {.label = "pressure", .unit = "MPa"}},
      {{"largest", &Joint::pressure_max_pa},
       {"largest inside", &Joint::interior_pressure_max_pa},
       {"mean", &Joint::pressure_mean_pa}},
      1e6);
}

Plot slip_plot(const Results& r) {
  return over_angle(r,
                    {.title = "Slip over skew",
                     .description = "Largest slip of the blade on the disk in the spin-up.",
                     .y = {.label = "slip", .unit = "\u00b5m"}},
                    {{"", &Joint::slip_max_m}}, 1e-6);
}

std::string page_html(const Results& r) {
  return ready_study::page("A skewed slot \u2013 dovetail", "", texts::page_html,
                           {{"lead", lead(r)},

                            {"joints", joint_table(r)},
                            {"over_angle", report::figures_html({pressure_plot(r), slip_plot(r)})},
                            {"maps", report::figures_html(maps(r))},
                            {"wear", wear_table(r)}},
                           r.made);
}

Json json_of(const Results& r) {
  Json json{{"quick", r.made.quick}, {"seconds", r.made.seconds}, {"joints", Json::array()}};
  for (const Joint& j : r.joints) {
    Json joint = optimizer::json_value<Json>(j);
    joint.update({{"flank", j.contact.flank},
                  {"along_m", j.contact.along_m},
                  {"across_m", j.contact.across_m},
                  {"area_m2", j.contact.area_m2},
                  {"pressure_pa", j.contact.preload_pressure_pa}});
    json["joints"].push_back(std::move(joint));
  }
  json["wear"] = optimizer::json_value<Json>(r.wear);
  return json;
}

std::string joints_csv(const Results& r) {
  std::string text = "skew_deg,flank,along_the_slot_mm,from_the_neck_side_mm,pressure_mpa,slip_um\n";
  for (const Joint& j : r.joints)
    for (std::size_t i = 0; i < j.contact.flank.size(); ++i)
      text +=
          fmt::format("{:g},{},{:.9g},{:.9g},{:.9g},{:.9g}\n", j.skew_deg,
                      j.contact.flank_names[static_cast<std::size_t>(j.contact.flank[i])], j.contact.across_m[i] / 1e-3,
                      j.contact.along_m[i] / 1e-3, j.contact.preload_pressure_pa[i] / 1e6, j.slip_m[i] / 1e-6);
  return text;
}

}  // namespace

void write(const std::string& folder, const Results& results) {
  ready_study::write(folder, {{"joints.csv", joints_csv(results)},
                              {"results.json", json_of(results).dump() + "\n"},
                              {"report.html", page_html(results)}});
}

}  // namespace dovetail::skewed_slot
