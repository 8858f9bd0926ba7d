#include "core/replace_file.hpp"

#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <climits>
#include <cstring>
#include <fstream>
#include <string>
#include <system_error>

#include "core/errors.hpp"

namespace dovetail {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const fs::path& target, const std::string& why) {
  throw InputError({.file = {}, .key = target.string(), .value = {}, .allowed = "cannot be written: " + why});
}

// What a signal handler may touch: lock-free atomics and memory that does not move.
enum class Slot { free, taken, named };
std::atomic<Slot> slot{Slot::free};
std::array<char, PATH_MAX> slot_name{};
static_assert(std::atomic<Slot>::is_always_lock_free);

/// A temporary file, removed unless it was renamed.
class Temporary {
 public:
  explicit Temporary(const fs::path& target)
      : path_(target.parent_path() /
              ("." + target.stem().string() + "." + std::to_string(::getpid()) + target.extension().string())) {
    const std::string& name = path_.native();
    Slot expected = Slot::free;
    if (name.size() >= slot_name.size() || !slot.compare_exchange_strong(expected, Slot::taken)) return;
    slot_name[name.copy(slot_name.data(), name.size())] = '\0';
    slot = Slot::named;
    named_ = true;
  }
  ~Temporary() {
    std::error_code ignored;
    if (!renamed_) fs::remove(path_, ignored);
    if (named_) slot = Slot::free;
  }
  Temporary(const Temporary&) = delete;
  Temporary& operator=(const Temporary&) = delete;

  [[nodiscard]] const fs::path& path() const { return path_; }
  void rename(const fs::path& target) {
    std::error_code error;
    fs::rename(path_, target, error);
    if (error) refuse(target, error.message());
    renamed_ = true;
  }

 private:
  fs::path path_;
  bool named_ = false;
  bool renamed_ = false;
};

}  // namespace

void check_replaceable(const fs::path& target) {
  std::error_code ignored, error;
  if (!target.has_filename()) refuse(target, "it names no file");
  if (fs::is_directory(target, ignored)) refuse(target, "it is a directory");
  const fs::path folder = target.has_parent_path() ? target.parent_path() : ".";
  if (!fs::is_directory(folder, error))
    refuse(target, error && error != std::errc::no_such_file_or_directory
                       ? error.message()
                       : "the directory " + folder.string() + " does not exist");
  // A new file is made beside it; a device is written to.
  const bool in_place = fs::exists(target, ignored) && !fs::is_regular_file(target, ignored);
  if (::access(in_place ? target.c_str() : folder.c_str(), in_place ? W_OK : W_OK | X_OK) != 0)
    refuse(target, std::strerror(errno));
}

void replace_file(const fs::path& target, const std::function<void(const fs::path& place)>& write) {
  check_replaceable(target);
  std::error_code ignored;
  if (fs::exists(target, ignored) && !fs::is_regular_file(target, ignored)) return write(target);
  Temporary temporary(target);
  write(temporary.path());
  temporary.rename(target);
}

void replace_file(const fs::path& target, std::string_view content) {
  replace_file(target, [&](const fs::path& place) {
    errno = 0;
    std::ofstream stream(place, std::ios::binary | std::ios::trunc);
    stream << content;
    stream.close();
    if (!stream) refuse(target, errno != 0 ? std::strerror(errno) : "writing failed");
  });
}

void remove_unfinished_file() noexcept {
  if (slot.load() == Slot::named) ::unlink(slot_name.data());
}

}  // namespace dovetail
