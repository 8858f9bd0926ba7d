#include "optimizer/mission/mission_bars.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "optimizer/bars/bars.hpp"
#include "optimizer/bars/params.hpp"
#include "optimizer/candidate/candidate_result.hpp"
#include "optimizer/responses/response_table.hpp"
#include "quality/truncation.hpp"
#include "wear/asymptote/worn_zones.hpp"

namespace dovetail::optimizer {

namespace {

constexpr CompanionParams kOther;

const Response& response_of(const std::string& name) {
  return *find_response(split_case(name).response);
}

class MissionBars {
 public:
  MissionBars(const MissionLoads& loads, const ModelBuilder& builder, const OtherMeshes& others, MissionResult& result)
      : loads_(loads), builder_(builder), others_(others), result_(result) {}

  void run() {
    ask_meshes();
    ask_longer_nodes();
    ask_settings();
    add_own();
    total();
  }

 private:
  using Change = std::function<void(Scene&, Computation&)>;

  /// A mesh on which other settings may be asked for.
  struct Base {
    const ModelBuilder* builder;
    MissionLoads loads;
    const MissionResult* answer;
  };

  [[nodiscard]] const Scene& scene() const { return loads_.all.front().scene; }
  [[nodiscard]] Evaluation& evaluation() { return result_.evaluation; }

  [[nodiscard]] static MissionLoads changed(MissionLoads loads, const std::function<void(Scene&)>& change) {
    for (MissionLoads::Load& load : loads.all) change(load.scene);
    return loads;
  }

  [[nodiscard]] MissionResult companion(const MissionLoads& loads, std::vector<CandidateModel> models,
                                        const Computation& how, const MissionResult* from) const {
    for (std::size_t k = 0; k < models.size(); ++k)
      if (models[k].converged()) renew_budget(loads.all[k].scene.solver, models[k]);
    return mission_of(loads, std::move(models), how, result_.mission->bearing.doubtful() ? nullptr : from);
  }

  /// The part of the bar that a companion says; false where it has no answer.
  bool add(const char* source, const Evaluation& other, const Factor& factor, const Evaluation& reference) {
    if (!other.converged()) {
      evaluation().messages.push_back(std::string("A design computed for the error of all cases together by ") +
                                      source + " ended with \"" + other.status + "\".");
      missing_ = other.status;
      return false;
    }
    for (const auto& [name, value] : evaluation().responses) {
      double& part = evaluation().error_sources[name][source];
      part =
          std::max(part, factor(response_of(name)) * std::abs(other.responses.at(name) - reference.responses.at(name)));
    }
    return true;
  }

  /// What a change of the worn volume changes, in proportion.
  void add_volume(const char* source, double volume) {
    const double whole = result_.mission->worn_volume;
    if (whole > 0)
      for (const auto& [name, value] : evaluation().responses)
        evaluation().error_sources[name][source] += volume / whole * std::abs(value);
  }

  void ask_meshes() {
    answers_.reserve(others_.meshes().size());
    for (const auto& [sizes, on_it] : others_.meshes()) {
      const MissionLoads there =
          changed(loads_, [ratio = sizes](Scene& each) { each = resized(std::move(each), ratio); });
      const double ratio =
          static_cast<double>(scene().mesh.flank_elements) / there.all.front().scene.mesh.flank_elements;
      answers_.push_back(
          {.builder = &on_it, .loads = there, .result = companion(there, models_of(there, on_it), {}, &result_)});
      if (finer_ || ratio == 1) continue;
      const auto factor = [ratio, in_space = scene().kind->in_space](const Response& response) {
        return left_over(in_space ? response.mesh_order.in_space : response.mesh_order.in_plane, ratio);
      };
      known_mesh_ = add("mesh", answers_.back().result.evaluation, factor, evaluation()) || known_mesh_;
      finer_ = ratio < 1 && answers_.back().result.evaluation.converged();
    }
    if (known_mesh_) missing_.clear();
  }

  /// See ErrorBarSources: of what a finer mesh and what longer nodes change the larger counts whole.
  void ask_longer_nodes() {
    Computation how;
    how.contact.lengths.finest *= kOther.longer_nodes;
    how.contact.lengths.coarsest *= kOther.longer_nodes;
    const MissionResult longer = companion(loads_, result_.models, how, &result_);
    const auto factor = [](const Response& response) { return left_over(response.grid_order, kOther.longer_nodes); };
    if (!add("contact_grid", longer.evaluation, factor, evaluation()) || !finer_) return;
    constexpr double kAgain = kOther.nodes_again;
    for (auto& [name, parts] : evaluation().error_sources) {
      const double whole = parts["contact_grid"];
      parts["contact_grid"] = kAgain * whole + (1 - kAgain) * std::max(0.0, whole - parts["mesh"]);
    }
  }

  void ask_settings() {
    std::vector<Base> bases;
    for (std::size_t i = answers_.size(); i-- > 0;)  // the coarsest one stands last
      if (others_.meshes()[i].ratio > 1 && answers_[i].result.evaluation.converged() &&
          answers_[i].result.mission->largest_depth > 0)
        bases.push_back({answers_[i].builder, answers_[i].loads, &answers_[i].result});
    bases.push_back({&builder_, loads_, &result_});
    const quality::TruncationFactors factors = quality::truncation_factors(true);
    ask(bases, "modes", kOther.modes_factor, [](Scene& each, Computation&) {
      each.solver.modes = std::max(2 * each.solver.modes, each.solver.modes + kOther.more_modes);
    });
    if (std::ranges::any_of(result_.models, [](const CandidateModel& model) { return model.matrices.by_other; }))
      ask(bases, "prestress", 1, [](Scene& each, Computation&) { each.solver.prestress = Prestress::own; });
    if (!scene().kind->coarse_answers) bases.erase(bases.begin(), bases.end() - 1);
    ask(bases, "harmonics", factors.harmonics, [](Scene& each, Computation&) {
      each.solver.harmonics = 2 * each.solver.harmonics + 1;
      each.solver.samples = quality::samples_for(each.solver.harmonics, each.solver.samples);
    });
    ask(bases, "samples", factors.samples, [](Scene& each, Computation&) { each.solver.samples *= 2; });
    ask(bases, "pseudo_penalty", factors.penalty, [](Scene&, Computation& how) { how.penalty_scale = kOther.softer; });
  }

  /// Of the first base that has an answer.
  void ask(const std::vector<Base>& bases, const char* source, double factor, const Change& change) {
    std::string failed;
    for (const Base& base : bases) {
      Computation how;
      how.grid_from = true;
      const MissionLoads there = changed(base.loads, [&](Scene& each) { change(each, how); });
      const SolverSettings &now = there.all.front().scene.solver, &before = base.loads.all.front().scene.solver;
      const bool same = now.modes == before.modes && now.prestress == before.prestress;
      const MissionResult answer =
          companion(there, same ? base.answer->models : models_of(there, *base.builder), how, base.answer);
      failed = answer.evaluation.status;
      if (!answer.evaluation.converged()) continue;
      add(source, answer.evaluation, same_for_all(factor), base.answer->evaluation);
      return;
    }
    missing_ = failed;
  }

  void add_own() {
    const wear::Mission& mission = *result_.mission;
    // See by_resonance of worn_bars: damping alone makes the peak no wider than friction and damping do.
    const double damping = scene().loading.damping_ratio;
    const double share = damping > 0 ? std::min(1.0, scene().solver.resonance_tolerance / (2 * damping)) : 1.0;
    add_volume("search", share * mission.worn_volume);
    for (auto& [name, parts] : evaluation().error_sources)  // of two frequencies
      if (&response_of(name) == &kMissionDrift) parts["search"] += 2 * scene().solver.resonance_tolerance;
    if (const double moved = result_.fit.settled ? 0 : result_.fit.share; moved > 0)
      add_volume("edge",
                 wear::width_changed_by(moved, {.volume = mission.worn_volume, .depth = mission.largest_depth}).volume);
    const auto told = [&](const char* what) {
      const auto found = evaluation().model.find(std::string(kMissionPrefix) + what);
      return found == evaluation().model.end() ? std::nan("") : found->second;
    };
    if (const double confirmed = told("confirmed_by_history"); confirmed != 1) {
      add_volume("order",
                 std::max(mission.largest_volume - mission.worn_volume, mission.worn_volume - mission.least_volume));
      if (std::isnan(confirmed)) return;  // no history was asked
    }
    // A history that came to no end leaves it open, as it does for one load.
    const double past = told("history_volume_m3");
    add_volume("history", std::isnan(past) ? mission.worn_volume : std::abs(past - mission.worn_volume));
  }

  void total() {
    for (const auto& [name, parts] : evaluation().error_sources) {
      double sum = 0;
      for (const auto& [source, part] : parts) sum += part;
      evaluation().error_estimates[name] = sum;
    }
    if (!missing_.empty()) evaluation().status = failed_at("error_estimates", missing_.substr(missing_.rfind(' ') + 1));
  }

  struct Answer {
    const ModelBuilder* builder;
    MissionLoads loads;
    MissionResult result;
  };

  const MissionLoads& loads_;
  const ModelBuilder& builder_;
  const OtherMeshes& others_;
  MissionResult& result_;
  std::vector<Answer> answers_;  // of the other meshes
  bool finer_ = false;           // one of them is finer and has an answer
  bool known_mesh_ = false;
  std::string missing_;  // how the companion ended without which a part is not known
};

}  // namespace

void add_mission_bars(const MissionLoads& loads, const ModelBuilder& builder, const OtherMeshes& others,
                      MissionResult& result) {
  MissionBars(loads, builder, others, result).run();
}

std::vector<CandidateModel> models_of(const MissionLoads& loads, const ModelBuilder& builder) {
  std::vector<CandidateModel> models(loads.all.size());
  for (std::size_t i = 0; i < models.size(); ++i) {
    const std::size_t load = loads.by_sharing.empty() ? i : loads.by_sharing[i];
    models[load] = builder.build(loads.all[load].scene);
  }
  return models;
}

}  // namespace dovetail::optimizer
