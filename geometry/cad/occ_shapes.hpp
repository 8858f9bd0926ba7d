#pragma once

// Shapes of Open CASCADE, in mm. Not for anyone outside this folder.
#include <Geom_BSplineCurve.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Shape.hxx>
#include <TopoDS_Solid.hxx>
#include <TopoDS_Wire.hxx>
#include <gp_Pnt.hxx>
#include <gp_Vec.hxx>
#include <optional>
#include <string>
#include <vector>

#include "geometry/cad/spline_net.hpp"
#include "geometry/profile/profile.hpp"

namespace dovetail::geometry::occ {

[[nodiscard]] inline Eigen::Vector3d in_space(const Eigen::Vector2d& at) {
  return {at.x(), at.y(), 0};
}
[[nodiscard]] gp_Pnt point(const Eigen::Vector3d& at);
[[nodiscard]] gp_Vec vector(const Eigen::Vector3d& along);

/// The surface of a net, and its curve along a at the first or last knot of b.
[[nodiscard]] TopoDS_Face face(const SplineNet& net);
[[nodiscard]] Handle(Geom_BSplineCurve) curve(const SplineNet& net, bool last);

/// An edge of a section in the plane z = 0 and the surface that it sweeps, where that is not its own shape.
struct SweptEdge {
  Edge edge;
  std::optional<SplineNet> net = {};  ///< a from the edge's start to its end, b along the sweep
};
using SweptChain = std::vector<SweptEdge>;
[[nodiscard]] SweptChain swept(const Chain& chain);

/// The body that a closed chain, moved to `start`, makes on its way by `along`, m; nets lie where they are.
[[nodiscard]] TopoDS_Shape sweep(const SweptChain& chain, const Eigen::Vector3d& start, const Eigen::Vector3d& along);

/// A closed chain moved by `offset`.
[[nodiscard]] TopoDS_Wire section_wire(const SweptChain& chain, const Eigen::Vector3d& offset, bool last = false);

/// A planar face within a closed wire.
[[nodiscard]] TopoDS_Face planar_face(const TopoDS_Wire& wire);

/// The body that closed faces bound.
[[nodiscard]] TopoDS_Shape sewn(const std::vector<TopoDS_Shape>& faces);

[[nodiscard]] TopoDS_Shape joined(const TopoDS_Shape& one, const TopoDS_Shape& other);
[[nodiscard]] TopoDS_Shape without(const TopoDS_Shape& body, const TopoDS_Shape& tool);

/// The one valid solid that a shape is. Throws InputError naming `what` when it is none.
[[nodiscard]] TopoDS_Solid one_solid(const TopoDS_Shape& shape, const std::string& what);

}  // namespace dovetail::geometry::occ
