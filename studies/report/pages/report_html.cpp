#include "studies/report/pages/report_html.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/replace_file.hpp"
#include "studies/report/pages/answers.hpp"
#include "studies/report/pages/page.hpp"
#include "studies/report/pages/report_tables.hpp"
#include "studies/report/plots/report_plots.hpp"
#include "studies/report/plots/section_drawing.hpp"
#include "studies/report/plots/stress_contours.hpp"
#include "studies/report/texts.hpp"
#include "studies/report/words/headline.hpp"
#include "studies/report/words/html.hpp"
#include "studies/report/words/report_words.hpp"
#include "studies/report/words/table.hpp"
#include "studies/report/words/units.hpp"
#include "wear/follow.hpp"

namespace dovetail::report {

namespace {

/// The designs there are to show: the best with the start behind it, or the start alone.
Comparison designs_of(const RunRecord& record) {
  if (!record.best_design)
    return {.before = nullptr, .after = record.baseline_design ? &*record.baseline_design : nullptr};
  const bool same = record.best == record.baseline;
  return {.before = record.baseline_design && !same ? &*record.baseline_design : nullptr,
          .after = &*record.best_design};
}

/// Names of the template that stand for a yes.
std::string when(bool holds) {
  return holds ? "yes" : "";
}

std::string notes(const Comparison& designs) {
  std::vector<std::string> all;
  for (const auto& [design, whose] : {std::pair{designs.before, "Before: "}, {designs.after, "After: "}})
    if (design)
      for (const std::string& note : design->notes)
        all.push_back(std::string(designs.before ? whose : "") + in_words(note));
  return list_html(all);
}

void add_opening(const RunRecord& record, Blanks& blanks) {
  std::vector<std::string> held;
  for (const Holder& by : holding(record)) held.push_back(by.words());
  blanks["name"] = record.title.empty() ? record.name : record.title;
  blanks["headline"] = headline(record);
  blanks["best"] = record.front ? "compromise on this front" : "best design";
  blanks["held"] = listed(held);
  blanks["free"] = when(held.empty() && record.best);
  blanks["outcome"] = outcome_table(record);
  blanks["sure"] = list_html(how_sure(record));
  blanks["far"] = list_html(how_far(record));
  blanks["next"] = list_html(what_next(record));
  blanks["ending"] = ending(record);
  blanks["key_figures"] = key_figures(record) + case_table(record);
}

/// Without the engine orders where they are not known.
std::vector<Figure> vibration_plots(const Comparison& designs) {
  std::vector<Figure> plots{response_plot(designs), nodal_diameter_plot(*designs.after)};
  if (Plot orders = engine_order_plot(*designs.after); !orders.series.empty()) plots.emplace_back(std::move(orders));
  return plots;
}

void add_designs(const Comparison& designs, Blanks& blanks) {
  for (const char* name :
       {"shape", "contact", "maps", "stress", "vibration", "wears", "history", "history_end", "notes", "in_space"})
    blanks[name];
  if (!designs.after) return;
  const DesignRecord& design = *designs.after;
  blanks["shape"] = joint_figure(design, designs.before) + sector_figure(design, designs.before);
  blanks["contact"] = figures_html(contact_plots(designs));
  if (in_space(design.contact)) blanks["maps"] = figures_html(contact_maps(designs));
  blanks["stress"] = stress_figures(designs);
  blanks["in_space"] = blanks["maps"];
  if (!design.unworn.frequency_hz.empty() || !design.nodal_diameters.frequency_hz.empty())
    blanks["vibration"] = figures_html(vibration_plots(designs));
  blanks["wears"] = when(!design.contact.depth_m.empty());
  blanks["notes"] = notes(designs);
  if (!design.history || design.history->cycles.empty()) return;
  blanks["history"] = figures_html(history_plots(designs));
  if (!optimizer::converged(design.history->status)) blanks["history_end"] = design.history->status;
}

void add_verification(const RunRecord& record, Blanks& blanks) {
  for (const char* name : {"verification", "verified", "finer", "follows"}) blanks[name];
  if (record.verifications.empty()) return;
  const VerificationRecord& first = record.verifications.front();
  blanks["verified"] = record.verifications.size() == 1 ? "The best design was" : "The best designs were";
  if (first.harmonics > 0)
    blanks["finer"] = fmt::format(" ({} edges per flank, {} harmonics, {} samples)", first.flank_elements,
                                  first.harmonics, first.samples);
  blanks["follows"] = when(named<wear::Follow>(first.follow) == wear::Follow::resonance);
  std::vector<Figure> plots;
  for (const VerificationRecord& v : record.verifications)  // of a design that does not wear there is no profile
    if (!optimizer::converged(v.status) || std::max({v.search_depth_m, v.direct_depth_m, v.history_depth_m}) > 0)
      plots.emplace_back(verification_plot(v));
  blanks["verification"] = verification_table(record) + figures_html(plots);
}

void add_front(const RunRecord& record, Blanks& blanks) {
  for (const char* name : {"front", "front_table", "hypervolume"}) blanks[name];
  if (!record.front) return;
  const FrontRecord& front = *record.front;
  double box = 1;
  for (std::size_t i = 0; i < front.columns(); ++i) box *= std::abs(front.reference[i] - front.ideal[i]);
  for (const Figure& figure : front_plots(record)) blanks["front"] += figure_html(figure);
  blanks["front_table"] = front_table(record);
  if (box > 0)
    blanks["hypervolume"] = fmt::format(
        "{} ({}\u00a0% of the box between the best value of each objective and the "
        "reference)",
        significant(front.hypervolume, 5), significant(100 * front.hypervolume / box, 3));
}

void add_search(const RunRecord& record, Blanks& blanks) {
  blanks["problem"] = problem_list(record) + case_list(record);
  blanks["limits"] = limit_table(record);
  blanks["departures"] = departure_table(record);
  std::vector<Figure> plots = limit_plots(record);
  plots.insert(plots.begin(), record.front ? hypervolume_plot(record) : objective_plot(record));
  blanks["search"] = record.evaluations.empty() ? "" : figures_html(plots);
  blanks["variables"] = variable_table(record);
  blanks["evaluations"] = evaluation_table(record);
  blanks["influence"] = influence_table(record);
  std::vector<Figure> over_variables = variable_plots(record);
  std::erase_if(over_variables, [](const Figure& figure) { return is_empty(std::get<Plot>(figure)); });
  blanks["over_variables"] = over_variables.empty() ? "" : figures_html(over_variables);
  blanks["candidates"] = candidates_chart(record);
}

}  // namespace

std::string report_html(const RunRecord& record) {
  Blanks blanks{{"provenance", provenance_section(record)}, {"wear", wear_words(record)}};
  add_opening(record, blanks);
  add_designs(designs_of(record), blanks);
  add_front(record, blanks);
  add_verification(record, blanks);
  add_search(record, blanks);
  return page(blanks["name"].empty() ? "dovetail" : blanks["name"] + " \u2013 dovetail", "",
              fill(texts::report_html, blanks));
}

void write_report(const std::filesystem::path& file, const RunRecord& record) {
  replace_file(file, report_html(record));
}

}  // namespace dovetail::report
