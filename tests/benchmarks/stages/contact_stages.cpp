#include "tests/benchmarks/stages/chain.hpp"

#include "optimizer/bars/error_bars.hpp"
#include "optimizer/candidate/worn_state.hpp"
#include "optimizer/responses/computed.hpp"
#include "optimizer/scene/scene_kind.hpp"
#include "steady/point.hpp"
#include "wear/asymptote/drift.hpp"

namespace dovetail::benchmarks {

namespace {

/// What the budget of a candidate has been spent on.
Needs spent_on_contact(const optimizer::CandidateModel& candidate) {
  const Budget& budget = *candidate.budget;
  return {{kDenseLu, budget.on_factors()}, {kMarch, budget.used() - budget.on_factors()}};
}

void fit_contact(Chain& chain) {
  chain.fit =
      optimizer::fit_contact(chain.scene, optimizer::until(optimizer::Stage::worn_resonance, false), chain.fitted);
  require(chain.fitted.converged() && !chain.fit.unworn.empty(), "contact_fit", chain.fitted.status);
}

void find_unworn(Chain& chain) {
  chain.unworn = paths::resonance(optimizer::joint_of(chain.scene, chain.fitted), chain.fit.unworn.front().omega,
                                  optimizer::resonance_options(chain.scene), chain.fit.unworn.front().displacement);
  require(chain.unworn->status == Status::converged, "unworn_resonance", to_string(chain.unworn->status));
}

void find_stress(const Chain& chain) {
  const fem::SectorMesh& sector = chain.fitted.mesh.sector;
  const Eigen::MatrixXd field = optimizer::displacement_field(chain.fitted, chain.unworn->state);
  (void)optimizer::fillet_stress(chain.scene, chain.fitted, field, sector.blade_fillet_nodes, sector.blade_fillet_share,
                                 chain.scene.blade.poisson_ratio);
  (void)optimizer::fillet_stress(chain.scene, chain.fitted, field, sector.disk_fillet_nodes, sector.disk_fillet_share,
                                 chain.scene.disk.poisson_ratio);
}

void find_asymptote(Chain& chain) {
  chain.rest = optimizer::worn_state(chain.scene, chain.fitted, optimizer::joint_of(chain.scene, chain.fitted),
                                     chain.unworn->state, false);
  require(chain.rest->asymptote.verdict == wear::Verdict::asymptote, "asymptote",
          wear::to_string(chain.rest->asymptote.verdict));
}

void find_worn(Chain& chain) {
  const steady::Joint joint = optimizer::joint_of(chain.scene, chain.fitted).worn(chain.rest->asymptote.depth);
  chain.worn = wear::resonance_drift(joint, *chain.unworn, optimizer::resonance_options(chain.scene)).worn;
  require(chain.worn->status == Status::converged, "worn_resonance", to_string(chain.worn->status));
}

double cube(double size) {
  return size * size * size;
}

}  // namespace

std::vector<Stage> contact_stages(Chain& chain) {
  const auto renew = [&] { optimizer::renew_budget(chain.scene.solver, chain.fitted); };
  const auto spent = [&] { return spent_on_contact(chain.fitted); };
  const auto on_first_grid = [&, renew] {
    if (!chain.candidate.condensed) {
      optimizer::lay_contact(chain.scene, chain.grid, chain.candidate);
      require(chain.candidate.converged(), "preload", chain.candidate.status);
    }
    chain.fitted = chain.candidate;
    renew();
  };
  const auto fit_needs = [&] {
    Needs needs = spent_on_contact(chain.fitted);
    needs[kDenseInverse] =
        chain.fit.grids * cube(static_cast<double>(chain.fitted.cells.count() * chain.fitted.condensed->directions()));
    return needs;
  };
  // A field is a substitution, half of a back-solve; both fillets want the same.
  const auto fields = [&] {
    return Needs{{kBackSolve, 0.5 * static_cast<double>(chain.unworn->state.displacement.cols())}};
  };
  return {{{"contact_fit", [&] { fit_contact(chain); }, on_first_grid}, fit_needs},
          {{"unworn_resonance", [&] { find_unworn(chain); }, renew}, spent},
          {{"stress", [&] { find_stress(chain); }}, fields},
          {{"asymptote", [&] { find_asymptote(chain); }, renew}, spent},
          {{"worn_resonance", [&] { find_worn(chain); }, renew}, spent}};
}

std::vector<Stage> whole_stages(Chain& chain) {
  const auto design_before = [&] {
    if (!chain.evaluator) chain.evaluator.emplace(chain.previous);
    (void)chain.evaluator->builder().build(chain.previous);
  };
  const auto evaluate = [&] {
    chain.result = chain.evaluator->evaluate(chain.scene, optimizer::kSearch);
    require(chain.result.evaluation.converged(), "whole", chain.result.evaluation.status);
  };
  const auto meshes = [&] {
    if (!chain.evaluator) chain.evaluator.emplace(chain.previous);
    if (!chain.others) chain.others.emplace(chain.previous);
    if (!chain.result.asymptote) chain.result = chain.evaluator->evaluate(chain.scene, optimizer::kSearch);
    chain.with_bars = chain.result;
  };
  const auto bars = [&] {
    optimizer::add_error_bars(chain.scene, chain.evaluator->builder(), &*chain.others,
                              optimizer::until(optimizer::Stage::worn_resonance, false), chain.with_bars);
    require(chain.with_bars.evaluation.converged(), "error_bars", chain.with_bars.evaluation.status);
  };
  const auto none = [] { return Needs{}; };
  return {{{"whole", evaluate, design_before}, none}, {{"error_bars", bars, meshes}, none}};
}

}  // namespace dovetail::benchmarks
