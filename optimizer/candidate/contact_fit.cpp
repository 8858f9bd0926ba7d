#include "optimizer/candidate/contact_fit.hpp"

#include <algorithm>
#include <limits>

#include "optimizer/candidate/candidate_result.hpp"
#include "optimizer/candidate/carried_over.hpp"
#include "optimizer/candidate/edge_search.hpp"
#include "optimizer/candidate/params.hpp"
#include "paths/resonance.hpp"
#include "paths/steady_state.hpp"
#include "wear/asymptote/followed_asymptote.hpp"
#include "wear/measures.hpp"

namespace dovetail::optimizer {

namespace {

constexpr ContactFitParams kFit;

/// Where a search of a grid begins: a state of the joint and the grid it was laid on, and a grid to lay first.
struct FitStart {
  double omega = 0;  ///< rad/s
  Eigen::MatrixXd displacement = {};
  std::vector<fem::CellStrip> strips = {};
  const LaidGrid* grid = nullptr;
};

FitStart start_of(const Scene& scene, const Computation& how, const CandidateModel& candidate) {
  if (how.from == nullptr || !how.from->unworn) return {};
  const CandidateResult& from = *how.from;
  return {.omega = omega_as(from, from.unworn->omega, scene, candidate),
          .displacement = from.unworn->state.displacement,
          .strips = from.model.cells.strips(),
          .grid = how.grid_from ? &from.fit.grid : nullptr};
}

/// Lays grid after grid on a candidate until the edges of worn zones stay where cells end.
class GridSearch {
 public:
  GridSearch(const Scene& scene, const Computation& how, const FitStart& start, CandidateModel& candidate)
      : scene_(scene),
        options_(how.contact),
        start_(start),
        candidate_(candidate),
        cells_(cell_lengths(scene, options_.lengths)),
        joint_(joint_of(scene, candidate, how.penalty_scale)) {
    release_.certify = release_.certify_finer = false;
  }

  ContactFit run() {
    ContactFit fit = laid();
    if (has_own_budget()) candidate_.budget->spend(joint_.options.budget->used());
    if (!candidate_.converged()) return fit;
    if (fit.known) fit.grid = {.edges = laid_, .counts = counts_, .search = search_, .moved = fit.moved};
    return fit;
  }

 private:
  ContactFit laid() {
    for (const fem::CellStrip& strip : candidate_.cells.strips())
      lengths_.emplace_back(fem::trace_lines(candidate_.mesh.sector.flanks[strip.flank]));
    laid_.resize(lengths_.size());
    counts_.resize(lengths_.size());
    const bool begun = lay_first();
    if (!candidate_.converged()) return fit_;
    // Where the law lets nodes rest in slip the history says which ones wear.
    rests_in_slip_ = wear::rests_in_slip(*candidate_.condensed);
    follows_ = scene_.loading.follow == wear::Follow::resonance && !rests_in_slip_;
    // A history on each grid, or a resonance that is followed there, is dear: what is asked of the design itself is
    // left the rest.
    if (rests_in_slip_ || follows_)
      joint_.options.budget = new_budget(scene_.solver, candidate_, options_.share_of_budget);
    release_.arbitration = rests_in_slip_ ? wear::Arbitration::unsettled : wear::Arbitration::never;
    // At the resonance of the first grid on all of them: it hardly moves, and edges move less.
    if (!begun && found_roughly()) {
      ++fit_.grids;
      if (!lay_next()) return unsettled();
      if (!find_resonance(peak_.omega, unworn_.displacement)) return unsettled();
    } else if (!find_first_resonance()) {
      return fit_;
    }
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
        if (!find_resonance(peak_.omega, unworn_.displacement)) return unsettled();
        at_resonance = true;
        --fit_.grids;
      } else if (fit_.grids == options_.grids) {
        return best_grid(best_.grid < fit_.grids);
      } else if (!lay_next() || !find_state()) {
        return unsettled();
      }
    }
  }

  /// How far edges may be left. A grid that another fit has left further than it aims at stays where it is left no
  /// further now: else what another grid changes would count as what the settings do.
  [[nodiscard]] double aim(bool begun) const {
    return begun && fit_.grids == 0 ? std::max(options_.aim, start_.grid->moved) : options_.aim;
  }

  [[nodiscard]] bool has_own_budget() const { return joint_.options.budget != candidate_.budget; }

  void lay(const std::vector<fem::FlankCells>& flanks) {
    if (flanks != candidate_.cells.flanks) lay_contact(scene_, flanks, candidate_);
    joint_.model = candidate_.condensed;
  }

  /// Whether that is the grid another fit ended with, and not one without edges.
  bool lay_first() {
    std::vector<fem::FlankCells> flanks = cell_grid(scene_, candidate_.mesh.sector, cells_);
    const bool begun = start_.grid != nullptr && start_.grid->edges.size() == lengths_.size();
    if (begun) {
      laid_ = start_.grid->edges;
      counts_ = start_.grid->counts;
      search_ = start_.grid->search;
      end_cells_at_edges(flanks);
    }
    lay(flanks);
    return begun;
  }

  /// Edges on the first grid with fewer harmonics.
  [[nodiscard]] bool found_roughly() {
    const int all = scene_.solver.harmonics;
    if (all < kFit.many_harmonics || start_.displacement.size() > 0 || rests_in_slip_ || follows_) return false;
    joint_.options.harmonics = (all / 2) | 1;  // even ones hardly move of flanks under pressure
    const bool found = find_first_resonance() && find_edges() && fit_.edges > 0;
    joint_.options.harmonics = all;
    best_ = {};
    if (!found) fit_ = {};
    return found;
  }

  [[nodiscard]] bool find_first_resonance() {
    if (start_.displacement.size() == 0) return find_resonance(candidate_.glued_frequencies(scene_.loading.mode - 1));
    return find_resonance(start_.omega, carried(start_.displacement, start_.strips)) ||
           find_resonance(candidate_.glued_frequencies(scene_.loading.mode - 1));
  }

  [[nodiscard]] bool find_resonance(double start, const Eigen::MatrixXd& guess = {}) {
    paths::ResonanceOptions peak = resonance_options(scene_);
    peak.begins_near = guess.size() > 0;
    peak.frequency_tolerance = std::max(peak.frequency_tolerance, kFit.frequency_tolerance);
    peak_ = paths::resonance(joint_, start, peak, guess);
    unworn_ = peak_.state;
    return peak_.status == Status::converged;
  }

  /// What the last grid says of the edges is not known: they may be anywhere near.
  [[nodiscard]] ContactFit unsettled() {
    fit_.spent = has_own_budget() && spent(joint_.options.budget);
    if (fit_.spent && !best_.flanks.empty()) return best_grid(true);
    fit_.settled = fit_.known = false;
    fit_.moved = fit_.share = 1;
    return fit_;
  }

  /// Where worn zones end on this grid, and how far that is from where it was laid for; false where no worn state is
  /// found.
  [[nodiscard]] bool find_edges() {
    fit_.omega = peak_.omega;
    fit_.displacement = unworn_.displacement;
    const wear::Asymptote worn = worn_on_grid();
    if (worn.verdict != wear::Verdict::asymptote) return false;
    const std::vector<std::vector<Edge>> edges = rests_in_slip_
                                                     ? resting_edges(candidate_.cells, *candidate_.condensed, worn)
                                                     : edge_places(candidate_.cells, worn.trail);
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
               .flanks = candidate_.cells.flanks,
               .laid = laid_,
               .counts = counts_,
               .search = before,
               .displacement = unworn_.displacement};
    return true;
  }

  /// Where the resonance is followed zones grow on the way: they are to end where nodes end at its end. Where it is
  /// lost on the way, or the budget is spent on the first grid, where they end before.
  [[nodiscard]] wear::Asymptote worn_on_grid() {
    if (!follows_) return wear::asymptote(joint_, peak_.omega, release_, &unworn_);
    wear::FollowedAsymptote followed = wear::followed_asymptote(joint_, peak_.omega, release_, {}, &unworn_);
    const bool lost = followed.asymptote.verdict != wear::Verdict::asymptote;
    const bool better_known = spent(joint_.options.budget) && !best_.flanks.empty();
    if (lost && !better_known && followed.held) return std::move(*followed.held);
    return std::move(followed.asymptote);
  }

  /// Where edges go to and fro, or their budget is spent: the grid that they would have left least, of those whose
  /// zones end at them. It is laid again where another one may be.
  [[nodiscard]] ContactFit best_grid(bool another_is_laid) {
    if (another_is_laid) {
      lay(best_.flanks);
      laid_ = best_.laid;
      counts_ = best_.counts;
    }
    search_ = best_.search;
    fit_.displacement = best_.displacement;
    fit_.moved = best_.misfit.moved;
    fit_.share = best_.misfit.share;
    fit_.settled = fit_.moved <= options_.tolerance;
    return fit_;
  }

  /// The next grid, and the state before as it is on it; false where there is none.
  [[nodiscard]] bool lay_next() {
    laid_ = search_.next(found_, laid_);
    std::vector<fem::FlankCells> flanks = candidate_.cells.flanks;
    end_cells_at_edges(flanks);
    const std::vector<fem::CellStrip> before = candidate_.cells.strips();
    lay(flanks);
    fit_.displacement.resize(0, 0);
    if (!candidate_.converged()) return false;
    unworn_.displacement = carried(unworn_.displacement, before);
    return true;
  }

  [[nodiscard]] bool find_state() {
    unworn_ = paths::steady_state(joint_, peak_.omega, Eigen::MatrixXd(unworn_.displacement));
    return unworn_.status == Status::converged;
  }

  [[nodiscard]] Eigen::MatrixXd carried(const Eigen::MatrixXd& displacement,
                                        const std::vector<fem::CellStrip>& before) const {
    return paths::padded(
        carried_over(displacement, before, candidate_.cells.strips(), candidate_.condensed->directions()),
        scene_.solver.harmonics);
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
    Eigen::MatrixXd displacement;
  };

  const Scene& scene_;
  const ContactFitOptions& options_;
  const FitStart& start_;
  CandidateModel& candidate_;
  CellLengths cells_;
  steady::Joint joint_;
  wear::AsymptoteOptions release_;
  bool rests_in_slip_ = false, follows_ = false;
  std::vector<EdgeLengths> lengths_;      // of every strip
  EdgeSearch::Places laid_, found_;       // edges that the grid was laid for, and those found on it
  std::vector<std::vector<int>> counts_;  // of cells between edges
  EdgeSearch search_;
  Best best_;
  paths::Resonance peak_;
  steady::State unworn_;
  ContactFit fit_;
};

}  // namespace

ContactFit fit_contact(const Scene& scene, const Computation& how, CandidateModel& candidate) {
  if (!how.contact.to_worn_zones) return {.moved = 0, .share = 0, .settled = true, .known = true};
  const FitStart start = start_of(scene, how, candidate);
  return GridSearch(scene, how, start, candidate).run();
}

}  // namespace dovetail::optimizer
