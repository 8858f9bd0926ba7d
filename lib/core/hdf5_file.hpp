#pragma once

#include <cstdint>
#include <functional>
#include <mutex>
#include <span>
#include <string>
#include <vector>

#include "core/errors.hpp"

/// The part of HDF5 this project needs: files of groups, attributes and row-major arrays. The library's own
/// error messages are silenced; everything that goes wrong is an InputError naming file and object.
namespace dovetail::hdf5 {

/// Row-major array of any rank; rank 0 holds one value.
template <class T>
struct Array {
  std::vector<std::size_t> shape;
  std::vector<T> values;

  [[nodiscard]] std::size_t rank() const { return shape.size(); }
};

struct Stored;

/// An open file. Objects are named by absolute paths ("/contact/area"); groups on the way to a new
/// data set are made. Where one thread has a file, others wait: HDF5 keeps global state.
class File {
 public:
  /// New or overwritten file.
  [[nodiscard]] static File create(const std::string& path);
  /// Existing file, read only. Throws when it is missing, no HDF5 file, or damaged.
  [[nodiscard]] static File open(const std::string& path);
  File(File&& other) noexcept;
  File& operator=(File&& other) noexcept;
  File(const File&) = delete;
  File& operator=(const File&) = delete;
  ~File();

  /// Writes everything to disk and closes; throws when that fails (a full disk). The destructor closes silently.
  void close();

  [[nodiscard]] const std::string& path() const { return path_; }
  [[nodiscard]] bool exists(const std::string& object) const;
  [[nodiscard]] bool is_group(const std::string& object) const;
  /// Names of the members of a group, sorted.
  [[nodiscard]] std::vector<std::string> members(const std::string& group) const;

  void make_group(const std::string& group);
  /// `values` in row-major order; the product of `shape` is their number. Throws when the object exists.
  void write(const std::string& object, std::span<const double> values, std::span<const std::size_t> shape);
  void write(const std::string& object, std::span<const std::int64_t> values, std::span<const std::size_t> shape);
  /// One-dimensional list of variable-length UTF-8 strings.
  void write(const std::string& object, std::span<const std::string> values);
  /// One-dimensional.
  void write(const std::string& object, std::span<const double> values);
  void write(const std::string& object, std::span<const std::int64_t> values);

  /// Throws InputError when missing or not of floating-point / integer / string type.
  [[nodiscard]] Array<double> read_reals(const std::string& object) const;
  [[nodiscard]] Array<std::int64_t> read_integers(const std::string& object) const;
  [[nodiscard]] Array<std::string> read_strings(const std::string& object) const;
  /// Shape without reading the data.
  [[nodiscard]] std::vector<std::size_t> shape(const std::string& object) const;

  void write_attribute(const std::string& object, const std::string& name, double value);
  void write_attribute(const std::string& object, const std::string& name, std::int64_t value);
  void write_attribute(const std::string& object, const std::string& name, const std::string& value);
  [[nodiscard]] bool has_attribute(const std::string& object, const std::string& name) const;
  /// One value each; throws when missing or of another type.
  [[nodiscard]] double real_attribute(const std::string& object, const std::string& name) const;
  [[nodiscard]] std::int64_t integer_attribute(const std::string& object, const std::string& name) const;
  [[nodiscard]] std::string string_attribute(const std::string& object, const std::string& name) const;

 private:
  explicit File(std::string path);
  [[nodiscard]] Stored data_set(const std::string& object) const;
  template <class T>
  [[nodiscard]] Array<T> read(const std::string& object) const;
  template <class T>
  [[nodiscard]] T attribute(const std::string& object, const std::string& name) const;
  template <class T>
  void write_numbers(const std::string& object, std::span<const T> values, std::span<const std::size_t> shape);
  [[noreturn]] void fail(const std::string& object, const std::string& value, const std::string& allowed) const;

  std::unique_lock<std::recursive_mutex> alone_;
  std::int64_t handle_ = -1;
  std::string path_;
};

/// Calls `write` with a new file beside `path` and renames it to `path` when all went well, so that a reader
/// never sees half a file; on an exception the temporary file is removed.
void write_and_rename(const std::string& path, const std::function<void(File&)>& write);

}  // namespace dovetail::hdf5
