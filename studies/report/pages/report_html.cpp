#include "studies/report/pages/report_html.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/replace_file.hpp"
#include "studies/report/pages/html.hpp"
#include "studies/report/pages/page_style.hpp"
#include "studies/report/pages/report_tables.hpp"
#include "studies/report/pages/report_words.hpp"
#include "studies/report/plots/report_plots.hpp"
#include "studies/report/plots/section_drawing.hpp"
#include "studies/report/plots/svg_plot.hpp"

namespace dovetail::report {

namespace {

std::string figures(const std::vector<Plot>& plots) {
  std::string text = "<div class=\"grid2\">\n";
  for (const Plot& plot : plots) text += plot_figure(plot);
  return text + "</div>\n";
}

/// The designs there are to show: the best with the start behind it, or the start alone.
Comparison designs_of(const RunRecord& record) {
  if (!record.best_design)
    return {.before = nullptr, .after = record.baseline_design ? &*record.baseline_design : nullptr};
  const bool same = record.best == record.baseline;
  return {.before = record.baseline_design && !same ? &*record.baseline_design : nullptr,
          .after = &*record.best_design};
}

std::string opening(const RunRecord& record) {
  const std::string name = record.title.empty() ? record.name : record.title;
  std::string text =
      "<header>\n<h1>" + escape(name) + "</h1>\n<p class=\"lead\">" + escape(headline(record)) + "</p>\n";
  const std::vector<std::string> held = holding(record);
  if (!held.empty())
    text += "<p>The best design is held by " + escape(listed(held)) + ".</p>\n";
  else if (record.best)
    text += "<p>No limit, rule or bound holds the best design: it lies inside of all of them.</p>\n";
  const std::vector<std::string> open = without_bar(record);
  if (!open.empty())
    text +=
        "<p>The best design rests on " + escape(listed(open)) + ", of which no error is known: the mesh does not " +
        "settle it, as at sharp ends of the flanks, where the pressure grows without limit the finer the mesh.</p>\n";
  return text + "<p class=\"soft\">" + escape(ending(record)) + "</p>\n</header>\n";
}

std::string notes(const Comparison& designs) {
  std::string text;
  for (const DesignRecord* design : {designs.before, designs.after}) {
    if (!design) continue;
    for (const std::string& note : design->notes)
      text += "<p class=\"soft\">" +
              std::string(!designs.before            ? ""
                          : design == designs.before ? "Before: "
                                                     : "After: ") +
              escape(note) + "</p>\n";
  }
  return text;
}

std::string shape_section(const Comparison& designs) {
  return "<section><h2>Shape</h2>\n<div class=\"shape\">" + joint_figure(*designs.after, designs.before) +
         sector_figure(*designs.after, designs.before) + "</div>\n</section>\n";
}

std::string contact_section(const Comparison& designs) {
  std::string text =
      "<section><h2>Contact, wear and stress</h2>\n" +
      figures({wear_depth_plot(designs), pressure_plot(designs), gap_plot(designs), fillet_plot(designs)});
  const std::vector<FlankMap> maps = contact_maps(*designs.after);
  if (!maps.empty()) {
    text += "<div class=\"grid2\">\n";
    for (const FlankMap& map : maps) text += flank_map_figure(map);
    text +=
        "</div>\n<p class=\"soft\">Plots along a flank show the line along the slot where the quantity is "
        "largest.</p>\n";
  }
  return text + "</section>\n";
}

std::string vibration_section(const Comparison& designs) {
  return "<section><h2>Vibration</h2>\n" + figures({response_plot(designs), nodal_diameter_plot(*designs.after)}) +
         "</section>\n";
}

std::string history_section(const DesignRecord& design) {
  std::string text = "<section><h2>Wear history</h2>\n";
  if (!design.history || design.history->cycles.empty())
    return text + "<p>No wear history was computed: the asymptotic wear above is found directly.</p>\n</section>\n";
  if (design.history->status != "converged")
    text += "<p>The history ended early (" + escape(design.history->status) + ").</p>\n";
  return text +
         figures({history_plot(design), history_depth_plot(design), history_amplitude_plot(design),
                  history_profile_plot(design)}) +
         "</section>\n";
}

std::string verification_section(const RunRecord& record) {
  if (record.verifications.empty()) return {};
  const VerificationRecord& first = record.verifications.front();
  std::string text = "<section><h2>Verification by the full history</h2>\n<p>" +
                     std::string(record.verifications.size() == 1 ? "The best design was worn cycle by cycle"
                                                                  : "The best designs were worn cycle by cycle") +
                     " until wear came to rest, at finer settings than the search";
  if (first.harmonics > 0)
    text += " (" + std::to_string(first.flank_elements) + " edges per flank, " + std::to_string(first.harmonics) +
            " harmonics, " + std::to_string(first.samples) + " samples)";
  text += ", and computed directly at the same settings. " +
          std::string(first.follow == "resonance" ? "The excitation follows the resonance of the joint as it wears."
                                                  : "The excitation stays at the unworn resonance.") +
          " The history's increments come from the stiffness of the contact, not from the direct answer, and are "
          "extrapolated to none.</p>\n<p class=\"soft\">Columns: the number of the "
          "evaluation and how its answers agree; worn volume at the settings of the search, directly and by the "
          "history at the finer settings, and the "
          "change from direct to history; largest depth of both; largest difference of their profiles by the largest "
          "depth.</p>\n" +
          verification_table(record);
  std::vector<Plot> plots;
  for (const VerificationRecord& v : record.verifications)  // of a design that does not wear there is no profile
    if (v.status != "converged" || std::max({v.search_depth_m, v.direct_depth_m, v.history_depth_m}) > 0)
      plots.push_back(verification_plot(v));
  return text + figures(plots) + "</section>\n";
}

std::string search_section(const RunRecord& record) {
  std::string text = "<section><h2>Search</h2>\n" + problem_list(record) + limit_table(record);
  if (record.evaluations.empty()) return text + "<p>There are no candidates to show.</p>\n</section>\n";
  std::vector<Plot> plots{objective_plot(record)};
  for (Plot& plot : limit_plots(record)) plots.push_back(std::move(plot));
  return text + figures(plots) + "<h3 class=\"above\">Design variables</h3>\n" + variable_table(record) +
         evaluation_table(record) + "</section>\n";
}

constexpr const char* kSection =
    "A plane section of one sector stands for the joint: skewed slots and bending out of the plane are not in it";
constexpr const char* kSector =
    "One sector in space stands for the disk; its frequencies with friction are those of nodal diameter 0";
constexpr const char* kLaws =
    ". Coulomb friction and Archard wear have constant coefficients, temperature and debris are left out, and measured "
    "wear coefficients scatter by about half. The error bars cover mesh, contact nodes, harmonics, samples, reduction "
    "and "
    "the edges of worn zones, but not these laws, so trust differences between designs more than absolute "
    "depths.</p>\n";

std::string limits(const Comparison& designs) {
  const bool space = designs.after && in_space(designs.after->contact);
  return std::string("<p>") + (space ? kSector : kSection) + kLaws;
}

}  // namespace

std::string report_html(const RunRecord& record) {
  const std::string name = record.title.empty() ? record.name : record.title;
  std::string text = page_begin(name.empty() ? "dovetail" : name + " \u2013 dovetail") + opening(record);
  text += "<section><h2>Key figures</h2>\n" + key_figures(record) + "</section>\n";
  const Comparison designs = designs_of(record);
  if (designs.after) {
    text += shape_section(designs) + contact_section(designs) + vibration_section(designs) +
            history_section(*designs.after) + notes(designs);
  } else {
    text +=
        "<section><h2>Designs</h2>\n<p>No design could be computed in full, so there are no shapes or curves to "
        "show.</p>\n</section>\n";
  }
  text += verification_section(record) + search_section(record);
  text += "<section><h2>Limits of the model</h2>\n" + limits(designs) + "</section>\n";
  text += "<section><h2>Provenance</h2>\n" + provenance_section(record) + "</section>\n";
  return text + kPageEnd;
}

void write_report(const std::filesystem::path& file, const RunRecord& record) {
  replace_file(file, report_html(record));
}

}  // namespace dovetail::report
