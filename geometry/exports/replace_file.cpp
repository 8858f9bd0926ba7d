#include "geometry/exports/replace_file.hpp"

#include <unistd.h>

#include <system_error>

#include "core/errors.hpp"

namespace dovetail::geometry {

namespace {

InputError cannot_write(const std::filesystem::path& target, const std::string& why) {
  return InputError({.file = {},
                     .key = "output file",
                     .value = target.string(),
                     .allowed = "must be a place that can be written to (" + why + ")"});
}

}  // namespace

void replace_file(const std::filesystem::path& target,
                  const std::function<bool(const std::filesystem::path& temporary)>& write) {
  std::filesystem::path temporary = target;
  temporary += ".part" + std::to_string(getpid());
  std::error_code error;
  try {
    if (!write(temporary)) throw cannot_write(target, "writing failed");
    std::filesystem::rename(temporary, target, error);
    if (error) throw cannot_write(target, error.message());
  } catch (...) {
    std::filesystem::remove(temporary, error);
    throw;
  }
}

}  // namespace dovetail::geometry
