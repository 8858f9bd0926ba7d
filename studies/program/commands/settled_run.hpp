#pragma once

#include <filesystem>
#include <iosfwd>
#include <map>
#include <string>

#include "optimizer/search/run.hpp"
#include "studies/program/engine/interrupt.hpp"
#include "studies/program/engine/run_engine.hpp"
#include "studies/program/study_file/study.hpp"

namespace dovetail::studies {

/// The study with everything that a run chooses before its search, as if it stood in its file: settings for the
/// accuracy it asks for, and the noise of its responses, both of the start. Kept in settings.json of the directory, and
/// with `resume` taken from there when the same was asked for.
[[nodiscard]] Study settled_run(Study study, const std::filesystem::path& directory, bool resume,
                                const RunEngineFactory& make_engine, std::ostream& err);

/// What is handed over.
struct HandedOver {
  Study study;
  std::string accuracy = {};  ///< a sentence on what `[optimizer] verify_accuracy` asked for came to; empty: not chosen
};

/// The study that was searched with settings for `[optimizer] verify_accuracy` at its best design, where that is asked
/// for. Kept in best_settings.json and resumed as above; as it was searched when interrupted on the way.
/// @param asked  the study as its file has it: what stands there stays
[[nodiscard]] HandedOver settled_best(const Study& asked, const Study& searched, const optimizer::Candidate& best,
                                      const std::filesystem::path& directory, bool resume,
                                      const OrderlyInterrupt& interrupt, std::ostream& err);

/// What the accuracy asked for chose, by key, for the search and for what is handed over. Empty where none was asked
/// for.
[[nodiscard]] std::map<std::string, std::string> chosen_settings(const Study& asked, const Study& searched,
                                                                 const Study& handed);

}  // namespace dovetail::studies
