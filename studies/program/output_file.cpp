#include "studies/program/output_file.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>

#include "core/errors.hpp"
#include "studies/program/interrupt.hpp"

namespace dovetail::studies {
namespace {

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& why) {
  throw InputError(Violation{.file = {}, .key = path.string(), .value = {}, .allowed = "cannot be written: " + why});
}

/// Removes the temporary file unless it was renamed.
class Temporary {
 public:
  explicit Temporary(const std::filesystem::path& target)
      : path_(target.parent_path() /
              ("." + target.stem().string() + "." + std::to_string(::getpid()) + target.extension().string())),
        guard_(path_.string()) {}
  ~Temporary() {
    std::error_code ignored;
    if (!renamed_) std::filesystem::remove(path_, ignored);
  }
  Temporary(const Temporary&) = delete;
  Temporary& operator=(const Temporary&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  void rename(const std::filesystem::path& target) {
    std::error_code error;
    std::filesystem::rename(path_, target, error);
    if (error) refuse(target, error.message());
    renamed_ = true;
  }

 private:
  std::filesystem::path path_;
  RemoveOnInterrupt guard_;
  bool renamed_ = false;
};

}  // namespace

void write_file_by(const std::filesystem::path& path, const std::function<void(const std::filesystem::path&)>& write) {
  if (path.empty() || !path.has_filename()) refuse(path, "it names no file");
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) refuse(path, "it is a directory");
  const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
  if (!std::filesystem::is_directory(folder, ignored))
    refuse(path, "the directory " + folder.string() + " does not exist");
  // A device or a pipe is written to, not replaced.
  if (std::filesystem::exists(path, ignored) && !std::filesystem::is_regular_file(path, ignored)) {
    write(path);
    return;
  }
  Temporary temporary(path);
  write(temporary.path());
  temporary.rename(path);
}

void write_file(const std::filesystem::path& path, const std::string& text) {
  write_file_by(path, [&](const std::filesystem::path& place) {
    errno = 0;
    std::ofstream stream(place, std::ios::binary | std::ios::trunc);
    stream << text;
    stream.close();
    if (!stream) refuse(path, errno != 0 ? std::strerror(errno) : "writing failed");
  });
}

}  // namespace dovetail::studies
