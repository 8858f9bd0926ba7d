#include "optimizer/candidate/edge_search.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "optimizer/candidate/node_lines.hpp"
#include "optimizer/candidate/params.hpp"
#include "wear/measures.hpp"

namespace dovetail::optimizer {

namespace {

constexpr EdgeSearchParams kEdgeSearch;

}  // namespace

std::vector<std::vector<Edge>> edge_places(const fem::ContactCells& cells, std::span<const wear::ReleaseTrail> trails) {
  const std::vector<fem::CellStrip> strips = cells.strips();
  const std::vector<wear::NodeLine> lines = node_lines(cells);
  std::vector<std::vector<Edge>> places(lines.size());
  std::map<std::pair<int, int>, wear::ZoneEdge> farthest;  // by the nodes that meet there
  for (const wear::ReleaseTrail& trail : trails)
    for (const wear::ZoneEdge& edge : wear::zone_edges(trail, lines, cells.area))
      if (const auto [at, first] = farthest.try_emplace({edge.worn, edge.bearing}, edge);
          !first && edge.fraction > at->second.fraction)
        at->second = edge;
  for (const auto& [nodes, edge] : farthest) {
    const auto line = static_cast<std::size_t>(edge.line);
    const fem::CellStrip& strip = strips[line];
    const auto middle = [&](int node) { return strip.middle(static_cast<std::size_t>(node) - strip.first); };
    const auto border = [&](int a, int b) {
      return strip.ends[static_cast<std::size_t>(std::max(a, b)) - strip.first];
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

std::vector<std::vector<Edge>> resting_edges(const fem::ContactCells& cells, const dynamics::CondensedModel& model,
                                             const wear::Asymptote& worn) {
  const std::vector<fem::CellStrip> strips = cells.strips();
  const std::vector<bool> wears = wear::worn_nodes(worn.depth);
  // Energy over that at which the node does not wear yet.
  const auto energy = [&](const steady::State& state, std::size_t node) {
    const double resting = model.wear_law().resting_energy(model.wear_node(static_cast<Eigen::Index>(node)));
    return state.nodes[node].dissipated_energy / resting;
  };
  std::vector<std::vector<Edge>> places(strips.size());
  for (std::size_t s = 0; s < strips.size(); ++s)
    for (std::size_t k = 0; k + 1 < strips[s].count(); ++k) {
      const fem::CellStrip& strip = strips[s];
      const std::size_t zone = wears[strip.first + k] ? k : k + 1, beyond = zone == k ? k + 1 : k;
      if (wears[strip.first + beyond] == wears[strip.first + zone] ||
          !worn.unworn.nodes[strip.first + beyond].carries_load)
        continue;
      const double from = strip.middle(zone), to = strip.middle(beyond), border = strip.ends[k + 1];
      const double rise = energy(worn.unworn, strip.first + zone) - energy(worn.unworn, strip.first + beyond);
      const double missing = 1 - energy(worn.steady, strip.first + beyond);
      const double back = rise > 0 ? std::clamp(missing / rise, 0.0, 1.0) : (border - to) / (from - to);
      places[s].push_back({.place = to + back * (from - to), .end = border, .outwards = zone < beyond ? 1 : -1});
    }
  return places;
}

void widen_narrow(const EdgeLengths& edge_lengths, const CellLengths& lengths, std::vector<double>& edges) {
  const auto narrowest = [&](double at) {
    return kEdgeSearch.narrowest * lengths.finest * edge_lengths.at(std::clamp(at, 0.0, 1.0));
  };
  for (double& edge : edges) edge = std::clamp(edge, narrowest(0), 1 - narrowest(1));
  for (std::size_t k = 0; k + 1 < edges.size();)
    if (edges[k + 1] - edges[k] < narrowest(edges[k]))
      edges.erase(edges.begin() + static_cast<std::ptrdiff_t>(k), edges.begin() + static_cast<std::ptrdiff_t>(k) + 2);
    else
      ++k;
}

void Misfit::add(const std::vector<Edge>& edges_now, const std::vector<double>& held, const std::vector<double>& next,
                 const std::vector<double>& laid, const EdgeLengths& lengths) {
  bool own = true;
  double beside = 0;  // how far edges are from the ends of their cells
  for (std::size_t k = 0; k < edges_now.size(); ++k) {
    const auto here = [&](double place) { return std::abs(place - edges_now[k].end) < kEdgeSearch.rounding; };
    own = own && std::ranges::any_of(laid, here);
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

EdgeSearch::Places EdgeSearch::hold(const std::vector<std::vector<Edge>>& edges,
                                    const std::vector<EdgeLengths>& lengths) {
  Places places(edges.size());
  held_.resize(edges.size());
  for (std::size_t l = 0; l < edges.size(); ++l) {
    if (held_[l].size() != edges[l].size()) held_[l].assign(edges[l].size(), {});
    for (std::size_t k = 0; k < edges[l].size(); ++k) {
      const Edge& edge = edges[l][k];
      Held& held = held_[l][k];
      double place = edge.place;
      if (held.grown > 0) place = edge.outwards > 0 ? std::max(place, held.place) : std::min(place, held.place);
      if (edge.grown) {
        place += edge.outwards * std::ldexp(kEdgeSearch.beyond, held.grown++) * lengths[l].at(edge.place);
        held.place = place;
      }
      places[l].push_back(place);
    }
  }
  return places;
}

bool EdgeSearch::holds() const {
  return std::ranges::any_of(held_, [](const std::vector<Held>& of_line) {
    return std::ranges::any_of(of_line, [](const Held& edge) { return edge.grown > 0; });
  });
}

EdgeSearch::Places EdgeSearch::next(const Places& found, const Places& laid) {
  const auto miss = [](const Places& edges, const Places& cells, std::size_t l, std::size_t k) {
    return edges[l][k] - cells[l][k];
  };
  Places places = found;
  for (std::size_t l = 0; l < found.size(); ++l) {
    if (laid_.size() != laid.size() || laid_[l].size() != laid[l].size() || found[l].size() != laid[l].size()) continue;
    for (std::size_t k = 0; k < found[l].size(); ++k) {
      const double step = laid[l][k] - laid_[l][k];
      const double slope = step == 0 ? 0 : (miss(found, laid, l, k) - miss(found_, laid_, l, k)) / step;
      if (slope < kEdgeSearch.flattest && slope > kEdgeSearch.steepest)
        places[l][k] = laid[l][k] - miss(found, laid, l, k) / slope;
    }
  }
  laid_ = laid;
  found_ = found;
  return places;
}

}  // namespace dovetail::optimizer
