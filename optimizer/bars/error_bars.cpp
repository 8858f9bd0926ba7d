#include "optimizer/bars/error_bars.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "optimizer/bars/bars.hpp"
#include "optimizer/bars/params.hpp"
#include "optimizer/bars/unseen_zones.hpp"
#include "optimizer/bars/worn_bars.hpp"
#include "optimizer/responses/computed.hpp"
#include "paths/resonance.hpp"
#include "quality/truncation.hpp"

namespace dovetail::optimizer {

namespace {

constexpr CompanionParams kCompanion;

/// Hardly anything bears, and on other nodes nothing does: that is no worn state.
void refuse_worn_state(const std::string& status, Evaluation& evaluation) {
  evaluation.status = status;
  evaluation.error_sources.clear();
  for (const Response& response : responses())
    if (response.stage >= Stage::worn_state) evaluation.responses.erase(std::string(response.name));
  evaluation.messages.push_back(
      "A worn state was found in which hardly anything bears; on another mesh or longer contact nodes there is "
      "none.");
}

CandidateResult companion(const Scene& scene, CandidateModel model, const Computation& how) {
  if (model.converged()) renew_budget(scene.solver, model);
  return computed(scene, std::move(model), how);
}

/// Asks companions of one design and gathers what they say.
class ErrorBarSources {
 public:
  ErrorBarSources(const Scene& scene, const ModelBuilder& builder, const OtherMeshes* others, const Computation& how,
                  CandidateResult& result)
      : scene_(scene), builder_(builder), others_(others), result_(result), bars_(scene, result), as_here_(how) {
    // Where hardly anything bears the question is what other settings come to on their own.
    if (!result.asymptote || !result.asymptote->bearing.doubtful()) as_here_.from = &result_;
    // Where the history decided, it does so for the companions.
    as_here_.history = result.asymptote && result.asymptote->decided_by == wear::FoundBy::history;
  }

  void run() {
    if (others_ == nullptr) {
      std::vector<Base> own{own_mesh()};
      if (as_here_.until >= Stage::unworn) ask_truncation(own);
      return bars_.total();
    }
    ask_meshes();
    const CandidateResult longer = on_nodes(kCompanion.longer_nodes);
    const std::string slides = failed_at("asymptote", Status::gross_sliding);
    const auto does = [&slides](const CandidateResult& answer) { return answer.evaluation.status == slides; };
    if (worn() && result_.asymptote->bearing.doubtful() && (does(longer) || std::ranges::any_of(answers_, does)))
      return refuse_worn_state(slides, result_.evaluation);
    add_contact_grid(longer.evaluation);
    if (as_here_.until >= Stage::unworn) {
      add_slip();
      bars_.add("search", LeftOpen{.frequency = scene_.solver.resonance_tolerance});
    }
    ask_settings();
    bars_.add_own_errors();
    if (worn()) {
      add_worn_bars(scene_, result_, bars_);
      bars_.match_unworn();
    }
    bars_.total();
  }

 private:
  using Change = std::function<void(Scene&, Computation&)>;

  [[nodiscard]] bool worn() const { return as_here_.until >= Stage::worn_state; }

  /// What changes next to nothing goes the way that the base went: from elsewhere it may come to another of two maxima
  /// that lie side by side.
  enum class Way { from_base, of_base };

  /// A mesh on which other settings may be asked for.
  struct Base {
    const ModelBuilder* builder;
    Scene scene;
    const CandidateResult* answer;
  };

  [[nodiscard]] Base own_mesh() const { return {&builder_, scene_, &result_}; }

  void ask_meshes() {
    std::vector<Companion> meshes;
    answers_.reserve(others_->meshes().size());
    for (const auto& [sizes, on_it] : others_->meshes()) {
      const Scene there = resized(scene_, sizes);
      // The coarsest meshes there are end the way down.
      const double ratio = static_cast<double>(scene_.mesh.flank_elements) / there.mesh.flank_elements;
      answers_.push_back(companion(there, on_it.build(there), as_here_));
      if (finer_ || ratio == 1) continue;  // 1: a mesh that is as large as meshes may be
      meshes.push_back({&answers_.back().evaluation, by_mesh(ratio)});
      finer_ = ratio < 1 && answers_.back().evaluation.converged();
    }
    bars_.add("mesh", meshes, result_.evaluation);
    ask_sections();
  }

  /// What the section leaves hardly depends on the layers along the slot.
  void ask_sections() {
    const OtherMeshes::Sections* on_them = others_->sections();
    if (on_them == nullptr) return;
    constexpr double kRatio = kCompanion.section_ratio;
    Computation how = as_here_;
    how.until = std::min(how.until, Stage::unworn);
    const Scene few = with_few_layers(scene_), fine = resized_section(few, kRatio);
    const Evaluation own = on_them->own ? companion(few, on_them->own->build(few), how).evaluation : result_.evaluation;
    const Evaluation finer = companion(fine, on_them->finer.build(fine), how).evaluation;
    if (own.converged()) return bars_.add("mesh", {{&finer, by_mesh(kRatio)}}, own);
    bars_.add("mesh", {{&own, by_mesh(kRatio)}}, result_.evaluation);
  }

  /// Of what a mesh with elements `ratio` times as long changes.
  [[nodiscard]] Factor by_mesh(double ratio) const {
    return [ratio, in_space = scene_.kind->in_space](const Response& response) {
      return left_over(in_space ? response.mesh_order.in_space : response.mesh_order.in_plane, ratio);
    };
  }

  /// The design on contact nodes that are `longer` times as long on the same mesh.
  [[nodiscard]] CandidateResult on_nodes(double longer) const {
    Computation how = as_here_;
    how.contact.lengths.finest *= longer;
    how.contact.lengths.coarsest *= longer;
    return companion(scene_, result_.model, how);
  }

  /// A finer mesh has shorter nodes, too: a part of what longer ones change remains beside it.
  void add_contact_grid(const Evaluation& longer) {
    constexpr double kAgain = kCompanion.nodes_again;
    const Factor factor = [again = finer_ ? kAgain : 1](const Response& response) {
      return again * left_over(response.grid_order, kCompanion.longer_nodes);
    };
    bars_.add("contact_grid", {{&longer, factor}}, result_.evaluation);
    if (!finer_) return;
    for (const Response& response : responses()) {
      if (!response.by_zone_ends || !bars_.asked(response)) continue;
      std::map<std::string, double>& of = bars_.sources(response);
      bars_.add("contact_grid", response, (1 - kAgain) * std::max(0.0, of["contact_grid"] / kAgain - of["mesh"]));
    }
  }

  /// What the ends of slipping zones leave open, and worn zones narrower than the contact nodes.
  void add_slip() {
    double left_open = slip_at_zone_ends(result_);  // J per cycle
    if (worn() && result_.asymptote->worn_volume == 0 && worn_per_energy(result_, left_open) > 0) {
      const Evaluation shorter = on_nodes(kCompanion.shorter_nodes).evaluation;
      bars_.add("contact_grid", {{&shorter, same_for_all(kCompanion.shorter_factor)}}, result_.evaluation);
      left_open += add_unseen_zones(scene_, result_, bars_);
    }
    bars_.add("contact_grid", LeftOpen{.slip_energy = left_open});
  }

  /// What the other settings leave hardly depends on the mesh: it is asked where a design costs least, and where that
  /// has no answer on a finer one. What the contact needs is asked on the design's own where coarser ones say nothing
  /// of it.
  void ask_settings() {
    std::vector<Base> bases;
    for (std::size_t i = answers_.size(); i-- > 0;)  // the coarsest one stands last
      if (const auto& [ratio, on_it] = others_->meshes()[i]; ratio > 1 && answers_[i].evaluation.converged())
        bases.push_back({&on_it, resized(scene_, ratio), &answers_[i]});
    bases.push_back(own_mesh());
    const std::span<const Base> of_contact =
        scene_.kind->coarse_answers ? std::span<const Base>(bases) : std::span<const Base>(bases).last(1);
    ask(bases, "modes", kCompanion.modes_factor, {[](Scene& changed, Computation&) {
          changed.solver.modes = std::max(2 * changed.solver.modes, changed.solver.modes + kCompanion.more_modes);
        }});
    if (result_.model.matrices.by_other)
      ask(bases, "prestress", 1, {[](Scene& changed, Computation&) { changed.solver.prestress = Prestress::own; }},
          Way::of_base);
    if (as_here_.until >= Stage::unworn) ask_truncation(of_contact);  // else nothing moves
  }

  void ask_truncation(std::span<const Base> of_contact) {
    // Contact nodes of a study have no mass.
    const quality::TruncationFactors factors = quality::truncation_factors(true);
    ask(of_contact, "harmonics", factors.harmonics, {[](Scene& changed, Computation&) {
          changed.solver.harmonics = 2 * changed.solver.harmonics + 1;
          changed.solver.samples = quality::samples_for(changed.solver.harmonics, changed.solver.samples);
        }});
    ask(of_contact, "samples", factors.samples, {[](Scene& changed, Computation&) { changed.solver.samples *= 2; }});
    ask(of_contact, "pseudo_penalty", factors.penalty,
        {[](Scene&, Computation& how) { how.penalty_scale = kCompanion.softer; },
         [](Scene&, Computation& how) { how.penalty_scale = kCompanion.harder; }});
  }

  /// Of the first base and the first of `changes` to it that has an answer.
  void ask(std::span<const Base> bases, const char* source, double factor, const std::vector<Change>& changes,
           Way way = Way::from_base) {
    Evaluation answer;
    for (const Base& base : bases)
      for (const Change& change : changes) {
        Scene changed = base.scene;
        Computation how = as_here_;
        if (as_here_.from != nullptr) how.from = base.answer;
        how.grid_from = true;
        if (way == Way::of_base) {
          how.from = base.answer == &result_ ? nullptr : as_here_.from;
          how.grid_from = false;
        }
        change(changed, how);
        const bool same =
            changed.solver.modes == base.scene.solver.modes && changed.solver.prestress == base.scene.solver.prestress;
        answer = companion(changed, same ? base.answer->model : base.builder->build(changed), how).evaluation;
        if (answer.converged()) return bars_.add(source, {{&answer, same_for_all(factor)}}, base.answer->evaluation);
      }
    bars_.add(source, {{&answer, same_for_all(factor)}}, result_.evaluation);
  }

  const Scene& scene_;
  const ModelBuilder& builder_;
  const OtherMeshes* others_;
  CandidateResult& result_;
  Bars bars_;
  Computation as_here_;
  std::vector<CandidateResult> answers_;  // of the other meshes
  bool finer_ = false;                    // one of them is finer and has an answer
};

}  // namespace

void add_error_bars(const Scene& scene, const ModelBuilder& builder, const OtherMeshes* others, const Computation& how,
                    CandidateResult& result) {
  ErrorBarSources(scene, builder, others, how, result).run();
}

}  // namespace dovetail::optimizer
