#pragma once

#include <Eigen/Geometry>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "studies/report/record/run_record.hpp"

namespace dovetail::report {

/// The stress of the spin-up in one plane across the slot: of a section all there is, in space the height of nodes with
/// the largest stress in the fillets, as the responses have it. At the sharp end of a flank the stress has no bound: it
/// says how fine the mesh is.
struct StressCut {
  struct Corner {
    Eigen::Vector2d at{0, 0};  ///< m, of a skewed slot where it would be in the middle section
    double value = 0;          ///< Pa
  };
  std::vector<std::array<Corner, 3>> triangles;  ///< those in the window; in space a quarter of a face of an element
  std::optional<double> height;                  ///< m, along the axis from the slot's middle; in the plane none
  std::optional<Corner> peak;                    ///< in the fillets

  /// "blade, neck fillet right": the edge of the profile next to the peak; empty without one.
  [[nodiscard]] std::string peak_place(const geometry::Profile& profile) const;
};

/// Nothing where no stress or no profile is kept.
/// - `beside`: a cut of another design that this one is compared with. Of heights whose peaks are nearly as large that
///   nearest to its height is taken: the two ends of a slot differ by little more than the mesh.
[[nodiscard]] std::optional<StressCut> worst_cut(const DesignRecord& design, const Eigen::AlignedBox2d& window,
                                                 const StressCut* beside = nullptr);

}  // namespace dovetail::report
