#pragma once

#include <filesystem>
#include <functional>
#include <string_view>

namespace dovetail {

/// Lets `write` fill a temporary file beside `target`, with the same ending, and renames it to `target`: readers see
/// the old file or the complete new one, never a part. A device or pipe is written to, not replaced. Throws InputError
/// naming `target` when it cannot be written, or what `write` throws; the temporary file is removed then.
void replace_file(const std::filesystem::path& target,
                  const std::function<void(const std::filesystem::path& place)>& write);

/// The same with this content.
void replace_file(const std::filesystem::path& target, std::string_view content);

/// Throws the InputError of replace_file when `target` names no file, a directory, or one in a directory that does not
/// exist: to be asked before a long computation.
void check_replaceable(const std::filesystem::path& target);

/// Removes the temporary file that is being written, if there is one (the first, if there are several). For signal
/// handlers about to end the process: safe to call at any instant.
void remove_unfinished_file() noexcept;

}  // namespace dovetail
