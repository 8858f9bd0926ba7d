#pragma once

#include <string>

namespace CLI {
class App;
}

/// What shells and manuals know of a command line, made of its definition.
namespace dovetail::studies {

/// A script that completes commands, options and their values in bash.
[[nodiscard]] std::string bash_completion(const CLI::App& app);
/// The same for zsh, with what the options say.
[[nodiscard]] std::string zsh_completion(const CLI::App& app);
/// The manual page, section 1.
[[nodiscard]] std::string manual_page(const CLI::App& app);

}  // namespace dovetail::studies
