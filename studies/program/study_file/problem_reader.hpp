#pragma once

#include "optimizer/problem/optimizer_options.hpp"
#include "optimizer/problem/problem.hpp"
#include "optimizer/scene/scene.hpp"
#include "studies/program/study_file/section_reader.hpp"

namespace dovetail::studies {

/// Reads [[variable]], [[case]], [[objective]] and [[constraint]]. `scene` gives the start of a variable that names
/// none; an accuracy of one response takes one of all, in `scene` or `options`. What is wrong goes to `problems`; the
/// result is meaningful only when nothing was.
[[nodiscard]] optimizer::Problem read_problem(SectionReader& root, const optimizer::Scene& scene,
                                              const optimizer::OptimizerOptions& options, Problems& problems);

}  // namespace dovetail::studies
