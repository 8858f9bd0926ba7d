#include "studies/program/run/finished_run.hpp"

#include <fstream>

#include "core/replace_file.hpp"
#include "studies/program/engine/json_values.hpp"

namespace dovetail::studies {
namespace {

constexpr const char* kFinished = "finished.json";

/// Sizes of the files that a run makes its answer of, and of what it hands over: what has changed since then is looked
/// at again.
Json sizes_in(const std::filesystem::path& directory) {
  Json sizes = Json::object();
  for (const char* name : {"settings.json", "best_settings.json", "journal.jsonl", "finer.jsonl", "front.jsonl",
                           "verification.jsonl", "departures.jsonl"}) {
    std::error_code none;
    const std::uintmax_t size = std::filesystem::file_size(directory / name, none);
    if (!none) sizes[name] = size;
  }
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator(directory, none))
    if (const std::string name = entry.path().filename().string(); name.starts_with("best.") && entry.is_regular_file())
      sizes[name] = entry.file_size();
  return sizes;
}

}  // namespace

std::optional<std::string> finished_before(const std::filesystem::path& directory, const std::string& question) {
  for (const char* file : {"results.h5", "report.html"})
    if (!std::filesystem::exists(directory / file)) return {};
  std::ifstream stream(directory / kFinished);
  if (!stream) return {};
  try {
    const Json json = Json::parse(stream);
    if (json.at("question") != question || json.at("sizes") != sizes_in(directory)) return {};
    return json.at("answer").get<std::string>();
  } catch (const Json::exception&) {
    return {};  // damaged: the run says it again
  }
}

void keep_finished(const std::filesystem::path& directory, const std::string& question, const std::string& answer) {
  replace_file(directory / kFinished,
               text({{"question", question}, {"sizes", sizes_in(directory)}, {"answer", answer}}));
}

void forget_finished(const std::filesystem::path& directory) {
  std::error_code ignored;
  std::filesystem::remove(directory / kFinished, ignored);
}

}  // namespace dovetail::studies
