#pragma once

#include <string>

#include "studies/paper_sequence/compute.hpp"

namespace dovetail::paper_sequence {

/// What differs between a plane section and a sector in space: words of the page, and how much is computed.
struct SceneWords {
  std::string title;       ///< of the page, after "Dynamics and fretting wear of a bladed disk"
  std::string column;      ///< heading over what is found here
  std::string where;       ///< the findings hold ...
  std::string such;        ///< the sequence is repeated in ...
  std::string difference;  ///< from the reference, of this scene alone
  std::string families;    ///< of modes, which ones the scene has not
  ComputeOptions options;
  int quick_flank_elements, quick_aerofoil_elements;
};
[[nodiscard]] const SceneWords& scene_words(const optimizer::Scene& scene);

/// How the pressures of the preload lie on the flanks.
[[nodiscard]] std::string pressure_text(const Results& results);
/// What the frequencies over nodal diameters show.
[[nodiscard]] std::string frequency_text(const Results& results);
/// Where the joint wears in the first cycle.
[[nodiscard]] std::string first_rate_text(const Results& results);

}  // namespace dovetail::paper_sequence
