#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace dovetail::report {

/// What a series stands for; the page's style sheet gives each a colour in light and dark.
/// `one` to `five` tell kinds of one rank from each other.
enum class Role { before, after, muted, bad, one, two, three, four, five };

enum class Stroke { none, solid, dashed, dotted };
enum class Mark { none, dot, circle, cross, triangle, star };

/// The least and the largest of values; empty before the first.
struct Bounds {
  double lower = std::numeric_limits<double>::infinity(), upper = -std::numeric_limits<double>::infinity();
  void add(double value);
  [[nodiscard]] bool empty() const { return !(lower <= upper); }
};

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
  std::optional<double> shade = {};      ///< 0 to 1, place in an order, as of states in time; tells it from its like
  std::vector<std::size_t> candidates = {};  ///< of a run, that the points are: chosen in one figure, shown in all

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
  Bounds range = {};       ///< what is shown, lines beyond it cut; empty: all values

  /// "position along the flank (mm)"
  [[nodiscard]] std::string title() const { return unit.empty() ? label : label + " (" + unit + ")"; }
};

struct Plot {
  std::string title = {};        ///< above the plot, and its accessible name
  std::string description = {};  ///< one sentence below it
  PlotAxis x = {}, y = {};
  std::vector<Series> series = {};
  std::vector<PlotLevel> levels = {};
  double shaded_below = 0;   ///< y, on a logarithmic axis: values below mean nothing; 0: all do
  std::string at_zero = {};  ///< a sentence in place of the drawing when all y are zero; empty: it is drawn
};

/// Nothing finite to draw (a logarithmic axis: nothing positive), or nothing but zeros where these are a sentence.
[[nodiscard]] bool is_empty(const Plot& plot);

/// The plot as data that the script of the page draws, with its title for readers that see no drawing.
[[nodiscard]] std::string chart_html(const Plot& plot);

}  // namespace dovetail::report
