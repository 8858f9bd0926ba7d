#pragma once

#include <string>

#include "studies/report/record/run_record.hpp"

namespace dovetail::report {

/// The joint, zoomed: the design's blade and disk filled, the outlines of `before` as thin lines behind (null: none),
/// and the form of the design's flanks as a band into the blade, its height exaggerated by the factor written below.
/// <figure> with its legend; a sentence when the design has no profile.
[[nodiscard]] std::string joint_figure(const DesignRecord& design, const DesignRecord* before);

/// The whole sector, small.
[[nodiscard]] std::string sector_figure(const DesignRecord& design, const DesignRecord* before);

}  // namespace dovetail::report
