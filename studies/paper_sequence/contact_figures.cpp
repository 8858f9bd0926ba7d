#include "studies/paper_sequence/contact_figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "studies/report/plots/report_plots.hpp"
#include "studies/report/words/units.hpp"

namespace dovetail::paper_sequence {
namespace {

using report::Figure;
using report::Plot;
using report::Role;
using report::scaled;
using report::Series;
using report::significant;
using report::Stroke;
using report::Unit;

/// Both flanks of the contact nodes; one line where the flanks are alike.
std::vector<Series> flank_lines(const report::ContactRecord& contact, const Numbers& values, double si) {
  const Numbers left = of_flank(contact, values, 0), right = of_flank(contact, values, 1);
  const double most = report::largest(values);
  const bool alike = std::equal(left.begin(), left.end(), right.begin(), right.end(),
                                [&](double a, double b) { return std::abs(a - b) < 0.01 * most; });
  Series first{.name = alike ? "both flanks" : "left flank",
               .x = scaled(of_flank(contact, contact.along_m, 0), 1e-3),
               .y = scaled(left, si),
               .mark = report::Mark::dot};
  if (alike) return {first};
  Series second{.name = "right flank",
                .x = scaled(of_flank(contact, contact.along_m, 1), 1e-3),
                .y = scaled(right, si),
                .role = Role::bad,
                .stroke = Stroke::dashed};
  return {first, second};
}

Plot along_flank(const Results& r, const Numbers& values, const Unit& unit, Plot plot) {
  plot.x = report::kAlongFlank;
  plot.y.unit = unit.symbol;
  plot.y.from_zero = true;
  plot.series = flank_lines(r.design.contact, values, unit.si);
  return plot;
}

/// Along the flank in the plane, over the flanks in space.
Figure of_contact(const Results& r, const Numbers& values, const Unit& unit, Plot plot) {
  if (!r.in_space()) return along_flank(r, values, unit, std::move(plot));
  return report::FlankMap{.title = plot.title,
                          .description = plot.description,
                          .quantity = plot.y.label,
                          .unit = unit,
                          .panels = report::flank_panels(r.design.contact, values)};
}

}  // namespace

Figure pressure_figure(const Results& r) {
  const Numbers& pressure = r.design.contact.preload_pressure_pa;
  return of_contact(r, pressure, report::readable_unit("Pa", report::largest(pressure)),
                    {.title = "Pressure after spin-up",
                     .description = "Under the centrifugal load alone. The last nodes stand for a sharp edge, whose "
                                    "pressure grows as the mesh gets finer.",
                     .y = {.label = "pressure"}});
}

Figure first_rate_figure(const Results& r) {
  const Numbers& rate = r.design.contact.wear_rate_m_per_cycle;
  const double most = report::largest(rate);
  return of_contact(r, rate, {.symbol = "", .si = std::max(most, 1e-300)},
                    {.title = "Wear rates of the first cycle",
                     .description = fmt::format("Over the largest of both flanks, {} nm per million cycles.",
                                                significant(most * 1e15, 3)),
                     .y = {.label = "rate / largest rate"}});
}

Figure profile_figure(const Results& r) {
  const bool ended = !r.in_space();  // where there is room for the end of the history, too
  Figure figure = of_contact(
      r, r.design.contact.depth_m, {.symbol = "\u00b5m", .si = 1e-6},
      {.title = "Final worn profile",
       .description = std::string("Depth off both surfaces together when wear has come to rest, found directly") +
                      (ended ? "; dashed: where the history ended." : "."),
       .y = {.label = "worn depth"}});
  if (!ended || r.history.depth_m.empty()) return figure;
  const std::vector<Series> lines = flank_lines(r.design.contact, r.history.depth_m.back(), 1e-6);
  for (const Series& line : lines)
    std::get<Plot>(figure).series.push_back({.name = "history" + (lines.size() > 1 ? ", " + line.name : ""),
                                             .x = line.x,
                                             .y = line.y,
                                             .role = Role::before,
                                             .stroke = Stroke::dashed});
  return figure;
}

}  // namespace dovetail::paper_sequence
