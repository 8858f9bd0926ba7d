#pragma once

#include <filesystem>
#include <functional>
#include <string>

namespace dovetail::studies {

/// Writes the text beside `path` and renames it there, so that `path` is never half written; an existing file is
/// replaced. Throws InputError naming the file when it cannot be written; nothing is left behind then.
void write_file(const std::filesystem::path& path, const std::string& text);

/// The same for a file another function writes: `write` gets the temporary path, whose ending is that of `path`.
void write_file_by(const std::filesystem::path& path, const std::function<void(const std::filesystem::path&)>& write);

}  // namespace dovetail::studies
