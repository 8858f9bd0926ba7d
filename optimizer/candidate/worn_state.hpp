#pragma once

#include "optimizer/candidate/candidate_model.hpp"
#include "optimizer/problem/evaluation.hpp"
#include "steady/state.hpp"
#include "wear/asymptote/rest.hpp"

namespace dovetail::optimizer {

/// Where the wear of a candidate comes to rest: wear::comes_to_rest with a budget of its own for each history.
///
/// - `joint`: the candidate's, unworn
/// - `unworn`: its steady state
/// - `history`: asks the history where the direct answer is in doubt
[[nodiscard]] wear::Rest worn_state(const Scene& scene, const CandidateModel& model, const steady::Joint& joint,
                                    const steady::State& unworn, bool history);

/// Whether the worn state was in doubt, and what decided: into the evaluation's `model` and `messages`.
/// - `unfinished`: of the Rest
void note_doubt(const wear::Asymptote& asymptote, wear::Unfinished unfinished, Evaluation& evaluation);

}  // namespace dovetail::optimizer
