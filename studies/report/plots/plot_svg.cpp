#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "studies/report/plots/scale.hpp"
#include "studies/report/words/html.hpp"
#include "studies/report/words/units.hpp"

namespace dovetail::report {

namespace {

/// The class of the style sheet.
std::string role_of(const Series& series) {
  constexpr std::array kRoles{"before", "after", "muted", "bad", "one", "two", "three", "four", "five"};
  return kRoles[static_cast<std::size_t>(series.role)];
}

std::string line_classes(const Series& series) {
  constexpr std::array kStrokes{"", "solid", "dashed", "dotted"};
  return "line " + role_of(series) + " " + kStrokes[static_cast<std::size_t>(series.stroke)];
}

/// Where the drawing stands and how values map into it.
struct Frame {
  const Plot& plot;
  Scale x, y;
  double left = 0, right = 0, top = 28, bottom = 0;

  /// Calls `draw` with the index of every point of the series that has a place, and the place.
  template <class Draw>
  void each_point(const Series& series, Draw&& draw) const {
    for (std::size_t i = 0; i < std::min(series.x.size(), series.y.size()); ++i)
      if (drawable(series.x[i], plot.x) && drawable(series.y[i], plot.y)) draw(i, x(series.x[i]), y(series.y[i]));
  }
};

struct PlotBounds {
  Bounds x, y;
};

PlotBounds bounds_of(const Plot& plot) {
  PlotBounds bounds;
  for (const Series& series : plot.series)
    for (std::size_t i = 0; i < std::min(series.x.size(), series.y.size()); ++i) {
      if (!drawable(series.x[i], plot.x) || !drawable(series.y[i], plot.y)) continue;
      bounds.x.add(series.x[i]);
      bounds.y.add(series.y[i]);
    }
  if (bounds.x.empty()) return bounds;
  for (const PlotLevel& level : plot.levels)
    if (drawable(level.y, plot.y)) bounds.y.add(level.y);
  if (plot.hatched_below > 0) bounds.y.add(plot.hatched_below);
  return bounds;
}

double letters(const std::string& text) {
  return static_cast<double>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

std::string line(const Series& series, const Frame& frame) {
  std::string data;
  std::size_t next = 0;  // after the last point drawn
  double last_y = 0;
  frame.each_point(series, [&](std::size_t i, double x, double y) {
    const bool open = i > 0 && i == next;
    if (open && series.steps) data += fmt::format("L{:.1f} {:.1f}", x, last_y);
    data += fmt::format("{}{:.1f} {:.1f}", open ? "L" : "M", x, y);
    next = i + 1;
    last_y = y;
  });
  return fmt::format("<path class=\"{}\" d=\"{}\"/>\n", line_classes(series), data);
}

/// Path of a mark around a place.
std::string mark_path(Mark mark, double x, double y) {
  if (mark == Mark::cross) return fmt::format("M{:.1f} {:.1f}l7 7m0 -7l-7 7", x - 3.5, y - 3.5);
  if (mark == Mark::triangle) return fmt::format("M{:.1f} {:.1f}l4 7h-8Z", x, y - 4.5);
  std::string star = fmt::format("M{:.1f} {:.1f}", x, y - 7);
  for (int i = 1; i < 10; ++i) {
    const double radius = i % 2 == 0 ? 7 : 3, angle = i * 0.6283185307179586;
    star += fmt::format("L{:.1f} {:.1f}", x + radius * std::sin(angle), y - radius * std::cos(angle));
  }
  return star + "Z";
}

std::string mark(const Series& series, double x, double y, const std::string& title) {
  const std::string said = title.empty() ? "" : "<title>" + escape(title) + "</title>", role = role_of(series);
  if (series.mark == Mark::dot || series.mark == Mark::circle)
    return fmt::format("<circle class=\"{} {}\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\">{}</circle>\n",
                       series.mark == Mark::dot ? "dot" : "mark", role, x, y, series.mark == Mark::dot ? 2 : 3, said);
  return fmt::format("<path class=\"mark {}{}\" d=\"{}\">{}</path>\n", role, series.mark == Mark::cross ? " open" : "",
                     mark_path(series.mark, x, y), said);
}

std::string marks(const Series& series, const Frame& frame) {
  const auto with_unit = [](double value, const std::string& unit) {
    return significant(value) + (unit.empty() ? "" : "\u00a0" + unit);
  };
  std::string text;
  frame.each_point(series, [&](std::size_t i, double x, double y) {
    const std::string name = series.mark == Mark::dot && !series.name.empty() ? series.name + ": " : "";
    text += mark(series, x, y,
                 i < series.titles.size() ? series.titles[i]
                                          : name + with_unit(series.x[i], frame.plot.x.unit) + "; " +
                                                with_unit(series.y[i], frame.plot.y.unit));
  });
  return text;
}

std::string grid(const Frame& frame) {
  const auto& [plot, x, y, left, right, top, bottom] = frame;
  std::string text = "<g class=\"grid\">\n";
  for (std::size_t i = 0; i < y.ticks().at.size(); ++i) {
    const double at = y(y.ticks().at[i]);
    text += fmt::format("<path d=\"M{:.1f} {:.1f}H{:.1f}\"/><text x=\"{:.1f}\" y=\"{:.1f}\" class=\"y\">{}</text>\n",
                        left, at, right, left - 7, at + 4, y.ticks().labels[i]);
  }
  double free_from = -1e9;
  for (std::size_t i = 0; i < x.ticks().at.size(); ++i) {
    const double at = x(x.ticks().at[i]), half = 3.6 * letters(x.ticks().labels[i]) + 3;
    text += fmt::format("<path class=\"tick\" d=\"M{:.1f} {:.1f}v5\"/>", at, bottom);
    if (at - half < free_from) continue;
    free_from = at + half;
    text +=
        fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" class=\"x\">{}</text>\n", at, bottom + 19, x.ticks().labels[i]);
  }
  text += fmt::format("<path class=\"base\" d=\"M{:.1f} {:.1f}H{:.1f}\"/>\n", left, bottom, right);
  text += fmt::format("<text x=\"4\" y=\"13\" class=\"title\">{}</text>\n", escape(plot.y.title()));
  return text + fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" class=\"title x-title\">{}</text>\n</g>\n", right,
                            bottom + 38, escape(plot.x.title()));
}

std::string levels(const Frame& frame) {
  std::string text;
  for (const PlotLevel& level : frame.plot.levels)
    if (drawable(level.y, frame.plot.y))
      text += fmt::format(
          "<path class=\"level\" d=\"M{:.1f} {:.1f}H{:.1f}\"/><text class=\"level\" x=\"{:.1f}\" "
          "y=\"{:.1f}\">{}</text>\n",
          frame.left, frame.y(level.y), frame.right, frame.right - 2, frame.y(level.y) - 5, escape(level.name));
  return text;
}

/// Oblique lines over the part of the plot whose values mean nothing.
std::string hatching(const Frame& frame) {
  if (!(frame.plot.hatched_below > 0)) return {};
  constexpr double kSpacing = 7;
  const double top = std::max(frame.y(frame.plot.hatched_below), frame.top), height = frame.bottom - top;
  std::string data;
  // Each rises to the right from the lower edge, or from the left one where it would begin further left.
  const auto lines = static_cast<int>(std::ceil((frame.right - frame.left + height) / kSpacing));
  for (int i = 1; i < lines; ++i) {
    const double x = frame.left - height + kSpacing * i;
    const double from = std::max(x, frame.left), to = std::min(x + height, frame.right);
    data += fmt::format("M{:.1f} {:.1f}L{:.1f} {:.1f}", from, frame.bottom - (from - x), to, frame.bottom - (to - x));
  }
  return fmt::format("<path class=\"hatch\" d=\"{}M{:.1f} {:.1f}H{:.1f}\"/>\n", data, frame.left, top, frame.right);
}

/// Labels of points: above, below or beside, the first place where no other label stands; none when there is no room.
std::string point_labels(const Frame& frame) {
  struct Box {
    double left, top, right, bottom;
    [[nodiscard]] bool meets(const Box& other) const {
      return left < other.right && other.left < right && top < other.bottom && other.top < bottom;
    }
  };
  std::vector<Box> taken;
  std::string text;
  for (const Series& series : frame.plot.series)
    frame.each_point(series, [&](std::size_t i, double x, double y) {
      if (i >= series.labels.size() || series.labels[i].empty()) return;
      const double width = 6.6 * letters(series.labels[i]), height = 11;
      const std::array<std::pair<double, double>, 6> places{{{x + 6, y - 6},
                                                             {x - 6 - width, y - 6},
                                                             {x + 6, y + 14},
                                                             {x - 6 - width, y + 14},
                                                             {x - width / 2, y - 8},
                                                             {x - width / 2, y + 17}}};
      for (const auto& [left, base] : places) {
        const Box box{left, base - height, left + width, base + 1};
        const auto meets = [&](const Box& other) { return box.meets(other); };
        if (box.right > frame.right + 8 || std::any_of(taken.begin(), taken.end(), meets)) continue;
        taken.push_back(box);
        text += fmt::format("<text class=\"point\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n", left, base,
                            escape(series.labels[i]));
        break;
      }
    });
  return text;
}

}  // namespace

bool is_empty(const Plot& plot) {
  return bounds_of(plot).x.empty();
}

std::string plot_svg(const Plot& plot) {
  const PlotBounds bounds = bounds_of(plot);
  if (bounds.x.empty()) return {};
  Frame frame{.plot = plot, .x = {plot.x, bounds.x, 6, true}, .y = {plot.y, bounds.y, 5, false}};
  double widest = 0;
  for (const std::string& label : frame.y.ticks().labels) widest = std::max(widest, letters(label));
  frame.left = 16 + 7.2 * widest;
  frame.right = plot.width - 14.0;
  frame.bottom = plot.height - 46.0;
  frame.x.place(frame.left, frame.right);
  frame.y.place(frame.bottom, frame.top);

  std::string text =
      svg_begin("plot", plot.title, plot.width, plot.height) + grid(frame) + hatching(frame) + levels(frame);
  for (const Series& series : plot.series)
    if (series.stroke != Stroke::none) text += line(series, frame);
  text += point_labels(frame);
  for (const Series& series : plot.series)
    if (series.mark != Mark::none) text += marks(series, frame);
  return text + "</svg>\n";
}

std::string plot_legend(const Plot& plot) {
  std::string text;
  for (const Series& series : plot.series) {
    if (series.name.empty() || (series.stroke == Stroke::none && series.x.empty())) continue;
    text += "<li><svg viewBox=\"0 0 24 12\" aria-hidden=\"true\">" +
            (series.stroke == Stroke::none ? mark(series, 12, 6, "")
                                           : "<path class=\"" + line_classes(series) + "\" d=\"M1 6H23\"/>") +
            "</svg>" + escape(series.name) + "</li>";
  }
  return text.empty() ? "" : "<ul class=\"legend\">" + text + "</ul>\n";
}

}  // namespace dovetail::report
