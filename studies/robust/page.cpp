// The page of the study, its table and its JSON.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "optimizer/problem/problem.hpp"
#include "studies/ready_study/program.hpp"
#include "studies/report/pages/page.hpp"
#include "studies/report/plots/report_plots.hpp"
#include "studies/report/words/table.hpp"
#include "studies/report/words/units.hpp"
#include "studies/robust/results.hpp"
#include "studies/robust/texts.hpp"

namespace dovetail::robust {
namespace {

using report::Plot;
using report::Series;
using report::significant;
using Json = nlohmann::ordered_json;

constexpr report::Unit kVolume{.symbol = "mm\u00b3", .si = 1e-9};
constexpr std::array kRoles{report::Role::before, report::Role::bad, report::Role::after};

/// Least and largest of a number over the cases, as the file has it.
std::string range_of(const studies::Study& study, const std::string& key) {
  double least = std::numeric_limits<double>::infinity(), most = -least;
  for (const optimizer::LoadCase& load : study.problem.cases)
    for (const optimizer::KeyChange& change : load.changes)
      if (change.key == key) {
        least = std::min(least, change.value);
        most = std::max(most, change.value);
      }
  return fmt::format("{:g} and {:g}", least, most);
}

std::string with_bar(const optimizer::Barred& value, const report::Unit& unit) {
  return std::isnan(value.bar) ? significant(value.value / unit.si, 3)
                               : report::with_error(value.value, value.bar, unit);
}

/// By how much less the robust optimum wears than another, in the worst case of both; with bars at least.
std::string less(const Results& r, std::size_t other) {
  const optimizer::Barred one = worst_volume(r.study, r.designs.back().corners),
                          than = worst_volume(r.study, r.designs[other].corners);
  if (!(than.value > 0)) return one.value > 0 ? "more than the other, which does not wear" : "as little: nothing";
  const double part = 1 - one.value / than.value;
  std::string text = fmt::format("{:.0f} % {}", 100 * std::abs(part), part < 0 ? "more" : "less");
  const double at_least = 1 - (one.value + one.bar) / (than.value - than.bar);
  if (at_least > 0 && than.value > than.bar) text += fmt::format(" (with all bars at least {:.0f} %)", 100 * at_least);
  return text;
}

bool all_met(const Results& r, const Design& design) {
  const auto met = [](const LimitLeft& limit) { return limit.met_with_bar(); };
  return std::ranges::all_of(limits(r.study, design.corners), met) &&
         std::ranges::all_of(limits(r.samples, design.samples), [](const LimitLeft& limit) { return limit.met(); });
}

std::string lead(const Results& r) {
  const Design& robust = r.designs.back();
  if (!robust.corners.converged()) return "The robust optimum could not be computed in every case";
  return fmt::format("In its worst case the robust optimum wears {} than the start and {} than the nominal optimum, {}",
                     less(r, 0), less(r, 1),
                     all_met(r, robust)
                         ? fmt::format("with every limit met in every case with its bar and in {} samples besides",
                                       r.samples.problem.cases.size())
                         : "but no design was found that meets every limit in every case: this is the best compromise");
}

std::string design_table(const Results& r) {
  report::Table table{.columns = {{""}}, .rows = {}};
  report::Row worst{.cells = {"worst worn volume (mm\u00b3)"}},
      in_samples{.cells = {"the same in the samples (mm\u00b3)"}};
  for (const Design& design : r.designs) {
    table.columns.push_back({design.name});
    worst.cells.emplace_back(report::Html{with_bar(worst_volume(r.study, design.corners), kVolume)});
    in_samples.cells.emplace_back(significant(worst_volume(r.samples, design.samples).value / kVolume.si, 3));
  }
  table.rows = {std::move(worst), std::move(in_samples)};
  const std::vector<optimizer::DesignVariable>& variables = r.study.problem.space.variables();
  for (std::size_t i = 0; i < variables.size(); ++i) {
    const std::string& key = variables[i].key;
    report::Row row{.cells = {fmt::format("{} ({})", report::key_words(key), report::key_unit(key))}};
    for (const Design& design : r.designs) row.cells.emplace_back(significant(design.x[i], 3));
    table.rows.push_back(std::move(row));
  }
  return table_html(table);
}

std::string share(double value) {
  return std::isnan(value) ? "\u2013" : fmt::format("{:+.1f} %", 100 * value);
}

std::string limit_table(const Results& r) {
  report::Table table{.columns = {{"limit"}}, .rows = {}};
  for (const Design& design : r.designs) table.columns.push_back({design.name});
  const std::vector<std::string> names = optimizer::constraint_names(r.study.problem);
  for (std::size_t i = 0; i < names.size(); ++i) {
    report::Row row{.cells = {report::words(names[i].substr(0, names[i].find(':')))}};
    for (const Design& design : r.designs) {
      const LimitLeft at = limits(r.study, design.corners)[i], in = limits(r.samples, design.samples)[i];
      const std::string bar = std::isnan(at.bar) ? "" : fmt::format(" \u00b1 {:.1f}", 100 * at.bar);
      row.cells.emplace_back(fmt::format("{}{} ({}){}", share(at.value), bar, share(in.value),
                                         at.met_with_bar() && in.met() ? ""
                                         : at.met()                    ? ", open"
                                                                       : ", broken"));
    }
    table.rows.push_back(std::move(row));
  }
  return table_html(table);
}

Plot force_plot(const Results& r) {
  Plot plot{.title = "Worst worn volume over the force",
            .description = "Of all corners of friction and fit at that force. Crosses: a limit is broken.",
            .x = {.label = "largest force at the tip", .unit = "N"},
            .y = {.label = "worst worn volume", .unit = "mm\u00b3", .from_zero = true}};
  Series broken{.name = "a limit is broken",
                .role = report::Role::muted,
                .stroke = report::Stroke::none,
                .mark = report::Mark::cross};
  for (std::size_t d = 0; d < r.designs.size(); ++d) {
    Series series{.name = r.designs[d].name, .role = kRoles[d], .mark = report::Mark::dot};
    for (std::size_t f = 0; f < r.forces_n.size(); ++f) {
      const double volume = worst_volume(r.at_force[f], r.designs[d].forces[f]).value / kVolume.si;
      series.add(r.forces_n[f], volume);
      if (!r.designs[d].forces[f].feasible) broken.add(r.forces_n[f], volume);
    }
    plot.series.push_back(std::move(series));
  }
  plot.series.push_back(std::move(broken));
  return plot;
}

/// Worn volumes of all samples of a study, rising.
std::vector<double> volumes(const studies::Study& study, const optimizer::Evaluation& evaluation) {
  std::vector<double> all;
  for (const optimizer::LoadCase& load : study.problem.cases) {
    const auto found =
        evaluation.responses.find(optimizer::of_case(study.problem.objective.front().response, load.name));
    if (found != evaluation.responses.end()) all.push_back(found->second / kVolume.si);
  }
  std::ranges::sort(all);
  return all;
}

Plot sample_plot(const Results& r) {
  Plot plot{.title = fmt::format("In {} samples", r.samples.problem.cases.size()),
            .description = "Share of the samples that wear less.",
            .x = {.label = "worn volume", .unit = "mm\u00b3", .from_zero = true},
            .y = {.label = "share", .unit = "%", .from_zero = true}};
  for (std::size_t d = 0; d < r.designs.size(); ++d) {
    Series series{.name = r.designs[d].name, .role = kRoles[d], .steps = true};
    const std::vector<double> all = volumes(r.samples, r.designs[d].samples);
    for (std::size_t i = 0; i < all.size(); ++i)
      series.add(all[i], 100.0 * static_cast<double>(i + 1) / static_cast<double>(all.size()));
    plot.series.push_back(std::move(series));
  }
  return plot;
}

/// What the robust optimum wears more at the largest force of the study than a newton below it, and what breaks first.
std::string cost(const Results& r) {
  const Design& robust = r.designs.back();
  std::string text;
  for (std::size_t f = 1; f < r.forces_n.size(); ++f) {
    const double before = worst_volume(r.at_force[f - 1], robust.forces[f - 1]).value / kVolume.si;
    const double here = worst_volume(r.at_force[f], robust.forces[f]).value / kVolume.si;
    text += fmt::format("{}{:g} N to {:g} N: {} mm\u00b3", text.empty() ? "The robust optimum, from " : ", ",
                        r.forces_n[f - 1], r.forces_n[f], significant(here - before, 2));
  }
  for (std::size_t f = 0; f < r.forces_n.size(); ++f)
    for (const LimitLeft& limit : limits(r.at_force[f], robust.forces[f]))
      if (!limit.met())
        return text + fmt::format(" more. At {:g} N the limit of the {} is broken, by {}.", r.forces_n[f],
                                  report::words(limit.name.substr(0, limit.name.find(':'))), share(limit.value));
  return text + " more. No limit is broken up to there.";
}

/// What stands in the way where no design holds over all of it.
std::string in_the_way(const Results& r) {
  std::vector<std::string> broken;
  for (const LimitLeft& limit : limits(r.study, r.designs.back().corners))
    if (!limit.met_with_bar())
      broken.push_back(
          fmt::format("the {} ({})", report::words(limit.name.substr(0, limit.name.find(':'))), share(limit.value)));
  return broken.empty() ? ""
                        : fmt::format("What stands in the way of a design that holds: {}.", fmt::join(broken, ", "));
}

std::string ends(const Results& r) {
  std::string text;
  for (const Design& design : r.designs)
    if (!design.end.empty()) text += fmt::format("{}{}: {}", text.empty() ? "" : "; ", design.name, design.end);
  return text + ".";
}

std::string page_html(const Results& r) {
  return ready_study::page("A robust joint \u2013 dovetail", "", texts::page_html,
                           {{"lead", lead(r)},

                            {"friction", range_of(r.study, "contact.friction")},
                            {"force", range_of(r.study, "loading.tip_force_n") + " N"},
                            {"fit", range_of(r.study, "geometry.flank_mismatch_um") + " \u00b5m"},
                            {"designs", design_table(r)},
                            {"limits", limit_table(r)},
                            {"samples", std::to_string(r.samples.problem.cases.size())},
                            {"ends", ends(r)},
                            {"over_force", report::figures_html({force_plot(r), sample_plot(r)})},
                            {"cost", cost(r)},
                            {"way", in_the_way(r)}},
                           r.made);
}

Json json_of(const Results& r) {
  Json json{{"quick", r.made.quick}, {"seconds", r.made.seconds}, {"designs", Json::array()}};
  for (const Design& design : r.designs) {
    Json one{{"name", design.name}, {"keeps_limits", all_met(r, design)}};
    const std::vector<optimizer::DesignVariable>& variables = r.study.problem.space.variables();
    for (std::size_t i = 0; i < variables.size(); ++i) one["parameters"][variables[i].key] = design.x[i];
    const optimizer::Barred worst = worst_volume(r.study, design.corners);
    one["worst_volume_m3"] = worst.value;
    one["worst_volume_bar_m3"] = worst.bar;
    one["worst_volume_in_samples_m3"] = worst_volume(r.samples, design.samples).value;
    for (std::size_t f = 0; f < r.forces_n.size(); ++f)
      one["over_force"].push_back({{"force_n", r.forces_n[f]},
                                   {"worst_volume_m3", worst_volume(r.at_force[f], design.forces[f]).value},
                                   {"limits_met", design.forces[f].feasible}});
    for (const LimitLeft& limit : limits(r.study, design.corners))
      one["limits"][limit.name] = {{"value", limit.value}, {"bar", limit.bar}};
    for (const LimitLeft& limit : limits(r.samples, design.samples)) one["limits_in_samples"][limit.name] = limit.value;
    json["designs"].push_back(std::move(one));
  }
  return json;
}

std::string designs_csv(const Results& r) {
  std::string text = "design,worst_volume_mm3,worst_volume_in_samples_mm3";
  for (const optimizer::DesignVariable& variable : r.study.problem.space.variables()) text += "," + variable.key;
  text += "\n";
  for (const Design& design : r.designs) {
    text += fmt::format("{},{:.6g},{:.6g}", design.name, worst_volume(r.study, design.corners).value / kVolume.si,
                        worst_volume(r.samples, design.samples).value / kVolume.si);
    for (const double value : design.x) text += fmt::format(",{:.9g}", value);
    text += "\n";
  }
  return text;
}

}  // namespace

void write(const std::string& folder, const Results& results) {
  ready_study::write(folder, {{"designs.csv", designs_csv(results)},
                              {"results.json", json_of(results).dump() + "\n"},
                              {"report.html", page_html(results)}});
}

}  // namespace dovetail::robust
