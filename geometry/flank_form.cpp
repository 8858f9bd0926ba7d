#include "geometry/flank_form.hpp"

#include <algorithm>
#include <cmath>

namespace dovetail::geometry {

namespace {

/// The relieved fraction of the flank at each end.
double relieved(const FlankParameters& p) {
  return p.relief_depth != 0 ? p.relief_length / p.length : 0;
}

}  // namespace

FlankForm::FlankForm(const FlankParameters& parameters) : parameters_(parameters) {
  const double border = std::clamp(relieved(parameters), 0.0, 1.0);
  pieces_ = {0, std::min(border, 1 - border), std::max(border, 1 - border), 1};

  // Each piece is a parabola: its smallest value is at an end or at its vertex.
  double smallest = raw(0);
  const auto consider = [&](double s) {
    if (raw(s) < smallest) {
      smallest = raw(s);
      touching_ = s;
    }
  };
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
  shift_ = smallest;
}

double FlankForm::raw(double s) const {
  const FlankParameters& p = parameters_;
  double gap = p.mismatch * s + p.crown * (2 * s - 1) * (2 * s - 1);
  const double border = relieved(p);
  for (double distance : {s, 1 - s})
    if (distance < border) gap += p.relief_depth * std::pow(1 - distance / border, 2);
  return gap;
}

double FlankForm::gap(double s) const {
  return std::max(0.0, raw(s) - shift_);
}

double FlankForm::slope(double s) const {
  const FlankParameters& p = parameters_;
  double slope = p.mismatch + 4 * p.crown * (2 * s - 1);
  const double border = relieved(p);
  if (s < border) slope -= 2 * p.relief_depth * (1 - s / border) / border;
  if (1 - s < border) slope += 2 * p.relief_depth * (1 - (1 - s) / border) / border;
  return slope;
}

GapGradient FlankForm::raw_gradient(double s) const {
  const FlankParameters& p = parameters_;
  GapGradient by{.mismatch = s, .crown = (2 * s - 1) * (2 * s - 1)};
  const double border = p.relief_length / p.length;
  for (double distance : {s, 1 - s}) {
    if (distance >= border) continue;
    const double left = 1 - distance / border;
    by.relief_depth += left * left;
    by.relief_length += 2 * p.relief_depth * left * distance / border / p.relief_length;
    by.length -= 2 * p.relief_depth * left * distance / border / p.length;
  }
  return by;
}

GapGradient FlankForm::gradient(double s) const {
  const GapGradient at = raw_gradient(s);
  const GapGradient touch = raw_gradient(touching_);
  return {.mismatch = at.mismatch - touch.mismatch,
          .crown = at.crown - touch.crown,
          .relief_length = at.relief_length - touch.relief_length,
          .relief_depth = at.relief_depth - touch.relief_depth,
          .length = at.length - touch.length};
}

}  // namespace dovetail::geometry
