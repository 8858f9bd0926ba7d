#pragma once

#include <Eigen/Geometry>
#include <string>

#include "studies/report/record/run_record.hpp"

namespace dovetail::report {

/// The edges around the flanks on both bodies, with a margin.
[[nodiscard]] Eigen::AlignedBox2d joint_window(const DesignRecord& design);

/// A chain as the data of a path, in mm, y downwards.
[[nodiscard]] std::string outline(const geometry::Chain& chain);

/// The joint, zoomed: the design's blade and disk filled, the outlines of `before` as thin lines behind (null: none),
/// its main dimensions, with those of `before` where they differ, and the form of the design's flanks as a band into
/// the blade, its height exaggerated by the factor written beside it. <figure> with its legend; a sentence when the
/// design has no profile.
[[nodiscard]] std::string joint_figure(const DesignRecord& design, const DesignRecord* before);

/// The whole sector, small.
[[nodiscard]] std::string sector_figure(const DesignRecord& design, const DesignRecord* before);

}  // namespace dovetail::report
