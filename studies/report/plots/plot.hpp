#pragma once

#include <string>
#include <vector>

namespace dovetail::report {

/// What a series stands for; the page's style sheet gives each a colour in light and dark.
/// `one` to `five` tell kinds of one rank from each other.
enum class Role { before, after, muted, bad, one, two, three, four, five };

enum class Stroke { none, solid, dashed, dotted };
enum class Mark { none, dot, circle, cross, triangle, star };

/// Values of a plot, joined by a line, marked one by one, or both; a NaN interrupts the line.
struct Series {
  std::string name = {};  ///< in the legend; empty: not listed
  std::vector<double> x = {}, y = {};
  Role role = Role::after;
  Stroke stroke = Stroke::solid;
  Mark mark = Mark::none;
  bool steps = false;                    ///< the line is constant until the next point
  std::vector<std::string> titles = {};  ///< tooltips of the marks; empty: the values
  std::vector<std::string> labels = {};  ///< beside the points, where there is room; empty: none

  void add(double at, double value) {
    x.push_back(at);
    y.push_back(value);
  }
};

/// A horizontal line across the plot, for limits.
struct PlotLevel {
  std::string name = {};
  double y = 0;
};

struct PlotAxis {
  std::string label = {};  ///< "position along the flank"
  std::string unit = {};   ///< "mm"; empty: none
  bool logarithmic = false;
  bool whole = false;      ///< counts something: ticks at whole numbers only
  bool tight = false;      ///< logarithmic: ends at the ticks next to the values, not at decades
  bool from_zero = false;  ///< the range includes 0

  /// "position along the flank (mm)"
  [[nodiscard]] std::string title() const { return unit.empty() ? label : label + " (" + unit + ")"; }
};

struct Plot {
  std::string title = {};        ///< above the plot, and its accessible name
  std::string description = {};  ///< one sentence below it
  PlotAxis x = {}, y = {};
  std::vector<Series> series = {};
  std::vector<PlotLevel> levels = {};
  double hatched_below = 0;       ///< y, on a logarithmic axis: values below mean nothing; 0: all do
  int width = 520, height = 320;  ///< of the drawing's coordinates; the page scales it
};

/// Nothing finite to draw (a logarithmic axis: nothing positive).
[[nodiscard]] bool is_empty(const Plot& plot);

/// The plot as one inline <svg>, of role img with its title; colours are those of plot.css.
[[nodiscard]] std::string plot_svg(const Plot& plot);

/// What the series mean, as a list; empty without names.
[[nodiscard]] std::string plot_legend(const Plot& plot);

}  // namespace dovetail::report
