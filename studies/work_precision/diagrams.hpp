#pragma once

#include <functional>
#include <string>

#include "studies/work_precision/sweep.hpp"

namespace dovetail::work_precision {

struct DiagramOptions {
  std::string study_file;  ///< of the scene
  bool quick = false;      ///< few settings, small models: a look at the page, no evidence
  std::function<void(const std::string&)> progress = {};  ///< a line for people
};

/// A contact patch with two tangential directions, of nodes that stick, slip and lift off.
[[nodiscard]] Diagram patch_diagram(const DiagramOptions& options);

/// The scene of the study file.
[[nodiscard]] Diagram scene_diagram(const DiagramOptions& options);

}  // namespace dovetail::work_precision
