#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "optimizer/accuracy/choice.hpp"
#include "optimizer/search/run.hpp"
#include "studies/program/answers/teller.hpp"
#include "studies/program/engine/interrupt.hpp"
#include "studies/program/engine/run_engine.hpp"
#include "studies/program/study_file/study.hpp"

namespace dovetail::studies {

/// A study with settings for an accuracy.
struct SettledStudy {
  Study study;
  std::string accuracy = {};        ///< what it came to where they were chosen; empty: none was asked for
  optimizer::BarParts raised = {};  ///< of the design there, see optimizer::SettingsChoice
};

/// Throws the InputError of a study that is not the one which the run in the directory was begun with, with what has
/// changed; returns where nothing is seen to have.
void refuse_changed(const std::filesystem::path& directory, const Study& study);

/// Throws an InputError where a run of `kept` evaluations is to go on with fewer than it has, and than it was begun
/// with: what it hands over would be of some of them alone.
void refuse_fewer(const std::filesystem::path& directory, const Study& study, std::size_t kept);

/// The study with everything that a run chooses before its search, as if it stood in its file: settings for the
/// accuracy it asks for, and the noise of its responses, both of the start. Kept in settings.json of the directory, and
/// with `resume` taken from there when the same was asked for.
[[nodiscard]] SettledStudy settled_run(const Study& asked, const std::filesystem::path& directory, bool resume,
                                       const RunEngineFactory& make_engine, Teller& teller);

/// The study that was searched with settings for `[optimizer] verify_accuracy` at its best design, where that is asked
/// for. Kept in best_settings.json and resumed as above; as it was searched when interrupted on the way.
/// @param asked  the study as its file has it: what stands there stays
[[nodiscard]] SettledStudy settled_best(const Study& asked, const Study& searched, const optimizer::Candidate& best,
                                        const std::filesystem::path& directory, bool resume,
                                        const OrderlyInterrupt& interrupt, Teller& teller);

/// The accuracy that is asked of what is handed over; nothing where none is.
[[nodiscard]] std::optional<optimizer::AccuracyGoal> goal_at_best(const Study& asked);

/// What the accuracy asked for chose, by key, for the search and for what is handed over, and what it came to. Empty
/// where none was asked for.
[[nodiscard]] std::map<std::string, std::string> chosen_settings(const Study& asked, const SettledStudy& searched,
                                                                 const SettledStudy& handed);

}  // namespace dovetail::studies
