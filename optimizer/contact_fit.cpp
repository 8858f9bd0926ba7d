#include "optimizer/contact_fit.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "fem/flank_trace.hpp"
#include "optimizer/evaluator.hpp"
#include "response/resonance.hpp"
#include "wear/asymptote.hpp"

namespace dovetail::optimizer {

namespace {

/// Length of the mesh's edge at a place on a flank, as fractions of the flank.
class EdgeLengths {
 public:
  explicit EdgeLengths(const fem::TraceLines& lines) {
    for (std::size_t i = 0; i < lines.across.size(); i += 2) corners_.push_back(lines.across[i]);
  }
  [[nodiscard]] double at(double s) const {
    const auto above = std::upper_bound(corners_.begin() + 1, corners_.end() - 1, s);
    return *above - *(above - 1);
  }
  [[nodiscard]] const std::vector<double>& corners() const { return corners_; }

 private:
  std::vector<double> corners_;
};

/// Ends of cells over a flank with an end on each of `edges` (rising, inside 0 to 1).
std::vector<double> fitted_ends(const EdgeLengths& lengths, const std::vector<double>& edges,
                                const ContactFitOptions& options) {
  const auto wanted = [&](double s) {
    double length = options.coarsest * lengths.at(s);
    const auto grow_from = [&](double place) {
      length = std::min(length, options.finest * lengths.at(place) + options.growth * std::abs(s - place));
    };
    grow_from(0);
    grow_from(1);
    for (const double edge : edges) grow_from(edge);
    return length;
  };
  std::vector<double> fixed{0};
  for (const double edge : edges) fixed.push_back(edge);
  fixed.push_back(1);
  std::vector<double> ends{0};
  constexpr int kSteps = 400;  // of the integral of 1 / length over a piece
  for (std::size_t p = 0; p + 1 < fixed.size(); ++p) {
    const double from = fixed[p], piece = fixed[p + 1] - from;
    std::vector<double> cells(kSteps + 1, 0.0);
    for (int k = 0; k < kSteps; ++k)
      cells[static_cast<std::size_t>(k) + 1] =
          cells[static_cast<std::size_t>(k)] + piece / kSteps / wanted(from + piece * (k + 0.5) / kSteps);
    const int count = std::max(1, static_cast<int>(std::lround(cells.back())));
    for (int c = 1; c < count; ++c) {
      const double at = cells.back() * c / count;
      const auto above = std::upper_bound(cells.begin(), cells.end() - 1, at);
      const double step = static_cast<double>(above - cells.begin()) - 1 + (at - *(above - 1)) / (*above - *(above - 1));
      ends.push_back(from + piece * step / kSteps);
    }
    ends.push_back(fixed[p + 1]);
  }
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

/// Edges of every strip as fractions of the flank, rising.
std::vector<std::vector<double>> edge_places(const fem::ContactCells& cells, const wear::ReleaseTrail& trail) {
  const std::vector<std::vector<int>> lines = lines_of(cells);
  std::vector<std::vector<double>> ends, places(lines.size());
  for (const fem::FlankCells& flank : cells.flanks)
    for (const std::vector<double>& across : flank.across) ends.push_back(across);
  for (const wear::ZoneEdge& edge : wear::zone_edges(trail, lines, cells.area)) {
    const auto line = static_cast<std::size_t>(edge.line);
    const auto middle = [&](int node) {
      const auto k = static_cast<std::size_t>(node - lines[line].front());
      return (ends[line][k] + ends[line][k + 1]) / 2;
    };
    places[line].push_back(middle(edge.worn) + edge.fraction * (middle(edge.bearing) - middle(edge.worn)));
  }
  for (std::vector<double>& of_line : places) std::sort(of_line.begin(), of_line.end());
  return places;
}

/// Edges closer to each other or to the ends of the flank than the trace resolves are none.
void drop_narrow(const EdgeLengths& lengths, const ContactFitOptions& options, std::vector<double>& edges) {
  constexpr double kNarrowest = 0.3;  // of the finest cell
  const auto close = [&](double a, double b) {
    return std::abs(a - b) < kNarrowest * options.finest * lengths.at(std::clamp((a + b) / 2, 0.0, 1.0));
  };
  std::erase_if(edges, [&](double edge) { return close(edge, 0) || close(edge, 1); });
  for (std::size_t k = 0; k + 1 < edges.size();)
    if (close(edges[k], edges[k + 1]))
      edges.erase(edges.begin() + static_cast<std::ptrdiff_t>(k), edges.begin() + static_cast<std::ptrdiff_t>(k) + 2);
    else
      ++k;
}

}  // namespace

std::vector<fem::FlankCells> contact_grid(const fem::SectorMesh& trace, const ContactFitOptions& options) {
  std::vector<fem::FlankCells> cells;
  for (const fem::Flank& flank : trace.flanks) {
    const fem::TraceLines lines = fem::trace_lines(flank);
    fem::FlankCells of_flank{.along = lines.along.size() > 1 ? lines.along : std::vector<double>{0, 1}, .across = {}};
    of_flank.across.assign(of_flank.along.size() - 1, fitted_ends(EdgeLengths(lines), {}, options));
    cells.push_back(std::move(of_flank));
  }
  return cells;
}

ContactFit fit_contact(const Scene& scene, const ContactFitOptions& options, CandidateModel& candidate) {
  ContactFit fit;
  const response::SteadyOptions steady = steady_options(scene.solver);
  wear::AsymptoteOptions release;
  release.arbitration = "never";
  release.interpolate_edge = release.certify = release.certify_finer = false;
  double omega = candidate.reduction.glued_frequencies(scene.loading.mode - 1);
  for (;; ++fit.grids) {
    const response::Resonance unworn = response::resonance(candidate.condensed, omega, {}, steady);
    if (unworn.status != Status::converged) return fit;
    omega = unworn.omega;
    const wear::Asymptote worn = wear::asymptote(candidate.condensed, omega, {}, steady, release, &unworn.state);
    if (worn.verdict != wear::Verdict::asymptote) return fit;
    if (std::getenv("FITLOG")) {
      std::fprintf(stderr, "grid %d passes %d V %.5g\n", fit.grids, worn.passes, 1e9 * worn.worn_volume);
      const auto lines = lines_of(candidate.cells);
      for (const wear::ZoneEdge& e : wear::zone_edges(worn.trail, lines, candidate.cells.area)) {
        const auto& r = worn.trail.reserves[static_cast<std::size_t>(worn.trail.released_in[static_cast<std::size_t>(e.worn)])];
        std::fprintf(stderr, "  edge line %d worn %d bearing %d pass %d excess %.4g margin %.4g area %.3g %.3g\n", e.line, e.worn - lines[static_cast<std::size_t>(e.line)].front(), e.bearing - lines[static_cast<std::size_t>(e.line)].front(), worn.trail.released_in[static_cast<std::size_t>(e.worn)], -r[e.worn], r[e.bearing], candidate.cells.area[e.worn], candidate.cells.area[e.bearing]);
      }
      for (const auto& pl : edge_places(candidate.cells, worn.trail)) for (double x : pl) std::fprintf(stderr, "  at %.5f\n", x);
    }
    std::vector<std::vector<double>> places = edge_places(candidate.cells, worn.trail);
    fit.moved = 0;
    fit.edges = 0;
    std::size_t strip = 0;
    std::vector<fem::FlankCells> flanks = candidate.cells.flanks;
    for (std::size_t f = 0; f < flanks.size(); ++f) {
      const EdgeLengths lengths(fem::trace_lines(candidate.mesh.sector.flanks[f]));
      for (std::vector<double>& ends : flanks[f].across) {
        std::vector<double>& edges = places[strip++];
        drop_narrow(lengths, options, edges);
        for (const double edge : edges) {
          double nearest = 1;
          for (const double end : ends) nearest = std::min(nearest, std::abs(end - edge));
          fit.moved = std::max(fit.moved, nearest / lengths.at(edge));
        }
        fit.edges += static_cast<int>(edges.size());
        if (!edges.empty()) ends = fitted_ends(lengths, edges, options);
      }
    }
    fit.settled = fit.moved <= options.tolerance;
    if (fit.settled || fit.grids == options.grids) return fit;
    lay_contact(scene, flanks, candidate);
    if (!candidate.converged()) return fit;
  }
}

}  // namespace dovetail::optimizer
