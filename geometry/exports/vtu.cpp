#include "geometry/exports/vtu.hpp"

#include <fmt/format.h>

#include <bit>
#include <cstdint>
#include <cstring>
#include <set>

#include "core/errors.hpp"
#include "core/replace_file.hpp"

namespace dovetail::geometry {

namespace {

static_assert(std::endian::native == std::endian::little, "the file says LittleEndian");

std::string base64(const std::string& bytes) {
  constexpr std::string_view kLetters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t triple = 0;
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    for (std::size_t k = 0; k < 3; ++k)
      triple = (triple << 8U) | (k < count ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    for (std::size_t k = 0; k < 4; ++k)
      text += k <= count ? kLetters[(triple >> (18U - 6U * static_cast<unsigned>(k))) & 63U] : '=';
  }
  return text;
}

/// Inline binary of VTK: the number of bytes as 64 bits, then the values, encoded in one piece. What belongs to points
/// or cells has as many as these, other arrays say how many they have.
template <class T>
std::string data_array(std::string_view type, const std::string& name, std::size_t components,
                       const std::vector<T>& values, const std::string& count = {}) {
  const std::uint64_t size = values.size() * sizeof(T);
  std::string bytes(sizeof(size) + size, '\0');
  std::memcpy(bytes.data(), &size, sizeof(size));
  if (size > 0) std::memcpy(bytes.data() + sizeof(size), values.data(), size);
  return fmt::format(
      "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\"{} format=\"binary\">{}</DataArray>\n", type, name,
      components, count, base64(bytes));
}

InputError refused(const std::string& field, const std::string& allowed) {
  return InputError({.file = {}, .key = "field " + field, .value = {}, .allowed = allowed});
}

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '&')
      result += "&amp;";
    else if (c == '<')
      result += "&lt;";
    else if (c == '"')
      result += "&quot;";
    else
      result += c;
  }
  return result;
}

std::string field_array(const MeshField& field) {
  const Eigen::Index components = field.values.rows() == 2 ? 3 : field.values.rows();
  std::vector<double> values;
  values.reserve(static_cast<std::size_t>(components * field.values.cols()));
  for (Eigen::Index i = 0; i < field.values.cols(); ++i)
    for (Eigen::Index k = 0; k < components; ++k) values.push_back(k < field.values.rows() ? field.values(k, i) : 0.0);
  return data_array("Float64", escaped(field.name), static_cast<std::size_t>(components), values);
}

void require_fields(std::span<const MeshField> fields, int count, const char* what, std::set<std::string> names) {
  for (const MeshField& field : fields) {
    if (field.values.rows() < 1 || field.values.cols() != count)
      throw refused(field.name, fmt::format("must have one column for each of the {} {}", count, what));
    if (!names.insert(field.name).second) throw refused(field.name, "must have a name of its own");
  }
}

/// VTK's number of a cell type and the place in our element of each of its nodes.
struct CellType {
  std::uint8_t number;
  std::vector<int> order;
};

CellType cell_type(fem::ElementKind kind) {
  if (kind == fem::ElementKind::triangle6) return {.number = 22, .order = {0, 1, 2, 3, 4, 5}};
  // Corners, then the middles of the edges of both triangles and of the uprights, then of the nine-node sides.
  return {.number = 32, .order = {0, 1, 2, 12, 13, 14, 3, 4, 5, 15, 16, 17, 6, 7, 8, 9, 10, 11}};
}

}  // namespace

std::string vtu(const fem::Mesh& mesh, std::span<const MeshField> point_fields, std::span<const MeshField> cell_fields,
                const std::map<std::string, std::vector<double>>& constants) {
  require_fields(point_fields, mesh.node_count(), "nodes", {});
  require_fields(cell_fields, mesh.element_count(), "elements", {"region", "body"});

  std::vector<double> points;
  points.reserve(static_cast<std::size_t>(3 * mesh.node_count()));
  for (Eigen::Index i = 0; i < mesh.nodes.cols(); ++i)
    for (Eigen::Index k = 0; k < 3; ++k) points.push_back(k < mesh.nodes.rows() ? mesh.nodes(k, i) : 0.0);
  const CellType cell = cell_type(mesh.kind);
  std::vector<std::int64_t> connectivity, offsets, region, body;
  for (int e = 0; e < mesh.element_count(); ++e) {
    const std::span<const int> element = mesh.element(e);
    for (const int place : cell.order) connectivity.push_back(element[static_cast<std::size_t>(place)]);
    offsets.push_back(static_cast<std::int64_t>(connectivity.size()));
    region.push_back(mesh.region[static_cast<std::size_t>(e)]);
    body.push_back(mesh.region_of(e).body);
  }
  const std::vector<std::uint8_t> types(static_cast<std::size_t>(mesh.element_count()), cell.number);

  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
      "header_type=\"UInt64\">\n";
  text += "<UnstructuredGrid>\n";
  if (!constants.empty()) {
    text += "<FieldData>\n";
    for (const auto& [name, values] : constants)
      text += data_array("Float64", escaped(name), 1, values, fmt::format(" NumberOfTuples=\"{}\"", values.size()));
    text += "</FieldData>\n";
  }
  text += fmt::format("<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n", mesh.node_count(), mesh.element_count());
  text += "<PointData>\n";
  for (const MeshField& field : point_fields) text += field_array(field);
  text +=
      "</PointData>\n<CellData>\n" + data_array("Int64", "region", 1, region) + data_array("Int64", "body", 1, body);
  for (const MeshField& field : cell_fields) text += field_array(field);
  text += "</CellData>\n<Points>\n" + data_array("Float64", "Points", 3, points) + "</Points>\n<Cells>\n";
  text += data_array("Int64", "connectivity", 1, connectivity) + data_array("Int64", "offsets", 1, offsets) +
          data_array("UInt8", "types", 1, types);
  return text + "</Cells>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
}

void write_vtu(const std::filesystem::path& file, const fem::Mesh& mesh, std::span<const MeshField> point_fields,
               std::span<const MeshField> cell_fields, const std::map<std::string, std::vector<double>>& constants) {
  const std::string text = vtu(mesh, point_fields, cell_fields, constants);
  replace_file(file, text);
}

}  // namespace dovetail::geometry
