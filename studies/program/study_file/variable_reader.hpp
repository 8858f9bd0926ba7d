#pragma once

#include <string>
#include <vector>

#include "optimizer/problem/design_space.hpp"
#include "optimizer/scene/scene.hpp"
#include "studies/program/study_file/section_reader.hpp"

namespace dovetail::studies {

/// What is said of a number of a wear law that the scene does not use.
[[nodiscard]] std::string left_aside_words(const optimizer::Scene& scene);

/// Why a key that is a number cannot be a variable, or follow from some; empty when it can.
[[nodiscard]] std::string conflict_of_variable(const Node* root, const optimizer::Parameter& parameter);

/// Reads [[variable]]. `scene` gives the start of one that names none. What is wrong goes to `problems`.
[[nodiscard]] std::vector<optimizer::DesignVariable> read_variables(SectionReader& root, const optimizer::Scene& scene,
                                                                    Problems& problems);

}  // namespace dovetail::studies
