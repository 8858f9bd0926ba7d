#pragma once

#include <filesystem>
#include <functional>

namespace dovetail::geometry {

/// Lets `write` fill a temporary file beside `target` and renames it to `target`: readers see the old file or the
/// complete new one, never a part. When `write` throws or returns false, or the rename fails, the temporary file is
/// removed and InputError (naming the file) or the exception of `write` is thrown.
void replace_file(const std::filesystem::path& target,
                  const std::function<bool(const std::filesystem::path& temporary)>& write);

}  // namespace dovetail::geometry
