// The best designs by the full wear history, beside the direct method.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "studies/report/pages/html.hpp"
#include "studies/report/pages/report_tables.hpp"
#include "studies/report/pages/units.hpp"
#include "studies/report/plots/report_plots.hpp"

namespace dovetail::report {

namespace {

std::string per_cent(double value, double reference) {
  if (!(reference > 0) || !std::isfinite(value)) return value == reference ? "0\u00a0%" : "\u2013";
  const double percent = 100 * (value / reference - 1);
  return (percent > 0 ? "+" : "") + significant(percent, 2) + "\u00a0%";
}

}  // namespace

Plot verification_plot(const VerificationRecord& record) {
  Plot plot{
      .title = fmt::format("Worn profile of evaluation {}", record.evaluation + 1),
      .description =
          "Depth along the more worn flank. Solid: the end of the history; dashed: the direct method at the "
          "same settings; dotted: at the settings of the search.",
      .x = {.label = "along the flank, from its neck side", .unit = "mm"},
      .y = {.label = "worn depth", .from_zero = true},
  };
  const std::size_t count = record.flank.size();
  if (count == 0 || record.direct_profile_m.size() != count) return plot;
  std::vector<double> worn(record.flank_names.size() + 1, 0.0);
  for (std::size_t i = 0; i < count; ++i) worn[static_cast<std::size_t>(record.flank[i])] += record.direct_profile_m[i];
  const auto shown = std::max_element(worn.begin(), worn.end()) - worn.begin();
  double most = 0;
  for (const Numbers* profile : {&record.search_profile_m, &record.direct_profile_m, &record.history_profile_m})
    most = std::max(most, largest(*profile));
  const Unit unit = readable_unit("m", most);
  plot.y.unit = unit.symbol;
  const auto add = [&](const char* name, const Numbers& profile, Role role, Stroke stroke) {
    if (profile.size() != count) return;
    PlotLine line{.name = name, .role = role, .stroke = stroke};
    for (const std::size_t i : worst_line(record.flank, record.across_m, record.direct_profile_m, shown)) {
      line.x.push_back(record.along_m[i] / 1e-3);
      line.y.push_back(profile[i] / unit.si);
    }
    plot.lines.push_back(std::move(line));
  };
  add("history", record.history_profile_m, Role::after, Stroke::solid);
  add("direct", record.direct_profile_m, Role::before, Stroke::dashed);
  add("search", record.search_profile_m, Role::muted, Stroke::dotted);
  return plot;
}

std::string verification_table(const RunRecord& record) {
  double most = 0, deepest = 0;
  for (const VerificationRecord& v : record.verifications) {
    most = std::max({most, v.search_volume_m3, v.direct_volume_m3, v.history_volume_m3});
    deepest = std::max({deepest, v.direct_depth_m, v.history_depth_m});
  }
  const Unit volume = readable_unit("m^3", most), depth = readable_unit("m", deepest);
  const std::string unknown = "not known";
  const Unit bare{.symbol = "", .si = volume.si};  // the unit stands in the head
  std::string text =
      "<div class=\"scroll\"><table><thead><tr><th scope=\"col\">#</th><th scope=\"col\" class=\"text\">status</th>";
  for (const std::string& column :
       {"search (" + volume.symbol + ")", "direct (" + volume.symbol + ")", "history (" + volume.symbol + ")",
        std::string("change"), "depth, direct (" + depth.symbol + ")", "history (" + depth.symbol + ")",
        std::string("profiles differ by")})
    text += "<th scope=\"col\">" + escape(column) + "</th>";
  text += "</tr></thead><tbody>\n";
  for (const VerificationRecord& v : record.verifications) {
    text += fmt::format(
        "<tr><th scope=\"row\">{}</th><td class=\"text\">{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td>"
        "<td>{}</td>",
        v.evaluation + 1, escape(v.agreement()), with_error(v.search_volume_m3, v.search_bar_m3, bare),
        significant(v.direct_volume_m3 / volume.si, 4),
        v.compared() ? with_error(v.history_volume_m3, v.history_bar_m3, bare) : unknown,
        v.compared() ? per_cent(v.history_volume_m3, v.direct_volume_m3) : unknown,
        significant(v.direct_depth_m / depth.si, 4),
        v.compared() ? significant(v.history_depth_m / depth.si, 4) : unknown);
    text += fmt::format("<td>{}</td></tr>\n",
                        v.compared() ? significant(100 * v.profile_difference, 2) + "\u00a0%" : unknown);
  }
  return text + "</tbody></table></div>\n";
}

}  // namespace dovetail::report
