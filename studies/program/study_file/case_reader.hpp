#pragma once

#include <vector>

#include "optimizer/problem/design_space.hpp"
#include "optimizer/problem/load_case.hpp"
#include "optimizer/scene/scene.hpp"
#include "studies/program/study_file/section_reader.hpp"

namespace dovetail::studies {

/// Reads [[case]]: a name, a weight, and keys of the scene with other numbers; a key may stand in quotes or not. What
/// is wrong goes to `problems`.
/// - `variables`: their keys no case may set
[[nodiscard]] std::vector<optimizer::LoadCase> read_cases(SectionReader& root, const optimizer::Scene& scene,
                                                          const std::vector<optimizer::DesignVariable>& variables,
                                                          Problems& problems);

/// Reads [[uncertain]] and [robust] and takes samples of the cases, of the study itself where there are none.
/// - `quantile`: of [robust]
[[nodiscard]] std::vector<optimizer::LoadCase> read_samples(SectionReader& root, const optimizer::Scene& scene,
                                                            const std::vector<optimizer::DesignVariable>& variables,
                                                            std::vector<optimizer::LoadCase> cases, double& quantile,
                                                            Problems& problems);

}  // namespace dovetail::studies
