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

template <class T>
void File::write_numbers(const std::string& object, std::span<const T> values, std::span<const std::size_t> shape) {
  const Quiet quiet;
  if (values.size() != product(shape)) fail(object, phrase({shape.begin(), shape.end()}), "shape must fit the values");
  if (!write_array(handle_, object, Kind<T>::in_file(), Kind<T>::in_memory(), values.data(), shape))
    fail(object, {}, kUnwritable);
}

void File::write(const std::string& object, std::span<const double> values, std::span<const std::size_t> shape) {
  write_numbers(object, values, shape);
}

void File::write(const std::string& object, std::span<const std::int64_t> values, std::span<const std::size_t> shape) {
  write_numbers(object, values, shape);
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

Stored File::data_set(const std::string& object) const {
  if (!exists(object)) fail(object, {}, "the data set is missing");
  Stored data(H5Dopen2(handle_, object.c_str(), H5P_DEFAULT), H5Dclose, H5Dget_type, H5Dget_space);
  if (!data.valid()) fail(object, {}, is_group(object) ? "must be a data set, not a group" : kDamaged);
  return data;
}

template <class T>
Array<T> File::read(const std::string& object) const {
  const Quiet quiet;
  const Stored data = data_set(object);
  if (H5Tget_class(data.type) != Kind<T>::kClass || H5Sget_simple_extent_type(data.space) == H5S_NULL)
    fail(object, type_name(data.type), std::string("must be an array of ") + Kind<T>::kArray);
  const auto read = [&](hid_t memory, void* buffer) {
    return H5Dread(data.id, memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, buffer);
  };
  Array<T> array{.shape = shape_of(data.space), .values = {}};
  bool ok = false;
  // A damaged header can claim any size; one that memory cannot hold is an error like any other.
  try {
    ok = values_of(data, product(array.shape), read, array.values);
  } catch (const std::bad_alloc&) {
  } catch (const std::length_error&) {
  }
  if (!ok) fail(object, "shape " + phrase(array.shape), kDamaged);
  return array;
}

Array<double> File::read_reals(const std::string& object) const {
  return read<double>(object);
}
Array<std::int64_t> File::read_integers(const std::string& object) const {
  return read<std::int64_t>(object);
}
Array<std::string> File::read_strings(const std::string& object) const {
  return read<std::string>(object);
}

std::vector<std::size_t> File::shape(const std::string& object) const {
  const Quiet quiet;
  return shape_of(data_set(object).space);
}

}  // namespace dovetail::hdf5
