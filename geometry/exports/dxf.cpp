#include "geometry/exports/dxf.hpp"

#include <dxflib/dl_dxf.h>

#include <cmath>
#include <fstream>
#include <memory>
#include <numbers>
#include <sstream>
#include <string>

#include "core/errors.hpp"
#include "core/replace_file.hpp"
#include "geometry/exports/dxf_owners.hpp"
#include "geometry/exports/millimetres.hpp"

namespace dovetail::geometry {

namespace {

/// Direction of a point seen from an arc's centre, degrees in [0, 360).
double direction(const Eigen::Vector2d& from) {
  const double angle = std::atan2(from.y(), from.x()) * 180 / std::numbers::pi;
  return angle < 0 ? angle + 360 : angle;
}

void write_edge(DL_Dxf& dxf, DL_WriterA& writer, const Edge& e, const std::string& layer) {
  const DL_Attributes attributes(layer, 256, -1, "BYLAYER", 1.0);
  const Eigen::Vector2d start = kPerMillimetre * e.start;
  const Eigen::Vector2d end = kPerMillimetre * e.end;
  if (!e.is_arc()) {
    dxf.writeLine(writer, DL_LineData(start.x(), start.y(), 0, end.x(), end.y(), 0), attributes);
    return;
  }
  // Arcs of a DXF file turn counter-clockwise.
  const Eigen::Vector2d center = kPerMillimetre * e.center;
  const double first = direction((e.sweep > 0 ? start : end) - center);
  const double last = direction((e.sweep > 0 ? end : start) - center);
  dxf.writeArc(writer, DL_ArcData(center.x(), center.y(), 0, kPerMillimetre * e.radius, first, last), attributes);
}

void write_tables(DL_Dxf& dxf, DL_WriterA& writer, std::span<const Layer> layers) {
  writer.sectionTables();
  dxf.writeVPort(writer);
  writer.tableLinetypes(3);
  for (const char* linetype : {"BYBLOCK", "BYLAYER", "CONTINUOUS"})
    dxf.writeLinetype(writer, DL_LinetypeData(linetype, "", 0, 0, 0.0));
  writer.tableEnd();
  writer.tableLayers(static_cast<int>(layers.size()) + 1);
  const auto write_layer = [&](const std::string& name, int color) {
    dxf.writeLayer(writer, DL_LayerData(name, 0), DL_Attributes(name, color, 25, "CONTINUOUS", 1.0));
  };
  write_layer("0", DL_Codes::black);
  int color = DL_Codes::red;
  for (const Layer& layer : layers) write_layer(layer.name, color++);
  writer.tableEnd();
  writer.tableStyle(1);
  dxf.writeStyle(writer, DL_StyleData("Standard", 0, 0.0, 1.0, 0.0, 0, 2.5, "txt", ""));
  writer.tableEnd();
  dxf.writeView(writer);
  dxf.writeUcs(writer);
  writer.tableAppid(1);
  dxf.writeAppid(writer, "ACAD");
  writer.tableEnd();
  dxf.writeDimStyle(writer, 1, 1, 1, 1, 1);
  dxf.writeBlockRecord(writer);
  writer.tableEnd();
  writer.sectionEnd();
}

void write_blocks(DL_Dxf& dxf, DL_WriterA& writer) {
  writer.sectionBlocks();
  for (const char* block : {"*Model_Space", "*Paper_Space", "*Paper_Space0"}) {
    dxf.writeBlock(writer, DL_BlockData(block, 0, 0.0, 0.0, 0.0));
    dxf.writeEndBlock(writer, block);
  }
  writer.sectionEnd();
}

/// The writer does not report a full disk; a complete file ends with this line.
bool is_complete(const std::string& text) {
  return text.ends_with("EOF\n");
}

bool write_file(const std::filesystem::path& file, std::span<const Layer> layers) {
  constexpr int kUnitMillimetre = 4;
  DL_Dxf dxf;
  const std::unique_ptr<DL_WriterA> writer(dxf.out(file.c_str(), DL_Codes::AC1015));
  if (!writer || writer->openFailed()) return false;
  dxf.writeHeader(*writer);
  writer->dxfString(9, "$INSUNITS");
  writer->dxfInt(70, kUnitMillimetre);
  writer->sectionEnd();
  write_tables(dxf, *writer, layers);
  write_blocks(dxf, *writer);
  writer->sectionEntities();
  for (const Layer& layer : layers)
    for (const Edge& e : layer.chain) write_edge(dxf, *writer, e, layer.name);
  writer->sectionEnd();
  dxf.writeObjects(*writer);
  dxf.writeObjectsEnd(*writer);
  writer->dxfEOF();
  writer->close();
  std::ostringstream written;
  written << std::ifstream(file).rdbuf();
  const std::string whole = with_owners(written.str());
  std::ofstream again(file, std::ios::trunc);
  return is_complete(whole) && again << whole << std::flush;
}

}  // namespace

void write_dxf(const std::filesystem::path& file, std::span<const Layer> layers) {
  dovetail::replace_file(file, [&](const std::filesystem::path& place) {
    if (!write_file(place, layers))
      throw InputError({.file = {}, .key = file.string(), .value = {}, .allowed = "cannot be written completely"});
  });
}

}  // namespace dovetail::geometry
