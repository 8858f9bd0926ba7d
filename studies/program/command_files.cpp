// Commands on what a run or a study left in files.
#include <filesystem>
#include <ostream>

#include "studies/program/commands.hpp"
#include "studies/program/export.hpp"

namespace dovetail::studies {

int run_export(const ExportOptions& options, const Streams& streams) {
  std::string file = options.input;
  if (std::filesystem::is_directory(file)) {
    const std::filesystem::path best = std::filesystem::path(file) / "best.toml";
    if (!std::filesystem::exists(best))
      throw InputError(Violation{.file = {},
                                 .key = file,
                                 .value = {},
                                 .allowed = "holds no best design (best.toml); name a study file or a finished run"});
    file = best.string();
  }
  const Study study = load_study(file, options.overrides);
  export_scene(study.scene, options.format, options.file);
  streams.out << options.file << ": written\n";
  return kDone;
}

}  // namespace dovetail::studies
