#pragma once

#include <optional>

#include "optimizer/candidate/candidate_model.hpp"
#include "optimizer/candidate/contact_fit.hpp"
#include "optimizer/candidate/fillet_stress.hpp"
#include "optimizer/candidate/stage.hpp"
#include "optimizer/problem/evaluation.hpp"
#include "paths/resonance.hpp"
#include "wear/asymptote/asymptote.hpp"

namespace dovetail::optimizer {

/// Everything an evaluation computed, for responses, reports and exports. Members after the stage that failed are
/// empty.
struct CandidateResult {
  Evaluation evaluation;
  std::optional<Stage> stage;  ///< the last one that was come through
  CandidateModel model;
  ContactFit fit;
  std::optional<paths::Resonance> unworn, worn;
  std::optional<wear::Asymptote> asymptote;
  std::optional<wear::Asymptote> held;  ///< where the resonance was followed: the one at the unworn resonance
  std::optional<FilletStress> blade_fillet, disk_fillet;
};

/// The physics on a model that converged: contact nodes fitted to the worn zones, then the stages in order. Its
/// evaluation has no responses, see computed.
[[nodiscard]] CandidateResult through_stages(const Scene& scene, CandidateModel model, const Computation& how);

/// Volume worn off by friction energy before anything has worn, at most, m^3/J, where a node may dissipate `more`, J,
/// than it does.
[[nodiscard]] double worn_per_energy(const CandidateResult& result, double more);

/// By wear, relative, of a joint that came through all stages.
[[nodiscard]] double drift(const CandidateResult& result);

/// Hz, of rad/s.
[[nodiscard]] double hertz(double omega);

/// Options of every steady state of a scene.
[[nodiscard]] steady::Options steady_options(const SolverSettings& settings);

/// Of every search of a resonance of a scene.
[[nodiscard]] inline paths::ResonanceOptions resonance_options(const Scene& scene) {
  return {.frequency_tolerance = scene.solver.resonance_tolerance};
}

/// The resonance of the joint before it wears: next to a state near by, and where there is none or that leads to none
/// from the glued joint.
[[nodiscard]] paths::Resonance unworn_resonance(const Scene& scene, const CandidateModel& model,
                                                const steady::Joint& joint, const NearResonance& near,
                                                paths::ResonanceOptions options);

/// Where a state of a design with other settings is looked for on this model: its frequency, rad/s - stuck flanks are
/// stiffer than those that slip, by about as much there as here - and its displacement.
[[nodiscard]] double omega_as(const CandidateResult& from, double omega, const Scene& scene,
                              const CandidateModel& model);
[[nodiscard]] Eigen::MatrixXd displacement_as(const CandidateResult& from, const steady::State& state,
                                              const Scene& scene, const CandidateModel& model);

/// The joint of a candidate with these options, on its budget.
[[nodiscard]] steady::Joint joint_of(const Scene& scene, const CandidateModel& model, double penalty_scale = 1);

}  // namespace dovetail::optimizer
