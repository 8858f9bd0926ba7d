#include "geometry/profile/flank_form.hpp"

#include <algorithm>
#include <cmath>

namespace dovetail::geometry {

namespace {

/// What both ends of a flank lose besides mismatch and crown: depth (1 - distance/reach)^2 within reach, a fraction of
/// the flank's length, of the end.
struct EndLoss {
  double reach, depth;
};

std::array<EndLoss, 2> end_losses(const FlankParameters& p) {
  return {EndLoss{p.relief_depth != 0 ? p.relief_length / p.length : 0, p.relief_depth},
          EndLoss{rounded_length(p.edge_radius) / p.length, EdgeParams{}.drop}};
}

}  // namespace

double rounded_length(double edge_radius) {
  return std::sqrt(2 * edge_radius * EdgeParams{}.drop);
}

FlankForm::FlankForm(const FlankParameters& parameters) : parameters_(parameters) {
  pieces_ = {0, 0, 0, 0, 0, 1};
  std::size_t border = 1;
  for (const EndLoss& loss : end_losses(parameters)) {
    pieces_[border++] = std::clamp(loss.reach, 0.0, 1.0);
    pieces_[border++] = std::clamp(1 - loss.reach, 0.0, 1.0);
  }
  std::sort(pieces_.begin(), pieces_.end());

  // Each piece is a parabola: its smallest value is at an end or at its vertex.
  shift_ = raw(0);
  const auto consider = [&](double s) { shift_ = std::min(shift_, raw(s)); };
  for (std::size_t i = 0; i + 1 < pieces_.size(); ++i) {
    const double from = pieces_[i];
    const double to = pieces_[i + 1];
    const double rise_from = raw((from + to) / 2) - raw(from);
    const double rise_to = raw(to) - raw((from + to) / 2);
    const double bend = rise_to - rise_from;
    if (bend > 0) {
      const double vertex = from + (to - from) * (0.25 - rise_from / (2 * bend));
      if (vertex > from && vertex < to) consider(vertex);
    }
    consider(to);
  }
}

double FlankForm::raw(double s) const {
  const FlankParameters& p = parameters_;
  double gap = p.mismatch * s + p.crown * (2 * s - 1) * (2 * s - 1);
  for (const EndLoss& loss : end_losses(p))
    for (double distance : {s, 1 - s})
      if (distance < loss.reach) gap += loss.depth * std::pow(1 - distance / loss.reach, 2);
  return gap;
}

double FlankForm::gap(double s) const {
  return std::max(0.0, raw(s) - shift_);
}

double FlankForm::slope(double s) const {
  const FlankParameters& p = parameters_;
  double slope = p.mismatch + 4 * p.crown * (2 * s - 1);
  for (const EndLoss& loss : end_losses(p)) {
    if (s < loss.reach) slope -= 2 * loss.depth / loss.reach * (1 - s / loss.reach);
    if (1 - s < loss.reach) slope += 2 * loss.depth / loss.reach * (1 - (1 - s) / loss.reach);
  }
  return slope;
}

}  // namespace dovetail::geometry
