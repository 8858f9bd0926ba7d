#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <functional>
#include <string_view>

#include "core/options.hpp"

namespace dovetail::geometry {

/// A bearing flank of the section. Its section in a study file is [geometry.NAME], its edges end with _NAME.
struct FlankPlace {
  std::string_view name;
  bool left;  ///< of the blade's centre line
};
/// All of them, in the order of ProfileParameters::flanks and of the flanks of meshes.
inline constexpr std::array kFlanks{FlankPlace{"left", true}, FlankPlace{"right", false}};
/// Index of the flank of that name. Asserts that there is one.
[[nodiscard]] inline std::size_t flank_index(std::string_view name) {
  const auto place = std::ranges::find(kFlanks, name, &FlankPlace::name);
  assert(place != kFlanks.end());
  return static_cast<std::size_t>(place - kFlanks.begin());
}

/// Dimensions of one bearing flank; those of others may differ.
struct FlankParameters {
  double angle = 0.8726646259971648;  ///< between flank and radial direction, rad
  double length = 5.5e-3;             ///< straight part, m
  double mismatch = 0;  ///< extra gap at the root-side end against the neck-side end, m (negative: at the neck side)
  double crown = 0;     ///< height of the blade flank's bulge at mid-length, m (negative: hollow)
  double relief_length = 0;  ///< length of the relieved zone at each end of the flank, m
  double relief_depth = 0;   ///< depth of the relief at the ends, m
  double edge_radius = 0;    ///< radius of the rounding at each end of the flank, m; 0: sharp (flank_form.hpp)
};

/// Every dimension of a dovetail section, SI. x is tangential, y radial; the blade's centre line is x = 0.
struct ProfileParameters {
  int sectors = 47;
  double bore_radius = 0.120;
  double rim_radius = 0.250;
  double neck_width = 8.5e-3;          ///< narrowest width of the blade's neck
  double neck_height = 3.0e-3;         ///< straight neck above the neck fillet up to the shank's shoulder
  double neck_fillet_radius = 2.0e-3;  ///< blade fillet between neck and flank (concave)
  double root_corner_radius = 1.5e-3;  ///< blade corner between flank and root bottom (convex)
  double lobe_radius = 1.5e-3;         ///< disk nose between slot mouth and flank (convex)
  double slot_fillet_radius = 2.0e-3;  ///< disk fillet between flank and slot floor (concave)
  double bottom_clearance = 0.5e-3;    ///< least distance between root bottom and slot floor, see profile.hpp
  double lobe_depth = 3.0e-3;          ///< of the flanks' neck-side ends below the rim, see profile.hpp
  double shank_width = 11e-3;
  double shank_height = 8e-3;  ///< from the straight neck's upper end to the platform
  double platform_width = 30e-3;
  double platform_thickness = 3e-3;
  double blend_radius = 1e-3;  ///< at the corners neck - shank, shank - platform, platform - aerofoil
  double aerofoil_span = 0.100;
  double aerofoil_root_thickness = 4e-3;
  double aerofoil_tip_thickness = 3e-3;
  double chord = 40e-3;        ///< thickness of the aerofoil region out of the plane
  double slot_length = 40e-3;  ///< thickness of blade root and disk out of the plane
  std::array<FlankParameters, kFlanks.size()> flanks;

  [[nodiscard]] const FlankParameters& flank(std::string_view name) const { return flanks[flank_index(name)]; }
  [[nodiscard]] FlankParameters& flank(std::string_view name) { return flanks[flank_index(name)]; }
  /// Mean over the flanks of a member or a function of them.
  template <class Of>
  [[nodiscard]] double mean(Of&& of) const {
    double sum = 0;
    for (const FlankParameters& flank : flanks) sum += std::invoke(of, flank);
    return sum / static_cast<double>(flanks.size());
  }
};

/// Rules a design has to keep besides fitting together.
struct FeasibilityLimits {
  double minimum_wall = 2.0e-3;           ///< thinnest wall allowed (neck, post between slots, platform), m
  double minimum_cutter_radius = 0.8e-3;  ///< smallest radius the tool can cut, m
  double friction = 0.5;                  ///< a flank steeper than atan(friction) from the radial direction locks
};

/// Sizes of the mesh.
struct MeshSizes {
  int flank_elements = 24;       ///< element edges along each straight flank
  double flank_grading = 8;      ///< longest of these edges, in the middle, over the shortest, at both ends; 1: equal
  double fillet_fraction = 0.1;  ///< element size on a fillet as a fraction of its radius
  double bulk_size = 3e-3;       ///< largest element size in the blade root and disk, m
  int aerofoil_elements = 24;    ///< element edges along the aerofoil's span
  double blend_fraction = 0.4;   ///< element size on a blend (no stress is read there) as a fraction of its radius
  double growth = 0.25;          ///< of the element size per distance from where a small one is wanted
};

}  // namespace dovetail::geometry

namespace dovetail {

/// Keys of the study file. build_profile accepts exactly the parameters whose values are in range.
template <>
[[nodiscard]] std::span<const Field<geometry::ProfileParameters>> option_table<geometry::ProfileParameters>();
template <>
[[nodiscard]] std::span<const Field<geometry::FlankParameters>> option_table<geometry::FlankParameters>();
template <>
[[nodiscard]] std::span<const Field<geometry::FeasibilityLimits>> option_table<geometry::FeasibilityLimits>();
template <>
[[nodiscard]] std::span<const Field<geometry::MeshSizes>> option_table<geometry::MeshSizes>();

}  // namespace dovetail
