#include "optimizer/candidate/contact_fit.hpp"

#include <algorithm>
#include <limits>
#include <optional>

#include "optimizer/candidate/candidate_result.hpp"
#include "optimizer/candidate/edge_search.hpp"
#include "optimizer/candidate/load_on_grid.hpp"
#include "paths/steady_state.hpp"
#include "wear/asymptote/followed_asymptote.hpp"
#include "wear/measures.hpp"
#include "wear/mission/mission.hpp"

namespace dovetail::optimizer {

namespace {

FitStart start_of(const Scene& scene, const Computation& how, const CandidateModel& candidate) {
  if (how.from == nullptr || !how.from->unworn) return {};
  const CandidateResult& from = *how.from;
  return {.unworn = {.omega = omega_as(from, from.unworn->omega, scene, candidate),
                     .displacement = from.unworn->state.displacement},
          .strips = from.model.cells.strips(),
          .grid = how.grid_from ? &from.fit.grid : nullptr};
}

/// Lays grid after grid on a design until the edges of worn zones stay where cells end.
class GridSearch {
 public:
  GridSearch(std::span<const FlankLoad> loads, const Computation& how)
      : scene_(*loads.front().scene), options_(how.contact), cells_(cell_lengths(scene_, options_.lengths)) {
    for (const FlankLoad& load : loads)
      loads_.push_back({.load = &load,
                        .joint = joint_of(*load.scene, *load.model, how.penalty_scale),
                        .options = how.contact.resonance});
    release_.certify = release_.certify_finer = false;
  }

  ContactFit run() {
    ContactFit fit = laid();
    for (const LoadOnGrid& load : loads_)
      if (has_own_budget(load)) load.model().budget->spend(load.joint.options.budget->used());
    if (!converged()) return fit;
    if (fit.known) fit.grid = {.edges = laid_, .counts = counts_, .search = search_, .moved = fit.moved};
    return fit;
  }

 private:
  ContactFit laid() {
    for (const fem::CellStrip& strip : cells().strips())
      lengths_.emplace_back(fem::trace_lines(sector().flanks[strip.flank]));
    laid_.resize(lengths_.size());
    counts_.resize(lengths_.size());
    const bool begun = lay_first();
    if (!converged()) return fit_;
    // Where the law lets nodes rest in slip the history says which ones wear.
    rests_in_slip_ = wear::rests_in_slip(*first().model().condensed);
    follows_ = scene_.loading.follow == wear::Follow::resonance && !rests_in_slip_;
    release_.arbitration = rests_in_slip_ ? wear::Arbitration::unsettled : wear::Arbitration::never;
    // At the resonance of the first grid on all of them: it hardly moves, and edges move less.
    for (LoadOnGrid& load : loads_)
      if (!load.find_first_resonance()) return fit_;
    // What is asked of the design itself is left the rest.
    const double share = rests_in_slip_ || follows_ ? options_.share_for_histories : options_.share_of_budget;
    for (LoadOnGrid& load : loads_)
      load.joint.options.budget = std::make_shared<Budget>(load.model().budget->part_of_rest(share));
    for (bool at_resonance = false;; ++fit_.grids) {
      if (!find_edges()) return unsettled();
      // A zone that the finer cells beside its edge make vanish is none.
      const bool vanished = fit_.edges == 0 && fit_.grids > 0;
      fit_.settled = vanished || fit_.moved <= options_.tolerance;
      // Edges that happen to lie at ends of cells of the first grid have no short cells beside them yet.
      const bool laid_for = begun || fit_.grids > 0 || fit_.edges == 0;
      if (vanished || (laid_for && fit_.moved <= aim(begun))) {
        // Where nodes beyond an edge hardly stick, do they at the resonance of this grid?
        if (!search_.holds() || at_resonance || vanished) return fit_;
        for (LoadOnGrid& load : loads_)
          if (!load.find_resonance_again()) return unsettled();
        at_resonance = true;
        --fit_.grids;
      } else if (fit_.grids == options_.grids) {
        return best_grid(best_.grid < fit_.grids);
      } else if (!lay_next()) {
        return unsettled();
      }
    }
  }

  /// How far edges may be left. A grid that another fit has left further than it aims at stays where it is left no
  /// further now: else what another grid changes would count as what the settings do.
  [[nodiscard]] double aim(bool begun) const {
    return begun && fit_.grids == 0 ? std::max(options_.aim, first().load->start.grid->moved) : options_.aim;
  }

  [[nodiscard]] LoadOnGrid& first() { return loads_.front(); }
  [[nodiscard]] const LoadOnGrid& first() const { return loads_.front(); }
  [[nodiscard]] const fem::ContactCells& cells() const { return first().model().cells; }
  [[nodiscard]] const fem::SectorMesh& sector() const { return first().model().mesh.sector; }
  [[nodiscard]] bool converged() const {
    return std::ranges::all_of(loads_, [](const LoadOnGrid& load) { return load.model().converged(); });
  }
  [[nodiscard]] static bool has_own_budget(const LoadOnGrid& load) {
    return load.joint.options.budget != load.model().budget;
  }

  void lay(const std::vector<fem::FlankCells>& flanks) {
    for (LoadOnGrid& load : loads_) {
      if (flanks != load.model().cells.flanks) lay_contact(load.scene(), flanks, load.model());
      load.joint.model = load.model().condensed;
    }
  }

  /// Whether that is the grid another fit ended with, and not one without edges.
  bool lay_first() {
    std::vector<fem::FlankCells> flanks = cell_grid(scene_, sector(), cells_);
    const LaidGrid* grid = first().load->start.grid;
    const bool begun = grid != nullptr && grid->edges.size() == lengths_.size();
    if (begun) {
      laid_ = grid->edges;
      counts_ = grid->counts;
      search_ = grid->search;
      end_cells_at_edges(flanks);
    }
    lay(flanks);
    return begun;
  }

  /// What the last grid says of the edges is not known: a grid before it stands in. Unless it was only the budget that
  /// ended, edges may be anywhere near.
  [[nodiscard]] ContactFit unsettled() {
    fit_.spent = std::ranges::any_of(
        loads_, [](const LoadOnGrid& load) { return has_own_budget(load) && spent(load.joint.options.budget); });
    if (!best_.flanks.empty()) {
      const ContactFit best = best_grid(true);
      if (fit_.spent) return best;
    }
    fit_.settled = fit_.known = false;
    fit_.moved = fit_.share = 1;
    return fit_;
  }

  /// Where worn zones end on this grid, and how far that is from where it was laid for; false where no worn state is
  /// found.
  [[nodiscard]] bool find_edges() {
    fit_.unworn.clear();
    for (const LoadOnGrid& load : loads_)
      fit_.unworn.push_back({.omega = load.peak.omega, .displacement = load.unworn.displacement});
    fit_.wear_rate = cells().area.dot(first().unworn.wear_rate);
    const std::optional<std::vector<std::vector<Edge>>> found = loads_.size() == 1 ? edges_of_one() : edges_of_all();
    if (!found) return false;
    const std::vector<std::vector<Edge>>& edges = *found;
    const EdgeSearch before = search_;
    found_ = search_.hold(edges, lengths_);
    Misfit misfit;
    for (std::size_t l = 0; l < found_.size(); ++l) {
      const std::vector<double> held = found_[l];
      widen_narrow(lengths_[l], cells_, found_[l]);
      misfit.add(edges[l], held, found_[l], laid_[l], lengths_[l]);
    }
    fit_.known = true;
    fit_.moved = misfit.moved;
    fit_.share = misfit.share;
    fit_.edges = misfit.edges;
    if (!best_.misfit.less_than(misfit))
      best_ = {.misfit = misfit,
               .grid = fit_.grids,
               .flanks = cells().flanks,
               .laid = laid_,
               .counts = counts_,
               .search = before,
               .unworn = fit_.unworn};
    return true;
  }

  [[nodiscard]] std::optional<std::vector<std::vector<Edge>>> edges_of_one() {
    const wear::Asymptote worn = worn_on_grid();
    if (worn.verdict != wear::Verdict::asymptote) return {};
    if (rests_in_slip_) return resting_edges(cells(), *first().model().condensed, worn);
    return edge_places(cells(), {&worn.trail, 1});
  }

  /// Of what all loads wear off together.
  [[nodiscard]] std::optional<std::vector<std::vector<Edge>>> edges_of_all() {
    std::vector<wear::MissionLoad> loads;
    for (const LoadOnGrid& load : loads_)
      loads.push_back({.joint = load.joint, .omega = load.peak.omega, .unworn = &load.unworn});
    wear::MissionOptions options{.asymptote = release_, .turns = false};
    const wear::Mission worn = wear::mission(loads, options);
    if (worn.verdict != wear::Verdict::asymptote) return {};
    return edge_places(cells(), worn.trails);
  }

  /// Where the resonance is followed zones grow on the way: they are to end where nodes end at its end. Where it is
  /// lost on the way, or the budget is spent on the first grid, where they end before.
  [[nodiscard]] wear::Asymptote worn_on_grid() {
    const auto& [load, joint, options, peak, unworn] = first();
    if (!follows_) return wear::asymptote(joint, peak.omega, release_, &unworn);
    wear::FollowedAsymptote followed = wear::followed_asymptote(joint, peak.omega, release_, {}, &unworn);
    const bool lost = followed.asymptote.verdict != wear::Verdict::asymptote;
    const bool better_known = spent(first().joint.options.budget) && !best_.flanks.empty();
    if (lost && !better_known && followed.held) return std::move(*followed.held);
    return std::move(followed.asymptote);
  }

  /// Where edges go to and fro, their budget is spent or there is no state on a grid: the one that they would have left
  /// least, of those whose zones end at them. It is laid again where another one may be.
  [[nodiscard]] ContactFit best_grid(bool another_is_laid) {
    if (another_is_laid) {
      lay(best_.flanks);
      laid_ = best_.laid;
      counts_ = best_.counts;
    }
    search_ = best_.search;
    fit_.unworn = best_.unworn;
    fit_.moved = best_.misfit.moved;
    fit_.share = best_.misfit.share;
    fit_.settled = fit_.moved <= options_.tolerance;
    return fit_;
  }

  /// The next grid and the unworn state on it; false where there is none.
  [[nodiscard]] bool lay_next() {
    laid_ = search_.next(found_, laid_);
    std::vector<fem::FlankCells> flanks = cells().flanks;
    end_cells_at_edges(flanks);
    const std::vector<fem::CellStrip> before = cells().strips();
    lay(flanks);
    fit_.unworn.clear();
    if (!converged()) return false;
    return std::ranges::all_of(loads_, [&](LoadOnGrid& load) { return load.find_unworn(before); });
  }

  void end_cells_at_edges(std::vector<fem::FlankCells>& flanks) {
    std::size_t strip = 0;
    for (fem::FlankCells& flank : flanks)
      for (std::vector<double>& ends : flank.across) {
        std::vector<double>& edges = laid_[strip];
        std::sort(edges.begin(), edges.end());
        widen_narrow(lengths_[strip], cells_, edges);
        ends = cell_ends(lengths_[strip], edges, cells_, counts_[strip]);
        ++strip;
      }
  }

  struct Best {
    Misfit misfit{.foreign = std::numeric_limits<int>::max()};
    int grid = 0;
    std::vector<fem::FlankCells> flanks;
    EdgeSearch::Places laid;
    std::vector<std::vector<int>> counts;
    EdgeSearch search;
    std::vector<NearResonance> unworn;
  };

  const Scene& scene_;  // of the first load: what grids follow from is the same in all
  const ContactFitOptions& options_;
  CellLengths cells_;
  std::vector<LoadOnGrid> loads_;
  wear::AsymptoteOptions release_;
  bool rests_in_slip_ = false, follows_ = false;
  std::vector<EdgeLengths> lengths_;      // of every strip
  EdgeSearch::Places laid_, found_;       // edges that the grid was laid for, and those found on it
  std::vector<std::vector<int>> counts_;  // of cells between edges
  EdgeSearch search_;
  Best best_;
  ContactFit fit_;
};

/// The grid of the load that wears its flanks fastest, for all of them.
ContactFit fit_to_fastest(std::span<const FlankLoad> loads, const Computation& how) {
  ContactFit fastest;
  std::size_t of = 0;
  for (std::size_t k = 0; k < loads.size(); ++k) {
    ContactFit fit = GridSearch(loads.subspan(k, 1), how).run();
    if (!loads[k].model->converged()) return fit;
    if (k == 0 || fit.wear_rate > fastest.wear_rate) {
      fastest = std::move(fit);
      of = k;
    }
  }
  NearResonance known = fastest.unworn.empty() ? NearResonance() : std::move(fastest.unworn.front());
  fastest.unworn.assign(loads.size(), {});
  fastest.unworn[of] = std::move(known);
  for (const FlankLoad& load : loads)
    if (load.model->cells.flanks != loads[of].model->cells.flanks)
      lay_contact(*load.scene, loads[of].model->cells.flanks, *load.model);
  return fastest;
}

ContactFit not_fitted() {
  return {.moved = 0, .share = 0, .settled = true, .known = true};
}

}  // namespace

ContactFit fit_contact(const Scene& scene, const Computation& how, CandidateModel& candidate) {
  if (!how.contact.to_worn_zones) return not_fitted();
  const FlankLoad one{.scene = &scene, .model = &candidate, .start = start_of(scene, how, candidate)};
  return GridSearch({&one, 1}, how).run();
}

ContactFit fit_contact(std::span<const FlankLoad> loads, const Computation& how) {
  if (loads.size() > 1 && wear::rests_in_slip(*loads.front().model->condensed)) return fit_to_fastest(loads, how);
  return GridSearch(loads, how).run();
}

}  // namespace dovetail::optimizer
