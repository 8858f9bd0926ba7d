#include "studies/program/run/finished_run.hpp"

#include <fstream>

#include "core/replace_file.hpp"
#include "studies/program/engine/json_values.hpp"

namespace dovetail::studies {
namespace {

constexpr const char* kFinished = "finished.json";

/// Sizes of the files that a run makes its answer of, and of what it hands over: where one has changed or is damaged
/// the run says and writes it again.
Json sizes_in(const std::filesystem::path& directory) {
  Json sizes = Json::object();
  for (const char* name :
       {"study.toml", "settings.json", "best_settings.json", "journal.jsonl", "finer.jsonl", "front.jsonl",
        "verification.jsonl", "departures.jsonl", "results.h5", "report.html", "candidates.csv"}) {
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

std::string written_to(const std::string& directory) {
  return "written to " + directory + "\n";
}

std::optional<std::string> finished_before(const std::filesystem::path& directory, const std::string& question) {
  for (const char* file : {"results.h5", "report.html"})
    if (!std::filesystem::exists(directory / file)) return {};
  std::ifstream stream(directory / kFinished);
  if (!stream) return {};
  try {
    const Json json = Json::parse(stream);
    if (json.at("question") != question || json.at("sizes") != sizes_in(directory)) return {};
    auto answer = json.at("answer").get<std::string>();
    // The directory may have moved since then.
    const std::string before = written_to(json.at("directory").get<std::string>());
    if (const std::size_t at = answer.find(before); at != answer.npos)
      answer.replace(at, before.size(), written_to(directory.string()));
    return answer;
  } catch (const Json::exception&) {
    return {};  // damaged: the run says it again
  }
}

void keep_finished(const std::filesystem::path& directory, const std::string& question, const std::string& answer) {
  replace_file(directory / kFinished, text({{"question", question},
                                            {"directory", directory.string()},
                                            {"sizes", sizes_in(directory)},
                                            {"answer", answer}}));
}

void forget_finished(const std::filesystem::path& directory) {
  std::error_code ignored;
  std::filesystem::remove(directory / kFinished, ignored);
}

}  // namespace dovetail::studies
