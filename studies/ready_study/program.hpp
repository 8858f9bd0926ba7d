#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "studies/report/pages/page.hpp"

namespace dovetail::ready_study {

/// How the results of a ready study were made, as its page says.
struct Made {
  bool quick = false;  ///< no evidence
  std::string commit = {};
  double seconds = 0;
  std::string study_text = {};
};

/// What a program of a ready study was called with, and its clock.
struct Call {
  std::string folder, study_file, commit = "unknown";
  bool quick = false;
  std::chrono::steady_clock::time_point begin = std::chrono::steady_clock::now();

  /// Seconds since the call.
  [[nodiscard]] double passed() const;
  /// What was made by now, of a study with that text.
  [[nodiscard]] Made made(const std::string& study_text) const;
  /// A line for people, with the seconds.
  void say(const std::string& what) const;
};

/// A flag besides --quick.
struct Flag {
  const char* name;
  const char* help;
  bool* set;
};

/// A program of a ready study: PROGRAM FOLDER --study FILE [--commit TEXT] [--quick].
struct Program {
  const char* page;   ///< the file of FOLDER to look at
  const char* about;  ///< for its help, as the following two
  const char* files;  ///< what FOLDER gets
  const char* quick;
  std::vector<Flag> flags = {};
  /// Computes and writes. @return what did not converge, in sentences
  std::function<std::vector<std::string>(const Call&)> run;
};

/// The program's exit status: 0 done, 1 failed, 2 the input is wrong, 3 something did not converge.
[[nodiscard]] int run(int argc, char** argv, const Program& program);

/// The page of a template, in which {{quick}}, {{{provenance}}} and {{study}} are how its results were made, with these
/// rows of provenance besides; see report::page.
[[nodiscard]] std::string page(const std::string& title, std::string_view rules, std::string_view text,
                               report::Blanks blanks, const Made& made,
                               const std::vector<std::pair<std::string, std::string>>& more = {});

/// Writes files, name and content, to a folder that is made if needed. Throws InputError when it cannot.
void write(const std::filesystem::path& folder, const std::vector<std::pair<std::string, std::string>>& files);

}  // namespace dovetail::ready_study
