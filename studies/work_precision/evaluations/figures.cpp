#include "studies/work_precision/evaluations/figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <utility>

#include "studies/report/plots/plot.hpp"
#include "studies/report/words/units.hpp"

namespace dovetail::work_precision {
namespace {

using report::Mark;
using report::Plot;
using report::Role;
using report::Series;
using report::Stroke;

constexpr double kRounding = 1e-9;  // errors that are none
constexpr double kDeep = 10;        // so far below what is resolved, and no further, errors are drawn

struct Look {
  WholeSweep key;
  const char* name;
  Role role;
  Stroke stroke;
};
constexpr std::array<Look, 7> kKnobs{
    {{WholeSweep::mesh, "mesh", Role::one, Stroke::solid},
     {WholeSweep::beside, "mesh beside the flanks", Role::one, Stroke::dashed},
     {WholeSweep::harmonics, "harmonics", Role::two, Stroke::solid},
     {WholeSweep::samples, "samples", Role::three, Stroke::solid},
     {WholeSweep::modes, "modes", Role::four, Stroke::solid},
     {WholeSweep::resonance_tolerance, "tolerance of the resonance", Role::five, Stroke::solid},
     {WholeSweep::tolerance, "of the residual", Role::five, Stroke::dashed}}};

/// What is drawn for one response.
class Drawing {
 public:
  Drawing(const WholeDiagram& diagram, std::string response)
      : diagram_(diagram),
        response_(std::move(response)),
        agreement_(error_of(diagram.reference.check, response_)),
        lowest_(std::max(kRounding, agreement_ > 0 ? agreement_ / kDeep : 0)) {
    for (const WholePoint* point : diagram.points()) {
      x_.add(point->run.seconds);
      if (point->run.converged() && !std::isnan(error_of(*point, response_))) y_.add(height(*point));
    }
    if (agreement_ > lowest_) y_.add(agreement_);
  }

  Plot plot() {
    Plot plot{.title = response_ == kWorst ? "worst of the responses that count" : report::words(response_),
              .x = {.label = "evaluation", .unit = "s", .logarithmic = true, .tight = true},
              .y = {.label = "relative error", .logarithmic = true}};
    plot.title[0] = static_cast<char>(std::toupper(plot.title[0]));
    if (agreement_ > kRounding) plot.shaded_below = agreement_;
    // Their labels come first where there is little room, their marks last and so on top.
    Series labels = choices();
    labels.name.clear();
    labels.mark = Mark::none;
    plot.series.push_back(std::move(labels));
    plot.series.push_back(combinations());
    for (const Look& look : kKnobs) plot.series.push_back(knob(look));
    plot.series.push_back(steps());
    plot.series.push_back(paper());
    plot.series.push_back(failed());
    Series stars = choices();
    stars.labels.clear();
    plot.series.push_back(std::move(stars));
    return plot;
  }

 private:
  [[nodiscard]] double height(const WholePoint& point) const { return std::max(error_of(point, response_), lowest_); }

  void add(Series& series, const WholePoint& point, const std::string& label) const {
    if (!point.run.converged()) return;
    series.add(point.run.seconds, height(point));
    series.labels.push_back(label);
    series.titles.push_back(described(point));
  }

  [[nodiscard]] std::string described(const WholePoint& point) const {
    const std::string words = setting_words(point.run.setting, diagram_.edges_of_file);
    return fmt::format(
        "{}: {:.3g} s, {}{}", point.label, point.run.seconds,
        point.run.converged() ? fmt::format("error {:.2g}", error_of(point, response_)) : point.run.status,
        words == point.label ? "" : "; " + words);
  }

  [[nodiscard]] Series knob(const Look& look) const {
    Series series{.name = look.name, .role = look.role, .stroke = look.stroke, .mark = Mark::dot};
    for (const WholeLine& line : diagram_.lines)
      if (line.key == look.key)
        for (const WholePoint& point : line.points) add(series, point, "");
    return series;
  }

  [[nodiscard]] Series combinations() const {
    Series series{.name = "combinations", .role = Role::muted, .stroke = Stroke::none, .mark = Mark::dot, .titles = {}};
    for (const WholeLine& line : diagram_.lines)
      if (line.key == WholeSweep::combinations || line.key == WholeSweep::descent)
        for (const WholePoint& point : line.points) add(series, point, "");
    return series;
  }

  [[nodiscard]] Series steps() const {
    Series series{.name = "front: least seconds for an error", .role = Role::after, .steps = true};
    for (const WholePoint* point : front(diagram_, response_)) series.add(point->run.seconds, height(*point));
    if (!series.x.empty()) series.add(x_.upper, series.y.back());
    return series;
  }

  [[nodiscard]] Series paper() const {
    Series series{.name = "the paper's settings", .role = Role::bad, .stroke = Stroke::none, .mark = Mark::triangle};
    for (const WholeLine& line : diagram_.lines)
      if (line.key == WholeSweep::paper)
        for (const WholePoint& point : line.points) add(series, point, point.run.in_steps ? "in steps" : "paper");
    return series;
  }

  [[nodiscard]] Series choices() const {
    Series series{.name = "automatic choice", .role = Role::after, .stroke = Stroke::none, .mark = Mark::star};
    for (const AutomaticChoice& choice : diagram_.automatic) add(series, choice.point, choice.point.label);
    return series;
  }

  /// Above all errors.
  [[nodiscard]] Series failed() const {
    Series series{.name = "failed", .role = Role::bad, .stroke = Stroke::none, .mark = Mark::cross};
    for (const WholePoint* point : diagram_.points()) {
      if (point->run.converged()) continue;
      series.add(point->run.seconds, y_.upper > 0 ? 2 * y_.upper : 1);
      series.titles.push_back(described(*point));
    }
    return series;
  }

  const WholeDiagram& diagram_;
  std::string response_;
  double agreement_, lowest_;
  report::Bounds x_, y_;
};

}  // namespace

Plot response_plot(const WholeDiagram& diagram, const std::string& response) {
  return Drawing(diagram, response).plot();
}

bool errs(const WholeDiagram& diagram, const std::string& response) {
  return std::ranges::any_of(diagram.points(),
                             [&](const WholePoint* point) { return error_of(*point, response) > kRounding; });
}

}  // namespace dovetail::work_precision
