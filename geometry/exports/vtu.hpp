#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "fem/mesh.hpp"

namespace dovetail::geometry {

/// Values at the nodes or in the elements of a mesh, [components, nodes or elements]; 1 component: a scalar. Two
/// components are written as vectors with a zero third one.
struct MeshField {
  std::string name;  ///< with its unit: "von_mises_pa"
  Eigen::MatrixXd values;
};

/// The mesh as quadratic triangles (VTK cell type 22: corners 0, 1, 2, then the middles of 01, 12, 20, the order of
/// fem::Mesh) or as 18-node wedges (VTK_BIQUADRATIC_QUADRATIC_WEDGE, 32: lower and upper corners, edges of the lower
/// and the upper triangle, uprights, sides) with point and cell fields; region and body of every element are added as
/// "region" and "body"; `constants` are numbers of the whole file (field data). VTK XML UnstructuredGrid, numbers as
/// inline base64, little endian; m. Throws InputError when a field's size does not fit the mesh or two fields share a
/// name.
[[nodiscard]] std::string vtu(const fem::Mesh& mesh, std::span<const MeshField> point_fields,
                              std::span<const MeshField> cell_fields = {},
                              const std::map<std::string, std::vector<double>>& constants = {});

/// Writes that file beside its place and renames it. Throws InputError, also when it cannot be written.
void write_vtu(const std::filesystem::path& file, const fem::Mesh& mesh, std::span<const MeshField> point_fields,
               std::span<const MeshField> cell_fields = {},
               const std::map<std::string, std::vector<double>>& constants = {});

}  // namespace dovetail::geometry
