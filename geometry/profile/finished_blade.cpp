#include <algorithm>
#include <cmath>

#include "geometry/profile/chain.hpp"
#include "geometry/profile/flank_form.hpp"

namespace dovetail::geometry {

namespace {

using Eigen::Vector2d;

constexpr FinishedParams kFinished = {};

/// A blade flank with its form, travelled like the nominal edge.
class FinishedFlank {
 public:
  FinishedFlank(const Edge& flank, const FlankForm& form, bool from_root)
      : flank_(flank), form_(form), from_root_(from_root) {}

  [[nodiscard]] double gap(double fraction) const { return form_.gap(from_root_ ? 1 - fraction : fraction); }
  [[nodiscard]] Vector2d point(double fraction) const {
    return flank_.point(fraction) - gap(fraction) * outward(flank_, 0);
  }
  [[nodiscard]] Chain edges() const {
    Chain chain;
    std::array<double, 6> borders = form_.pieces();
    if (from_root_) {
      std::reverse(borders.begin(), borders.end());
      for (double& border : borders) border = 1 - border;
    }
    double from = 0;
    for (double border : borders)
      if ((border - from) * flank_.length() > kFinished.shortest) {
        append(chain, from, border == borders.back() ? 1.0 : border, 0);
        from = border;
      }
    for (std::size_t i = 0; i < chain.size(); ++i) chain[i].name = flank_.name + "_" + std::to_string(i + 1);
    return chain;
  }

 private:
  void append(Chain& chain, double from, double to, int depth) const {
    const double middle = (from + to) / 2;
    Edge fit = line({}, point(from), point(to));
    if ((point(middle) - fit.point(0.5)).norm() > kFinished.straight)
      fit = arc_through({}, point(from), point(middle), point(to));
    if (depth < kFinished.halvings && error(fit, from, to) > kFinished.error / 2) {
      append(chain, from, middle, depth + 1);
      append(chain, middle, to, depth + 1);
    } else {
      chain.push_back(fit);
    }
  }

  /// Largest distance of the form from the edge that stands for it.
  [[nodiscard]] double error(const Edge& fit, double from, double to) const {
    double largest = 0;
    for (int i = 1; i < kFinished.places; ++i) {
      const Vector2d at = point(from + (to - from) * i / kFinished.places);
      const double distance =
          fit.is_arc() ? (at - fit.center).norm() - fit.radius : (at - fit.start).dot(outward(fit, 0));
      largest = std::max(largest, std::abs(distance));
    }
    return largest;
  }

  const Edge& flank_;
  const FlankForm& form_;
  bool from_root_;
};

void finish(Chain& blade, const std::string& name, const FlankForm& form, bool from_root) {
  const auto at = std::find_if(blade.begin(), blade.end(), [&](const Edge& e) { return e.name == name; });
  const std::size_t index = static_cast<std::size_t>(at - blade.begin());
  const Edge flank = *at;
  const FinishedFlank finished(flank, form, from_root);
  Edge& before = blade[(index + blade.size() - 1) % blade.size()];
  before = redrawn(before, false, finished.point(0), finished.gap(0));
  Edge& after = blade[(index + 1) % blade.size()];
  after = redrawn(after, true, finished.point(1), finished.gap(1));
  const Chain edges = finished.edges();
  blade.insert(blade.erase(at), edges.begin(), edges.end());
}

}  // namespace

Vector2d outward(const Edge& e, double fraction) {
  const Vector2d tangent = e.tangent(fraction);
  return {tangent.y(), -tangent.x()};
}

Edge redrawn(const Edge& e, bool at_start, const Vector2d& moved, double gap) {
  if (gap == 0) return e;
  return arc_through(e.name, at_start ? moved : e.start, e.point(0.5) - gap / 2 * outward(e, 0.5),
                     at_start ? e.end : moved);
}

Chain finished_blade(const ProfileParameters& parameters) {
  Chain blade = build_profile(parameters).blade;
  for (std::size_t f = 0; f < kFlanks.size(); ++f)
    finish(blade, "flank_" + std::string(kFlanks[f].name), FlankForm(parameters.flanks[f]), !kFlanks[f].left);
  return blade;
}

}  // namespace dovetail::geometry
