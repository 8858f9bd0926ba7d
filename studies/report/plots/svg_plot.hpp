#pragma once

#include <optional>
#include <string>
#include <vector>

namespace dovetail::report {

/// What a line or marker stands for; the page's style sheet gives each a colour in light and dark.
enum class Role { before, after, muted, bad };

enum class Stroke { solid, dashed, dotted };
enum class Shape { circle, cross, triangle, star };

/// One line of a plot; a NaN interrupts it.
struct PlotLine {
  std::string name = {};  ///< in the legend; empty: not listed
  std::vector<double> x = {}, y = {};
  std::vector<std::string> labels = {};  ///< beside the points, where there is room; empty: none
  Role role = Role::after;
  Stroke stroke = Stroke::solid;
  bool dots = false;    ///< a small dot at each point, with its values as tooltip
  bool steps = false;   ///< constant until the next point
  bool filled = false;  ///< light area down to the axis
};

/// Separate markers.
struct PlotPoints {
  std::string name = {};
  std::vector<double> x = {}, y = {};
  std::vector<std::string> titles = {};  ///< tooltips; empty: the values
  Role role = Role::after;
  Shape shape = Shape::circle;
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
  bool whole = false;                            ///< counts something: ticks at whole numbers only
  bool tight = false;                            ///< logarithmic: ends at the ticks next to the values, not at decades
  bool from_zero = false;                        ///< the range includes 0
  std::optional<double> lower = {}, upper = {};  ///< fixed ends of the range
};

struct Plot {
  std::string title = {};        ///< above the plot, and its accessible name
  std::string description = {};  ///< one sentence below it
  PlotAxis x = {}, y = {};
  std::vector<PlotLine> lines = {};
  std::vector<PlotPoints> points = {};
  std::vector<PlotLevel> levels = {};
  int width = 520, height = 320;  ///< of the drawing's coordinates; the page scales it
};

/// Nothing finite to draw (a logarithmic axis: nothing positive).
[[nodiscard]] bool is_empty(const Plot& plot);

/// The plot as one inline <svg>, of role img with its title; colours are the style sheet's (plot_style()).
[[nodiscard]] std::string plot_svg(const Plot& plot);

/// What lines and markers mean, as a list; empty without names.
[[nodiscard]] std::string plot_legend(const Plot& plot);

/// <figure>: title, legend, drawing, description, and the numbers as a table under <details>. An empty plot becomes a
/// sentence.
[[nodiscard]] std::string plot_figure(const Plot& plot);

/// Rules and colour variables, light and dark, for the figures of a page.
[[nodiscard]] std::string plot_style();

}  // namespace dovetail::report
