#include <dxflib/dl_creationadapter.h>
#include <dxflib/dl_dxf.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <fstream>
#include <map>
#include <numbers>
#include <sstream>

#include "core/errors.hpp"
#include "geometry/exports/dxf.hpp"
#include "geometry/exports/svg.hpp"
#include "geometry/profile/measures.hpp"

namespace dovetail::geometry {
namespace {

using Eigen::Vector2d;

/// A folder of its own, removed at the end.
class ExportTest : public testing::Test {
 protected:
  void SetUp() override { std::filesystem::create_directories(folder_); }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  const std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() /
      ("dovetail_export_" + std::to_string(getpid()) + testing::UnitTest::GetInstance()->current_test_info()->name());

  [[nodiscard]] std::size_t files() const {
    return static_cast<std::size_t>(
        std::distance(std::filesystem::directory_iterator(folder_), std::filesystem::directory_iterator{}));
  }
};
using Dxf = ExportTest;
using Svg = ExportTest;

ProfileParameters formed_design() {
  ProfileParameters p;
  p.flank("right").mismatch = 15e-6;
  p.flank("right").crown = 8e-6;
  p.flank("left").relief_length = 1e-3;
  p.flank("left").relief_depth = 10e-6;
  return p;
}

/// One entity as read: in mm and degrees.
struct Entity {
  std::string layer;
  bool arc;
  Vector2d start, end, center;
  double radius, first, last;
};

class Reader : public DL_CreationAdapter {
 public:
  std::vector<Entity> entities;
  std::vector<std::string> layers;
  int unit = -1;
  void addLayer(const DL_LayerData& layer) override { layers.push_back(layer.name); }
  void addLine(const DL_LineData& l) override {
    entities.push_back({getAttributes().getLayer(), false, {l.x1, l.y1}, {l.x2, l.y2}, {0, 0}, 0, 0, 0});
  }
  void addArc(const DL_ArcData& a) override {
    entities.push_back({getAttributes().getLayer(), true, {0, 0}, {0, 0}, {a.cx, a.cy}, a.radius, a.angle1, a.angle2});
  }
  void setVariableInt(const std::string& key, int value, int) override {
    if (key == "$INSUNITS") unit = value;
  }
};

// Readers that check a file repair one whose objects do not.
TEST_F(Dxf, SaysWhoOwnsEachObject) {
  const std::filesystem::path file = folder_ / "section.dxf";
  write_dxf(file, section_layers({}));
  std::ifstream stream(file);
  std::map<std::string, std::string> owners;
  std::vector<std::string> listed;
  std::string code, value, object;
  bool objects = false;
  while (std::getline(stream, code) && std::getline(stream, value)) {
    const int number = std::stoi(code);
    objects = objects || (number == 2 && value == "OBJECTS");
    if (!objects) continue;
    if (number == 5) owners.emplace(object = value, "");
    if (number == 330 && owners[object].empty()) owners[object] = value;
    if (number == 350) listed.push_back(value);
  }
  EXPECT_GT(owners.size(), 8U);
  int roots = 0;
  for (const auto& [handle, owner] : owners)
    if (owner == "0")
      ++roots;
    else
      EXPECT_TRUE(owners.contains(owner)) << handle << " is owned by " << owner;
  EXPECT_EQ(roots, 1);
  for (const std::string& handle : listed) EXPECT_TRUE(owners.contains(handle)) << handle;
}

TEST_F(Dxf, IsReadBackWithTheSameLinesAndArcs) {
  const std::filesystem::path file = folder_ / "section.dxf";
  const std::vector<Layer> layers = section_layers(formed_design());
  write_dxf(file, layers);
  Reader reader;
  DL_Dxf dxf;
  ASSERT_TRUE(dxf.in(file.string(), &reader));
  EXPECT_EQ(reader.unit, 4) << "millimetres";
  EXPECT_THAT(reader.layers, testing::IsSupersetOf({"BLADE", "DISK"}));

  std::size_t next = 0;
  for (const Layer& layer : layers)
    for (const Edge& e : layer.chain) {
      ASSERT_LT(next, reader.entities.size());
      const Entity& read = reader.entities[next++];
      EXPECT_EQ(read.layer, layer.name);
      ASSERT_EQ(read.arc, e.is_arc()) << e.name;
      if (!read.arc) {
        EXPECT_NEAR((read.start - 1e3 * e.start).norm() + (read.end - 1e3 * e.end).norm(), 0, 1e-12) << e.name;
        continue;
      }
      // 16 digits after the point; centres of flat arcs lie some 1000 mm away.
      EXPECT_NEAR((read.center - 1e3 * e.center).norm(), 0, 1e-9) << e.name;
      EXPECT_NEAR(read.radius, 1e3 * e.radius, 1e-9) << e.name;
      const auto at = [&](double degrees) {
        const double angle = degrees * std::numbers::pi / 180;
        return Vector2d(read.center + read.radius * Vector2d(std::cos(angle), std::sin(angle)));
      };
      const Vector2d first = e.sweep > 0 ? e.start : e.end;
      const Vector2d last = e.sweep > 0 ? e.end : e.start;
      EXPECT_NEAR((at(read.first) - 1e3 * first).norm(), 0, 1e-9) << e.name;
      EXPECT_NEAR((at(read.last) - 1e3 * last).norm(), 0, 1e-9) << e.name;
      double turn = read.last - read.first;
      if (turn < 0) turn += 360;
      EXPECT_NEAR(turn, std::abs(e.sweep) * 180 / std::numbers::pi, 1e-7) << e.name;
    }
  EXPECT_EQ(next, reader.entities.size());
  EXPECT_EQ(files(), 1U) << "no temporary file is left";
}

TEST_F(Dxf, RefusesAPlaceThatCannotBeWritten) {
  const std::vector<Layer> layers = section_layers({});
  EXPECT_THROW(write_dxf(folder_ / "absent" / "section.dxf", layers), InputError);
}

TEST_F(Svg, DrawsOnePathPerLayerInMillimetres) {
  const std::vector<Layer> layers = section_layers({});
  const std::string drawing = svg(layers);
  EXPECT_THAT(drawing, testing::StartsWith("<svg xmlns=\"http://www.w3.org/2000/svg\""));
  EXPECT_THAT(drawing, testing::EndsWith("</svg>\n"));
  EXPECT_THAT(drawing, testing::HasSubstr("<path class=\"blade\" d=\"M "));
  EXPECT_THAT(drawing, testing::HasSubstr("<path class=\"disk\" d=\"M "));
  EXPECT_THAT(drawing, testing::Not(testing::HasSubstr("nan")));
}

/// Follows the path data of one layer and returns the area it encloses, in mm2, positive counter-clockwise as seen.
double drawn_area(const std::string& drawing, const std::string& layer) {
  const std::string head = "<path class=\"" + layer + "\" d=\"";
  const auto from = drawing.find(head) + head.size();
  std::istringstream data(drawing.substr(from, drawing.find('"', from) - from));
  double doubled = 0;
  Vector2d at(0, 0), to(0, 0);
  char command = 0;
  while (data >> command && command != 'Z') {
    double rx = 0, ry = 0, turn = 0;
    int large = 0, clockwise = 0;
    if (command == 'A') data >> rx >> ry >> turn >> large >> clockwise;
    data >> to.x() >> to.y();
    to.y() = -to.y();
    if (command != 'M') doubled += at.x() * to.y() - at.y() * to.x();
    if (command == 'A') {
      double sweep = 2 * std::asin((to - at).norm() / (2 * rx));
      if (large == 1) sweep = 2 * std::numbers::pi - sweep;
      doubled += (clockwise == 1 ? -1 : 1) * rx * rx * (sweep - std::sin(sweep));
    }
    at = to;
  }
  return doubled / 2;
}

TEST_F(Svg, EnclosesTheAreaOfTheChainsByItsArcs) {
  const std::vector<Layer> layers = section_layers(formed_design());
  const std::string drawing = svg(layers);
  // Coordinates are rounded to 1e-6 mm along boundaries below 1000 mm.
  EXPECT_NEAR(drawn_area(drawing, "blade"), 1e6 * area(layers[0].chain), 1e-3);
  EXPECT_NEAR(drawn_area(drawing, "disk"), 1e6 * area(layers[1].chain), 1e-3);
}

TEST_F(Svg, ShowsTheWindowAskedFor) {
  const Eigen::AlignedBox2d window(Vector2d(-0.012, 0.238), Vector2d(0.013, 0.256));
  EXPECT_THAT(svg(section_layers({}), window),
              testing::HasSubstr("width=\"25mm\" height=\"18mm\" viewBox=\"-12 -256 25 18\""));
}

TEST_F(Svg, IsWrittenToAFile) {
  const std::vector<Layer> layers = section_layers({});
  write_svg(folder_ / "section.svg", layers);
  std::ifstream in(folder_ / "section.svg");
  std::stringstream text;
  text << in.rdbuf();
  EXPECT_EQ(text.str(), svg(layers));
  EXPECT_EQ(files(), 1U);
}

}  // namespace
}  // namespace dovetail::geometry
