#include "studies/report/record/results_archive.hpp"

#include <array>
#include <limits>
#include <set>

namespace dovetail::report {

void Archive::refuse(const std::string& path, const std::string& value, const std::string& allowed) const {
  throw InputError({.file = file_.path(), .key = path, .value = value, .allowed = allowed});
}

void Archive::require_size(const std::string& path, std::size_t found, std::size_t expected) const {
  if (found != expected)
    refuse(path, std::to_string(found) + " entries", "must have " + std::to_string(expected) + " entries");
}

void Archive::read(const std::string& path, Numbers& values) const {
  values = list(path, file_.read_reals(path));
}
void Archive::read(const std::string& path, Wholes& values) const {
  values = list(path, file_.read_integers(path));
}
void Archive::read(const std::string& path, Texts& values) const {
  values = file_.read_strings(path).values;
}

std::size_t Archive::table(const std::string& path, Numbers& values, std::size_t columns) {
  if (out_) {
    const std::array<std::size_t, 2> shape{columns == 0 ? 0 : values.size() / columns, columns};
    out_->write(path, values, shape);
    return columns;
  }
  hdf5::Array<double> array = file_.read_reals(path);
  if (array.rank() != 2) refuse(path, "rank " + std::to_string(array.rank()), "must be a table");
  values = std::move(array.values);
  return array.shape[1];
}

void Archive::exchange(const std::string& group, const std::string& name, std::optional<std::size_t>& index) {
  std::int64_t value = index ? static_cast<std::int64_t>(*index) : -1;
  exchange(group, name, value);
  if (value < -1) refuse(name, std::to_string(value), "must be the index of an evaluation, or -1");
  if (value >= 0) index = static_cast<std::size_t>(value);
}

template <class List, class Map>
void Archive::exchange_pairs(const std::string& group, const std::array<std::string, 2>& written, Map& map) {
  Texts names;
  List values;
  for (const auto& [name, value] : map) {
    names.push_back(name);
    values.push_back(value);
  }
  exchange(group, written[0], names);
  exchange(group, written[1], values);
  require_size(in(group, written[1]), values.size(), names.size());
  for (std::size_t i = 0; i < names.size(); ++i) map[names[i]] = values[i];
}

void Archive::exchange(const std::string& group, const std::string& name, NamedValues& values) {
  exchange_pairs<Numbers>(in(group, name), {"names", "values"}, values);
}

void Archive::exchange(const std::string& group, const std::string& name, std::map<std::string, std::string>& values) {
  exchange_pairs<Texts>(group, {name + "_names", name + "_values"}, values);
}

void Archive::exchange(const std::string& group, const std::string& name, fem::Mesh& mesh) {
  const std::string own = in(group, name), at = own + "/elements";
  Wholes elements(mesh.connectivity.begin(), mesh.connectivity.end());
  if (out_) {
    const std::array<std::size_t, 2> shape{static_cast<std::size_t>(mesh.element_count()),
                                           static_cast<std::size_t>(mesh.nodes_per_element())};
    out_->write(at, elements, shape);
  } else {
    hdf5::Array<std::int64_t> array = file_.read_integers(at);
    if (array.rank() != 2 || (array.shape[1] != 6 && array.shape[1] != 18))
      refuse(at, {}, "must have 6 or 18 nodes per element");
    mesh.kind = array.shape[1] == 6 ? fem::ElementKind::triangle6 : fem::ElementKind::wedge18;
    elements = std::move(array.values);
  }
  const auto d = static_cast<std::size_t>(mesh.dimensions());
  Numbers nodes(mesh.nodes.data(), mesh.nodes.data() + mesh.nodes.size());
  if (table(own + "/nodes_m", nodes, d) != d && !nodes.empty())
    refuse(own + "/nodes_m", {}, "must have " + std::to_string(d) + " columns");
  Wholes region(mesh.region.begin(), mesh.region.end());
  exchange(own, "region", region);
  exchange(own, "regions", mesh.regions);
  if (out_) return;
  mesh.nodes = Eigen::Map<const Eigen::MatrixXd>(nodes.data(), static_cast<Eigen::Index>(d),
                                                 static_cast<Eigen::Index>(nodes.size() / d));
  require_size(at, elements.size(), static_cast<std::size_t>(mesh.nodes_per_element()) * region.size());
  const auto indices = [&](const std::string& path, const Wholes& list, std::size_t count, const char* what) {
    for (const std::int64_t index : list)
      if (index < 0 || index >= static_cast<std::int64_t>(count))
        refuse(path, std::to_string(index), std::string("must be indices of ") + what);
    return std::vector<int>(list.begin(), list.end());
  };
  mesh.connectivity = indices(at, elements, static_cast<std::size_t>(mesh.node_count()), "nodes");
  mesh.region = indices(own + "/region", region, mesh.regions.size(), "regions");
}

void Archive::exchange(const std::string& group, const std::string& name, optimizer::Problem& problem) {
  const std::string own = in(group, name);
  std::vector<optimizer::DesignVariable> variables = problem.space.variables();
  exchange(own, "variables", variables);
  exchange(own, "objective", problem.objective);
  std::int64_t front = problem.front ? 1 : 0;
  if (out_ || has_attribute(own, "front")) exchange(own, "front", front);
  problem.front = front != 0;
  exchange(own, "constraints", problem.constraints);
  if (out_ || file_.exists(in(own, "cases"))) exchange(own, "cases", problem.cases);
  if (out_ || has_attribute(own, "quantile")) exchange(own, "quantile", problem.quantile);
  if (out_)
    out_->write(in(own, "constraint_names"), constraint_names(problem));
  else
    problem.space = optimizer::DesignSpace(std::move(variables));
}

void Archive::exchange(const std::string& group, const std::string& name, Provenance& provenance) {
  const std::string own = in(group, name);
  Texts study{provenance.study_text};  // too long for an attribute
  exchange(own, "study_text", study);
  require_size(own + "/study_text", study.size(), 1);
  provenance.study_text = study.front();
  optimizer::each_field<Provenance>([&](const auto& field) { exchange_field(own, provenance, field); });
}

void Archive::column(const std::string& group, const std::string& name, std::vector<std::optional<double>>& values) {
  Numbers numbers;
  Wholes there;
  for (const std::optional<double>& value : values) {
    numbers.push_back(value.value_or(std::numeric_limits<double>::quiet_NaN()));
    there.push_back(value ? 1 : 0);
  }
  exchange(group, name, numbers);
  exchange(group, "has_" + name, there);
  require_size(in(group, "has_" + name), there.size(), numbers.size());
  values.assign(numbers.size(), std::nullopt);
  for (std::size_t i = 0; i < numbers.size(); ++i)
    if (there[i] != 0) values[i] = numbers[i];
}

void Archive::column(const std::string& group, const std::string& name, std::vector<Eigen::Vector2d>& values) {
  Numbers all;
  for (const Eigen::Vector2d& value : values) all.insert(all.end(), {value.x(), value.y()});
  if (table(in(group, name), all, 2) != 2 && !all.empty()) refuse(in(group, name), {}, "must have 2 columns");
  values.clear();
  for (std::size_t i = 0; i < all.size(); i += 2) values.emplace_back(all[i], all[i + 1]);
}

void Archive::column(const std::string& group, const std::string& name, std::vector<Numbers>& values) {
  Numbers all;
  for (const Numbers& row : values) all.insert(all.end(), row.begin(), row.end());
  const std::size_t columns = table(in(group, name), all, values.empty() ? 0 : values.front().size());
  if (out_) return;
  values.assign(columns == 0 ? values.size() : all.size() / columns, {});
  if (columns == 0) return;
  for (std::size_t i = 0; i < all.size(); ++i) values[i / columns].push_back(all[i]);
}

void Archive::column(const std::string& group, const std::string& name, std::vector<Texts>& values) {
  Wholes of;
  Texts all;
  for (std::size_t i = 0; i < values.size(); ++i)
    for (const std::string& text : values[i]) {
      of.push_back(static_cast<std::int64_t>(i));
      all.push_back(text);
    }
  exchange(in(group, name), "evaluation", of);
  exchange(in(group, name), "text", all);
  if (out_) return;
  require_size(in(group, name), all.size(), of.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (of[i] < 0 || of[i] >= static_cast<std::int64_t>(values.size()))
      refuse(in(group, name) + "/evaluation", std::to_string(of[i]), "must be indices of evaluations");
    values[static_cast<std::size_t>(of[i])].push_back(all[i]);
  }
}

void Archive::column(const std::string& group, const std::string& name, std::vector<NamedValues>& values) {
  std::set<std::string> sorted;
  for (const NamedValues& named : values)
    for (const auto& [key, value] : named) sorted.insert(key);
  Texts names(sorted.begin(), sorted.end());
  exchange(in(group, name), "names", names);
  std::vector<Numbers> rows(values.size()), there(values.size());
  for (std::size_t i = 0; i < values.size(); ++i)
    for (const std::string& key : names) {
      const auto found = values[i].find(key);
      const bool known = found != values[i].end();
      rows[i].push_back(known ? found->second : std::numeric_limits<double>::quiet_NaN());
      there[i].push_back(known ? 1 : 0);
    }
  column(in(group, name), "values", rows);
  column(in(group, name), "present", there);
  if (out_) return;
  require_size(in(group, name) + "/values", rows.size(), values.size());
  require_size(in(group, name) + "/present", there.size(), values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    require_size(in(group, name) + "/values", rows[i].size(), names.size());
    require_size(in(group, name) + "/present", there[i].size(), names.size());
    for (std::size_t k = 0; k < names.size(); ++k)
      if (there[i][k] != 0) values[i][names[k]] = rows[i][k];
  }
}

}  // namespace dovetail::report
