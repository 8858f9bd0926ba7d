#include "studies/program/engine/run_folder.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <ostream>
#include <system_error>

#include "studies/program/study_file/refusal.hpp"

namespace dovetail::studies {

namespace fs = std::filesystem;

namespace {

/// Whether there is such a file. Throws InputError where nobody may look.
bool exists(const fs::path& file, const std::string& input) {
  std::error_code error;
  const bool is = fs::exists(file, error);
  if (error == std::errc::permission_denied) refuse(input, "cannot be read: " + error.message());
  return is;
}

}  // namespace

fs::path run_file(const std::string& directory, const std::string& name, const std::string& what) {
  std::error_code ignored;
  fs::path file = fs::path(directory) / name;
  if (!fs::is_directory(directory, ignored)) refuse(directory, "is not the directory of a run");
  if (!exists(file, directory)) refuse(directory, "holds no " + what + " (" + name + ")");
  return file;
}

std::string study_or_best(const std::string& input, std::ostream* err) {
  std::error_code ignored;
  if (!fs::is_directory(input, ignored)) {
    if (exists(input, input) && ::access(input.c_str(), R_OK) != 0)
      refuse(input, std::string("cannot be read: ") + std::strerror(errno));
    return input;
  }
  const auto holds = [&](const char* name) { return exists(fs::path(input) / name, input); };
  if (holds("best.toml")) {
    std::string best = (fs::path(input) / "best.toml").string();
    if (err != nullptr) *err << "dovetail: " << input << ": of this run the best design is taken, " << best << "\n";
    return best;
  }
  if (!holds("journal.jsonl"))
    refuse(input, "cannot be read: it is a directory, and not that of a run; name a study file");
  refuse(input, holds("results.h5")
                    ? "is a run that found no feasible design"
                    : "is a run without a best design yet; `dovetail run ... --resume` goes on with it");
}

}  // namespace dovetail::studies
