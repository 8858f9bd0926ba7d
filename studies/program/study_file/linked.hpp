#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "optimizer/problem/problem.hpp"
#include "optimizer/scene/scene.hpp"
#include "studies/program/study_file/section_reader.hpp"

namespace dovetail::studies {

/// A key of the study file that follows from the design variables.
struct LinkedKey {
  std::string key;
  /// A formula of their keys, written with '_' in place of '.': numbers, + - * / ^, brackets, comparisons, `a ? b : c`
  /// and the functions of muParser (sqrt, sin in rad, min, max, ...). In the units of the file.
  std::string value;
};

/// What a point of the design space sets, and what follows from it. A formula without a value gives NaN.
[[nodiscard]] std::map<std::string, double> with_linked(std::map<std::string, double> settings,
                                                        std::span<const LinkedKey> linked);

/// Reads [[linked]]. A formula is tried at the numbers that the scene has; the scene gets what it comes to.
[[nodiscard]] std::vector<LinkedKey> read_linked(SectionReader& root, const optimizer::Problem& problem,
                                                 optimizer::Scene& scene, Problems& problems);

}  // namespace dovetail::studies
