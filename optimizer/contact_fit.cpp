#include "optimizer/contact_fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "optimizer/evaluator.hpp"
#include "paths/resonance.hpp"
#include "paths/steady_state.hpp"
#include "wear/asymptote.hpp"

namespace dovetail::optimizer {

namespace {

constexpr double kRounding = 1e-9;  // of a flank

std::vector<std::vector<double>> ends_of(const fem::ContactCells& cells) {
  std::vector<std::vector<double>> ends;
  for (const fem::FlankCells& flank : cells.flanks) ends.insert(ends.end(), flank.across.begin(), flank.across.end());
  return ends;
}

std::vector<std::vector<int>> lines_of(const fem::ContactCells& cells) {
  std::vector<std::vector<int>> lines;
  for (int i = 0; i < cells.count(); ++i) {
    if (static_cast<std::size_t>(cells.strip(i)) == lines.size()) lines.emplace_back();
    lines.back().push_back(i);
  }
  return lines;
}

/// An edge of a worn zone on a flank.
struct Edge {
  double place = 0;    ///< fraction of the flank
  double end = 0;      ///< where the last cell of the zone ends
  int outwards = 1;    ///< 1: the zone is on the neck side of it, -1: on the root side
  bool grown = false;  ///< by a later pass of release than the one that began the zone
};

/// Edges of every strip, rising.
std::vector<std::vector<Edge>> edge_places(const fem::ContactCells& cells, const wear::ReleaseTrail& trail) {
  const std::vector<std::vector<int>> lines = lines_of(cells);
  const std::vector<std::vector<double>> ends = ends_of(cells);
  std::vector<std::vector<Edge>> places(lines.size());
  for (const wear::ZoneEdge& edge : wear::zone_edges(trail, lines, cells.area)) {
    const auto line = static_cast<std::size_t>(edge.line);
    const auto middle = [&](int node) {
      const auto k = static_cast<std::size_t>(node - lines[line].front());
      return (ends[line][k] + ends[line][k + 1]) / 2;
    };
    const auto border = [&](int a, int b) {
      return ends[line][static_cast<std::size_t>(std::max(a, b) - lines[line].front())];
    };
    // A zone that grew in a later pass grows from where it ended: not at all while the node beside it hardly slips.
    const double from = edge.before < 0 ? middle(edge.first) : border(edge.before, edge.first);
    places[line].push_back({.place = from + middle(edge.worn) - middle(edge.first) +
                                     edge.fraction * (middle(edge.bearing) - middle(edge.worn)),
                            .end = border(edge.worn, edge.bearing),
                            .outwards = edge.worn < edge.bearing ? 1 : -1,
                            .grown = edge.before >= 0});
  }
  for (std::vector<Edge>& of_line : places) std::ranges::sort(of_line, {}, &Edge::place);
  return places;
}

/// Zones narrower than the trace resolves: those at the ends of the flank stay as wide as it resolves, others are none.
void widen_narrow(const EdgeLengths& edge_lengths, const CellLengths& lengths, std::vector<double>& edges) {
  constexpr double kNarrowest = 0.3;  // of the finest cell
  const auto narrowest = [&](double at) {
    return kNarrowest * lengths.finest * edge_lengths.at(std::clamp(at, 0.0, 1.0));
  };
  for (double& edge : edges) edge = std::clamp(edge, narrowest(0), 1 - narrowest(1));
  for (std::size_t k = 0; k + 1 < edges.size();)
    if (edges[k + 1] - edges[k] < narrowest(edges[k]))
      edges.erase(edges.begin() + static_cast<std::ptrdiff_t>(k), edges.begin() + static_cast<std::ptrdiff_t>(k) + 2);
    else
      ++k;
}

/// How far the worn zones of a grid are from those that it was laid for.
struct Misfit {
  int foreign = 0;  ///< strips on which a zone ends where none was laid to end: a node beyond it wore, too
  int edges = 0;    ///< of zones
  /// Largest way of an edge to where the next grid has it - on strips with more or fewer zones than the grid was laid
  /// for, from the end of its cell - in lengths of the mesh's edge.
  double moved = 0;
  double share = 0;  ///< the same, of the narrower of the two pieces of the flank that meet at the edge

  /// Of a strip: its edges, where they are `held`, where the next grid has them, and where this one was laid for.
  void add(const std::vector<Edge>& edges_now, const std::vector<double>& held, const std::vector<double>& next,
           const std::vector<double>& laid, const EdgeLengths& lengths) {
    bool own = true;
    double beside = 0;  // how far edges are from the ends of their cells
    for (std::size_t k = 0; k < edges_now.size(); ++k) {
      own = own &&
            std::ranges::any_of(laid, [&](double place) { return std::abs(place - edges_now[k].end) < kRounding; });
      beside = std::max(beside, std::abs(held[k] - edges_now[k].end));
    }
    foreign += own ? 0 : 1;
    edges += static_cast<int>(next.size());
    for (std::size_t k = 0; k < next.size(); ++k) {
      const double way = next.size() == laid.size() ? std::abs(next[k] - laid[k]) : beside;
      const double below = next[k] - (k == 0 ? 0 : next[k - 1]);
      const double above = (k + 1 == next.size() ? 1 : next[k + 1]) - next[k];
      moved = std::max(moved, way / lengths.at(next[k]));
      share = std::max(share, std::min(1.0, way / std::min(below, above)));
    }
  }
  [[nodiscard]] bool less_than(const Misfit& other) const {
    return foreign != other.foreign ? foreign < other.foreign : moved < other.moved;
  }
};

/// Where the ends of cells are put so that edges found on the grid (`found`) coincide with them: at the zero of found -
/// laid, by the secant through the last two grids, edge by edge. Beside a narrow zone edges move against the cells, and
/// putting the next grid where the last one found them would go to and fro.
class EdgeSearch {
 public:
  /// The places of `edges`. Those that grew in a later pass go on a little further than they have to, and each time
  /// they grow again twice as far, so that the nodes beyond them stick, and do not come back: an earlier pass alone
  /// would end there before.
  std::vector<std::vector<double>> hold(const std::vector<std::vector<Edge>>& edges,
                                        const std::vector<EdgeLengths>& lengths) {
    constexpr double kBeyond = 0.05;  // lengths of the mesh's edge
    std::vector<std::vector<double>> places(edges.size());
    held_.resize(edges.size());
    for (std::size_t l = 0; l < edges.size(); ++l) {
      if (held_[l].size() != edges[l].size()) held_[l].assign(edges[l].size(), {});
      for (std::size_t k = 0; k < edges[l].size(); ++k) {
        const Edge& edge = edges[l][k];
        Held& held = held_[l][k];
        double place = edge.place;
        if (held.grown > 0) place = edge.outwards > 0 ? std::max(place, held.place) : std::min(place, held.place);
        if (edge.grown) {
          place += edge.outwards * std::ldexp(kBeyond, held.grown++) * lengths[l].at(edge.place);
          held.place = place;
        }
        places[l].push_back(place);
      }
    }
    return places;
  }
  /// Whether an edge is held where the nodes beyond it hardly stick.
  [[nodiscard]] bool holds() const {
    return std::ranges::any_of(held_, [](const std::vector<Held>& of_line) {
      return std::ranges::any_of(of_line, [](const Held& edge) { return edge.grown > 0; });
    });
  }
  std::vector<std::vector<double>> next(const std::vector<std::vector<double>>& found,
                                        const std::vector<std::vector<double>>& laid) {
    std::vector<std::vector<double>> places = found;
    for (std::size_t l = 0; l < found.size(); ++l) {
      if (laid_.size() != laid.size() || laid_[l].size() != laid[l].size() || found[l].size() != laid[l].size())
        continue;
      for (std::size_t k = 0; k < found[l].size(); ++k) {
        const double step = laid[l][k] - laid_[l][k];
        const double slope = step == 0 ? 0 : (miss(found, laid, l, k) - miss(found_, laid_, l, k)) / step;
        // A slope of -1 is that of edges that do not depend on the grid.
        if (slope < -0.5 && slope > -4) places[l][k] = laid[l][k] - miss(found, laid, l, k) / slope;
      }
    }
    laid_ = laid;
    found_ = found;
    return places;
  }

 private:
  struct Held {
    int grown = 0;  ///< how often
    double place = 0;
  };
  using Places = std::vector<std::vector<double>>;
  static double miss(const Places& found, const Places& laid, std::size_t l, std::size_t k) {
    return found[l][k] - laid[l][k];
  }
  Places laid_, found_;
  std::vector<std::vector<Held>> held_;
};

/// Displacements U [nc, 2H+1] of one grid carried over to another with the same strips, linear between the middles of
/// cells: a start for the state there.
Eigen::MatrixXd carried_over(const Eigen::MatrixXd& from, const std::vector<std::vector<double>>& before,
                             const std::vector<std::vector<double>>& after, Eigen::Index directions) {
  std::size_t cells = 0;
  for (const std::vector<double>& ends : after) cells += ends.size() - 1;
  Eigen::MatrixXd to(static_cast<Eigen::Index>(cells) * directions, from.cols());
  Eigen::Index first = 0, row = 0;
  for (std::size_t strip = 0; strip < after.size(); ++strip) {
    const std::vector<double>& old = before[strip];
    const auto middle = [&old](std::size_t k) { return (old[k] + old[k + 1]) / 2; };
    const std::size_t count = old.size() - 1;
    for (std::size_t cell = 0; cell + 1 < after[strip].size(); ++cell) {
      const double at = (after[strip][cell] + after[strip][cell + 1]) / 2;
      std::size_t k = 0;
      while (k + 2 < count && middle(k + 1) < at) ++k;
      const double t = count == 1 ? 0 : std::clamp((at - middle(k)) / (middle(k + 1) - middle(k)), 0.0, 1.0);
      const Eigen::Index low = (first + static_cast<Eigen::Index>(k)) * directions;
      const Eigen::Index high = count == 1 ? low : low + directions;
      to.middleRows(row, directions) =
          (1 - t) * from.middleRows(low, directions) + t * from.middleRows(high, directions);
      row += directions;
    }
    first += static_cast<Eigen::Index>(count);
  }
  return to;
}

}  // namespace

ContactFit fit_contact(const Scene& scene, const Computation& how, CandidateModel& candidate) {
  const ContactFitOptions& options = how.contact;
  const CellLengths cells = cell_lengths(scene, options.lengths);
  ContactFit fit;
  steady::Options steady = steady_options(scene.solver);
  steady.budget = candidate.budget;
  steady.penalty_scale = how.penalty_scale;
  lay_contact(scene, cell_grid(scene, candidate.mesh.sector, cells), candidate);
  if (!candidate.converged()) return fit;
  wear::AsymptoteOptions release;
  release.arbitration = "never";
  release.certify = release.certify_finer = false;
  std::vector<EdgeLengths> lengths;  // of every strip
  for (std::size_t f = 0; f < candidate.cells.flanks.size(); ++f)
    lengths.insert(lengths.end(), candidate.cells.flanks[f].across.size(),
                   EdgeLengths(fem::trace_lines(candidate.mesh.sector.flanks[f])));
  std::vector<std::vector<double>> laid(lengths.size());
  std::vector<std::vector<int>> counts(lengths.size());
  EdgeSearch search;
  struct Best {
    Misfit misfit{.foreign = std::numeric_limits<int>::max()};
    int grid = 0;
    std::vector<fem::FlankCells> flanks;
    Eigen::MatrixXd displacement;
  } best;
  paths::Resonance peak = paths::resonance({candidate.condensed, {}, steady},
                                           candidate.reduction.glued_frequencies(scene.loading.mode - 1));
  if (peak.status != Status::converged) return fit;
  // What the last grid says of the edges is not known: they may be anywhere near.
  const auto unsettled = [&fit] {
    fit.settled = fit.known = false;
    fit.moved = fit.share = 1;
    return fit;
  };
  // At the resonance of the first grid on all of them: it hardly moves, and edges move less.
  steady::State unworn = peak.state;
  bool at_resonance = false;
  for (;; ++fit.grids) {
    fit.omega = peak.omega;
    fit.displacement = unworn.displacement;
    const wear::Asymptote worn = wear::asymptote({candidate.condensed, {}, steady}, peak.omega, release, &unworn);
    if (worn.verdict != wear::Verdict::asymptote) return unsettled();
    const std::vector<std::vector<Edge>> edges_now = edge_places(candidate.cells, worn.trail);
    std::vector<std::vector<double>> found = search.hold(edges_now, lengths);
    Misfit misfit;
    for (std::size_t l = 0; l < found.size(); ++l) {
      const std::vector<double> held = found[l];
      widen_narrow(lengths[l], cells, found[l]);
      misfit.add(edges_now[l], held, found[l], laid[l], lengths[l]);
    }
    fit.known = true;
    fit.moved = misfit.moved;
    fit.share = misfit.share;
    fit.edges = misfit.edges;
    // A zone that the finer cells beside its edge make vanish is none.
    const bool vanished = fit.edges == 0 && fit.grids > 0;
    fit.settled = vanished || fit.moved <= options.tolerance;
    if (vanished || !best.misfit.less_than(misfit))
      best = {
          .misfit = misfit, .grid = fit.grids, .flanks = candidate.cells.flanks, .displacement = unworn.displacement};
    // Edges that happen to lie at ends of cells of the first grid have no short cells beside them yet.
    const bool laid_for = fit.grids > 0 || fit.edges == 0;
    if (vanished || (laid_for && fit.moved <= options.aim)) {
      // Where nodes beyond an edge hardly stick, do they at the resonance of this grid?
      if (!search.holds() || at_resonance || vanished) return fit;
      peak = paths::resonance({candidate.condensed, {}, steady}, peak.omega);
      if (peak.status != Status::converged) return unsettled();
      unworn = peak.state;
      at_resonance = true;
      --fit.grids;
      continue;
    }
    if (fit.grids == options.grids) {
      // Edges that go to and fro: the grid that they would have left least, of those whose zones end at them.
      if (best.grid < fit.grids) {
        lay_contact(scene, best.flanks, candidate);
        fit.displacement = best.displacement;
      }
      fit.moved = best.misfit.moved;
      fit.share = best.misfit.share;
      fit.settled = fit.moved <= options.tolerance;
      return fit;
    }
    laid = search.next(found, laid);
    std::vector<fem::FlankCells> flanks = candidate.cells.flanks;
    std::size_t strip = 0;
    for (fem::FlankCells& flank : flanks)
      for (std::vector<double>& ends : flank.across) {
        std::vector<double>& edges = laid[strip];
        std::sort(edges.begin(), edges.end());
        widen_narrow(lengths[strip], cells, edges);
        ends = cell_ends(lengths[strip], edges, cells, counts[strip]);
        ++strip;
      }
    const std::vector<std::vector<double>> before = ends_of(candidate.cells);
    lay_contact(scene, flanks, candidate);
    fit.displacement.resize(0, 0);
    if (!candidate.converged()) return unsettled();
    const Eigen::MatrixXd guess =
        carried_over(unworn.displacement, before, ends_of(candidate.cells), candidate.condensed->directions());
    unworn = paths::steady_state({candidate.condensed, {}, steady}, peak.omega, guess);
    if (unworn.status != Status::converged) return unsettled();
  }
}

}  // namespace dovetail::optimizer
