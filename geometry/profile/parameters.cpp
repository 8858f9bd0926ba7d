#include "geometry/profile/parameters.hpp"

#include <array>

#include "geometry/profile/key_units.hpp"

namespace dovetail {

namespace {

using geometry::between, geometry::kDegree, geometry::kMicrometre, geometry::kMillimetre;

/// Longest dimension that means anything for a bladed disk, mm.
constexpr Range kLength{.lower = 0, .upper = 5000, .lower_open = true};
/// Widths, heights and radii within one sector, mm.
constexpr Range kDetail{.lower = 0, .upper = 1000, .lower_open = true};
/// Departures of the real flank from the nominal one, um: larger ones are no longer a gap function.
constexpr Range kForm = between(-500, 500);

using P = geometry::ProfileParameters;
using F = geometry::FlankParameters;
using L = geometry::FeasibilityLimits;
using M = geometry::MeshSizes;

}  // namespace

template <>
std::span<const Field<P>> option_table<P>() {
  static const std::array fields{
      Field<P>{"sectors", &P::sectors, 1, between(3, 500), "Number of blades on the disk.", true},
      Field<P>{"bore_radius_mm", &P::bore_radius, kMillimetre, kLength, "Inner radius of the disk.", true},
      Field<P>{"rim_radius_mm", &P::rim_radius, kMillimetre, kLength, "Outer radius of the disk.", true},
      Field<P>{"neck_width_mm", &P::neck_width, kMillimetre, kDetail, "Narrowest width of the blade's neck.", true},
      Field<P>{"neck_height_mm", &P::neck_height, kMillimetre, kDetail,
               "Height of the straight neck between the neck fillets and the shank's shoulder (mean of both sides)."},
      Field<P>{"neck_fillet_radius_mm", &P::neck_fillet_radius, kMillimetre, kDetail,
               "Radius of the blade's fillet between neck and flank.", true},
      Field<P>{"root_corner_radius_mm", &P::root_corner_radius, kMillimetre, kDetail,
               "Radius of the blade's corner between flank and root bottom.", true},
      Field<P>{"lobe_radius_mm", &P::lobe_radius, kMillimetre, kDetail,
               "Radius of the disk's nose between slot mouth and flank; smaller than the neck fillet's.", true},
      Field<P>{"slot_fillet_radius_mm", &P::slot_fillet_radius, kMillimetre, kDetail,
               "Radius of the disk's fillet between flank and slot floor; not smaller than the root corner's.", true},
      Field<P>{"bottom_clearance_mm", &P::bottom_clearance, kMillimetre, kDetail,
               "Least distance between root bottom and slot floor; also the radial extent of the slot's straight side "
               "beyond the blade's flank."},
      Field<P>{"lobe_depth_mm", &P::lobe_depth, kMillimetre, kDetail,
               "Depth of the flanks' neck-side ends below the rim (mean of both sides)."},
      Field<P>{"shank_width_mm", &P::shank_width, kMillimetre, kDetail, "Width of the shank; wider than the neck."},
      Field<P>{"shank_height_mm", &P::shank_height, kMillimetre, kDetail,
               "Height from the upper end of the straight neck to the platform."},
      Field<P>{"platform_width_mm", &P::platform_width, kMillimetre, kDetail,
               "Width of the platform; less than the pitch at its radius."},
      Field<P>{"platform_thickness_mm", &P::platform_thickness, kMillimetre, kDetail, "Thickness of the platform."},
      Field<P>{"blend_radius_mm", &P::blend_radius, kMillimetre, kDetail,
               "Radius of the blade's blends at neck and shank, shank and platform, platform and aerofoil."},
      Field<P>{"aerofoil_span_mm", &P::aerofoil_span, kMillimetre, kLength,
               "Height of the aerofoil above the platform.", true},
      Field<P>{"aerofoil_root_thickness_mm", &P::aerofoil_root_thickness, kMillimetre, kDetail,
               "Thickness of the aerofoil at the platform.", true},
      Field<P>{"aerofoil_tip_thickness_mm", &P::aerofoil_tip_thickness, kMillimetre, kDetail,
               "Thickness of the aerofoil at its tip.", true},
      Field<P>{"chord_mm", &P::chord, kMillimetre, kLength, "Extent of the aerofoil out of the plane.", true},
      Field<P>{"slot_length_mm", &P::slot_length, kMillimetre, kLength,
               "Extent of blade root and disk out of the plane.", true},
  };
  return fields;
}

template <>
std::span<const Field<F>> option_table<F>() {
  static const std::array fields{
      Field<F>{"flank_angle_deg", &F::angle, kDegree, between(5, 85),
               "Angle between the flank and the radial direction.", true},
      Field<F>{"flank_length_mm", &F::length, kMillimetre, kDetail, "Length of the straight flank.", true},
      Field<F>{"flank_mismatch_um", &F::mismatch, kMicrometre, kForm,
               "Gap at the flank's root-side end relative to its neck-side end; negative opens the neck side."},
      Field<F>{"flank_crown_um", &F::crown, kMicrometre, kForm,
               "Height of the flank's bulge at mid-length; negative makes it hollow."},
      Field<F>{"relief_length_mm", &F::relief_length, kMillimetre, between(0, 1000),
               "Length of the relieved zone at each end of the flank."},
      Field<F>{"relief_depth_um", &F::relief_depth, kMicrometre, between(0, 500),
               "Depth of the relief at the flank's ends."},
      Field<F>{"flank_edge_radius_mm", &F::edge_radius, kMillimetre, between(0, 1000),
               "Radius with which the blade's flank rounds off at its ends; 0: sharp."},
  };
  return fields;
}

template <>
std::span<const Field<L>> option_table<L>() {
  static const std::array fields{
      Field<L>{"minimum_wall_mm", &L::minimum_wall, kMillimetre, kDetail, "Thinnest wall allowed anywhere."},
      Field<L>{"minimum_cutter_radius_mm", &L::minimum_cutter_radius, kMillimetre, between(0, 1000),
               "Smallest radius the tool can cut."},
  };
  return fields;
}

template <>
std::span<const Field<M>> option_table<M>() {
  static const std::array fields{
      Field<M>{"flank_elements", &M::flank_elements, 1, between(2, 2000), "Element edges along each straight flank."},
      Field<M>{"flank_grading", &M::flank_grading, 1, between(1, 50),
               "Longest element edge along a flank, in its middle, over the shortest ones at its ends, where pressures "
               "peak and worn zones begin; 1: all equal."},
      Field<M>{"fillet_fraction", &M::fillet_fraction, 1, between(0.002, 1),
               "Element size on a fillet as a fraction of its radius."},
      Field<M>{"bulk_size_mm", &M::bulk_size, kMillimetre, between(0.05, 100),
               "Largest element size in the blade root and the disk."},
      Field<M>{"aerofoil_elements", &M::aerofoil_elements, 1, between(2, 2000),
               "Element edges along the aerofoil's span."},
      Field<M>{"blend_fraction", &M::blend_fraction, 1, between(0.05, 2),
               "Element size on the blends of neck, shank, platform and aerofoil as a fraction of their radius."},
      Field<M>{"growth", &M::growth, 1, between(0.05, 2),
               "Growth of the element size with the distance from where a small one is wanted."},
  };
  return fields;
}

}  // namespace dovetail
