#include "studies/report/results_archive.hpp"

#include <array>

namespace dovetail::report {

namespace {

Numbers coordinates(const geometry::Chain& chain, Eigen::Vector2d geometry::Edge::*member) {
  Numbers result;
  for (const geometry::Edge& e : chain) {
    result.push_back((e.*member).x());
    result.push_back((e.*member).y());
  }
  return result;
}

}  // namespace

void Writer::table(const std::string& path, const Numbers& values, std::size_t columns) {
  const std::array<std::size_t, 2> shape{columns == 0 ? 0 : values.size() / columns, columns};
  file_.write(path, values, shape);
}

void Writer::values(const std::string& group, const std::map<std::string, double>& named) {
  std::vector<std::string> names;
  Numbers list;
  for (const auto& [name, value] : named) {
    names.push_back(name);
    list.push_back(value);
  }
  texts(group + "/names", names);
  numbers(group + "/values", list);
}

void Writer::chain(const std::string& group, const geometry::Chain& chain) {
  std::vector<std::string> names;
  Numbers radius, sweep;
  for (const geometry::Edge& e : chain) {
    names.push_back(e.name);
    radius.push_back(e.radius);
    sweep.push_back(e.sweep);
  }
  texts(group + "/name", names);
  table(group + "/start_m", coordinates(chain, &geometry::Edge::start), 2);
  table(group + "/end_m", coordinates(chain, &geometry::Edge::end), 2);
  table(group + "/center_m", coordinates(chain, &geometry::Edge::center), 2);
  numbers(group + "/radius_m", radius);
  numbers(group + "/sweep_rad", sweep);
}

void Writer::mesh(const std::string& group, const fem::Mesh& mesh) {
  table(group + "/nodes_m", {mesh.nodes.data(), mesh.nodes.data() + mesh.nodes.size()},
        static_cast<std::size_t>(mesh.dimensions()));
  const std::vector<std::int64_t> elements(mesh.connectivity.begin(), mesh.connectivity.end());
  const std::array<std::size_t, 2> shape{static_cast<std::size_t>(mesh.element_count()),
                                         static_cast<std::size_t>(mesh.nodes_per_element())};
  file_.write(group + "/elements", elements, shape);
  wholes(group + "/region", {mesh.region.begin(), mesh.region.end()});
  std::vector<std::string> names;
  std::vector<std::int64_t> body, plane_stress;
  Numbers thickness;
  for (const fem::Region& region : mesh.regions) {
    names.push_back(region.name);
    body.push_back(region.body);
    plane_stress.push_back(region.plane_stress ? 1 : 0);
    thickness.push_back(region.thickness);
  }
  texts(group + "/regions/name", names);
  wholes(group + "/regions/body", body);
  wholes(group + "/regions/plane_stress", plane_stress);
  numbers(group + "/regions/thickness_m", thickness);
}

void Writer::text(const std::string& group, const std::string& name, const std::string& value) {
  file_.write_attribute(group, name, value);
}
void Writer::whole(const std::string& group, const std::string& name, std::int64_t value) {
  file_.write_attribute(group, name, value);
}
void Writer::number(const std::string& group, const std::string& name, double value) {
  file_.write_attribute(group, name, value);
}

void Reader::refuse(const std::string& path, const std::string& value, const std::string& allowed) const {
  throw InputError({.file = file_.path(), .key = path, .value = value, .allowed = allowed});
}

void Reader::require_size(const std::string& path, std::size_t found, std::size_t expected) const {
  if (found != expected)
    refuse(path, std::to_string(found) + " entries", "must have " + std::to_string(expected) + " entries");
}

void Reader::numbers(const std::string& path, Numbers& values) const {
  hdf5::Array<double> array = file_.read_reals(path);
  if (array.rank() != 1) refuse(path, "rank " + std::to_string(array.rank()), "must be a list");
  values = std::move(array.values);
}

void Reader::later_numbers(const std::string& path, Numbers& values) const {
  values.clear();
  if (file_.exists(path)) numbers(path, values);
}

void Reader::table(const std::string& path, Numbers& values, std::size_t columns) const {
  hdf5::Array<double> array = file_.read_reals(path);
  if (array.rank() != 2 || (array.shape[1] != columns && !array.values.empty()))
    refuse(path, {}, "must have " + std::to_string(columns) + " columns");
  values = std::move(array.values);
}

void Reader::wholes(const std::string& path, std::vector<std::int64_t>& values) const {
  hdf5::Array<std::int64_t> array = file_.read_integers(path);
  if (array.rank() != 1) refuse(path, "rank " + std::to_string(array.rank()), "must be a list");
  values = std::move(array.values);
}

void Reader::texts(const std::string& path, std::vector<std::string>& values) const {
  values = file_.read_strings(path).values;
}

void Reader::values(const std::string& group, std::map<std::string, double>& named) const {
  std::vector<std::string> names;
  Numbers list;
  texts(group + "/names", names);
  numbers(group + "/values", list);
  require_size(group + "/values", list.size(), names.size());
  named.clear();
  for (std::size_t i = 0; i < names.size(); ++i) named[names[i]] = list[i];
}

void Reader::chain(const std::string& group, geometry::Chain& chain) const {
  std::vector<std::string> names;
  Numbers start, end, center, radius, sweep;
  texts(group + "/name", names);
  table(group + "/start_m", start, 2);
  table(group + "/end_m", end, 2);
  table(group + "/center_m", center, 2);
  numbers(group + "/radius_m", radius);
  numbers(group + "/sweep_rad", sweep);
  for (const auto& [name, list] : {std::pair{"/start_m", &start}, {"/end_m", &end}, {"/center_m", &center}})
    require_size(group + name, list->size(), 2 * names.size());
  for (const auto& [name, list] : {std::pair{"/radius_m", &radius}, {"/sweep_rad", &sweep}})
    require_size(group + name, list->size(), names.size());
  chain.clear();
  for (std::size_t i = 0; i < names.size(); ++i)
    chain.push_back({.name = names[i],
                     .start = {start[2 * i], start[2 * i + 1]},
                     .end = {end[2 * i], end[2 * i + 1]},
                     .center = {center[2 * i], center[2 * i + 1]},
                     .radius = radius[i],
                     .sweep = sweep[i]});
}

void Reader::mesh(const std::string& group, fem::Mesh& mesh) const {
  const hdf5::Array<std::int64_t> elements = file_.read_integers(group + "/elements");
  if (elements.rank() != 2 || (elements.shape[1] != 6 && elements.shape[1] != 18))
    refuse(group + "/elements", {}, "must have 6 or 18 nodes per element");
  mesh.kind = elements.shape[1] == 6 ? fem::ElementKind::triangle6 : fem::ElementKind::wedge18;
  Numbers nodes;
  const Eigen::Index d = mesh.dimensions();
  table(group + "/nodes_m", nodes, static_cast<std::size_t>(d));
  mesh.nodes = Eigen::Map<const Eigen::MatrixXd>(nodes.data(), d, static_cast<Eigen::Index>(nodes.size()) / d);

  std::vector<std::int64_t> region, body, plane_stress;
  std::vector<std::string> names;
  Numbers thickness;
  wholes(group + "/region", region);
  texts(group + "/regions/name", names);
  wholes(group + "/regions/body", body);
  wholes(group + "/regions/plane_stress", plane_stress);
  numbers(group + "/regions/thickness_m", thickness);
  require_size(group + "/regions/body", body.size(), names.size());
  require_size(group + "/regions/plane_stress", plane_stress.size(), names.size());
  require_size(group + "/regions/thickness_m", thickness.size(), names.size());
  require_size(group + "/elements", elements.values.size(), elements.shape[1] * region.size());

  mesh.regions.clear();
  for (std::size_t i = 0; i < names.size(); ++i)
    mesh.regions.push_back({.name = names[i],
                            .body = static_cast<int>(body[i]),
                            .thickness = thickness[i],
                            .plane_stress = plane_stress[i] != 0});
  mesh.connectivity.clear();
  for (const std::int64_t node : elements.values) {
    if (node < 0 || node >= mesh.node_count())
      refuse(group + "/elements", std::to_string(node), "must be indices of nodes");
    mesh.connectivity.push_back(static_cast<int>(node));
  }
  mesh.region.clear();
  for (const std::int64_t index : region) {
    if (index < 0 || index >= static_cast<std::int64_t>(names.size()))
      refuse(group + "/region", std::to_string(index), "must be indices of regions");
    mesh.region.push_back(static_cast<int>(index));
  }
}

void Reader::group(const std::string& path) const {
  if (!file_.is_group(path)) refuse(path, {}, "the group is missing");
}
void Reader::text(const std::string& group, const std::string& name, std::string& value) const {
  value = file_.string_attribute(group, name);
}
void Reader::whole(const std::string& group, const std::string& name, std::int64_t& value) const {
  value = file_.integer_attribute(group, name);
}
void Reader::number(const std::string& group, const std::string& name, double& value) const {
  value = file_.real_attribute(group, name);
}

}  // namespace dovetail::report
