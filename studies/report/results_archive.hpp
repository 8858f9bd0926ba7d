#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/hdf5_file.hpp"
#include "studies/report/run_record.hpp"

namespace dovetail::report {

/// Writes the pieces of a record. Writer and Reader have the same members, so that one function that names every
/// piece (exchange) serves both ways and they cannot drift apart.
class Writer {
 public:
  explicit Writer(hdf5::File& file) : file_(file) {}

  void numbers(const std::string& path, const Numbers& values) { file_.write(path, values); }
  void later_numbers(const std::string& path, const Numbers& values) { numbers(path, values); }
  /// [rows, columns], row by row; columns > 0.
  void table(const std::string& path, const Numbers& values, std::size_t columns);
  void wholes(const std::string& path, const std::vector<std::int64_t>& values) { file_.write(path, values); }
  void texts(const std::string& path, const std::vector<std::string>& values) { file_.write(path, values); }
  void values(const std::string& group, const std::map<std::string, double>& named);
  void chain(const std::string& group, const geometry::Chain& chain);
  void mesh(const std::string& group, const fem::Mesh& mesh);

  // Attributes of a group.
  void group(const std::string& path) { file_.make_group(path); }
  void text(const std::string& group, const std::string& name, const std::string& value);
  void whole(const std::string& group, const std::string& name, std::int64_t value);
  void number(const std::string& group, const std::string& name, double value);

  /// `body(value)` when there is one; its group's existence tells the reader.
  template <class T, class Body>
  void optional(const std::string& /*group*/, const std::optional<T>& value, Body&& body) {
    if (value) body(*value);
  }
  /// Records in the groups 0, 1, ... below `group`.
  template <class T, class Body>
  void records(const std::string& group, const std::vector<T>& list, Body&& body) {
    this->group(group);
    for (std::size_t i = 0; i < list.size(); ++i) body(group + "/" + std::to_string(i), list[i]);
  }

 private:
  hdf5::File& file_;
};

/// Reads them again; everything inconsistent is an InputError naming file and data set.
class Reader {
 public:
  explicit Reader(const hdf5::File& file) : file_(file) {}

  void numbers(const std::string& path, Numbers& values) const;
  /// The same of a list that older files do not have: empty then.
  void later_numbers(const std::string& path, Numbers& values) const;
  void table(const std::string& path, Numbers& values, std::size_t columns) const;
  void wholes(const std::string& path, std::vector<std::int64_t>& values) const;
  void texts(const std::string& path, std::vector<std::string>& values) const;
  void values(const std::string& group, std::map<std::string, double>& named) const;
  void chain(const std::string& group, geometry::Chain& chain) const;
  void mesh(const std::string& group, fem::Mesh& mesh) const;

  void group(const std::string& path) const;
  void text(const std::string& group, const std::string& name, std::string& value) const;
  void whole(const std::string& group, const std::string& name, std::int64_t& value) const;
  void number(const std::string& group, const std::string& name, double& value) const;

  template <class T, class Body>
  void optional(const std::string& group, std::optional<T>& value, Body&& body) const {
    if (file_.exists(group)) body(value.emplace());
  }
  template <class T, class Body>
  void records(const std::string& group, std::vector<T>& list, Body&& body) const {
    list.resize(file_.members(group).size());
    for (std::size_t i = 0; i < list.size(); ++i) body(group + "/" + std::to_string(i), list[i]);
  }

  /// Throws InputError unless `found` entries are the `expected` ones.
  void require_size(const std::string& path, std::size_t found, std::size_t expected) const;
  [[noreturn]] void refuse(const std::string& path, const std::string& value, const std::string& allowed) const;
  [[nodiscard]] const hdf5::File& file() const { return file_; }

 private:
  const hdf5::File& file_;
};

/// Problem and evaluations. The evaluations' sizes are those of the problem, which is to be read first; writing others
/// is an InputError.
void write_problem(Writer& writer, const optimizer::Problem& problem);
void read_problem(const Reader& reader, optimizer::Problem& problem);
void write_evaluations(Writer& writer, const RunRecord& record);
void read_evaluations(const Reader& reader, RunRecord& record);

/// The design below `group`, both ways.
void exchange(Writer& writer, const std::string& group, const DesignRecord& design);
void exchange(const Reader& reader, const std::string& group, DesignRecord& design);

/// A verification below `group`, both ways.
void exchange(Writer& writer, const std::string& group, const FinerRecord& record);
void exchange(const Reader& reader, const std::string& group, FinerRecord& record);
void exchange(Writer& writer, const std::string& group, const VerificationRecord& record);
void exchange(const Reader& reader, const std::string& group, VerificationRecord& record);

}  // namespace dovetail::report
