#include "studies/report/plots/section_drawing.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include "geometry/profile/measures.hpp"
#include "studies/report/words/html.hpp"
#include "studies/report/words/units.hpp"

namespace dovetail::report {

namespace {

using geometry::Chain;
using geometry::Edge;

/// Drawings are in mm, y downwards on the screen.
std::string point(const Eigen::Vector2d& metres) {
  return fmt::format("{:.4f} {:.4f}", 1e3 * metres.x(), -1e3 * metres.y());
}

std::string body(const Chain& chain, const char* classes, const char* title) {
  if (chain.empty()) return {};
  return fmt::format("<path class=\"{}\" d=\"{}\"><title>{}</title></path>\n", classes, outline(chain), title);
}

/// 1, 2 or 5 times a power of ten, at most `largest`.
double round_factor(double largest) {
  const double power = std::pow(10.0, std::floor(std::log10(largest)));
  const double lead = largest / power;
  return (lead >= 5 ? 5 : lead >= 2 ? 2 : 1) * power;
}

double largest_gap(const DesignRecord& design) {
  double largest = 0;
  for (const double gap : design.contact.gap_m)
    if (std::isfinite(gap)) largest = std::max(largest, gap);
  return largest;
}

/// The nodes of a flank that a section shows: of a joint in space the strip next to its middle.
/// @return  their numbers, and how far a skewed slot lies aside there
std::pair<std::vector<std::size_t>, double> shown_nodes(const ContactRecord& contact, std::int64_t flank) {
  constexpr double kSame = 1e-9;
  const bool in_space = contact.across_m.size() == contact.gap_m.size();
  const auto across = [&](std::size_t i) { return in_space ? std::abs(contact.across_m[i]) : 0.0; };
  double middle = std::numeric_limits<double>::infinity(), mean = 0, there = 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < contact.gap_m.size(); ++i)
    if (contact.flank[i] == flank) {
      middle = std::min(middle, across(i));
      mean += contact.x_m[i];
      ++count;
    }
  std::vector<std::size_t> nodes;
  double side = 0;  // one of the two that lie as near
  for (std::size_t i = 0; i < contact.gap_m.size(); ++i) {
    if (contact.flank[i] != flank || across(i) > middle + kSame) continue;
    if (nodes.empty() && in_space) side = contact.across_m[i];
    if (in_space && std::abs(contact.across_m[i] - side) > kSame) continue;
    nodes.push_back(i);
    there += contact.x_m[i];
  }
  if (nodes.empty() || !in_space) return {nodes, 0};
  return {nodes, there / static_cast<double>(nodes.size()) - mean / static_cast<double>(count)};
}

/// The gap of each flank as a band from the nominal flank into the blade.
std::string flank_bands(const DesignRecord& design, double factor) {
  const ContactRecord& contact = design.contact;
  std::string text;
  for (std::size_t flank = 0; flank < contact.flank_names.size(); ++flank) {
    const auto edge = std::find_if(design.profile.blade.begin(), design.profile.blade.end(),
                                   [&](const Edge& e) { return e.name == "flank_" + contact.flank_names[flank]; });
    if (edge == design.profile.blade.end()) continue;
    const Eigen::Vector2d along = edge->tangent(0);
    const Eigen::Vector2d inward(-along.y(), along.x());  // material lies on the left
    std::string surface, form;
    const auto [nodes, aside] = shown_nodes(contact, static_cast<std::int64_t>(flank));
    for (const std::size_t i : nodes) {
      const Eigen::Vector2d at(contact.x_m[i] - aside, contact.y_m[i]);
      const Eigen::Vector2d moved = at + factor * contact.gap_m[i] * inward;
      surface += (surface.empty() ? "M" : "L") + point(at);
      form = "L" + point(moved) + form;
    }
    if (!surface.empty())
      text += fmt::format("<path class=\"form\" d=\"{}{}Z\"><title>gap of the {} flank</title></path>\n", surface, form,
                          escape(contact.flank_names[flank]));
  }
  return text;
}

std::string drawing(const Eigen::AlignedBox2d& box, const std::string& label, const std::string& content) {
  const Eigen::Vector2d size = 1e3 * box.sizes();
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"drawing\" viewBox=\"{:.3f} {:.3f} {:.3f} {:.3f}\" "
      "role=\"img\" aria-label=\"{}\">\n{}</svg>\n",
      1e3 * box.min().x(), -1e3 * box.max().y(), size.x(), size.y(), escape(label), content);
}

/// A bar of 1, 2 or 5 10^k mm in the lower left corner.
std::string scale_bar(const Eigen::AlignedBox2d& box) {
  const Eigen::Vector2d size = 1e3 * box.sizes();
  const double length = round_factor(0.25 * size.x()), text_size = 0.024 * std::max(size.x(), size.y());
  const double x = 1e3 * box.min().x() + 0.03 * size.x(), y = -1e3 * box.min().y() - 0.03 * size.y();
  return fmt::format(
      "<path class=\"bar\" d=\"M{0:.3f} {1:.3f}v{2:.3f}h{3:.3f}v-{2:.3f}\"/><text x=\"{4:.3f}\" y=\"{5:.3f}\" "
      "font-size=\"{6:.3f}\">{7} mm</text>\n",
      x, y - 0.3 * text_size, 0.3 * text_size, length, x + length + 0.5 * text_size, y, text_size,
      significant(length, 1));
}

std::string bodies(const DesignRecord& design, const DesignRecord* before, const std::string& between) {
  std::string text = body(design.profile.disk, "disk", "disk") + body(design.profile.blade, "blade", "blade") + between;
  if (before)
    text += body(before->profile.disk, "ghost", "disk before") + body(before->profile.blade, "ghost", "blade before");
  return text;
}

/// A dimension of the study file, as it is and, where it differs, was: "8.5 \u2192 9 mm".
std::string dimension(const DesignRecord& design, const DesignRecord* before, const std::string& key) {
  const auto value_in = [&](const DesignRecord& of) {
    for (const std::string& name : {"geometry.right." + key, "geometry." + key})
      if (const auto found = of.parameters.find(name); found != of.parameters.end()) return found->second;
    return std::nan("");
  };
  const double now = value_in(design);
  if (!std::isfinite(now)) return {};
  const std::string unit = key_unit(key), text = plain(now, 4);
  const std::string was = before ? plain(value_in(*before), 4) : text;
  return (was == text ? text : was + " \u2192 " + text) + (unit == "\u00b0" ? "" : "\u00a0") + unit;
}

/// Where a main dimension is, and what it is called beside the drawing.
struct Dimension {
  const char *key, *edge, *word;
};
constexpr std::array<Dimension, 6> kDimensions{{{"neck_width_mm", "neck_right", "neck"},
                                                {"neck_fillet_radius_mm", "neck_fillet_right", "R"},
                                                {"flank_length_mm", "flank_right", "flank"},
                                                {"flank_angle_deg", "flank_right", "angle"},
                                                {"root_corner_radius_mm", "root_corner_right", "R"},
                                                {"slot_fillet_radius_mm", "slot_fillet_right", "slot R"}}};

/// Main dimensions beside the joint, each with a line to its place; on the right, where `box` has room for them.
std::string dimensions(const DesignRecord& design, const DesignRecord* before, const Eigen::AlignedBox2d& box,
                       double text_size) {
  std::string text;
  const double x = 1e3 * box.max().x() - 12.5 * text_size, spacing = 1.9 * text_size;
  double y = -1e3 * box.max().y() + 2 * text_size;
  for (const auto& [key, edge, word] : kDimensions) {
    const std::string value = dimension(design, before, key);
    const Chain& chain = std::string_view(edge).starts_with("slot") ? design.profile.disk : design.profile.blade;
    const auto found = std::ranges::find(chain, edge, &Edge::name);
    if (found == chain.end() || value.empty()) continue;
    const Eigen::Vector2d at = found->point(0.5);
    y = std::max(y, -1e3 * at.y() - 2 * text_size);
    text += fmt::format(
        "<path class=\"leader\" d=\"M{0}L{1:.3f} {2:.3f}\"/><circle class=\"leader\" cx=\"{3:.3f}\" cy=\"{4:.3f}\" "
        "r=\"{5:.3f}\"/><text x=\"{6:.3f}\" y=\"{7:.3f}\" font-size=\"{8:.3f}\">{9} {10}</text>\n",
        point(at), x, y, 1e3 * at.x(), -1e3 * at.y(), 0.16 * text_size, x + 0.3 * text_size, y + 0.35 * text_size,
        text_size, word, escape(value));
    y += spacing;
  }
  return "<g class=\"dimension\">" + text + "</g>";
}

/// The same below the drawing, where that is too small for letters.
std::string dimension_list(const DesignRecord& design, const DesignRecord* before) {
  std::string text;
  for (const Dimension& of : kDimensions)
    if (const std::string value = dimension(design, before, of.key); !value.empty())
      text += "<li>" + escape(key_words(of.key) + " " + value) + "</li>";
  return text.empty() ? "" : "<ul class=\"label\">" + text + "</ul>\n";
}

std::string legend(bool before, bool form) {
  std::string text =
      "<li><svg viewBox=\"0 0 24 12\"><path class=\"blade\" d=\"M1 1H23V11H1Z\"/></svg>blade</li>"
      "<li><svg viewBox=\"0 0 24 12\"><path class=\"disk\" d=\"M1 1H23V11H1Z\"/></svg>disk</li>";
  if (before) text += "<li><svg viewBox=\"0 0 24 12\"><path class=\"ghost\" d=\"M1 6H23\"/></svg>before</li>";
  if (form)
    text += "<li><svg viewBox=\"0 0 24 12\"><path class=\"form\" d=\"M1 2H23V10H1Z\"/></svg>form of the flanks</li>";
  return "<ul class=\"legend\" aria-hidden=\"true\">" + text + "</ul>\n";
}

}  // namespace

std::string outline(const geometry::Chain& chain) {
  std::string data = "M" + point(chain.front().start);
  for (const Edge& e : chain) {
    if (e.is_arc())
      data += fmt::format("A{0:.4f} {0:.4f} 0 {1} {2} {3}", 1e3 * e.radius,
                          std::abs(e.sweep) > std::numbers::pi ? 1 : 0, e.sweep > 0 ? 0 : 1, point(e.end));
    else
      data += "L" + point(e.end);
  }
  return data + "Z";
}

Eigen::AlignedBox2d joint_window(const DesignRecord& design) {
  constexpr std::array kShown{"flank_", "neck_fillet", "root_", "slot_", "lobe_", "runout", "mouth"};
  Eigen::AlignedBox2d box;
  for (const Chain* chain : {&design.profile.blade, &design.profile.disk})
    for (const Edge& e : *chain)
      if (std::any_of(kShown.begin(), kShown.end(), [&](const char* part) { return e.name.starts_with(part); }))
        for (const double at : {0.0, 0.5, 1.0}) box.extend(e.point(at));
  if (box.isEmpty()) box = geometry::bounding_box(design.profile.blade);
  const Eigen::Vector2d margin(0.10 * box.sizes().x(), 0.14 * box.sizes().y());
  return {box.min() - margin, box.max() + margin};
}

std::string joint_figure(const DesignRecord& design, const DesignRecord* before) {
  const std::string title = "<h3>Joint</h3>\n";
  if (design.profile.blade.empty() || design.profile.disk.empty())
    return "<figure class=\"nothing\">" + title + "<p>Nothing to show: the section was not built.</p></figure>\n";
  if (before && before->profile.blade.empty()) before = nullptr;
  Eigen::AlignedBox2d box = joint_window(design);
  const double text_size = 0.03e3 * box.sizes().x();
  const double gap = largest_gap(design);
  // Below a nanometre a flank is flat to any machine.
  const bool formed = gap > 1e-9;
  const double factor = formed ? std::max(1.0, round_factor(0.09 * box.sizes().y() / gap)) : 1;
  if (!design.parameters.empty()) box.extend(Eigen::Vector2d(box.max().x() + 13e-3 * text_size, box.max().y()));
  std::string beside = dimensions(design, before, box, text_size) + scale_bar(box);
  if (formed)
    beside += fmt::format(
        "<text class=\"factor\" x=\"{:.3f}\" y=\"{:.3f}\" font-size=\"{:.3f}\" text-anchor=\"end\">form of the "
        "flanks \u00d7\u00a0{}</text>\n",
        1e3 * box.max().x() - text_size, -1e3 * box.min().y() - text_size, text_size, significant(factor, 1));
  std::string caption = "Section of the joint; the blade is pulled upwards.";
  if (formed)
    caption +=
        fmt::format(" The band on the flanks is the material taken off them, drawn {} times as deep (at most {}).",
                    significant(factor, 1), plain(1e6 * gap, 2) + "\u00a0\u00b5m");
  else
    caption += " Both flanks are flat and parallel.";
  return "<figure>" + title + legend(before != nullptr, formed) +
         drawing(box, "Section of the joint",
                 bodies(design, before, formed ? flank_bands(design, factor) : "") + beside) +
         dimension_list(design, before) + "<figcaption>" + escape(caption) + "</figcaption></figure>\n";
}

std::string sector_figure(const DesignRecord& design, const DesignRecord* before) {
  if (design.profile.blade.empty() || design.profile.disk.empty()) return {};
  if (before && before->profile.blade.empty()) before = nullptr;
  Eigen::AlignedBox2d box = geometry::bounding_box(design.profile.blade);
  box.extend(geometry::bounding_box(design.profile.disk));
  const Eigen::Vector2d margin = Eigen::Vector2d::Constant(0.02 * box.sizes().maxCoeff());
  // Below the bore is room for the scale.
  box = Eigen::AlignedBox2d(box.min() - margin - Eigen::Vector2d(0, 2.5 * margin.y()), box.max() + margin);
  return "<figure class=\"sector\"><h3>Sector</h3>\n" +
         drawing(box, "Section of one sector, bore to aerofoil tip", bodies(design, before, "") + scale_bar(box)) +
         "<figcaption>One sector, from the bore to the aerofoil's tip.</figcaption></figure>\n";
}

}  // namespace dovetail::report
