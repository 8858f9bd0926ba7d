#pragma once

#include <string>

#include "studies/paper_sequence/results.hpp"

namespace dovetail::paper_sequence {

/// What the page says differently of a plane section and of a sector in space.
struct SceneWords {
  std::string title;        ///< of the page, after "Dynamics and fretting wear of a bladed disk"
  std::string column;       ///< heading over what is found here
  std::string where;        ///< the findings hold ...
  std::string such;         ///< the sequence is repeated in ...
  std::string differences;  ///< <li> entries of this scene alone
};
[[nodiscard]] SceneWords scene_words(const Results& results);

/// How the pressures of the preload lie on the flanks.
[[nodiscard]] std::string pressure_text(const Results& results);
/// What the frequencies over nodal diameters show.
[[nodiscard]] std::string frequency_text(const Results& results);
/// Where the joint wears in the first cycle.
[[nodiscard]] std::string first_rate_text(const Results& results);

}  // namespace dovetail::paper_sequence
