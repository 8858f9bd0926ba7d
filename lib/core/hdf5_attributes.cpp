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

// An opened attribute; `one` tells whether it holds a single value (scalar, or an array of one).
struct Attribute {
  Handle id, type, space;

  Attribute(hid_t file, const std::string& object, const std::string& name)
      : id(H5Aopen_by_name(file, object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose),
        type(id.valid() ? H5Aget_type(id) : H5I_INVALID_HID, H5Tclose),
        space(id.valid() ? H5Aget_space(id) : H5I_INVALID_HID, H5Sclose) {}
  [[nodiscard]] bool valid() const { return id.valid() && type.valid() && space.valid(); }
  [[nodiscard]] bool one() const { return H5Sget_simple_extent_npoints(space) == 1; }
};

std::string key(const std::string& object, const std::string& name) {
  return "attribute " + name + " of " + object;
}

constexpr const char* kUnwritable = "cannot be written: the object is missing, or the disk is full";

}  // namespace

void File::write_attribute(const std::string& object, const std::string& name, double value) {
  const Quiet quiet;
  if (!write_value(handle_, object, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, &value))
    fail(key(object, name), {}, kUnwritable);
}

void File::write_attribute(const std::string& object, const std::string& name, std::int64_t value) {
  const Quiet quiet;
  if (!write_value(handle_, object, name, H5T_STD_I64LE, H5T_NATIVE_INT64, &value))
    fail(key(object, name), {}, kUnwritable);
}

void File::write_attribute(const std::string& object, const std::string& name, const std::string& value) {
  const Quiet quiet;
  const Handle type = string_type();
  const char* pointer = value.c_str();
  if (!write_value(handle_, object, name, type, type, &pointer)) fail(key(object, name), {}, kUnwritable);
}

bool File::has_attribute(const std::string& object, const std::string& name) const {
  const Quiet quiet;
  return exists(object) && H5Aexists_by_name(handle_, object.c_str(), name.c_str(), H5P_DEFAULT) > 0;
}

double File::real_attribute(const std::string& object, const std::string& name) const {
  const Quiet quiet;
  if (!has_attribute(object, name)) fail(key(object, name), {}, "the attribute is missing");
  const Attribute attribute(handle_, object, name);
  if (!attribute.valid()) fail(key(object, name), {}, kDamaged);
  if (H5Tget_class(attribute.type) != H5T_FLOAT || !attribute.one())
    fail(key(object, name), type_name(attribute.type), "must be one floating-point number");
  double value = 0;
  if (H5Aread(attribute.id, H5T_NATIVE_DOUBLE, &value) < 0) fail(key(object, name), {}, kDamaged);
  return value;
}

std::int64_t File::integer_attribute(const std::string& object, const std::string& name) const {
  const Quiet quiet;
  if (!has_attribute(object, name)) fail(key(object, name), {}, "the attribute is missing");
  const Attribute attribute(handle_, object, name);
  if (!attribute.valid()) fail(key(object, name), {}, kDamaged);
  if (H5Tget_class(attribute.type) != H5T_INTEGER || !attribute.one())
    fail(key(object, name), type_name(attribute.type), "must be one integer");
  std::int64_t value = 0;
  if (H5Aread(attribute.id, H5T_NATIVE_INT64, &value) < 0) fail(key(object, name), {}, kDamaged);
  return value;
}

std::string File::string_attribute(const std::string& object, const std::string& name) const {
  const Quiet quiet;
  if (!has_attribute(object, name)) fail(key(object, name), {}, "the attribute is missing");
  const Attribute attribute(handle_, object, name);
  if (!attribute.valid()) fail(key(object, name), {}, kDamaged);
  if (H5Tget_class(attribute.type) != H5T_STRING || !attribute.one())
    fail(key(object, name), type_name(attribute.type), "must be one string");
  std::vector<std::string> values;
  const auto read = [&](hid_t memory, void* buffer) { return H5Aread(attribute.id, memory, buffer); };
  if (!strings_from(attribute.type, attribute.space, 1, read, values)) fail(key(object, name), {}, kDamaged);
  return values.front();
}

}  // namespace dovetail::hdf5
