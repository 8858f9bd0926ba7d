#pragma once

#include <optional>
#include <string>

#include "optimizer/candidate/candidate_model.hpp"
#include "optimizer/problem/evaluation.hpp"
#include "steady/state.hpp"
#include "wear/asymptote/asymptote.hpp"

namespace dovetail::optimizer {

/// Where the wear of a candidate comes to rest.
struct WornState {
  wear::Asymptote asymptote;
  std::optional<wear::Asymptote> held;  ///< where the resonance is followed: at the unworn one
  double omega = 0;                     ///< rad/s, at which wear came to rest
  std::string unfinished;               ///< what to say of a history that was asked and came to no end, or ""
};

/// The worn state found directly, or by the wear history where that finds none. With `history`, where the direct one is
/// in doubt, the wear history decides, on a budget of its own. But the direct one stays, in doubt, where the history
/// does not come to an end. It stays, too, where the history ends within a node of it, as on other nodes the history
/// may well end in it, and where the two are far apart and a history with more harmonics and samples ends nearer to it.
///
/// @param joint   the candidate's, unworn
/// @param unworn  its steady state
[[nodiscard]] WornState worn_state(const Scene& scene, const CandidateModel& model, const steady::Joint& joint,
                                   const steady::State& unworn, bool history);

/// Whether the worn state was in doubt, and what decided: into the evaluation's `model` and `messages`.
/// @param unfinished  of the WornState
void note_doubt(const wear::Asymptote& asymptote, const std::string& unfinished, Evaluation& evaluation);

}  // namespace dovetail::optimizer
