#pragma once

#include <filesystem>
#include <optional>
#include <string>

/// What a run that came to its end answered, in finished.json of its directory: the same command once more has nothing
/// to do.
namespace dovetail::studies {

/// The line of an answer that says where everything is.
[[nodiscard]] std::string written_to(const std::string& directory);

/// The answer to the same question, where what the run made it of and the files it handed over are still there.
[[nodiscard]] std::optional<std::string> finished_before(const std::filesystem::path& directory,
                                                         const std::string& question);
void keep_finished(const std::filesystem::path& directory, const std::string& question, const std::string& answer);
/// Something is about to change.
void forget_finished(const std::filesystem::path& directory);

}  // namespace dovetail::studies
