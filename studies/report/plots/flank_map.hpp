#pragma once

#include <string>
#include <vector>

#include "studies/report/words/units.hpp"

namespace dovetail::report {

/// One bearing flank seen from its blade: values at contact nodes, which stand in strips across the slot; every strip
/// has places of its own.
struct FlankPanel {
  std::string name = {};            ///< "left flank"
  std::vector<double> along = {};   ///< [n] m, along the flank from its neck side
  std::vector<double> across = {};  ///< [n] m, along the slot
  std::vector<double> values = {};  ///< [n] SI; NaN: not known
};

/// A quantity over the flanks of a joint in space, side by side with one scale of colours from 0 to the largest value.
struct FlankMap {
  std::string title = {};
  std::string description = {};  ///< a sentence below
  std::string quantity = {};     ///< "pressure"
  std::string at_zero = {};  ///< a sentence in place of the drawing when no value is above zero; empty: a general one
  Unit unit = {};
  std::vector<FlankPanel> panels = {};
  double full_scale = 0;  ///< SI, of the darkest colour when it is above the largest value: for maps to be compared

  /// "pressure (MPa)"
  [[nodiscard]] std::string value_title() const {
    return unit.symbol.empty() ? quantity : quantity + " (" + unit.symbol + ")";
  }
};

/// No finite value, or none above zero.
[[nodiscard]] bool is_empty(const FlankMap& map);

/// A cell around each contact node, as data that the script of the page draws.
[[nodiscard]] std::string chart_html(const FlankMap& map);

}  // namespace dovetail::report
