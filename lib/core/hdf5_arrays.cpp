#include <stdexcept>

#include "core/hdf5_file.hpp"
#include "core/hdf5_handles.hpp"

namespace dovetail::hdf5 {

namespace {
bool write_array(hid_t file, const std::string& object, hid_t file_type, hid_t memory_type, const void* data,
                 std::span<const std::size_t> shape) {
  const Handle create(H5Pcreate(H5P_LINK_CREATE), H5Pclose);
  H5Pset_create_intermediate_group(create, 1);
  const Handle space = make_space(shape);
  const Handle set(H5Dcreate2(file, object.c_str(), file_type, space, create, H5P_DEFAULT, H5P_DEFAULT), H5Dclose);
  if (!set.valid()) return false;
  return product(shape) == 0 || H5Dwrite(set, memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data) >= 0;
}
constexpr const char* kUnwritable = "cannot be written: the object exists, or the disk is full";
}  // namespace

void File::write(const std::string& object, std::span<const double> values, std::span<const std::size_t> shape) {
  const Quiet quiet;
  if (values.size() != product(shape)) fail(object, phrase({shape.begin(), shape.end()}), "shape must fit the values");
  if (!write_array(handle_, object, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, values.data(), shape))
    fail(object, {}, kUnwritable);
}

void File::write(const std::string& object, std::span<const std::int64_t> values, std::span<const std::size_t> shape) {
  const Quiet quiet;
  if (values.size() != product(shape)) fail(object, phrase({shape.begin(), shape.end()}), "shape must fit the values");
  if (!write_array(handle_, object, H5T_STD_I64LE, H5T_NATIVE_INT64, values.data(), shape))
    fail(object, {}, kUnwritable);
}

void File::write(const std::string& object, std::span<const std::string> values) {
  const Quiet quiet;
  std::vector<const char*> pointers;
  for (const std::string& value : values) pointers.push_back(value.c_str());
  const Handle type = string_type();
  const std::size_t shape[] = {values.size()};
  if (!write_array(handle_, object, type, type, pointers.data(), shape)) fail(object, {}, kUnwritable);
}

void File::write(const std::string& object, std::span<const double> values) {
  const std::size_t shape[] = {values.size()};
  write(object, values, shape);
}

void File::write(const std::string& object, std::span<const std::int64_t> values) {
  const std::size_t shape[] = {values.size()};
  write(object, values, shape);
}

namespace {
// Opened data set with its type and shape; the reader says what it must hold.
struct DataSet {
  Handle set, type, space;
  std::vector<std::size_t> shape;

  DataSet(hid_t file, const std::string& object)
      : set(H5Dopen2(file, object.c_str(), H5P_DEFAULT), H5Dclose),
        type(set.valid() ? H5Dget_type(set) : H5I_INVALID_HID, H5Tclose),
        space(set.valid() ? H5Dget_space(set) : H5I_INVALID_HID, H5Sclose),
        shape(space.valid() ? shape_of(space) : std::vector<std::size_t>{}) {}
  [[nodiscard]] bool valid() const { return set.valid() && type.valid() && space.valid(); }
  [[nodiscard]] bool empty_space() const { return H5Sget_simple_extent_type(space) == H5S_NULL; }
};
}  // namespace

template <class T>
static Array<T> read_array(const DataSet& data, hid_t memory_type, bool& ok) {
  Array<T> array{.shape = data.shape, .values = {}};
  // A damaged header can claim any size; one that memory cannot hold is an error like any other.
  try {
    array.values.resize(product(array.shape));
  } catch (const std::exception&) {
    ok = false;
    return array;
  }
  ok = array.values.empty() || H5Dread(data.set, memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, array.values.data()) >= 0;
  return array;
}

Array<double> File::read_reals(const std::string& object) const {
  const Quiet quiet;
  if (!exists(object)) fail(object, {}, "the data set is missing");
  const DataSet data(handle_, object);
  if (!data.valid()) fail(object, {}, is_group(object) ? "must be a data set, not a group" : kDamaged);
  if (H5Tget_class(data.type) != H5T_FLOAT || data.empty_space())
    fail(object, type_name(data.type), "must be an array of 64-bit floating-point numbers");
  bool ok = false;
  Array<double> array = read_array<double>(data, H5T_NATIVE_DOUBLE, ok);
  if (!ok) fail(object, "shape " + phrase(data.shape), kDamaged);
  return array;
}

Array<std::int64_t> File::read_integers(const std::string& object) const {
  const Quiet quiet;
  if (!exists(object)) fail(object, {}, "the data set is missing");
  const DataSet data(handle_, object);
  if (!data.valid()) fail(object, {}, is_group(object) ? "must be a data set, not a group" : kDamaged);
  if (H5Tget_class(data.type) != H5T_INTEGER || data.empty_space())
    fail(object, type_name(data.type), "must be an array of 64-bit integers");
  bool ok = false;
  Array<std::int64_t> array = read_array<std::int64_t>(data, H5T_NATIVE_INT64, ok);
  if (!ok) fail(object, "shape " + phrase(data.shape), kDamaged);
  return array;
}

Array<std::string> File::read_strings(const std::string& object) const {
  const Quiet quiet;
  if (!exists(object)) fail(object, {}, "the data set is missing");
  const DataSet data(handle_, object);
  if (!data.valid()) fail(object, {}, is_group(object) ? "must be a data set, not a group" : kDamaged);
  if (H5Tget_class(data.type) != H5T_STRING || data.empty_space())
    fail(object, type_name(data.type), "must be an array of strings");
  Array<std::string> array{.shape = data.shape, .values = {}};
  bool ok = false;
  try {
    const auto read = [&](hid_t memory, void* buffer) {
      return H5Dread(data.set, memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, buffer);
    };
    ok = strings_from(data.type, data.space, product(array.shape), read, array.values);
  } catch (const std::bad_alloc&) {
    ok = false;
  } catch (const std::length_error&) {
    ok = false;
  }
  if (!ok) fail(object, "shape " + phrase(data.shape), kDamaged);
  return array;
}

std::vector<std::size_t> File::shape(const std::string& object) const {
  const Quiet quiet;
  if (!exists(object)) fail(object, {}, "the data set is missing");
  const DataSet data(handle_, object);
  if (!data.valid()) fail(object, {}, is_group(object) ? "must be a data set, not a group" : kDamaged);
  return data.shape;
}

}  // namespace dovetail::hdf5
