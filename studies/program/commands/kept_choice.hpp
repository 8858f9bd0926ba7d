#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "optimizer/accuracy/choice.hpp"
#include "studies/program/study_file/study.hpp"

namespace dovetail::studies {

/// What a run searches with and its study file does not give.
struct Chosen {
  std::map<std::string, double> settings;  ///< by key
  double noise = 0;
  nlohmann::ordered_json accuracy = {};  ///< how settings were chosen, see accuracy_json
};

/// Everything that the choice hangs on; which keys the file gives, too, for a key that is given stays.
[[nodiscard]] std::string question_of(const Study& study);

void keep(const std::filesystem::path& file, const std::string& question, const Chosen& chosen);
/// What was chosen before for the same question; nothing where none was. Throws InputError for a damaged file.
[[nodiscard]] std::optional<Chosen> kept(const std::filesystem::path& file, const std::string& question);

/// The parts of bars that the choice raised.
[[nodiscard]] optimizer::BarParts raised_in(const Chosen& chosen);

/// The study as if what was chosen stood in its file; `kept_in` is where it was read from, if it was.
[[nodiscard]] Study with_chosen(const Study& study, const Chosen& chosen, const std::filesystem::path& kept_in);

}  // namespace dovetail::studies
