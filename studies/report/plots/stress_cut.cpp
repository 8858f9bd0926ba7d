#include "studies/report/plots/stress_cut.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace dovetail::report {

namespace {

using Corner = StressCut::Corner;

/// A height of nodes, and how far a skewed slot lies aside there.
struct Level {
  double height = 0, aside = 0;
};

/// Those of the nodes on the flanks, rising; the middle one is the section.
std::vector<Level> levels_of(const FieldRecord& fields) {
  constexpr double kSame = 1e-9;
  std::vector<std::pair<double, double>> places;  // height, x
  for (const std::int64_t node : fields.flank_nodes)
    places.emplace_back(fields.mesh.nodes(2, node), fields.mesh.nodes(0, node));
  std::ranges::sort(places);
  std::vector<Level> levels;
  std::size_t first = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    levels.resize(std::max<std::size_t>(levels.size(), 1));
    if (places[i].first - places[first].first > kSame) {
      levels.emplace_back();
      first = i;
    }
    Level& level = levels.back();
    level.height = places[first].first;
    level.aside += (places[i].second - level.aside) / static_cast<double>(i - first + 1);
  }
  if (!levels.empty()) {
    const double middle = levels[levels.size() / 2].aside;
    for (Level& level : levels) level.aside -= middle;
  }
  return levels;
}

/// On a fillet of the profile: meshes have their nodes on the true curve.
bool on_fillet(const Eigen::Vector2d& at, const geometry::Profile& profile) {
  constexpr double kSame = 1e-7, kTurn = 1e-6;
  for (const geometry::Chain* chain : {&profile.blade, &profile.disk})
    for (const geometry::Edge& edge : *chain) {
      if (!edge.is_arc() || edge.name.find("fillet") == std::string::npos) continue;
      const Eigen::Vector2d from = edge.start - edge.center, to = at - edge.center;
      if (std::abs(to.norm() - edge.radius) > kSame) continue;
      const double turn =
          std::copysign(1.0, edge.sweep) * std::atan2(from.x() * to.y() - from.y() * to.x(), from.dot(to));
      if (turn > -kTurn && turn < std::abs(edge.sweep) + kTurn) return true;
    }
  return false;
}

/// Six nodes in the order of a plane triangle.
using Face = std::span<const int>;

/// Cuts one after another, with what they need of a design.
class Cutter {
 public:
  Cutter(const DesignRecord& design, const Eigen::AlignedBox2d& window)
      : fields_(design.fields),
        profile_(design.profile),
        window_(window),
        in_space_(fields_.mesh.kind == fem::ElementKind::wedge18),
        on_flank_(static_cast<std::size_t>(fields_.mesh.node_count()), false) {
    for (const std::int64_t node : fields_.flank_nodes) on_flank_[static_cast<std::size_t>(node)] = true;
  }

  [[nodiscard]] StressCut cut(const Level& level, bool uppermost) const {
    StressCut result;
    if (in_space_) result.height = level.height;
    for (int e = 0; e < fields_.mesh.element_count(); ++e) {
      const Face element = fields_.mesh.element(e);
      // The upper face of an element is the lower one of the next.
      for (std::size_t face = 0; face < (!in_space_ ? 1U : uppermost ? 3U : 2U); ++face)
        add(element.subspan(6 * face, 6), level, result);
    }
    return result;
  }

 private:
  [[nodiscard]] Corner corner(int node, const Level& level) const {
    return {.at = Eigen::Vector2d(fields_.mesh.nodes(0, node) - level.aside, fields_.mesh.nodes(1, node)),
            .value = fields_.von_mises_pa[static_cast<std::size_t>(node)]};
  }

  void add(Face face, const Level& level, StressCut& cut) const {
    constexpr double kSame = 1e-8;
    if (in_space_ && std::ranges::any_of(
                         face, [&](int node) { return std::abs(fields_.mesh.nodes(2, node) - level.height) > kSame; }))
      return;
    std::array<Corner, 6> corners;
    std::ranges::transform(face, corners.begin(), [&](int node) { return corner(node, level); });
    if (std::none_of(corners.begin(), corners.begin() + 3, [&](const Corner& c) { return window_.contains(c.at); }))
      return;
    // Meshes in space are coarse, and have values in the middles of their edges too.
    constexpr std::array<std::array<std::size_t, 3>, 4> kQuarters{{{0, 3, 5}, {3, 1, 4}, {5, 4, 2}, {3, 4, 5}}};
    if (in_space_)
      for (const auto& [a, b, c] : kQuarters) cut.triangles.push_back({corners[a], corners[b], corners[c]});
    else
      cut.triangles.push_back({corners[0], corners[1], corners[2]});
    for (std::size_t i = 0; i < 6; ++i)
      if (const Corner& c = corners[i]; (!cut.peak || c.value > cut.peak->value) &&
                                        !on_flank_[static_cast<std::size_t>(face[i])] && on_fillet(c.at, profile_))
        cut.peak = c;
  }

  const FieldRecord& fields_;
  const geometry::Profile& profile_;
  const Eigen::AlignedBox2d& window_;
  bool in_space_;
  std::vector<bool> on_flank_;
};

}  // namespace

std::string StressCut::peak_place(const geometry::Profile& profile) const {
  if (!peak) return {};
  std::string place;
  double nearest = std::numeric_limits<double>::infinity();
  for (const auto& [body, chain] : {std::pair{"blade", &profile.blade}, {"disk", &profile.disk}})
    for (const geometry::Edge& edge : *chain)
      for (int i = 0; i <= 16; ++i)
        if (const double distance = (edge.point(i / 16.0) - peak->at).norm(); distance < nearest) {
          nearest = distance;
          place = std::string(body) + ", " + edge.name;
        }
  std::ranges::replace(place, '_', ' ');
  return place;
}

std::optional<StressCut> worst_cut(const DesignRecord& design, const Eigen::AlignedBox2d& window,
                                   const StressCut* beside) {
  const FieldRecord& fields = design.fields;
  if (fields.mesh.element_count() == 0 || design.profile.blade.empty() ||
      fields.von_mises_pa.size() != static_cast<std::size_t>(fields.mesh.node_count()))
    return {};
  const Cutter cutter(design, window);
  if (fields.mesh.dimensions() == 2) return cutter.cut({}, false);
  constexpr double kNearly = 0.95;
  std::vector<StressCut> cuts;
  double most = 0;
  const std::vector<Level> levels = levels_of(fields);
  for (const Level& level : levels) {
    StressCut cut = cutter.cut(level, &level == &levels.back());
    if (!cut.peak) continue;
    most = std::max(most, cut.peak->value);
    cuts.push_back(std::move(cut));
  }
  const auto away = [&](const StressCut& cut) {
    return beside && beside->height ? std::abs(*cut.height - *beside->height) : most - cut.peak->value;
  };
  StressCut* chosen = nullptr;
  for (StressCut& cut : cuts)
    if (cut.peak->value >= kNearly * most && (chosen == nullptr || away(cut) < away(*chosen))) chosen = &cut;
  if (chosen == nullptr) return {};
  return std::move(*chosen);
}

}  // namespace dovetail::report
