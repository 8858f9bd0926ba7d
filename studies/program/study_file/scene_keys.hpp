#pragma once

#include <string>
#include <vector>

#include "optimizer/scene/scene.hpp"
#include "studies/program/study_file/section_reader.hpp"

namespace dovetail::studies {

/// The parameter of that key, or nullptr: then `value`, at `path`, is reported, with the key it may have meant.
[[nodiscard]] const optimizer::Parameter* scene_key(const std::string& key, const Node& value, const std::string& path,
                                                    Problems& problems);

/// Whether two keys set the same number.
[[nodiscard]] bool overlap(const std::string& a, const std::string& b);

}  // namespace dovetail::studies
