#include "core/hdf5_file.hpp"
#include "core/hdf5_handles.hpp"

namespace dovetail::hdf5 {

namespace {

bool write_value(hid_t file, const std::string& object, const std::string& name, hid_t file_type, hid_t memory_type,
                 const void* value) {
  const Handle owner(H5Oopen(file, object.c_str(), H5P_DEFAULT), H5Oclose);
  if (!owner.valid()) return false;
  if (H5Aexists(owner, name.c_str()) > 0) H5Adelete(owner, name.c_str());
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  const Handle attribute(H5Acreate2(owner, name.c_str(), file_type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  return attribute.valid() && H5Awrite(attribute, memory_type, value) >= 0;
}

std::string key(const std::string& object, const std::string& name) {
  return "attribute " + name + " of " + object;
}

constexpr const char* kAttributeUnwritable = "cannot be written: the object is missing, or the disk is full";

}  // namespace

void File::write_attribute(const std::string& object, const std::string& name, double value) {
  const Quiet quiet;
  if (!write_value(handle_, object, name, Kind<double>::in_file(), Kind<double>::in_memory(), &value))
    fail(key(object, name), {}, kAttributeUnwritable);
}

void File::write_attribute(const std::string& object, const std::string& name, std::int64_t value) {
  const Quiet quiet;
  if (!write_value(handle_, object, name, Kind<std::int64_t>::in_file(), Kind<std::int64_t>::in_memory(), &value))
    fail(key(object, name), {}, kAttributeUnwritable);
}

void File::write_attribute(const std::string& object, const std::string& name, const std::string& value) {
  const Quiet quiet;
  const Handle type = string_type();
  const char* pointer = value.c_str();
  if (!write_value(handle_, object, name, type, type, &pointer)) fail(key(object, name), {}, kAttributeUnwritable);
}

bool File::has_attribute(const std::string& object, const std::string& name) const {
  const Quiet quiet;
  return exists(object) && H5Aexists_by_name(handle_, object.c_str(), name.c_str(), H5P_DEFAULT) > 0;
}

template <class T>
T File::attribute(const std::string& object, const std::string& name) const {
  const Quiet quiet;
  if (!has_attribute(object, name)) fail(key(object, name), {}, "the attribute is missing");
  const Stored found(H5Aopen_by_name(handle_, object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
                     H5Aget_type, H5Aget_space);
  if (!found.valid()) fail(key(object, name), {}, kDamaged);
  // A scalar, or an array of one.
  if (H5Tget_class(found.type) != Kind<T>::kClass || H5Sget_simple_extent_npoints(found.space) != 1)
    fail(key(object, name), type_name(found.type), std::string("must be one ") + Kind<T>::kOne);
  std::vector<T> values;
  const auto read = [&](hid_t memory, void* buffer) { return H5Aread(found.id, memory, buffer); };
  if (!values_of(found, 1, read, values)) fail(key(object, name), {}, kDamaged);
  return values.front();
}

double File::real_attribute(const std::string& object, const std::string& name) const {
  return attribute<double>(object, name);
}
std::int64_t File::integer_attribute(const std::string& object, const std::string& name) const {
  return attribute<std::int64_t>(object, name);
}
std::string File::string_attribute(const std::string& object, const std::string& name) const {
  return attribute<std::string>(object, name);
}

}  // namespace dovetail::hdf5
