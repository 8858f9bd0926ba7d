// The whole path on a coarse section of the default joint: geometry to worn resonance.
#include "optimizer/evaluator.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "optimizer/problem/problem.hpp"
#include "optimizer/responses/response_table.hpp"
#include "paths/steady_state.hpp"
#include "tests/unit/reduction/stiffness_error.hpp"
#include "tests/verification/optimizer/coarse_scene.hpp"
#include "wear/history/history.hpp"
#include "wear/measures.hpp"

namespace dovetail::optimizer {
namespace {

const SceneEvaluator& evaluator() {
  static const SceneEvaluator instance(coarse_scene());
  return instance;
}

const CandidateResult& baseline() {
  static const CandidateResult result = evaluator().evaluate(coarse_scene());
  return result;
}

TEST(SectionEvaluation, ConvergesWithEveryResponseAndAFiniteErrorBar) {
  const Evaluation& evaluation = baseline().evaluation;
  ASSERT_TRUE(evaluation.converged()) << evaluation.status;
  for (const auto& [name, value] : evaluation.responses) EXPECT_TRUE(std::isfinite(value)) << name;
  EXPECT_GE(evaluation.responses.size(), 17U);
  // Every response has a bar, the sum of its sources, or is named as one without a limit.
  EXPECT_EQ(evaluation.error_estimates.size() + evaluation.unbounded.size(), evaluation.responses.size());
  EXPECT_EQ(evaluation.unbounded, (std::vector<std::string>{"contact_pressure_max_pa"}));
  for (const auto& [name, bar] : evaluation.error_estimates) {
    EXPECT_TRUE(std::isfinite(bar) && bar >= 0) << name;
    double sum = 0;
    for (const auto& [source, part] : evaluation.error_sources.at(name)) sum += part;
    EXPECT_DOUBLE_EQ(sum, bar) << name;
  }
  EXPECT_GT(evaluation.error_sources.at("resonance_hz").at("mesh"), 0);
}

// The status names the stage that spent the budget, responses of those before it stay.
TEST(SectionEvaluation, EndsWithItsBudget) {
  const double spent = baseline().evaluation.model.at("jacobians_spent");
  ASSERT_GT(spent, 5);
  Scene scene = coarse_scene();
  scene.solver.max_jacobians = static_cast<int>(0.8 * spent);
  const Evaluation part = evaluator().evaluate(scene).evaluation;
  const std::size_t colon = part.status.find(": ");
  ASSERT_NE(colon, std::string::npos) << part.status;
  EXPECT_EQ(part.status.substr(colon + 2), "budget_spent");
  EXPECT_TRUE(part.responses.contains("mass_kg"));
  // What it has is what it would have said with more, but for contact nodes that are laid less closely.
  for (const auto& [name, value] : part.responses) {
    const double whole = baseline().evaluation.responses.at(name);
    EXPECT_NEAR(value, whole, 0.03 * std::abs(whole)) << name;
  }
  // Of worn zones nothing is said where the joint did not come to vibrate.
  scene.solver.max_jacobians = 1;
  const Evaluation early = evaluator().evaluate(scene).evaluation;
  EXPECT_EQ(early.status, "unworn_resonance: budget_spent");
  EXPECT_TRUE(early.messages.empty());
  Scene hurried = coarse_scene();
  hurried.solver.time_limit = 1e-9;
  EXPECT_NE(evaluator().evaluate(hurried).evaluation.status.find("budget_spent"), std::string::npos);
}

TEST(SectionEvaluation, TellsWhetherItNeededAnotherPseudoPenalty) {
  EXPECT_EQ(baseline().evaluation.model.at("penalty_ratio"), 1);
  // Far stiffer than the contact, the one asked for does not converge from closed contact.
  Scene scene = coarse_scene();
  scene.solver.pseudo_penalty = 1e16;
  const Evaluation other = evaluator().evaluate(scene).evaluation;
  ASSERT_TRUE(other.model.contains("penalty_ratio")) << other.status;
  EXPECT_EQ(other.model.at("penalty_ratio") != 1,
            std::any_of(other.messages.begin(), other.messages.end(), [](const std::string& message) {
              return message.find("times the pseudo-penalty") != std::string::npos;
            }));
}

TEST(SectionEvaluation, FlanksCarryTheCentrifugalPull) {
  // Static equilibrium of the blade in the radial direction, its displacement neglected against its radius (1e-4).
  const CandidateModel& model = baseline().model;
  const Scene scene = coarse_scene();
  const double angle = scene.geometry.flank("right").angle;
  double radial = 0;
  for (Eigen::Index i = 0; i < model.cells.count(); ++i) {
    const double normal = model.preload.force(2 * i);
    const double tangential = model.preload.force(2 * i + 1);
    // Force on the blade is -lambda; n = (+-cos, sin), t points down the flank: (+-sin, -cos).
    radial += -(normal * std::sin(angle) - tangential * std::cos(angle));
  }
  const double speed = scene.loading.speed;
  double pull = 0;
  const fem::Mesh& mesh = model.mesh.sector.mesh;
  std::vector<bool> blade_node(static_cast<std::size_t>(mesh.node_count()), false);
  for (int e = 0; e < mesh.element_count(); ++e)
    if (mesh.regions[static_cast<std::size_t>(mesh.region[static_cast<std::size_t>(e)])].body == 0)
      for (const int node : mesh.element(e)) blade_node[static_cast<std::size_t>(node)] = true;
  const Eigen::VectorXd load = fem::centrifugal_load(model.matrices.shared->system.full.mass, mesh);
  for (int node = 0; node < mesh.node_count(); ++node)
    if (blade_node[static_cast<std::size_t>(node)]) pull += speed * speed * load(2 * node + 1);
  EXPECT_NEAR(-radial, pull, 2e-3 * pull);
}

TEST(SectionEvaluation, ReducedModelAgreesWithTheFullOneAtEveryHarmonic) {
  // The reduction of the evaluator compared with the full matrices it came from: errors like (h w / w_cut)^2.
  const CandidateModel& model = baseline().model;
  const double omega = baseline().unworn->omega;
  reduction::FullModel full;
  full.stiffness = fem::constrain(model.matrices.stiffness(), model.matrices.shared->system.constraints);
  full.mass = model.matrices.shared->system.mass;
  full.static_force = model.matrices.shared->system.centrifugal;
  full.cosine_force = model.matrices.shared->system.tip;
  full.sine_force = Eigen::MatrixXd::Zero(model.matrices.shared->system.size(), 1);
  full.outputs = model.matrices.shared->system.tip;
  full.output_names = {"tip_x"};
  full.contact = model.matrices.trace.contact;
  Eigen::SparseMatrix<double> same(full.contact.count(), full.contact.count());
  same.setIdentity();
  const reduction::Reduction reduced =
      reduction::reduce(model.matrices.trace, same, full.contact, coarse_scene().loading.damping_ratio);
  // 1.001: beside the resonance of the glued blade, where Z is large but finite.
  const std::array<double, 4> at{0.0, 1.01 * omega, 2 * omega, 3 * omega};
  for (const reduction::StiffnessError& error : reduction::compare(full, reduced, at)) {
    EXPECT_LT(error.stiffness, 2e-3) << error.angular_frequency / omega;
    EXPECT_LT(error.flexibility, 1e-4) << error.angular_frequency / omega;
  }
}

TEST(SectionEvaluation, EnergyIsBalancedAtTheResonance) {
  // Harmonic by harmonic the truncated contact force does the work input - damping: to the residual tolerance.
  const steady::State& state = baseline().unworn->state;
  EXPECT_NEAR(state.input_energy, state.damping_energy + state.contact_work, 1e-7 * state.input_energy);
  // Friction's own count from the slip differs by truncation in harmonics and samples: under 5 % at H = 3.
  EXPECT_NEAR(state.friction_energy, state.contact_work, 0.05 * state.contact_work);
}

TEST(SectionEvaluation, EnergyBalanceConvergesWithHarmonicsAndSamples) {
  const CandidateModel& model = baseline().model;
  std::vector<double> defect;
  for (const int harmonics : {3, 9, 27}) {
    steady::Options options = steady_options({});
    options.harmonics = harmonics;
    options.samples = 128 * harmonics;
    const steady::State state = paths::steady_state({model.condensed, {}, options}, baseline().unworn->omega);
    ASSERT_EQ(state.status, Status::converged);
    defect.push_back(std::abs(state.input_energy - state.damping_energy - state.friction_energy) / state.input_energy);
  }
  EXPECT_LT(defect[1], defect[0]);
  EXPECT_LT(defect[2], 0.5 * defect[1]);
}

TEST(SectionEvaluation, DirectAsymptoteAgreesWithTheHistory) {
  const CandidateResult& result = baseline();
  const wear::Asymptote& direct = *result.asymptote;
  ASSERT_EQ(direct.verdict, wear::Verdict::asymptote);
  ASSERT_GT(direct.largest_depth, 0);
  // First order in the increment: 1 % of the depth leaves about 1 % of it.
  wear::HistoryOptions options{.increment = 0.01 * direct.largest_depth, .steps = 2000};
  options.rate_fraction = 1e-6;
  const wear::History history = wear::history({result.model.condensed, {}, steady_options(coarse_scene().solver)},
                                              {.omega = result.unworn->omega}, options);
  ASSERT_EQ(history.status, Status::converged);
  const Eigen::VectorXd last = history.depth.row(history.depth.rows() - 1);
  EXPECT_LT((last - direct.depth).cwiseAbs().maxCoeff(), 0.05 * direct.largest_depth);
}

TEST(SectionEvaluation, SpinsUpFlanksThatTouchAtBothEnds) {
  // Hollow flanks on a mismatch: contact starts at one end and jumps to both within one of the preload's equal load
  // steps, which Newton's method does not follow; the path does in shorter ones.
  Scene scene;
  for (geometry::FlankParameters& flank : scene.geometry.flanks) {
    flank.mismatch = 6.694892451738145e-6;
    flank.crown = -2.7817521711339706e-6;
    flank.angle = 0.94607466;
    flank.length = 5.582930293028078e-3;
  }
  scene.geometry.neck_width = 8.678662842517202e-3;
  scene.geometry.neck_fillet_radius = 1.824488370054469e-3;
  const SceneEvaluator own(Scene{});
  const Evaluation evaluation = own.evaluate(scene).evaluation;
  EXPECT_TRUE(evaluation.converged()) << evaluation.status;
}

TEST(SectionEvaluation, SpinUpStaysInTheSlot) {
  // Spin softening gives the blade a second balance of forces, fallen towards the axis with all contact open. At 40
  // degrees Newton's method goes there from closed contact.
  Scene scene;
  scene.geometry.flank("left").angle = scene.geometry.flank("right").angle = 40 * 3.14159265358979 / 180;
  const SceneEvaluator own(scene);
  const Evaluation evaluation = own.evaluate(scene).evaluation;
  ASSERT_TRUE(evaluation.converged()) << evaluation.status;
  EXPECT_GT(evaluation.responses.at("contact_pressure_mean_pa"), 7e7);
  EXPECT_GT(evaluation.responses.at("asymptotic_wear_volume_m3"), 1e-10);
}

TEST(SectionEvaluation, GrossSlipHasNoAsymptote) {
  // Twenty newtons slide whole flanks: releasing them would leave nothing that holds the blade.
  Scene scene = coarse_scene();
  scene.loading.tip_force = 20;
  const Evaluation evaluation = evaluator().evaluate(scene).evaluation;
  EXPECT_FALSE(evaluation.converged());
  EXPECT_FALSE(evaluation.responses.contains("asymptotic_wear_volume_m3"));
  EXPECT_GT(evaluation.responses.at("dissipated_energy_j"), 0);
}

// Flanks that lift off in every cycle: nodes wear to where they touch without slip, before they touch nothing.
TEST(SectionEvaluation, HistoryDecidesWhereTheDirectWornStateIsInDoubt) {
  Scene scene = coarse_scene();
  for (geometry::FlankParameters& flank : scene.geometry.flanks) {
    flank.mismatch = 6.131298e-6;
    flank.crown = 4.587724e-6;
    flank.angle = 52.72727 * std::numbers::pi / 180;
    flank.length = 5.872546e-3;
  }
  scene.geometry.neck_width = 9.234462e-3;
  scene.geometry.neck_fillet_radius = 2.395893e-3;
  scene.contact.friction = 0.60024;
  scene.loading.tip_force = 4.449043;
  scene.loading.damping_ratio = 0.001833;
  scene.loading.speed = 8542.736562 * std::numbers::pi / 30;
  const CandidateResult searched = evaluator().evaluate(scene, kSearch);
  ASSERT_TRUE(searched.evaluation.converged()) << searched.evaluation.status;
  EXPECT_EQ(searched.evaluation.model.at("wear_history_may_differ"), 1);
  EXPECT_EQ(searched.evaluation.model.at("wear_decided_by_history"), 0);

  const CandidateResult settled = evaluator().evaluate(scene);
  ASSERT_TRUE(settled.evaluation.converged()) << settled.evaluation.status;
  EXPECT_EQ(settled.evaluation.model.at("wear_history_may_differ"), 0);
  EXPECT_EQ(settled.evaluation.model.at("wear_decided_by_history"), 1);
  EXPECT_TRUE(std::ranges::any_of(settled.evaluation.messages, [](const std::string& message) {
    return message.find("the wear history decided") != std::string::npos;
  }));
  const double direct = searched.asymptote->worn_volume, decided = settled.asymptote->worn_volume;
  EXPECT_GT(std::abs(decided / direct - 1), 0.01);
  EXPECT_GE(settled.evaluation.error_estimates.at("asymptotic_wear_volume_m3"), std::abs(decided - direct));

  // Explicit histories, which know of neither. A node more or less that wears makes them end up to 1 % apart, with
  // shorter increments, too, and extrapolation to none doubles that: the mean of some counts.
  const double increment = 0.03 * wear::largest_penetration(*searched.model.condensed, searched.unworn->state);
  const auto ended = [&](double part) {
    wear::HistoryOptions options;
    options.increment = part * increment;
    options.steps = 4000;
    options.finish = false;
    const wear::History history = wear::history({searched.model.condensed, {}, steady_options(scene.solver)},
                                                {.omega = searched.unworn->omega}, options);
    EXPECT_EQ(history.end, wear::HistoryEnd::worn_out);
    return history.worn_volume(history.cycles.size() - 1);
  };
  const double explicit_volume = (ended(0.95) + ended(1) + ended(1.05)) / 3;
  EXPECT_LT(std::abs(explicit_volume - decided), 0.3 * std::abs(explicit_volume - direct))
      << explicit_volume << " " << decided << " " << direct;
}

// Flanks on which the history ends in the direct worn state, too, but wears off whole nodes. Explicit histories on 80
// to 256 edges per flank end with 0.619, 0.632, 0.647, 0.658, 0.665 and 0.675 mm^3: 0.705 on infinitely short nodes.
TEST(SectionEvaluation, NodesOfAConfirmingHistoryAreInTheBar) {
  Scene scene = coarse_scene();
  for (geometry::FlankParameters& flank : scene.geometry.flanks) {
    flank.mismatch = 24.429651 * 1e-6;
    flank.crown = 6.409498 * 1e-6;
    flank.angle = 50.05622 * std::numbers::pi / 180;
    flank.length = 5.600917 * 1e-3;
  }
  scene.geometry.neck_width = 9.107106 * 1e-3;
  scene.geometry.neck_fillet_radius = 1.768042 * 1e-3;
  scene.contact.friction = 0.392378;
  scene.loading.tip_force = 3.592642;
  scene.loading.damping_ratio = 0.000789;
  scene.loading.speed = 11668.783379 * std::numbers::pi / 30;
  const CandidateResult settled = evaluator().evaluate(scene);
  ASSERT_TRUE(settled.evaluation.converged()) << settled.evaluation.status;
  ASSERT_EQ(settled.asymptote->doubt, wear::Doubt::lift_off);
  ASSERT_TRUE(settled.asymptote->confirmed_by_history);
  ASSERT_EQ(settled.asymptote->decided_by, wear::FoundBy::release);
  const char* name = "asymptotic_wear_volume_m3";
  const double volume = settled.evaluation.responses.at(name), bar = settled.evaluation.error_estimates.at(name);
  EXPECT_GT(settled.evaluation.error_sources.at(name).at("history"), 0.05 * volume);
  EXPECT_LT(bar, 0.5 * volume);
  for (const double ended : {0.619e-9, 0.705e-9}) EXPECT_LT(std::abs(volume - ended), bar) << volume;
}

TEST(SectionEvaluation, WearsByEnergyAsByArchardAndLessBeyondAThreshold) {
  Scene scene = coarse_scene();
  scene.contact.wear_law = "energy";
  scene.contact.wear.at("energy").coefficient = scene.contact.wear.at("archard").coefficient / scene.contact.friction;
  const Purpose without_bars{.bars = false};
  const Evaluation energy = evaluator().evaluate(scene, without_bars).evaluation;
  ASSERT_TRUE(energy.converged()) << energy.status;
  const auto volume = [](const Evaluation& evaluation) { return evaluation.responses.at("asymptotic_wear_volume_m3"); };
  EXPECT_NEAR(volume(energy), volume(baseline().evaluation), 1e-6 * volume(energy));
  // Where nodes rest in slip no release of nodes finds the end: a search asks the history, too.
  scene.contact.wear.at("energy").threshold = 10;
  const Evaluation less = evaluator().evaluate(scene, without_bars).evaluation;
  const Evaluation searched = evaluator().evaluate(scene, kSearch).evaluation;
  ASSERT_TRUE(less.converged()) << less.status;
  ASSERT_TRUE(searched.converged()) << searched.status;
  EXPECT_LT(volume(less), 0.9 * volume(energy));
  EXPECT_GT(volume(less), 0);
  EXPECT_EQ(less.model.at("wear_decided_by_history"), 1);
  EXPECT_NEAR(volume(searched), volume(less), 1e-6 * volume(less));
}

TEST(SectionEvaluation, RoughFlanksAreSofterAndRigidInTheLimit) {
  const auto resonance = [](double stiffness) {
    Scene scene = coarse_scene();
    scene.contact.normal_stiffness = scene.contact.tangential_stiffness = stiffness;
    const Evaluation found = evaluator().evaluate(scene, {.bars = false, .until = Stage::unworn}).evaluation;
    EXPECT_TRUE(found.converged()) << found.status;
    return std::pair{found.responses.at("resonance_hz"), found.responses.at("blade_fillet_stress_pa")};
  };
  const auto rigid = resonance(0), soft = resonance(1e13), stiff = resonance(1e15), stiffer = resonance(1e16);
  EXPECT_LT(soft.first, 0.999 * rigid.first);
  // What is left falls with the compliance.
  EXPECT_NEAR((rigid.first - stiff.first) / (rigid.first - stiffer.first), 10, 1);
  EXPECT_NEAR(stiffer.second, rigid.second, 1e-2 * rigid.second);
}

// What a stage answers hardly depends on whether later ones are computed, too: contact nodes follow worn zones only
// where these are.
TEST(SectionEvaluation, StopsAfterTheStageAskedForWithinTheBars) {
  for (const Stage last : {Stage::model, Stage::unworn, Stage::worn_state}) {
    const CandidateResult part = evaluator().evaluate(coarse_scene(), {.until = last});
    const Evaluation &some = part.evaluation, &all = baseline().evaluation;
    ASSERT_TRUE(some.converged()) << some.status;
    EXPECT_EQ(part.unworn.has_value(), last >= Stage::unworn);
    EXPECT_EQ(part.asymptote.has_value(), last >= Stage::worn_state);
    EXPECT_FALSE(part.worn);
    for (const Response& response : responses()) {
      const std::string name(response.name);
      ASSERT_EQ(some.responses.contains(name), response.stage <= last) << name;
      if (response.stage > last) {
        EXPECT_FALSE(some.error_estimates.contains(name)) << name;
        continue;
      }
      EXPECT_EQ(some.error_estimates.contains(name), all.error_estimates.contains(name)) << name;
      const double bar = all.error_estimates.contains(name) ? all.error_estimates.at(name) : all.responses.at(name);
      EXPECT_NEAR(some.responses.at(name), all.responses.at(name), bar) << name;
      // On the same contact nodes it is the same.
      if (last == Stage::worn_state) {
        EXPECT_EQ(some.responses.at(name), all.responses.at(name)) << name;
      }
    }
  }
}

// Designs with one mesh compute their matrices once, and matrices computed before change no result.
TEST(SectionEvaluation, DesignsThatDifferOnTheFlanksShareTheirMatrices) {
  Scene scene = coarse_scene();
  scene.solver.prestress = Prestress::shared;
  const ModelBuilder builder(scene);
  const CandidateModel first = builder.build(scene);
  ASSERT_TRUE(first.converged()) << first.status;
  EXPECT_TRUE(first.timings_s.contains("reduction"));
  Scene other = scene;
  for (geometry::FlankParameters& flank : other.geometry.flanks) {
    flank.mismatch += 4e-6;
    flank.crown += 2e-6;
  }
  other.contact.friction *= 0.9;
  other.loading.tip_force *= 3;
  const CandidateModel again = builder.build(other);
  EXPECT_EQ(again.matrices.shared, first.matrices.shared);
  EXPECT_FALSE(again.timings_s.contains("reduction"));
  const CandidateModel fresh = ModelBuilder(scene).build(other);
  EXPECT_NE(fresh.matrices.shared, first.matrices.shared);
  EXPECT_EQ(again.model.stiffness, fresh.model.stiffness);
  EXPECT_EQ(again.model.cosine_force, fresh.model.cosine_force);
  EXPECT_EQ(again.preload.pressure, fresh.preload.pressure);
  EXPECT_EQ(again.matrices.trace.contact.friction, fresh.matrices.trace.contact.friction);
  // A design's own prestress hangs on its gaps.
  other.solver.prestress = Prestress::own;
  EXPECT_NE(builder.build(other).matrices.shared, builder.build(scene).matrices.shared);
}

// The keys by which a study tells that its designs share their matrices.
TEST(SectionEvaluation, KnowsWhichKeysLeaveTheMatrices) {
  Scene scene = coarse_scene();
  scene.solver.prestress = Prestress::shared;
  const ModelBuilder builder(scene);
  const auto with = [&](const char* key, double value) {
    Scene changed = scene;
    set_parameter(changed, key, value);
    return builder.build(changed).matrices.shared;
  };
  for (const auto& [key, value] :
       std::vector<std::pair<const char*, double>>{{"geometry.flank_mismatch_um", 3},
                                                   {"geometry.left.flank_crown_um", 1},
                                                   {"contact.friction", 0.45},
                                                   {"contact.wear_coefficient_per_pa", 2e-13},
                                                   {"contact.normal_stiffness_n_per_m3", 1e15},
                                                   {"loading.tip_force_n", 3},
                                                   {"loading.damping_ratio", 0.002},
                                                   {"geometry.neck_width_mm", 8.6},
                                                   {"geometry.flank_angle_deg", 51},
                                                   {"scene.speed_rpm", 9000},
                                                   {"material.blade.density_kg_m3", 4400},
                                                   {"geometry.slot_length_mm", 41},
                                                   {"solver.modes", 10}}) {
    const auto before = builder.build(scene).matrices.shared;
    EXPECT_EQ(with(key, value) == before, shares_matrices(key)) << key;
  }
}

// Contact nodes are laid at a resonance that is found with few harmonics at first and less closely than the one that
// counts: they end where they would at that one, as closely as edges are asked for.
TEST(SectionEvaluation, ContactNodesAreLaidAtTheResonanceThatCounts) {
  for (const double mismatch : {4e-6, 8e-6}) {
    Scene scene = coarse_scene();
    for (geometry::FlankParameters& flank : scene.geometry.flanks) flank.mismatch = mismatch;
    const CandidateModel model = ModelBuilder(scene).build(scene);
    Computation closely;
    closely.contact.resonance = {
        .harmonics = scene.solver.harmonics, .samples = scene.solver.samples, .of_half_width = 0};
    const CandidateResult roughly = through_stages(scene, model, {}), close = through_stages(scene, model, closely);
    ASSERT_TRUE(roughly.evaluation.converged() && close.evaluation.converged());
    ASSERT_GT(close.fit.edges, 0);
    EXPECT_EQ(roughly.fit.edges, close.fit.edges);
    for (std::size_t f = 0; f < close.model.cells.flanks.size(); ++f) {
      const std::vector<double>&here = roughly.model.cells.flanks[f].across.front(),
            &there = close.model.cells.flanks[f].across.front();
      ASSERT_EQ(here.size(), there.size());
      for (std::size_t k = 0; k < there.size(); ++k)
        EXPECT_NEAR(here[k], there[k], 2 * ContactFitOptions{}.aim / scene.mesh.flank_elements) << f << " " << k;
    }
    EXPECT_NEAR(roughly.asymptote->worn_volume, close.asymptote->worn_volume, 1e-3 * close.asymptote->worn_volume);
    EXPECT_NEAR(roughly.unworn->omega, close.unworn->omega, 1e-6 * close.unworn->omega);
    EXPECT_NE(roughly.unworn->omega, close.unworn->omega);
  }
}

// A state that is near no resonance leads to none: it is then looked for from the glued joint.
TEST(SectionEvaluation, AResonanceIsFoundFromAStateThatIsFarFromIt) {
  const Scene scene = coarse_scene();
  const CandidateModel model = ModelBuilder(scene).build(scene);
  ASSERT_TRUE(model.converged()) << model.status;
  const steady::Joint joint = joint_of(scene, model);
  const paths::Resonance alone = unworn_resonance(scene, model, joint, {}, resonance_options(scene));
  NearResonance far{.omega = 0.4 * alone.omega, .displacement = 0 * alone.state.displacement};
  const paths::Resonance found = unworn_resonance(scene, model, joint, far, resonance_options(scene));
  ASSERT_EQ(found.status, Status::converged);
  EXPECT_NEAR(found.omega, alone.omega, 1e-6 * alone.omega);
  EXPECT_GT(found.solves, alone.solves);
}

// Cases that differ in friction or force share the matrices of their design, which are its own in the evaluator's
// friction; what another friction changes in them is in the bars.
TEST(SectionEvaluation, CasesOfADesignShareItsMatrices) {
  Scene scene = coarse_scene();
  for (geometry::FlankParameters& flank : scene.geometry.flanks) flank.mismatch = 8e-6;
  scene.solver.prestress = Prestress::cases;
  Scene slippery = scene, own = scene, another_form = scene;
  slippery.contact.friction = 0.8 * scene.contact.friction;
  slippery.loading.tip_force *= 2;
  own.solver.prestress = Prestress::own;
  another_form.geometry.flanks.front().crown += 1e-6;
  const ModelBuilder builder(scene);
  const CandidateModel first = builder.build(scene);
  ASSERT_TRUE(first.converged()) << first.status;
  EXPECT_FALSE(first.matrices.by_other);
  EXPECT_EQ(first.model.stiffness, builder.build(own).model.stiffness);
  const std::shared_ptr<const Matrices> shared = builder.build(scene).matrices.shared;
  const CandidateModel again = builder.build(slippery);
  EXPECT_EQ(again.matrices.shared, shared);
  EXPECT_TRUE(again.matrices.by_other);
  const CandidateModel fresh = ModelBuilder(scene).build(slippery);
  EXPECT_EQ(again.model.stiffness, fresh.model.stiffness);
  EXPECT_EQ(again.model.cosine_force, fresh.model.cosine_force);
  EXPECT_EQ(again.preload.pressure, fresh.preload.pressure);
  EXPECT_NE(builder.build(another_form).matrices.shared, shared);

  const Evaluation found = SceneEvaluator(scene).evaluate(slippery).evaluation;
  slippery.solver.prestress = Prestress::own;
  const Evaluation exact = SceneEvaluator(scene).evaluate(slippery, {.bars = false}).evaluation;
  ASSERT_TRUE(found.converged() && exact.converged()) << found.status << exact.status;
  double largest = 0;
  for (const auto& [name, value] : exact.responses) {
    const auto sources = found.error_sources.find(name);
    if (sources == found.error_sources.end() || !sources->second.contains("prestress")) continue;
    const double change = std::abs(found.responses.at(name) - value);
    largest = std::max(largest, change / std::abs(value));
    EXPECT_LE(change, 2 * sources->second.at("prestress") + 1e-5 * std::abs(value)) << name;
    const auto bar = found.error_estimates.find(name);
    const double whole = bar == found.error_estimates.end() ? kInfinity : bar->second;
    EXPECT_LE(change, 0.1 * whole + 1e-5 * std::abs(value)) << name;
  }
  EXPECT_GT(largest, 1e-5);  // there is something to be in the bars
}

// Matrices that designs share answer as those assembled for each of them, within the bar that they have for that, which
// is next to nothing.
TEST(SectionEvaluation, SharedMatricesAnswerAsADesignsOwn) {
  for (const double mismatch : {15e-6, -5e-6}) {
    Scene scene = coarse_scene();
    for (geometry::FlankParameters& flank : scene.geometry.flanks) {
      flank.mismatch = mismatch;
      flank.crown = 5e-6;
    }
    scene.contact.friction = 0.4;
    scene.solver.prestress = Prestress::shared;
    Scene reference = scene;
    reference.contact.friction = 0.6;
    const Evaluation shared = SceneEvaluator(reference).evaluate(scene).evaluation;
    scene.solver.prestress = Prestress::own;
    const Evaluation own = evaluator().evaluate(scene, {.bars = false}).evaluation;
    ASSERT_TRUE(shared.converged() && own.converged()) << shared.status << own.status;
    for (const auto& [name, value] : own.responses) {
      const double change = std::abs(shared.responses.at(name) - value);
      EXPECT_LT(change, 1e-5 * std::abs(value)) << name;
      if (!shared.error_sources.contains(name)) continue;
      EXPECT_LT(shared.error_sources.at(name).at("prestress"), 1e-4 * std::abs(value)) << name;
    }
    EXPECT_NE(shared.responses.at("resonance_hz"), own.responses.at("resonance_hz"));
  }
}

TEST(SectionEvaluation, RunsTwiceToTheSameBits) {
  const CandidateResult again = evaluator().evaluate(coarse_scene());
  EXPECT_EQ(again.evaluation.responses, baseline().evaluation.responses);
  EXPECT_EQ(again.evaluation.error_estimates, baseline().evaluation.error_estimates);
}

TEST(SectionEvaluation, MirrorImagesWearAlike) {
  Scene left = coarse_scene();
  Scene right = coarse_scene();
  left.geometry.flank("left").mismatch = 10e-6;
  right.geometry.flank("right").mismatch = 10e-6;
  const Evaluation a = evaluator().evaluate(left).evaluation;
  const Evaluation b = evaluator().evaluate(right).evaluation;
  ASSERT_TRUE(a.converged() && b.converged()) << a.status << b.status;
  for (const char* name : {"resonance_hz", "asymptotic_wear_volume_m3", "blade_fillet_stress_pa", "mass_kg"})
    EXPECT_NEAR(a.responses.at(name), b.responses.at(name), 1e-5 * std::abs(b.responses.at(name))) << name;
}

TEST(SectionEvaluation, InfeasibleDesignIsNamedNotComputed) {
  Scene scene = coarse_scene();
  scene.geometry.flank("left").angle = scene.geometry.flank("right").angle = 0.4;  // below atan(0.5) = 0.46: locks
  const Evaluation evaluation = evaluator().evaluate(scene).evaluation;
  EXPECT_EQ(evaluation.status, "infeasible");
  EXPECT_FALSE(evaluation.feasible);
  EXPECT_GT(evaluation.constraints.at("rule:self_locking_left"), 0);
  EXPECT_FALSE(evaluation.messages.empty());
  EXPECT_FALSE(evaluation.responses.contains("resonance_hz"));
}

TEST(SectionEvaluation, SceneOutOfRangeIsRefused) {
  Scene scene = coarse_scene();
  scene.contact.friction = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(static_cast<void>(evaluator().evaluate(scene)), InputError);
}

TEST(SectionEvaluation, ErrorBarsCoverAFinerComputationInTime) {
  Scene fine = coarse_scene();
  fine.solver.harmonics = 9;
  fine.solver.samples = 512;
  fine.solver.modes = 40;
  const Evaluation reference = evaluator().evaluate(fine).evaluation;
  ASSERT_TRUE(reference.converged()) << reference.status;
  const Evaluation& coarse = baseline().evaluation;
  for (const auto& [name, bar] : coarse.error_estimates) {
    // Twice the bar: the bars are estimates of the error, not bounds; rounding of the search for the rest.
    const double difference = std::abs(coarse.responses.at(name) - reference.responses.at(name));
    EXPECT_LE(difference, 2 * bar + 1e-9 * std::abs(reference.responses.at(name)))
        << name << ": " << coarse.responses.at(name) << " +- " << bar << ", finer " << reference.responses.at(name);
  }
}

}  // namespace
}  // namespace dovetail::optimizer
