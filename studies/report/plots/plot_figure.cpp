// A plot with what surrounds it on the page: title, legend, sentence and numbers.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "studies/report/pages/html.hpp"
#include "studies/report/pages/units.hpp"
#include "studies/report/plots/svg_plot.hpp"

namespace dovetail::report {

namespace {

constexpr std::array<const char*, 4> kRoleClass{"before", "after", "muted", "bad"};
constexpr std::array<const char*, 3> kStrokeClass{"solid", "dashed", "dotted"};
constexpr std::array<const char*, 4> kShape{"<circle class=\"mark {0}\" cx=\"12\" cy=\"6\" r=\"3.5\"/>",
                                            "<path class=\"mark {0} open\" d=\"M8.5 2.5l7 7m0 -7l-7 7\"/>",
                                            "<path class=\"mark {0}\" d=\"M12 1.5l4.5 8h-9Z\"/>",
                                            "<path class=\"mark {0}\" d=\"M12 0l1.8 3.8 4.2.5-3.1 2.9.8 "
                                            "4.1-3.7-2-3.7 2 .8-4.1-3.1-2.9 4.2-.5Z\"/>"};

std::string legend_entry(const std::string& drawing, const std::string& name) {
  return fmt::format("<li><svg viewBox=\"0 0 24 12\" aria-hidden=\"true\">{}</svg>{}</li>", drawing, escape(name));
}

std::string heading(const PlotAxis& axis, const std::string& name) {
  const std::string text = name.empty() ? axis.label : name;
  return fmt::format("<th scope=\"col\">{}</th>", escape(axis.unit.empty() ? text : text + " (" + axis.unit + ")"));
}

/// Lines over the same x share a table.
std::string table_of(const Plot& plot, const std::vector<double>& x, const std::vector<const std::vector<double>*>& y,
                     const std::vector<std::string>& names) {
  std::string text = "<table><thead><tr>" + heading(plot.x, "");
  for (const std::string& name : names) text += heading(plot.y, name);
  text += "</tr></thead><tbody>\n";
  for (std::size_t i = 0; i < x.size(); ++i) {
    text += "<tr><td>" + plain(x[i], 7) + "</td>";
    for (const std::vector<double>* values : y)
      text += "<td>" + (i < values->size() ? significant((*values)[i], 5) : "") + "</td>";
    text += "</tr>\n";
  }
  return text + "</tbody></table>\n";
}

std::string numbers(const Plot& plot) {
  std::string text;
  std::vector<bool> done(plot.lines.size(), false);
  for (std::size_t i = 0; i < plot.lines.size(); ++i) {
    if (done[i]) continue;
    std::vector<const std::vector<double>*> y;
    std::vector<std::string> names;
    for (std::size_t j = i; j < plot.lines.size(); ++j) {
      if (done[j] || plot.lines[j].x != plot.lines[i].x) continue;
      done[j] = true;
      y.push_back(&plot.lines[j].y);
      names.push_back(plot.lines[j].name);
    }
    text += table_of(plot, plot.lines[i].x, y, names);
  }
  for (const PlotPoints& points : plot.points)
    if (!points.x.empty()) text += table_of(plot, points.x, {&points.y}, {points.name});
  return "<details class=\"numbers\"><summary>Numbers</summary><div class=\"scroll\">" + text + "</div></details>\n";
}

}  // namespace

std::string plot_legend(const Plot& plot) {
  std::string text;
  for (const PlotLine& line : plot.lines)
    if (!line.name.empty())
      text += legend_entry(
          fmt::format("<path class=\"line {} {}\" d=\"M1 6H23\"/>", kRoleClass[static_cast<std::size_t>(line.role)],
                      kStrokeClass[static_cast<std::size_t>(line.stroke)]),
          line.name);
  for (const PlotPoints& points : plot.points)
    if (!points.name.empty() && !points.x.empty())
      text += legend_entry(fmt::format(fmt::runtime(kShape[static_cast<std::size_t>(points.shape)]),
                                       kRoleClass[static_cast<std::size_t>(points.role)]),
                           points.name);
  return text.empty() ? "" : "<ul class=\"legend\">" + text + "</ul>\n";
}

std::string plot_figure(const Plot& plot) {
  const std::string title = "<h3>" + escape(plot.title) + "</h3>\n";
  if (is_empty(plot))
    return "<figure class=\"nothing\">" + title + "<p>Nothing to show: these values were not computed.</p></figure>\n";
  std::string text = "<figure>" + title + plot_legend(plot) + plot_svg(plot);
  if (!plot.description.empty()) text += "<figcaption>" + escape(plot.description) + "</figcaption>\n";
  return text + numbers(plot) + "</figure>\n";
}

std::string plot_style() {
  return R"(
:root{color-scheme:light dark;--paper:#fbfbfa;--card:#fff;--ink:#1c2127;--soft:#59626d;--hair:#e3e5e8;--base:#9aa1aa;
--before:#8b929b;--after:#0b62b8;--bad:#c2511c;--wash:#dfeaf6;--steel:#eceef0}
@media(prefers-color-scheme:dark){:root{--paper:#14171b;--card:#1b1f25;--ink:#e7e9ec;--soft:#a2abb5;--hair:#2d333b;
--base:#69727d;--before:#8d96a1;--after:#64b0ff;--bad:#f0905c;--wash:#1d3148;--steel:#2a2f36}}
svg.plot{display:block;width:100%;height:auto;overflow:visible}
svg.plot text{font:12.5px system-ui,-apple-system,"Segoe UI",Roboto,sans-serif;fill:var(--soft)}
.grid path{stroke:var(--hair);stroke-width:1;fill:none}.grid path.base,.grid path.tick{stroke:var(--base)}
svg.plot text.point{font-size:11px;paint-order:stroke;stroke:var(--card);stroke-width:3px}
.grid text.y{text-anchor:end;font-variant-numeric:tabular-nums}.grid text.x{text-anchor:middle}
svg.plot text.title{fill:var(--ink)}.grid text.x-title{text-anchor:end}
path.line{fill:none;stroke-width:2;stroke-linejoin:round;stroke-linecap:round}
path.dashed{stroke-dasharray:6 4}path.dotted{stroke-dasharray:1 4}
path.level{stroke:var(--bad);stroke-width:1;stroke-dasharray:2 3}svg.plot text.level{text-anchor:end;fill:var(--bad)}
.line.before{stroke:var(--before)}.line.after{stroke:var(--after)}.line.muted{stroke:var(--base)}.line.bad{stroke:var(--bad)}
.area{opacity:.14;stroke:none}.area.before{fill:var(--before)}.area.after{fill:var(--after)}
.mark{stroke:var(--card);stroke-width:.8}.dot{stroke:none}.mark.before,.dot.before{fill:var(--before)}
.mark.after,.dot.after{fill:var(--after)}.mark.muted,.dot.muted{fill:var(--base)}.mark.bad,.dot.bad{fill:var(--bad)}
.mark.open{fill:none;stroke-width:1.6}.mark.open.bad{stroke:var(--bad)}.mark.open.muted{stroke:var(--base)}
.mark.open.before{stroke:var(--before)}.mark.open.after{stroke:var(--after)}
ul.legend{list-style:none;display:flex;flex-wrap:wrap;gap:.2rem 1.1rem;margin:0 0 .5rem;padding:0;font-size:.84rem;color:var(--soft)}
ul.legend li{display:flex;align-items:center;gap:.4rem}ul.legend svg{width:24px;height:12px;flex:none}
)";
}

}  // namespace dovetail::report
