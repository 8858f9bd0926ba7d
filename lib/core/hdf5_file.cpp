#include "core/hdf5_file.hpp"

#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <utility>

#include "core/hdf5_handles.hpp"
#include "core/replace_file.hpp"

namespace dovetail::hdf5 {

namespace {

std::recursive_mutex& library() {
  static std::recursive_mutex mutex;
  return mutex;
}

}  // namespace

File::File(std::string path) : alone_(library()), path_(std::move(path)) {}

void File::fail(const std::string& object, const std::string& value, const std::string& allowed) const {
  throw InputError({.file = path_, .line = 0, .key = object, .value = value, .allowed = allowed});
}

File File::create(const std::string& path) {
  File file(path);
  const Quiet quiet;
  // From HDF5 1.8 on the structure of a file carries checksums, so that damage is noticed when it is read.
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_libver_bounds(access, H5F_LIBVER_V18, H5F_LIBVER_LATEST);
  file.handle_ = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access);
  if (file.handle_ < 0)
    throw InputError({.file = path, .line = 0, .key = "/", .value = {}, .allowed = "cannot be written"});
  return file;
}

File File::open(const std::string& path) {
  File file(path);
  const Quiet quiet;
  const auto refuse = [&](const std::string& why) {
    throw InputError({.file = path, .line = 0, .key = "/", .value = {}, .allowed = why});
  };
  std::error_code error;
  if (!std::filesystem::exists(path, error)) refuse("the file does not exist");
  if (!std::filesystem::is_regular_file(path, error)) refuse("must be a file");
  if (::access(path.c_str(), R_OK) != 0) refuse("the file must be readable, but permission is denied");
  if (H5Fis_hdf5(path.c_str()) <= 0) refuse("must be an HDF5 file");
  // Closing the file closes every object in it, also those that reading a damaged file may have left open.
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_fclose_degree(access, H5F_CLOSE_STRONG);
  file.handle_ = H5Fopen(path.c_str(), H5F_ACC_RDONLY, access);
  if (file.handle_ < 0) refuse("cannot be opened as HDF5: the file is truncated, damaged or being written");
  return file;
}

File::File(File&& other) noexcept
    : alone_(std::move(other.alone_)), handle_(std::exchange(other.handle_, -1)), path_(std::move(other.path_)) {}

File& File::operator=(File&& other) noexcept {
  std::swap(alone_, other.alone_);
  std::swap(handle_, other.handle_);
  std::swap(path_, other.path_);
  return *this;
}

File::~File() {
  const Quiet quiet;
  if (handle_ >= 0) H5Fclose(handle_);
}

void File::close() {
  const Quiet quiet;
  if (handle_ < 0) return;
  const bool flushed = H5Fflush(handle_, H5F_SCOPE_GLOBAL) >= 0;
  const bool closed = H5Fclose(std::exchange(handle_, -1)) >= 0;
  if (!flushed || !closed) fail("/", {}, "cannot be written completely");
}

bool File::exists(const std::string& object) const {
  const Quiet quiet;
  if (object == "/") return true;
  // H5Lexists fails on a missing intermediate group: ask for each part of the path in turn.
  for (std::size_t end = object.find('/', 1);; end = object.find('/', end + 1)) {
    if (H5Lexists(handle_, object.substr(0, end).c_str(), H5P_DEFAULT) <= 0) return false;
    if (end == std::string::npos) return H5Oexists_by_name(handle_, object.c_str(), H5P_DEFAULT) > 0;
  }
}

bool File::is_group(const std::string& object) const {
  const Quiet quiet;
  if (!exists(object)) return false;
  const Handle id(H5Oopen(handle_, object.c_str(), H5P_DEFAULT), H5Oclose);
  return id.valid() && H5Iget_type(id) == H5I_GROUP;
}

std::vector<std::string> File::members(const std::string& group) const {
  const Quiet quiet;
  if (!is_group(group)) fail(group, {}, "must be a group");
  std::vector<std::string> names;
  const auto collect = [](hid_t, const char* name, const H5L_info_t*, void* list) -> herr_t {
    static_cast<std::vector<std::string>*>(list)->emplace_back(name);
    return 0;
  };
  if (H5Literate_by_name(handle_, group.c_str(), H5_INDEX_NAME, H5_ITER_INC, nullptr, collect, &names, H5P_DEFAULT) < 0)
    fail(group, {}, kDamaged);
  std::sort(names.begin(), names.end());
  return names;
}

void File::make_group(const std::string& group) {
  const Quiet quiet;
  const Handle create(H5Pcreate(H5P_LINK_CREATE), H5Pclose);
  H5Pset_create_intermediate_group(create, 1);
  const Handle id(H5Gcreate2(handle_, group.c_str(), create, H5P_DEFAULT, H5P_DEFAULT), H5Gclose);
  if (!id.valid()) fail(group, {}, "cannot be written as a group");
}

void write_and_rename(const std::string& path, const std::function<void(File&)>& write) {
  replace_file(path, [&](const std::filesystem::path& place) {
    try {
      File file = File::create(place.string());
      write(file);
      file.close();
    } catch (const InputError& refused) {
      // The user knows the name asked for, not the temporary one.
      std::vector<Violation> found = refused.violations();
      for (Violation& violation : found)
        if (violation.file == place.string()) violation.file = path;
      throw InputError(found);
    }
  });
}

}  // namespace dovetail::hdf5
