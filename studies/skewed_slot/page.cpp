// The page of the study, its tables and its JSON.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/replace_file.hpp"
#include "studies/report/pages/html.hpp"
#include "studies/report/pages/page_style.hpp"
#include "studies/report/pages/units.hpp"
#include "studies/report/plots/flank_map.hpp"
#include "studies/report/plots/report_plots.hpp"
#include "studies/report/plots/svg_plot.hpp"
#include "studies/skewed_slot/results.hpp"

namespace dovetail::skewed_slot {
namespace {

using report::escape;
using report::FlankMap;
using report::Plot;
using report::significant;
using Json = nlohmann::ordered_json;

bool good(const Joint& joint) {
  return joint.status == "converged";
}

std::string degrees(double angle) {
  return angle == 0 ? "straight slot" : fmt::format("{:g}\u00b0 skew", angle);
}

FlankMap map_of(const Joint& joint, const Numbers& values, report::Unit unit, std::string title, std::string quantity) {
  return {.title = std::move(title) + ", " + degrees(joint.skew_deg),
          .quantity = std::move(quantity),
          .unit = std::move(unit),
          .panels = report::flank_panels(joint.contact, values)};
}

Plot over_angle(const Results& r, Plot plot, const std::vector<std::pair<std::string, double Joint::*>>& quantities,
                double si) {
  plot.x = {.label = "skew", .unit = "degrees"};
  plot.y.from_zero = true;
  for (std::size_t q = 0; q < quantities.size(); ++q) {
    report::PlotLine line{.name = quantities[q].first};
    line.role = q == 0 ? report::Role::after : q == 1 ? report::Role::bad : report::Role::before;
    line.stroke = q == 2 ? report::Stroke::dashed : report::Stroke::solid;
    line.dots = true;
    for (const Joint& joint : r.joints) {
      line.x.push_back(joint.skew_deg);
      line.y.push_back(good(joint) ? joint.*(quantities[q].second) / si : std::nan(""));
    }
    plot.lines.push_back(std::move(line));
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
  std::string text =
      "<div class=\"scroll\"><table><thead><tr><th>skew</th><th>mean pressure (MPa)</th><th>largest (MPa)</th><th>"
      "largest inside (MPa)</th><th>largest slip (\u00b5m)</th><th>time (s)</th><th "
      "class=\"text\">status</th></tr></thead>"
      "<tbody>\n";
  for (const Joint& j : r.joints)
    text += fmt::format(
        "<tr><td>{:g}\u00b0</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td "
        "class=\"text\">{}</td></tr>\n",
        j.skew_deg, significant(j.pressure_mean_pa / 1e6, 4), significant(j.pressure_max_pa / 1e6, 4),
        significant(j.interior_pressure_max_pa / 1e6, 4), significant(j.slip_max_m / 1e-6, 4),
        significant(j.seconds, 3), escape(j.status));
  return text + "</tbody></table></div>\n";
}

std::string wear_table(const Results& r) {
  if (r.wear.empty()) return {};
  std::string text =
      "<section><h2>Wear at the resonance</h2>\n<div class=\"scroll\"><table><thead><tr><th>skew</th><th>resonance (Hz)"
      "</th><th>amplitude (mm)</th><th>worn volume (mm\u00b3)</th><th>largest depth (\u00b5m)</th><th>time (s)</th><th "
      "class=\"text\">status</th></tr></thead><tbody>\n";
  for (const Wear& w : r.wear)
    text += fmt::format(
        "<tr><td>{:g}\u00b0</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td "
        "class=\"text\">{}</td></tr>\n",
        w.skew_deg, significant(w.resonance_hz, 6), significant(w.peak_amplitude_m / 1e-3, 4),
        significant(w.volume_m3 / 1e-9, 3), significant(w.depth_m / 1e-6, 3), significant(w.seconds, 3),
        escape(w.status));
  return text +
         "</tbody></table></div>\n<p class=\"soft\">Of whole contact nodes, when wear has come to "
         "rest.</p></section>\n";
}

/// The straight and the most skewed slot on one scale of colours.
std::string pair_of_maps(const Results& r, const Numbers& (*values)(const Joint&), const report::Unit& unit,
                         const std::string& title, const std::string& quantity) {
  std::string text;
  const std::array<const Joint*, 2> joints{&r.joints.front(), &r.joints.back()};
  const double most = std::max(report::largest(values(*joints[0])), report::largest(values(*joints[1])));
  for (const Joint* joint : joints) {
    FlankMap map = map_of(*joint, values(*joint), unit, title, quantity);
    map.full_scale = most;
    text += report::flank_map_figure(map);
  }
  return text;
}

std::string maps(const Results& r) {
  constexpr auto pressure = [](const Joint& joint) -> const Numbers& { return joint.contact.preload_pressure_pa; };
  constexpr auto slip = [](const Joint& joint) -> const Numbers& { return joint.slip_m; };
  return "<div class=\"grid2 maps\">\n" +
         pair_of_maps(r, pressure, {.symbol = "MPa", .si = 1e6}, "Pressure", "pressure") +
         pair_of_maps(r, slip, {.symbol = "\u00b5m", .si = 1e-6}, "Slip", "slip") + "</div>\n";
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

std::string provenance(const Results& r) {
  const report::Provenance made = report::provenance();
  std::string text = "<section><h2>Provenance</h2>\n<dl>\n";
  for (const auto& [name, value] : {std::pair<std::string, std::string>{"Time taken", significant(r.seconds, 3) + " s"},
                                    {"Commit", r.commit},
                                    {"Compiler", made.compiler},
                                    {"Date", made.date_utc}})
    text += "<dt>" + name + "</dt><dd>" + escape(value) + "</dd>\n";
  return text + "</dl>\n<details><summary>Study file</summary><pre>" + escape(r.study_text) +
         "</pre></details></section>\n";
}

std::string page_html(const Results& r) {
  std::string text = report::page_begin("A skewed slot \u2013 dovetail") +
                     "<header><h1>A straight slot against a skewed one</h1>\n<p class=\"lead\">" + escape(lead(r)) +
                     "</p>\n";
  if (r.quick) text += "<p class=\"flag\">A quick look on a coarse mesh: no evidence.</p>\n";
  text +=
      "<p>Broached slots often run at an angle to the axis of rotation, so that the foot suits the aerofoil's stagger. "
      "Published finite-element work on fan-blade dovetails reports about twice the peak pressure and slip at 20 "
      "degrees. "
      "Here the same section is swept along both slots, with the same load.</p></header>\n<section><h2>After "
      "spin-up</h2>\n" +
      joint_table(r) + "<div class=\"grid2\" style=\"margin-top:1rem\">\n" + report::plot_figure(pressure_plot(r)) +
      report::plot_figure(slip_plot(r)) + "</div>\n" + maps(r) + "</section>\n" + wear_table(r);
  return text + provenance(r) + report::kPageEnd;
}

Json json_of(const Results& r) {
  Json json{{"quick", r.quick}, {"seconds", r.seconds}, {"joints", Json::array()}, {"wear", Json::array()}};
  for (const Joint& j : r.joints)
    json["joints"].push_back({{"skew_deg", j.skew_deg},
                              {"status", j.status},
                              {"pressure_mean_pa", j.pressure_mean_pa},
                              {"pressure_max_pa", j.pressure_max_pa},
                              {"interior_pressure_max_pa", j.interior_pressure_max_pa},
                              {"slip_max_m", j.slip_max_m},
                              {"flank", j.contact.flank},
                              {"along_m", j.contact.along_m},
                              {"across_m", j.contact.across_m},
                              {"area_m2", j.contact.area_m2},
                              {"pressure_pa", j.contact.preload_pressure_pa},
                              {"slip_m", j.slip_m},
                              {"seconds", j.seconds}});
  for (const Wear& w : r.wear)
    json["wear"].push_back({{"skew_deg", w.skew_deg},
                            {"status", w.status},
                            {"resonance_hz", w.resonance_hz},
                            {"peak_amplitude_m", w.peak_amplitude_m},
                            {"asymptotic_wear_volume_m3", w.volume_m3},
                            {"asymptotic_wear_depth_max_m", w.depth_m},
                            {"seconds", w.seconds}});
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
  std::error_code ignored;  // what is missing is named when a file cannot be written
  std::filesystem::create_directories(folder, ignored);
  const std::filesystem::path path(folder);
  replace_file(path / "joints.csv", joints_csv(results));
  replace_file(path / "results.json", json_of(results).dump() + "\n");
  replace_file(path / "report.html", page_html(results));
}

}  // namespace dovetail::skewed_slot
