#include "studies/report/plots/stress_contours.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "studies/report/plots/section_drawing.hpp"
#include "studies/report/plots/stress_cut.hpp"
#include "studies/report/words/html.hpp"
#include "studies/report/words/units.hpp"

namespace dovetail::report {

namespace {

constexpr std::size_t kBands = 8;
constexpr double kMillimetre = 1e-3, kMegapascal = 1e6;

using Corner = StressCut::Corner;

struct Shown {
  const DesignRecord* design;
  std::string title;
  StressCut cut;
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

/// The peak in the fillets, or the stress that one in two hundred corners of the window exceeds where that is less: at
/// sharp ends of the flanks it has no bound.
double nearly_largest(const StressCut& cut, const Eigen::AlignedBox2d& box) {
  std::vector<double> values;
  for (const auto& triangle : cut.triangles)
    for (const Corner& corner : triangle)
      if (box.contains(corner.at)) values.push_back(corner.value);
  if (values.empty()) return 0;
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(0.995 * static_cast<double>(values.size() - 1));
  std::ranges::nth_element(values, at);
  return cut.peak ? std::min(*at, cut.peak->value) : *at;
}

std::string path(const std::vector<Corner>& polygon) {
  std::string data;
  for (const Corner& corner : polygon)
    data += fmt::format("{}{:.2f} {:.2f}", data.empty() ? "M" : "L", corner.at.x() / kMillimetre,
                        -corner.at.y() / kMillimetre);
  return data + "Z";
}

/// Millimetres from the middle of the window: few digits are enough.
std::string bands(const StressCut& cut, const Eigen::AlignedBox2d& box, double step) {
  std::array<std::string, kBands> data;
  for (const auto& corners : cut.triangles) {
    std::vector<Corner> triangle(corners.begin(), corners.end());
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

/// A bar of colours with the values between them.
std::string legend(double step) {
  std::string text;
  for (std::size_t band = 0; band < kBands; ++band)
    text += fmt::format(
        "<li><svg viewBox=\"0 0 24 12\" preserveAspectRatio=\"none\"><path class=\"band{}\" d=\"M0 0H24V12H0Z\"/></svg>"
        "{}{}</li>",
        band, plain(step * static_cast<double>(band) / kMegapascal, 4), band + 1 == kBands ? " +" : "");
  return "<p class=\"upwards\">von Mises stress (MPa)</p><ul class=\"scale\" aria-hidden=\"true\">" + text + "</ul>\n";
}

/// A ring around the place, with its value on the side where there is room.
std::string peak_mark(const Corner& peak, const Eigen::AlignedBox2d& box) {
  const double size = 0.045 * box.sizes().x() / kMillimetre;
  const Eigen::Vector2d at = (peak.at - box.center()) / kMillimetre;
  const bool left = at.x() > 0;
  return fmt::format(
      "<circle class=\"ring halo\" cx=\"{0:.2f}\" cy=\"{1:.2f}\" r=\"{2:.2f}\"/><circle class=\"ring\" cx=\"{0:.2f}\" "
      "cy=\"{1:.2f}\" r=\"{2:.2f}\"/><text x=\"{3:.2f}\" y=\"{4:.2f}\" font-size=\"{5:.2f}\" "
      "text-anchor=\"{6}\">{7}\u00a0MPa</text>\n",
      at.x(), -at.y(), 0.4 * size, at.x() + (left ? -0.7 : 0.7) * size, -at.y() + 0.35 * size, size,
      left ? "end" : "start", significant(peak.value / kMegapascal, 3));
}

std::string caption(const StressCut& cut, const geometry::Profile& profile) {
  std::string text = "Under the centrifugal load alone, before any vibration.";
  if (cut.height)
    text +=
        fmt::format(" Cut across the slot {}\u00a0mm along the axis from its middle, where a fillet is loaded most.",
                    plain(*cut.height / kMillimetre, 3));
  if (cut.peak)
    text += fmt::format(
        " Ringed: the largest stress in the fillets, {}\u00a0MPa ({}). At a sharp end of a flank it depends on "
        "the "
        "mesh.",
        significant(cut.peak->value / kMegapascal, 3), cut.peak_place(profile));
  return text;
}

/// Blade and disk around their stresses.
std::string outlines(const geometry::Profile& profile, const Eigen::AlignedBox2d& box) {
  return fmt::format("<g transform=\"translate({:.3f} {:.3f})\"><path class=\"outline\" d=\"{}{}\"/></g>\n",
                     -box.center().x() / kMillimetre, box.center().y() / kMillimetre, outline(profile.disk),
                     outline(profile.blade));
}

std::string figure(const Shown& shown, const Eigen::AlignedBox2d& box, double step) {
  const Eigen::Vector2d size = box.sizes() / kMillimetre;
  return fmt::format(
      "<figure><h3>{0}</h3>\n{1}<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"drawing contours\" viewBox=\"{2:.2f} "
      "{3:.2f} {4:.2f} {5:.2f}\" role=\"img\" "
      "aria-label=\"{0}\">\n{6}{7}{8}</svg>\n<figcaption>{9}</figcaption></figure>\n",
      escape(shown.title), legend(step), -size.x() / 2, -size.y() / 2, size.x(), size.y(), bands(shown.cut, box, step),
      outlines(shown.design->profile, box), shown.cut.peak ? peak_mark(*shown.cut.peak, box) : "",
      escape(caption(shown.cut, shown.design->profile)));
}

}  // namespace

std::string stress_figures(const Comparison& designs) {
  Eigen::AlignedBox2d box;
  for (const DesignRecord* design : {designs.before, designs.after})
    if (design && !design->profile.blade.empty()) box.extend(joint_window(*design));
  std::vector<Shown> all;
  for (const auto& [design, when] : {std::pair{designs.before, ", before"}, {designs.after, ", after"}})
    if (std::optional<StressCut> cut =
            design ? worst_cut(*design, box, all.empty() ? nullptr : &all.front().cut) : std::nullopt)
      all.push_back({design, std::string("Stress after spin-up") + (designs.before ? when : ""), *std::move(cut)});
  double most = 0;
  for (const Shown& shown : all) most = std::max(most, nearly_largest(shown.cut, box));
  if (!(most > 0)) return {};
  // A round step whose bands reach about there.
  const double rough = most / (kBands - 0.5), power = std::pow(10.0, std::floor(std::log10(rough)));
  double step = 10 * power;
  for (const double factor : {8.0, 6.0, 5.0, 4.0, 3.0, 2.5, 2.0, 1.5, 1.0})
    if (factor * power >= rough) step = factor * power;
  std::string text;
  for (const Shown& shown : all) text += figure(shown, box, step);
  return "<div class=\"grid2\">\n" + text + "</div>\n";
}

}  // namespace dovetail::report
