#pragma once

#include <array>
#include <concepts>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/hdf5_file.hpp"
#include "studies/report/record/record_tables.hpp"

namespace dovetail::report {

using Wholes = std::vector<std::int64_t>;
using Texts = std::vector<std::string>;
using NamedValues = std::map<std::string, double>;

/// Records to a results file or from it, by their tables of fields: one function serves both ways, so that they cannot
/// drift apart. A record is a group; its texts and numbers are attributes, its lists and tables data sets, its records
/// groups. The root is the group "". What is inconsistent in a file read is an InputError naming file and data set.
class Archive {
 public:
  /// Writes what it is given.
  explicit Archive(hdf5::File& file) : file_(file), out_(&file) {}
  /// Reads into what it is given.
  explicit Archive(const hdf5::File& file) : file_(file) {}

  template <optimizer::Record R>
  void exchange(const std::string& group, const std::string& name, R& record) {
    const std::string own = in(group, name);
    if (out_ && !own.empty() && !file_.exists(own)) out_->make_group(own);
    optimizer::each_field<R>([&](const auto& field) { exchange_field(own, record, field); });
    if (!out_) require_consistent(own, record);
  }
  template <optimizer::Record R>
  void exchange(const std::string& group, const std::string& name, std::optional<R>& record) {
    if (!out_ && file_.exists(in(group, name))) record.emplace();
    if (record) exchange(group, name, *record);
  }
  template <optimizer::Record R>
  void exchange(const std::string& group, const std::string& name, std::vector<R>& list) {
    const std::string own = in(group, name);
    if constexpr (kInColumns<R>) {
      bool first = true;
      optimizer::each_field<R>([&](const auto& field) {
        exchange_column(own, field, list, first);
        first = false;
      });
    } else {
      if (out_) out_->make_group(own);
      if (!out_) list.resize(file_.members(own).size());
      for (std::size_t i = 0; i < list.size(); ++i) exchange(own, std::to_string(i), list[i]);
    }
  }
  template <OneOf<std::string, double, std::int64_t> T>
  void exchange(const std::string& group, const std::string& name, T& value) {
    const std::string object = group.empty() ? "/" : group;
    out_ ? out_->write_attribute(object, name, value) : read(object, name, value);
  }
  template <OneOf<Numbers, Wholes, Texts> T>
  void exchange(const std::string& group, const std::string& name, T& values) {
    out_ ? out_->write(in(group, name), values) : read(in(group, name), values);
  }
  /// -1 stands for none.
  void exchange(const std::string& group, const std::string& name, std::optional<std::size_t>& index);
  void exchange(const std::string& group, const std::string& name, NamedValues& values);
  void exchange(const std::string& group, const std::string& name, std::map<std::string, std::string>& values);
  void exchange(const std::string& group, const std::string& name, fem::Mesh& mesh);
  void exchange(const std::string& group, const std::string& name, optimizer::Problem& problem);
  void exchange(const std::string& group, const std::string& name, Provenance& provenance);

  void require_consistent(const std::string& group, const RunRecord& record) const;
  [[noreturn]] void refuse(const std::string& path, const std::string& value, const std::string& allowed) const;

 private:
  [[nodiscard]] static std::string in(const std::string& group, const std::string& name) {
    return name.empty() ? group : group + "/" + name;
  }
  [[nodiscard]] bool has_attribute(const std::string& group, const std::string& name) const {
    return file_.has_attribute(group.empty() ? "/" : group, name);
  }
  template <class R, class Field>
  void exchange_field(const std::string& group, R& record, const Field& field) {
    const std::string path = in(group, field.name);
    if constexpr (requires { field.columns; }) {
      const std::size_t columns = table(path, record.*field.member, out_ ? field.columns(record) : 0);
      if ((record.*field.member).empty() || columns == field.columns(record)) return;
      refuse(path, {}, "must have " + std::to_string(field.columns(record)) + " columns");
    } else if (out_ || !field.later || file_.exists(path) || file_.exists(path + "_names") ||
               has_attribute(group, field.name)) {
      exchange(group, field.name, record.*field.member);
    }
  }
  template <class R, class T>
  void exchange_column(const std::string& group, const optimizer::RecordField<R, T>& field, std::vector<R>& list,
                       bool first) {
    if (!out_ && field.later && !file_.exists(in(group, field.name))) return;
    std::vector<T> values;
    for (const R& record : list) values.push_back(record.*field.member);
    column(group, field.name, values);
    if (out_) return;
    if (first) list.resize(values.size());
    require_size(in(group, field.name), values.size(), list.size());
    for (std::size_t i = 0; i < list.size(); ++i) list[i].*field.member = std::move(values[i]);
  }

  // One field of all records of a list: one that is read comes with as many entries as there are records.
  template <OneOf<std::string, double> T>
  void column(const std::string& group, const std::string& name, std::vector<T>& values) {
    exchange(group, name, values);
  }
  template <OneOf<int, bool> T>
  void column(const std::string& group, const std::string& name, std::vector<T>& values) {
    Wholes wholes(values.begin(), values.end());
    exchange(group, name, wholes);
    values.assign(wholes.begin(), wholes.end());
  }
  /// NaN where there is none, and a second list that says where there is one.
  void column(const std::string& group, const std::string& name, std::vector<std::optional<double>>& values);
  void column(const std::string& group, const std::string& name, std::vector<Eigen::Vector2d>& values);
  /// Lists of one length, the rows of a table.
  void column(const std::string& group, const std::string& name, std::vector<Numbers>& values);
  /// All texts, and the index of the record of each.
  void column(const std::string& group, const std::string& name, std::vector<Texts>& values);
  /// Values [records, names], and which of them there are.
  void column(const std::string& group, const std::string& name, std::vector<NamedValues>& values);

  /// [rows, columns] row by row. @return the number of columns there are
  std::size_t table(const std::string& path, Numbers& values, std::size_t columns);
  void read(const std::string& path, Numbers& values) const;
  void read(const std::string& path, Wholes& values) const;
  void read(const std::string& path, Texts& values) const;
  template <class T>
  [[nodiscard]] std::vector<T> list(const std::string& path, hdf5::Array<T> array) const {
    if (array.rank() != 1) refuse(path, "rank " + std::to_string(array.rank()), "must be a list");
    return std::move(array.values);
  }
  template <class T>
  void read(const std::string& object, const std::string& name, T& value) const {
    if constexpr (std::same_as<T, std::string>)
      value = file_.string_attribute(object, name);
    else if constexpr (std::same_as<T, double>)
      value = file_.real_attribute(object, name);
    else
      value = file_.integer_attribute(object, name);
  }
  /// A map as a list of its names and a list of its values, under these two names.
  template <class List, class Map>
  void exchange_pairs(const std::string& group, const std::array<std::string, 2>& written, Map& map);

  /// Throws InputError unless `found` entries are the `expected` ones.
  void require_size(const std::string& path, std::size_t found, std::size_t expected) const;
  /// Each list is empty or has an entry for each node, and the nodes lie on the flanks named.
  void require_nodes(const std::string& group, const Wholes& flank, const Texts& flank_names,
                     std::initializer_list<const Numbers*> lists) const;
  template <class R>
  void require_consistent(const std::string& /*group*/, const R& /*record*/) const {}
  void require_consistent(const std::string& group, const DesignRecord& design) const;
  void require_consistent(const std::string& group, const VerificationRecord& record) const;

  const hdf5::File& file_;
  hdf5::File* out_ = nullptr;
};

}  // namespace dovetail::report
