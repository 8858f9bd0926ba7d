#include "studies/report/plots/stress_contours.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "studies/report/plots/section_drawing.hpp"
#include "studies/report/words/html.hpp"
#include "studies/report/words/units.hpp"

namespace dovetail::report {

namespace {

constexpr std::size_t kBands = 8;
constexpr double kMillimetre = 1e-3, kMegapascal = 1e6;

struct Corner {
  Eigen::Vector2d at;
  double value;
};

/// What is left of a polygon where `sign * value >= sign * level`, values between corners being linear.
std::vector<Corner> clipped(const std::vector<Corner>& polygon, double level, double sign) {
  std::vector<Corner> kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Corner& a = polygon[i];
    const Corner& b = polygon[(i + 1) % polygon.size()];
    const double da = sign * (a.value - level), db = sign * (b.value - level);
    if (da >= 0) kept.push_back(a);
    if ((da < 0) != (db < 0)) kept.push_back({a.at + da / (da - db) * (b.at - a.at), level});
  }
  return kept;
}

bool has_stress(const DesignRecord& design) {
  const FieldRecord& fields = design.fields;
  return fields.mesh.element_count() > 0 && fields.mesh.kind == fem::ElementKind::triangle6 &&
         fields.von_mises_pa.size() == static_cast<std::size_t>(fields.mesh.node_count()) &&
         !design.profile.blade.empty();
}

std::vector<Corner> corners(const FieldRecord& fields, int element) {
  std::vector<Corner> triangle;
  for (const int node : fields.mesh.element(element).first(3))
    triangle.push_back({fields.mesh.nodes.col(node), fields.von_mises_pa[static_cast<std::size_t>(node)]});
  return triangle;
}

bool within(const Eigen::AlignedBox2d& box, const std::vector<Corner>& triangle) {
  return std::ranges::any_of(triangle, [&](const Corner& corner) { return box.contains(corner.at); });
}

/// The stress that one in two hundred nodes of the window exceeds: at sharp ends of the flanks it has no bound.
double nearly_largest(const DesignRecord& design, const Eigen::AlignedBox2d& box) {
  std::vector<double> values;
  const FieldRecord& fields = design.fields;
  for (int i = 0; i < fields.mesh.node_count(); ++i)
    if (box.contains(Eigen::Vector2d(fields.mesh.nodes.col(i))))
      values.push_back(fields.von_mises_pa[static_cast<std::size_t>(i)]);
  if (values.empty()) return 0;
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(0.995 * static_cast<double>(values.size() - 1));
  std::ranges::nth_element(values, at);
  return *at;
}

std::string path(const std::vector<Corner>& polygon) {
  std::string data;
  for (const Corner& corner : polygon)
    data += fmt::format("{}{:.2f} {:.2f}", data.empty() ? "M" : "L", corner.at.x() / kMillimetre,
                        -corner.at.y() / kMillimetre);
  return data + "Z";
}

/// Millimetres from the middle of the window: few digits are enough.
std::string bands(const FieldRecord& fields, const Eigen::AlignedBox2d& box, double step) {
  std::array<std::string, kBands> data;
  for (int e = 0; e < fields.mesh.element_count(); ++e) {
    std::vector<Corner> triangle = corners(fields, e);
    if (!within(box, triangle)) continue;
    for (Corner& corner : triangle) corner.at -= box.center();
    const auto [least, most] = std::ranges::minmax(triangle, {}, &Corner::value);
    for (std::size_t band = 0; band < kBands; ++band) {
      const double lower = step * static_cast<double>(band), upper = lower + step;
      const bool last = band + 1 == kBands;
      if (most.value < lower || (!last && least.value >= upper)) continue;
      std::vector<Corner> part = band == 0 ? triangle : clipped(triangle, lower, 1);
      if (!last) part = clipped(part, upper, -1);
      if (part.size() > 2) data[band] += path(part);
    }
  }
  std::string text;
  for (std::size_t band = 0; band < kBands; ++band)
    if (!data[band].empty())
      text += fmt::format("<path class=\"band{}\" d=\"{}\"><title>{} to {}\u00a0MPa</title></path>\n", band, data[band],
                          plain(step * static_cast<double>(band) / kMegapascal, 4),
                          band + 1 == kBands ? "more" : plain(step * static_cast<double>(band + 1) / kMegapascal, 4));
  return text;
}

std::string legend(double step) {
  std::string text;
  for (std::size_t band = 0; band < kBands; ++band)
    text += fmt::format(
        "<li><svg viewBox=\"0 0 24 12\"><path class=\"band{}\" d=\"M1 1H23V11H1Z\"/></svg>{}{}</li>", band,
        plain(step * static_cast<double>(band) / kMegapascal, 4),
        band + 1 == kBands ? " MPa and more" : "\u2013" + plain(step * static_cast<double>(band + 1) / kMegapascal, 4));
  return "<ul class=\"legend\" aria-hidden=\"true\">" + text + "</ul>\n";
}

std::string figure(const DesignRecord& design, const Eigen::AlignedBox2d& box, double step, const std::string& title) {
  const Eigen::Vector2d size = box.sizes() / kMillimetre;
  return fmt::format(
      "<figure><h3>{0}</h3>\n{1}<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"drawing contours\" viewBox=\"{2:.2f} "
      "{3:.2f} {4:.2f} {5:.2f}\" role=\"img\" aria-label=\"{0}\">\n{6}</svg>\n<figcaption>Von Mises stress under the "
      "centrifugal load alone, before any vibration.</figcaption></figure>\n",
      escape(title), legend(step), -size.x() / 2, -size.y() / 2, size.x(), size.y(), bands(design.fields, box, step));
}

}  // namespace

std::string stress_figures(const Comparison& designs) {
  std::vector<std::pair<const DesignRecord*, std::string>> shown;
  if (designs.before && has_stress(*designs.before)) shown.emplace_back(designs.before, "Stress after spin-up, before");
  if (designs.after && has_stress(*designs.after))
    shown.emplace_back(designs.after, designs.before ? "Stress after spin-up, after" : "Stress after spin-up");
  if (shown.empty()) return {};
  Eigen::AlignedBox2d box;
  for (const auto& [design, title] : shown) box.extend(joint_window(*design));
  double most = 0;
  for (const auto& [design, title] : shown) most = std::max(most, nearly_largest(*design, box));
  if (!(most > 0)) return {};
  // A round step whose bands reach about there.
  const double rough = most / (kBands - 0.5), power = std::pow(10.0, std::floor(std::log10(rough)));
  double step = 10 * power;
  for (const double factor : {5.0, 4.0, 3.0, 2.5, 2.0, 1.5, 1.0})
    if (factor * power >= rough) step = factor * power;
  std::string text;
  for (const auto& [design, title] : shown) text += figure(*design, box, step, title);
  return "<div class=\"grid2\">\n" + text + "</div>\n";
}

}  // namespace dovetail::report
