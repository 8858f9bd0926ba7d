#include "geometry/cad/sector_solids.hpp"

#include <APIHeaderSection_MakeHeader.hxx>
#include <BRepMesh_IncrementalMesh.hxx>
#include <BRep_Tool.hxx>
#include <IGESControl_Controller.hxx>
#include <IGESControl_Writer.hxx>
#include <Interface_Static.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Message_Printer.hxx>
#include <Poly_Triangulation.hxx>
#include <STEPControl_Writer.hxx>
#include <Standard_Failure.hxx>
#include <StepBasic_Product.hxx>
#include <StepData_StepModel.hxx>
#include <TCollection_HAsciiString.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <mutex>

#include "core/errors.hpp"
#include "core/replace_file.hpp"
#include "geometry/cad/occ_sector.hpp"
#include "geometry/exports/millimetres.hpp"

namespace dovetail::geometry {
namespace {

/// The modeller's exceptions are none of the standard library's.
template <class Work>
auto translated(const Work& work) {
  try {
    return work();
  } catch (const Standard_Failure& failure) {
    throw InputError({.file = {},
                      .key = "geometry",
                      .value = {},
                      .allowed = std::string("makes no solid: ") + failure.GetMessageString()});
  }
}

/// Writers share settings and tell the terminal what they do: one at a time, and silently.
std::mutex& writers() {
  static std::mutex mutex;
  return mutex;
}

/// The modeller numbers them.
void name_products(const StepData_StepModel& model) {
  const char* name = "BLADE";
  for (int i = 1; i <= model.NbEntities(); ++i)
    if (const auto product = Handle(StepBasic_Product)::DownCast(model.Value(i)); !product.IsNull()) {
      product->SetName(new TCollection_HAsciiString(name));
      product->SetId(new TCollection_HAsciiString(name));
      name = "DISK";
    }
}

InputError unwritable(const std::filesystem::path& file) {
  return InputError({.file = {}, .key = file.string(), .value = {}, .allowed = "cannot be written completely"});
}

}  // namespace

struct SectorSolids::Shapes {
  TopoDS_Solid blade, disk;
};

SectorSolids::SectorSolids(const SolidDesign& design) {
  checked(design.solid);
  const Profile profile = build_profile(design.profile);
  shapes_ = translated([&] {
    return std::make_shared<const Shapes>(Shapes{.blade = occ::one_solid(occ::blade_shape(design, profile), "blade"),
                                                 .disk = occ::one_solid(occ::disk_shape(design, profile), "disk")});
  });
}

void SectorSolids::write_step(const std::filesystem::path& file) const {
  const std::scoped_lock one_at_a_time(writers());
  Message::DefaultMessenger()->RemovePrinters(STANDARD_TYPE(Message_Printer));
  replace_file(file, [&](const std::filesystem::path& place) {
    STEPControl_Writer writer;
    // Curves in the parameters of surfaces would come as splines even on planes; readers find them again.
    Interface_Static::SetIVal("write.surfacecurve.mode", 0);
    const auto add = [&](const TopoDS_Shape& shape) {
      return writer.Transfer(shape, STEPControl_ManifoldSolidBrep) == IFSelect_RetDone;
    };
    const bool whole = translated([&] { return add(shapes_->blade) && add(shapes_->disk); });
    name_products(*writer.Model());
    APIHeaderSection_MakeHeader header(writer.Model());
    header.SetName(new TCollection_HAsciiString(file.filename().c_str()));
    header.SetDescriptionValue(1, new TCollection_HAsciiString("Blade and disk of one sector"));
    header.SetAuthorValue(1, new TCollection_HAsciiString());
    header.SetOrganizationValue(1, new TCollection_HAsciiString());
    header.SetOriginatingSystem(new TCollection_HAsciiString("dovetail"));
    if (!whole || writer.Write(place.c_str()) != IFSelect_RetDone) throw unwritable(file);
  });
}

void SectorSolids::write_iges(const std::filesystem::path& file) const {
  const std::scoped_lock one_at_a_time(writers());
  Message::DefaultMessenger()->RemovePrinters(STANDARD_TYPE(Message_Printer));
  replace_file(file, [&](const std::filesystem::path& place) {
    IGESControl_Controller::Init();
    constexpr int kSolids = 1;
    IGESControl_Writer writer("MM", kSolids);
    const bool whole = translated([&] { return writer.AddShape(shapes_->blade) && writer.AddShape(shapes_->disk); });
    writer.ComputeModel();
    if (!whole || !writer.Write(place.c_str())) throw unwritable(file);
  });
}

std::array<std::vector<Triangle>, 2> SectorSolids::triangles(double deviation, double turn) const {
  std::array<std::vector<Triangle>, 2> bodies;
  translated([&] {
    for (std::size_t body = 0; body < bodies.size(); ++body) {
      const TopoDS_Solid& solid = body == 0 ? shapes_->blade : shapes_->disk;
      std::vector<Triangle>& list = bodies[body];
      const BRepMesh_IncrementalMesh mesh(solid, kPerMillimetre * deviation, false, turn);
      for (TopExp_Explorer faces(solid, TopAbs_FACE); faces.More(); faces.Next()) {
        TopLoc_Location place;
        const Handle(Poly_Triangulation) flat = BRep_Tool::Triangulation(TopoDS::Face(faces.Current()), place);
        if (flat.IsNull()) throw Standard_Failure("a face has no triangles");
        const bool turned = faces.Current().Orientation() == TopAbs_REVERSED;
        for (int t = 1; t <= flat->NbTriangles(); ++t) {
          std::array<int, 3> corners{};
          flat->Triangle(t).Get(corners[0], corners[1], corners[2]);
          if (turned) std::swap(corners[1], corners[2]);
          Triangle& triangle = list.emplace_back();
          for (std::size_t i = 0; i < 3; ++i) {
            const gp_Pnt at = flat->Node(corners[i]).Transformed(place.Transformation());
            triangle[i] = Eigen::Vector3d(at.X(), at.Y(), at.Z()) / kPerMillimetre;
          }
        }
      }
    }
  });
  return bodies;
}

}  // namespace dovetail::geometry
