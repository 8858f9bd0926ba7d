#include "studies/report/plots/svg_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "studies/report/pages/html.hpp"
#include "studies/report/pages/units.hpp"
#include "studies/report/plots/ticks.hpp"

namespace dovetail::report {

namespace {

constexpr std::array<const char*, 4> kRoleClass{"before", "after", "muted", "bad"};
constexpr std::array<const char*, 3> kStrokeClass{"solid", "dashed", "dotted"};

bool drawable(double value, const PlotAxis& axis) {
  return std::isfinite(value) && (!axis.logarithmic || value > 0);
}

/// One axis: range, ticks and the map to pixels.
class Scale {
 public:
  Scale(const PlotAxis& axis, double lower, double upper, int count, bool tight) : logarithmic_(axis.logarithmic) {
    if (axis.from_zero && !logarithmic_) {
      lower = std::min(lower, 0.0);
      upper = std::max(upper, 0.0);
    }
    lower = axis.lower.value_or(lower);
    upper = std::max(axis.upper.value_or(upper), lower);
    ticks_ = logarithmic_ ? logarithmic_ticks(lower, upper) : linear_ticks(lower, upper, count, tight);
    if (axis.whole && !logarithmic_) keep_whole_ticks();
    if (axis.tight && logarithmic_) end_at_ticks(lower, upper);
  }
  void place(double from, double to) {
    from_ = from;
    to_ = to;
  }
  [[nodiscard]] double operator()(double value) const {
    const auto position = [&](double v) { return logarithmic_ ? std::log10(v) : v; };
    return from_ + (to_ - from_) * (position(value) - position(ticks_.lower)) /
                       (position(ticks_.upper) - position(ticks_.lower));
  }
  [[nodiscard]] const Ticks& ticks() const { return ticks_; }

 private:
  void keep_whole_ticks() {
    Ticks kept{.lower = ticks_.lower, .upper = ticks_.upper, .at = {}, .labels = {}};
    for (const double at : ticks_.at) {
      if (std::abs(at - std::round(at)) > 1e-9) continue;
      kept.at.push_back(at);
      kept.labels.push_back(plain(at, 12));
    }
    ticks_ = std::move(kept);
  }

  void end_at_ticks(double lower, double upper) {
    std::size_t first = 0, last = ticks_.at.size();
    while (first + 2 < last && ticks_.at[first + 1] <= lower) ++first;
    while (first + 2 < last && ticks_.at[last - 2] >= upper) --last;
    if (last == 0) return;
    const auto keep = [&](auto& list) {
      list = {list.begin() + static_cast<std::ptrdiff_t>(first), list.begin() + static_cast<std::ptrdiff_t>(last)};
    };
    keep(ticks_.at);
    keep(ticks_.labels);
    ticks_.lower = ticks_.at.front();
    ticks_.upper = ticks_.at.back();
  }

  bool logarithmic_;
  Ticks ticks_;
  double from_ = 0, to_ = 1;
};

struct Bounds {
  double lower = std::numeric_limits<double>::infinity(), upper = -std::numeric_limits<double>::infinity();
  void add(double value) {
    lower = std::min(lower, value);
    upper = std::max(upper, value);
  }
  [[nodiscard]] bool empty() const { return !(lower <= upper); }
};

struct PlotBounds {
  Bounds x, y;
};

PlotBounds bounds_of(const Plot& plot) {
  PlotBounds bounds;
  const auto add = [&](const std::vector<double>& x, const std::vector<double>& y) {
    for (std::size_t i = 0; i < std::min(x.size(), y.size()); ++i) {
      if (!drawable(x[i], plot.x) || !drawable(y[i], plot.y)) continue;
      bounds.x.add(x[i]);
      bounds.y.add(y[i]);
    }
  };
  for (const PlotLine& line : plot.lines) add(line.x, line.y);
  for (const PlotPoints& points : plot.points) add(points.x, points.y);
  if (bounds.x.empty()) return bounds;
  for (const PlotLevel& level : plot.levels)
    if (drawable(level.y, plot.y)) bounds.y.add(level.y);
  return bounds;
}

std::size_t letters(const std::string& text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

std::string axis_title(const PlotAxis& axis) {
  return axis.unit.empty() ? axis.label : axis.label + " (" + axis.unit + ")";
}

std::string values_title(const Plot& plot, double x, double y) {
  const auto with_unit = [](double value, const std::string& unit) {
    return significant(value) + (unit.empty() ? "" : "\u00a0" + unit);
  };
  return with_unit(x, plot.x.unit) + "; " + with_unit(y, plot.y.unit);
}

std::string path_of(const PlotLine& line, const Plot& plot, const Scale& x, const Scale& y) {
  std::string data;
  std::string filled;
  bool open = false;
  double first_x = 0, last_x = 0, last_y = 0;
  const double floor = y(y.ticks().lower);
  const auto close = [&] {
    if (open && line.filled) filled += fmt::format("L{:.1f} {:.1f}L{:.1f} {:.1f}Z", last_x, floor, first_x, floor);
    open = false;
  };
  for (std::size_t i = 0; i < std::min(line.x.size(), line.y.size()); ++i) {
    if (!drawable(line.x[i], plot.x) || !drawable(line.y[i], plot.y)) {
      close();
      continue;
    }
    const double px = x(line.x[i]), py = y(line.y[i]);
    std::string step;
    if (open && line.steps) step = fmt::format("L{:.1f} {:.1f}", px, last_y);
    step += fmt::format("{}{:.1f} {:.1f}", open ? "L" : "M", px, py);
    if (!open) first_x = px;
    data += step;
    filled += step;
    open = true;
    last_x = px;
    last_y = py;
  }
  close();
  const std::string role = kRoleClass[static_cast<std::size_t>(line.role)];
  std::string text;
  if (line.filled) text += fmt::format("<path class=\"area {}\" d=\"{}\"/>\n", role, filled);
  return text + fmt::format("<path class=\"line {} {}\" d=\"{}\"/>\n", role,
                            kStrokeClass[static_cast<std::size_t>(line.stroke)], data);
}

std::string marker(Shape shape, double x, double y, const char* role, const std::string& title) {
  std::string path;
  switch (shape) {
    case Shape::circle:
      return fmt::format("<circle class=\"mark {}\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3\"><title>{}</title></circle>\n",
                         role, x, y, escape(title));
    case Shape::cross:
      path = fmt::format("M{:.1f} {:.1f}l7 7m0 -7l-7 7", x - 3.5, y - 3.5);
      break;
    case Shape::triangle:
      path = fmt::format("M{:.1f} {:.1f}l4 7h-8Z", x, y - 4.5);
      break;
    case Shape::star:
      path = fmt::format("M{:.1f} {:.1f}", x, y - 7);
      for (int i = 1; i < 10; ++i) {
        const double radius = i % 2 == 0 ? 7 : 3, angle = i * 0.6283185307179586;
        path += fmt::format("L{:.1f} {:.1f}", x + radius * std::sin(angle), y - radius * std::cos(angle));
      }
      path += "Z";
      break;
  }
  return fmt::format("<path class=\"mark {}{}\" d=\"{}\"><title>{}</title></path>\n", role,
                     shape == Shape::cross ? " open" : "", path, escape(title));
}

std::string grid(const Plot& plot, const Scale& x, const Scale& y, double left, double right, double bottom) {
  std::string text = "<g class=\"grid\">\n";
  for (std::size_t i = 0; i < y.ticks().at.size(); ++i) {
    const double at = y(y.ticks().at[i]);
    text += fmt::format("<path d=\"M{:.1f} {:.1f}H{:.1f}\"/><text x=\"{:.1f}\" y=\"{:.1f}\" class=\"y\">{}</text>\n",
                        left, at, right, left - 7, at + 4, y.ticks().labels[i]);
  }
  double free_from = -1e9;
  for (std::size_t i = 0; i < x.ticks().at.size(); ++i) {
    const double at = x(x.ticks().at[i]);
    const double half = 3.6 * static_cast<double>(letters(x.ticks().labels[i])) + 3;
    text += fmt::format("<path class=\"tick\" d=\"M{:.1f} {:.1f}v5\"/>", at, bottom);
    if (at - half < free_from) continue;
    free_from = at + half;
    text +=
        fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" class=\"x\">{}</text>\n", at, bottom + 19, x.ticks().labels[i]);
  }
  text += fmt::format("<path class=\"base\" d=\"M{:.1f} {:.1f}H{:.1f}\"/>\n", left, bottom, right);
  text += fmt::format("<text x=\"4\" y=\"13\" class=\"title\">{}</text>\n", escape(axis_title(plot.y)));
  text += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" class=\"title x-title\">{}</text>\n", right, bottom + 38,
                      escape(axis_title(plot.x)));
  return text + "</g>\n";
}

/// Labels of points: above, below or beside, the first place where no other label stands; none when there is no room.
std::string point_labels(const Plot& plot, const Scale& x, const Scale& y, double right) {
  struct Box {
    double left, top, right, bottom;
    [[nodiscard]] bool meets(const Box& other) const {
      return left < other.right && other.left < right && top < other.bottom && other.top < bottom;
    }
  };
  std::vector<Box> taken;
  std::string text;
  for (const PlotLine& line : plot.lines)
    for (std::size_t i = 0; i < std::min({line.x.size(), line.y.size(), line.labels.size()}); ++i) {
      if (!drawable(line.x[i], plot.x) || !drawable(line.y[i], plot.y) || line.labels[i].empty()) continue;
      const double px = x(line.x[i]), py = y(line.y[i]);
      const double width = 6.6 * static_cast<double>(letters(line.labels[i])), height = 11;
      const std::array<std::pair<double, double>, 6> places{{{px + 6, py - 6},
                                                             {px - 6 - width, py - 6},
                                                             {px + 6, py + 14},
                                                             {px - 6 - width, py + 14},
                                                             {px - width / 2, py - 8},
                                                             {px - width / 2, py + 17}}};
      for (const auto& [left, base] : places) {
        const Box box{left, base - height, left + width, base + 1};
        const auto meets = [&](const Box& other) { return box.meets(other); };
        if (box.right > right + 8 || std::any_of(taken.begin(), taken.end(), meets)) continue;
        taken.push_back(box);
        text += fmt::format("<text class=\"point\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n", left, base,
                            escape(line.labels[i]));
        break;
      }
    }
  return text;
}

}  // namespace

bool is_empty(const Plot& plot) {
  return bounds_of(plot).x.empty();
}

std::string plot_svg(const Plot& plot) {
  const PlotBounds bounds = bounds_of(plot);
  if (bounds.x.empty()) return {};
  Scale x(plot.x, bounds.x.lower, bounds.x.upper, 6, true);
  Scale y(plot.y, bounds.y.lower, bounds.y.upper, 5, false);

  std::size_t widest = 0;
  for (const std::string& label : y.ticks().labels) widest = std::max(widest, letters(label));
  const double left = 16 + 7.2 * static_cast<double>(widest), right = plot.width - 14.0;
  const double top = 28, bottom = plot.height - 46.0;
  x.place(left, right);
  y.place(bottom, top);

  std::string text = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"plot\" viewBox=\"0 0 {} {}\" role=\"img\" "
      "aria-label=\"{}\">\n",
      plot.width, plot.height, escape(plot.title));
  text += grid(plot, x, y, left, right, bottom);
  for (const PlotLevel& level : plot.levels) {
    if (!drawable(level.y, plot.y)) continue;
    text += fmt::format(
        "<path class=\"level\" d=\"M{:.1f} {:.1f}H{:.1f}\"/><text class=\"level\" x=\"{:.1f}\" "
        "y=\"{:.1f}\">{}</text>\n",
        left, y(level.y), right, right - 2, y(level.y) - 5, escape(level.name));
  }
  for (const PlotLine& line : plot.lines) text += path_of(line, plot, x, y);
  text += point_labels(plot, x, y, right);
  for (const PlotLine& line : plot.lines) {
    if (!line.dots) continue;
    for (std::size_t i = 0; i < std::min(line.x.size(), line.y.size()); ++i) {
      if (!drawable(line.x[i], plot.x) || !drawable(line.y[i], plot.y)) continue;
      text +=
          fmt::format("<circle class=\"dot {}\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"2\"><title>{}</title></circle>\n",
                      kRoleClass[static_cast<std::size_t>(line.role)], x(line.x[i]), y(line.y[i]),
                      escape((line.name.empty() ? "" : line.name + ": ") + values_title(plot, line.x[i], line.y[i])));
    }
  }
  for (const PlotPoints& points : plot.points) {
    for (std::size_t i = 0; i < std::min(points.x.size(), points.y.size()); ++i) {
      if (!drawable(points.x[i], plot.x) || !drawable(points.y[i], plot.y)) continue;
      text += marker(points.shape, x(points.x[i]), y(points.y[i]), kRoleClass[static_cast<std::size_t>(points.role)],
                     i < points.titles.size() ? points.titles[i] : values_title(plot, points.x[i], points.y[i]));
    }
  }
  return text + "</svg>\n";
}

}  // namespace dovetail::report
