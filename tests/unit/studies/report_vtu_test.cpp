#include <gtest/gtest.h>

#include <cstring>
#include <map>

#include "core/errors.hpp"
#include "geometry/exports/vtu.hpp"
#include "tests/unit/studies/report_markup.hpp"

namespace dovetail::geometry {
namespace {

std::string decoded(const std::string& text) {
  const std::string letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  for (std::size_t i = 0; i + 3 < text.size(); i += 4) {
    std::uint32_t triple = 0;
    for (std::size_t k = 0; k < 4; ++k)
      triple = triple << 6U | (text[i + k] == '=' ? 0U : static_cast<std::uint32_t>(letters.find(text[i + k])));
    for (std::size_t k = 0; k < 3; ++k)
      if (text[i + 3] != '=' || k < (text[i + 2] == '=' ? 1U : 2U))
        bytes += static_cast<char>(triple >> (16U - 8U * static_cast<unsigned>(k)) & 255U);
  }
  return bytes;
}

/// The values of a data array.
template <class T>
std::vector<T> array(const std::string& file, const std::string& name, int components) {
  const std::size_t tag = file.find("Name=\"" + name + "\" NumberOfComponents=\"" + std::to_string(components) + "\"");
  EXPECT_NE(tag, std::string::npos) << name;
  const std::size_t begin = file.find('>', tag) + 1;
  const std::string bytes = decoded(file.substr(begin, file.find('<', begin) - begin));
  std::uint64_t size = 0;
  EXPECT_GE(bytes.size(), sizeof(size));
  std::memcpy(&size, bytes.data(), sizeof(size));
  EXPECT_EQ(bytes.size(), sizeof(size) + size) << name;
  std::vector<T> values(size / sizeof(T));
  std::memcpy(values.data(), bytes.data() + sizeof(size), size);
  return values;
}

/// Two triangles on the unit square, the diagonal bulged so that a wrong order of middle nodes shows.
fem::Mesh square() {
  fem::Mesh mesh;
  mesh.nodes.resize(2, 9);
  mesh.nodes << 0, 1, 1, 0, 0.5, 1, 0.5, 0, 0.6,  //
      0, 0, 1, 1, 0, 0.5, 1, 0.5, 0.4;
  mesh.connectivity = {0, 1, 2, 4, 5, 8, 0, 2, 3, 8, 6, 7};
  mesh.region = {0, 1};
  mesh.regions = {{.name = "blade_root", .body = 0, .thickness = 1}, {.name = "disk", .body = 1, .thickness = 1}};
  return mesh;
}

TEST(Vtu, ReadsBackWithVtksOrderOfQuadraticTriangles) {
  const fem::Mesh mesh = square();
  const Eigen::MatrixXd pressure = Eigen::RowVectorXd::LinSpaced(9, -1, 1);
  const Eigen::MatrixXd displacement = Eigen::MatrixXd::Random(2, 9);
  const Eigen::MatrixXd energy = Eigen::RowVector2d(0.1, 1e300);
  const std::vector<MeshField> points{{"pressure_pa", pressure}, {"displacement_m", displacement}};
  const std::vector<MeshField> cells{{"energy_j", energy}};
  const std::string file = vtu(mesh, points, cells);
  EXPECT_EQ(report::markup_error(file), "");

  EXPECT_EQ(array<std::uint8_t>(file, "types", 1), (std::vector<std::uint8_t>{22, 22}));
  EXPECT_EQ(array<std::int64_t>(file, "offsets", 1), (std::vector<std::int64_t>{6, 12}));
  EXPECT_EQ(array<std::int64_t>(file, "region", 1), (std::vector<std::int64_t>{0, 1}));
  EXPECT_EQ(array<std::int64_t>(file, "body", 1), (std::vector<std::int64_t>{0, 1}));

  // VTK_QUADRATIC_TRIANGLE: nodes 3, 4, 5 are in the middle of (0,1), (1,2), (2,0). The straight sides of the square
  // must hold their middles exactly, the diagonal's is 0.1 sqrt(2) off.
  const std::vector<std::int64_t> nodes = array<std::int64_t>(file, "connectivity", 1);
  const std::vector<double> at = array<double>(file, "Points", 3);
  ASSERT_EQ(nodes.size(), 12U);
  ASSERT_EQ(at.size(), 27U);
  for (std::size_t element = 0; element < 2; ++element) {
    for (std::size_t side = 0; side < 3; ++side) {
      const auto point = [&](std::size_t local) {
        const auto n = static_cast<std::size_t>(nodes[6 * element + local]);
        return Eigen::Vector3d(at[3 * n], at[3 * n + 1], at[3 * n + 2]);
      };
      const Eigen::Vector3d chord = 0.5 * (point(side) + point((side + 1) % 3));
      const bool diagonal = std::abs(point(side).x() - point((side + 1) % 3).x()) > 0.9 &&
                            std::abs(point(side).y() - point((side + 1) % 3).y()) > 0.9;
      EXPECT_NEAR((point(3 + side) - chord).norm(), diagonal ? 0.1 * std::sqrt(2.0) : 0.0, 1e-15);
    }
  }

  const std::vector<double> scalar = array<double>(file, "pressure_pa", 1);
  for (std::size_t i = 0; i < 9; ++i) EXPECT_EQ(scalar[i], pressure(0, static_cast<Eigen::Index>(i)));
  const std::vector<double> vector = array<double>(file, "displacement_m", 3);
  for (std::size_t i = 0; i < 9; ++i) {
    EXPECT_EQ(vector[3 * i], displacement(0, static_cast<Eigen::Index>(i)));
    EXPECT_EQ(vector[3 * i + 1], displacement(1, static_cast<Eigen::Index>(i)));
    EXPECT_EQ(vector[3 * i + 2], 0.0);
  }
  EXPECT_EQ(array<double>(file, "energy_j", 1), (std::vector<double>{0.1, 1e300}));
}

TEST(Vtu, HasNumbersOfTheWholeFile) {
  const std::string file = vtu(square(), {}, {}, {{"mode_frequency_hz", {490.5, 2000, 1e300}}});
  EXPECT_EQ(report::markup_error(file), "");
  EXPECT_LT(file.find("<FieldData>"), file.find("<Piece"));
  EXPECT_NE(file.find("NumberOfTuples=\"3\""), std::string::npos);
  EXPECT_EQ(array<double>(file, "mode_frequency_hz", 1), (std::vector<double>{490.5, 2000, 1e300}));
}

TEST(Vtu, RefusesFieldsThatDoNotFit) {
  const fem::Mesh mesh = square();
  const Eigen::MatrixXd nodal = Eigen::MatrixXd::Zero(1, 9), elementwise = Eigen::MatrixXd::Zero(1, 2);
  const auto refused = [&](std::vector<MeshField> points, std::vector<MeshField> cells) {
    try {
      (void)vtu(mesh, points, cells);
    } catch (const InputError&) {
      return true;
    }
    return false;
  };
  EXPECT_FALSE(refused({{"a", nodal}}, {{"a", elementwise}}));
  EXPECT_TRUE(refused({{"a", elementwise}}, {}));
  EXPECT_TRUE(refused({}, {{"a", nodal}}));
  EXPECT_TRUE(refused({{"a", nodal}, {"a", nodal}}, {}));
  EXPECT_TRUE(refused({}, {{"region", elementwise}}));
}

}  // namespace
}  // namespace dovetail::geometry
