#pragma once

#include <string>
#include <vector>

#include "studies/report/record/run_record.hpp"

namespace dovetail::report {

/// Where nothing could be computed how most candidates ended: "asymptote: no_asymptote in 6 of 6"; else nothing.
[[nodiscard]] std::string why_none(const RunRecord& record);

/// What no candidate keeps.
struct Unkept {
  std::string limit;  ///< "the upper limit of the peak amplitude (8 mm)"; empty where it is none alone
  std::string words;  ///< that, where it is, and how near the nearest candidate comes
};

/// The limits and rules that no candidate keeps; where some keep all of them and there is no best design, what looks at
/// finer meshes have against those.
[[nodiscard]] std::vector<Unkept> never_kept(const RunRecord& record);

/// The words of several.
[[nodiscard]] std::vector<std::string> words_of(const std::vector<Unkept>& unkept);

}  // namespace dovetail::report
