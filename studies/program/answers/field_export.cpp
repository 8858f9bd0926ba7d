#include "studies/program/answers/field_export.hpp"

#include <array>

#include "geometry/exports/vtu.hpp"

namespace dovetail::studies {

void export_fields(const report::FieldRecord& fields, const std::filesystem::path& file) {
  const auto matrix = [](const report::Numbers& values, Eigen::Index components) -> Eigen::MatrixXd {
    return Eigen::Map<const Eigen::MatrixXd>(values.data(), components,
                                             static_cast<Eigen::Index>(values.size()) / components);
  };
  const std::array<geometry::MeshField, 2> point_fields{
      {{.name = "displacement_m", .values = matrix(fields.displacement_m, fields.mesh.dimensions())},
       {.name = "von_mises_pa", .values = matrix(fields.von_mises_pa, 1)}}};
  geometry::write_vtu(file, fields.mesh, point_fields);
}

}  // namespace dovetail::studies
