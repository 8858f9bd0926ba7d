#include <fmt/format.h>

#include "studies/program/engine/response_curve.hpp"

namespace dovetail::studies {
namespace {

std::string cell(const std::string& text) {
  return fmt::format(" {:>16}", text);
}
std::string cell(double value) {
  return fmt::format(" {:>16.8g}", value);
}

/// A change of -inf..inf per cent of something: what a reader compares.
std::string bar(double value) {
  return std::isfinite(value) ? fmt::format(" {:>16.2g}", value) : cell("unknown");
}

}  // namespace

std::string response_table(const ResponseCurve& curve) {
  const AnalysisChoice& choice = curve.choice;
  std::string text = fmt::format("{:>16}", "frequency_hz") + cell("status");
  for (const std::string& name : curve.output_names) {
    text += cell(name);
    if (choice.error_bars) text += cell("+-");
    if (choice.penalty_sensitivity) text += cell("d ln/d ln eps");
    if (choice.traction_bounds) text += cell("least") + cell("most");
  }
  if (choice.stability) text += cell("stability") + cell("modulus");
  text += "\n";
  for (std::size_t i = 0; i < curve.states.size(); ++i) {
    const steady::State& state = curve.states[i];
    const bool turn = curve.branch && curve.branch->points[i].is_turn;
    text += fmt::format("{:>16.9g}", curve.frequency_hz[i]) +
            cell(turn ? std::string("turning point") : std::string(to_string(state.status)));
    if (state.status == Status::converged) {
      const PointAnalysis none;
      const PointAnalysis& point = choice.any() ? curve.analyses[i] : none;
      for (Eigen::Index k = 0; k < state.amplitudes.size(); ++k) {
        text += cell(state.amplitudes[k]);
        if (point.bars) text += bar(point.bars->total.amplitudes(k));
        if (point.sensitivity) text += bar(point.sensitivity->slope.amplitudes(k));
        if (point.tractions) {
          const tractions::TractionBounds& bounds = point.tractions->amplitudes[static_cast<std::size_t>(k)];
          text += cell(bounds.minimum.value) + cell(bounds.maximum.value);
        }
      }
      if (point.stability) {
        text += cell(std::string(to_string(point.stability->verdict)));
        text += point.stability->multipliers.size() > 0 ? cell(point.stability->largest_modulus) : cell("-");
      }
    }
    text += "\n";
  }
  return text;
}

}  // namespace dovetail::studies
