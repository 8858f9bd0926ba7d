#pragma once

#include "core/errors.hpp"
#include "core/replace_file.hpp"

namespace dovetail::geometry {

/// dovetail::replace_file for a `write` that says whether it succeeded.
inline void replace_file(const std::filesystem::path& target,
                         const std::function<bool(const std::filesystem::path& temporary)>& write) {
  dovetail::replace_file(target, [&](const std::filesystem::path& place) {
    if (!write(place))
      throw InputError({.file = {}, .key = target.string(), .value = {}, .allowed = "cannot be written completely"});
  });
}

}  // namespace dovetail::geometry
