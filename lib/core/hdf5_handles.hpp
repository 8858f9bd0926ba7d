#pragma once

#include <hdf5.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <numeric>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

// Private to the sources of dovetail::hdf5: owners of HDF5 identifiers and what they are asked for.
namespace dovetail::hdf5 {

// The library prints its error stack unless told otherwise; the caller's setting is put back.
class Quiet {
 public:
  Quiet() {
    // A damaged file can leave objects inside the library that it cannot close at exit and complains about on
    // standard error; every file is closed explicitly here, so the library's own clean-up is not needed.
    [[maybe_unused]] static const herr_t once = H5dont_atexit();
    H5Eget_auto2(H5E_DEFAULT, &function_, &data_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  ~Quiet() { H5Eset_auto2(H5E_DEFAULT, function_, data_); }
  Quiet(const Quiet&) = delete;
  Quiet& operator=(const Quiet&) = delete;

 private:
  H5E_auto2_t function_ = nullptr;
  void* data_ = nullptr;
};

class Handle {
 public:
  Handle(hid_t id, herr_t (*closer)(hid_t)) : id_(id), close_(closer) {}
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, H5I_INVALID_HID)), close_(other.close_) {}
  Handle& operator=(Handle&&) = delete;
  operator hid_t() const { return id_; }  // NOLINT: stands for the identifier in every call
  [[nodiscard]] bool valid() const { return id_ >= 0; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

inline std::string phrase(const std::vector<std::size_t>& shape) {
  std::string text = "[";
  for (std::size_t k = 0; k < shape.size(); ++k) text += (k ? "," : "") + std::to_string(shape[k]);
  return text + "]";
}

inline std::string type_name(hid_t type) {
  switch (H5Tget_class(type)) {
    case H5T_INTEGER:
      return "integer";
    case H5T_FLOAT:
      return "floating point";
    case H5T_STRING:
      return "string";
    case H5T_COMPOUND:
      return "compound";
    case H5T_ENUM:
      return "enumeration";
    default:
      return "another type";
  }
}

inline std::vector<std::size_t> shape_of(hid_t space) {
  const int rank = H5Sget_simple_extent_ndims(space);
  std::vector<hsize_t> extents(static_cast<std::size_t>(std::max(rank, 0)));
  if (rank > 0) H5Sget_simple_extent_dims(space, extents.data(), nullptr);
  return {extents.begin(), extents.end()};
}

inline std::size_t product(std::span<const std::size_t> shape) {
  return std::accumulate(shape.begin(), shape.end(), std::size_t{1}, std::multiplies<>{});
}

inline Handle make_space(std::span<const std::size_t> shape) {
  if (shape.empty()) return {H5Screate(H5S_SCALAR), H5Sclose};
  const std::vector<hsize_t> extents(shape.begin(), shape.end());
  return {H5Screate_simple(static_cast<int>(extents.size()), extents.data(), nullptr), H5Sclose};
}

inline constexpr const char* kDamaged = "must be readable, but the file is truncated or damaged here";

inline Handle string_type() {
  const hid_t type = H5Tcopy(H5T_C_S1);
  H5Tset_size(type, H5T_VARIABLE);
  H5Tset_cset(type, H5T_CSET_UTF8);
  return {type, H5Tclose};
}

// Strings of `count` elements, of fixed or variable length. `read` fills a buffer of the given memory type.
inline bool strings_from(hid_t type, hid_t space, std::size_t count, const std::function<herr_t(hid_t, void*)>& read,
                         std::vector<std::string>& values) {
  values.assign(count, {});
  if (count == 0) return true;
  if (H5Tis_variable_str(type) > 0) {
    const Handle memory(H5Tcopy(type), H5Tclose);
    std::vector<char*> pointers(count, nullptr);
    if (read(memory, pointers.data()) < 0) return false;
    for (std::size_t k = 0; k < count; ++k)
      if (pointers[k] != nullptr) values[k] = pointers[k];
    H5Dvlen_reclaim(memory, space, H5P_DEFAULT, pointers.data());
    return true;
  }
  const std::size_t size = H5Tget_size(type);
  const Handle memory(H5Tcopy(type), H5Tclose);
  std::vector<char> buffer(size * count);
  if (read(memory, buffer.data()) < 0) return false;
  const bool space_padded = H5Tget_strpad(type) == H5T_STR_SPACEPAD;
  for (std::size_t k = 0; k < count; ++k) {
    std::string text(buffer.data() + k * size, size);
    if (const std::size_t end = text.find('\0'); end != std::string::npos) text.resize(end);
    if (space_padded) text.resize(text.find_last_not_of(' ') + 1);
    values[k] = text;
  }
  return true;
}

/// A data set or an attribute with its type and shape.
struct Stored {
  Handle id, type, space;

  Stored(hid_t opened, herr_t (*closer)(hid_t), hid_t (*type_of)(hid_t), hid_t (*space_of)(hid_t))
      : id(opened, closer),
        type(id.valid() ? type_of(id) : H5I_INVALID_HID, H5Tclose),
        space(id.valid() ? space_of(id) : H5I_INVALID_HID, H5Sclose) {}
  [[nodiscard]] bool valid() const { return id.valid() && type.valid() && space.valid(); }
};

// What values of a type are in a file, and what a message calls them.
template <class T>
struct Kind;
template <>
struct Kind<double> {
  static constexpr H5T_class_t kClass = H5T_FLOAT;
  static constexpr const char *kArray = "64-bit floating-point numbers", *kOne = "floating-point number";
  static hid_t in_file() { return H5T_IEEE_F64LE; }
  static hid_t in_memory() { return H5T_NATIVE_DOUBLE; }
};
template <>
struct Kind<std::int64_t> {
  static constexpr H5T_class_t kClass = H5T_INTEGER;
  static constexpr const char *kArray = "64-bit integers", *kOne = "integer";
  static hid_t in_file() { return H5T_STD_I64LE; }
  static hid_t in_memory() { return H5T_NATIVE_INT64; }
};
template <>
struct Kind<std::string> {
  static constexpr H5T_class_t kClass = H5T_STRING;
  static constexpr const char *kArray = "strings", *kOne = "string";
};

// All values of `stored`, which `read` puts into a buffer of the given memory type; false when it cannot.
template <class T>
bool values_of(const Stored& stored, std::size_t count, const std::function<herr_t(hid_t, void*)>& read,
               std::vector<T>& values) {
  if constexpr (std::is_same_v<T, std::string>) {
    return strings_from(stored.type, stored.space, count, read, values);
  } else {
    values.resize(count);
    return values.empty() || read(Kind<T>::in_memory(), values.data()) >= 0;
  }
}

}  // namespace dovetail::hdf5
