#include "geometry/cad/occ_shapes.hpp"

#include <BRepAlgoAPI_Cut.hxx>
#include <BRepAlgoAPI_Fuse.hxx>
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeSolid.hxx>
#include <BRepBuilderAPI_MakeVertex.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepBuilderAPI_Sewing.hxx>
#include <BRepCheck_Analyzer.hxx>
#include <BRepLib.hxx>
#include <BRepPrimAPI_MakePrism.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Precision.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColgp_Array1OfPnt.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <gp_Circ.hxx>

#include <algorithm>

#include "core/errors.hpp"
#include "geometry/exports/millimetres.hpp"

namespace dovetail::geometry::occ {
namespace {

/// Edges that are the same to rounding are sewn, mm; the modeller's own resolution is a tenth of it.
constexpr double kSeam = 1e-6;

struct Knots {
  TColStd_Array1OfReal at;
  TColStd_Array1OfInteger times;
};

Knots knots(const std::vector<double>& places) {
  const int count = static_cast<int>(places.size());
  Knots knots{TColStd_Array1OfReal(1, count), TColStd_Array1OfInteger(1, count)};
  for (int i = 1; i <= count; ++i) {
    knots.at(i) = places[static_cast<std::size_t>(i - 1)];
    knots.times(i) = i == 1 || i == count ? 4 : 2;
  }
  return knots;
}

/// The edge at the start or the end of its sweep.
TopoDS_Edge edge_between(const SweptEdge& swept, bool last, const Eigen::Vector3d& offset, const TopoDS_Vertex& from,
                         const TopoDS_Vertex& to) {
  if (swept.net) return BRepBuilderAPI_MakeEdge(curve(*swept.net, last), from, to);
  const Edge& e = swept.edge;
  if (!e.is_arc()) return BRepBuilderAPI_MakeEdge(from, to);
  // Circles turn counter-clockwise about their axis.
  const gp_Dir axis(0, 0, e.sweep > 0 ? 1 : -1), towards_start(vector(in_space(e.start - e.center)));
  const gp_Circ circle(gp_Ax2(point(in_space(e.center) + offset), axis, towards_start), kPerMillimetre * e.radius);
  return BRepBuilderAPI_MakeEdge(circle, from, to);
}

Eigen::Vector3d start_of(const SweptEdge& swept, bool last, const Eigen::Vector3d& offset) {
  if (!swept.net) return in_space(swept.edge.start) + offset;
  return last ? swept.net->poles.front().back() : swept.net->poles.front().front();
}

}  // namespace

gp_Pnt point(const Eigen::Vector3d& at) {
  return {kPerMillimetre * at.x(), kPerMillimetre * at.y(), kPerMillimetre * at.z()};
}

gp_Vec vector(const Eigen::Vector3d& along) {
  return {kPerMillimetre * along.x(), kPerMillimetre * along.y(), kPerMillimetre * along.z()};
}

TopoDS_Face face(const SplineNet& net) {
  TColgp_Array2OfPnt poles(1, static_cast<int>(net.poles.size()), 1, static_cast<int>(net.poles.front().size()));
  for (int i = poles.LowerRow(); i <= poles.UpperRow(); ++i)
    for (int j = poles.LowerCol(); j <= poles.UpperCol(); ++j)
      poles(i, j) = point(net.poles[static_cast<std::size_t>(i - 1)][static_cast<std::size_t>(j - 1)]);
  const Knots a = knots(net.a), b = knots(net.b);
  const Handle(Geom_Surface) surface = new Geom_BSplineSurface(poles, a.at, b.at, a.times, b.times, 3, 3);
  return BRepBuilderAPI_MakeFace(surface, Precision::Confusion());
}

Handle(Geom_BSplineCurve) curve(const SplineNet& net, bool last) {
  TColgp_Array1OfPnt poles(1, static_cast<int>(net.poles.size()));
  for (int i = poles.Lower(); i <= poles.Upper(); ++i) {
    const std::vector<Eigen::Vector3d>& row = net.poles[static_cast<std::size_t>(i - 1)];
    poles(i) = point(last ? row.back() : row.front());
  }
  const Knots a = knots(net.a);
  return new Geom_BSplineCurve(poles, a.at, a.times, 3);
}

SweptChain swept(const Chain& chain) {
  SweptChain result;
  for (const Edge& e : chain) result.push_back({e});
  return result;
}

TopoDS_Wire section_wire(const SweptChain& chain, const Eigen::Vector3d& offset, bool last) {
  std::vector<TopoDS_Vertex> corners;
  for (std::size_t i = 0; i < chain.size(); ++i) {
    // A net ends where the edge after it does not know.
    const SweptEdge& before = chain[(i + chain.size() - 1) % chain.size()];
    Eigen::Vector3d at = start_of(chain[i], last, offset);
    if (before.net && !chain[i].net) at = last ? before.net->poles.back().back() : before.net->poles.back().front();
    corners.push_back(BRepBuilderAPI_MakeVertex(point(at)));
  }
  BRepBuilderAPI_MakeWire wire;
  for (std::size_t i = 0; i < chain.size(); ++i)
    wire.Add(edge_between(chain[i], last, offset, corners[i], corners[(i + 1) % chain.size()]));
  return wire;
}

TopoDS_Shape sweep(const SweptChain& chain, const Eigen::Vector3d& start, const Eigen::Vector3d& along) {
  const TopoDS_Wire first = section_wire(chain, start);
  // A net that is the same all along could be swept as a curve, too, but the modeller's volumes of swept splines are
  // off by 1e-5: it does not look at their knots.
  if (std::ranges::none_of(chain, [](const SweptEdge& e) { return e.net.has_value(); }))
    return BRepPrimAPI_MakePrism(planar_face(first), vector(along));
  std::vector<TopoDS_Shape> faces{planar_face(first), planar_face(section_wire(chain, start + along, true))};
  TopExp_Explorer edge(first, TopAbs_EDGE);
  for (const SweptEdge& swept : chain) {
    faces.push_back(swept.net ? TopoDS_Shape(face(*swept.net))
                              : BRepPrimAPI_MakePrism(edge.Current(), vector(along)).Shape());
    edge.Next();
  }
  return sewn(faces);
}

TopoDS_Face planar_face(const TopoDS_Wire& wire) {
  return BRepBuilderAPI_MakeFace(wire, true);
}

TopoDS_Shape sewn(const std::vector<TopoDS_Shape>& faces) {
  BRepBuilderAPI_Sewing sewing(kSeam);
  for (const TopoDS_Shape& face : faces) sewing.Add(face);
  sewing.Perform();
  BRepBuilderAPI_MakeSolid solid;
  for (TopExp_Explorer shell(sewing.SewedShape(), TopAbs_SHELL); shell.More(); shell.Next())
    solid.Add(TopoDS::Shell(shell.Current()));
  TopoDS_Solid body = solid.Solid();
  BRepLib::OrientClosedSolid(body);
  return body;
}

TopoDS_Shape joined(const TopoDS_Shape& one, const TopoDS_Shape& other) {
  return BRepAlgoAPI_Fuse(one, other).Shape();
}

TopoDS_Shape without(const TopoDS_Shape& body, const TopoDS_Shape& tool) {
  return BRepAlgoAPI_Cut(body, tool).Shape();
}

TopoDS_Solid one_solid(const TopoDS_Shape& shape, const std::string& what) {
  TopExp_Explorer solids(shape, TopAbs_SOLID);
  if (solids.More()) {
    TopoDS_Solid solid = TopoDS::Solid(solids.Current());
    solids.Next();
    if (!solids.More() && BRepCheck_Analyzer(solid).IsValid()) return solid;
  }
  throw InputError(
      {.file = {},
       .key = "geometry",
       .value = {},
       .allowed = "makes no valid solid of the " + what + ": does the design keep the rules of its geometry?"});
}

}  // namespace dovetail::geometry::occ
