#include "wear/asymptote.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <utility>

#include "wear/archard.hpp"
#include "wear/history.hpp"
#include "wear/release.hpp"

namespace dovetail::wear {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// How the release loop ended.
enum class Ending { settled, nothing_holds, failed };

/// What the loop knows about the nodes.
struct Passes {
  std::vector<bool> released;
  VectorXd margin;  // smallest friction margin met so far, of nodes that never slipped
  VectorXd excess;  // overload relieved by slip in the pass that released the node
  response::SteadyState state;
};

std::vector<bool> loaded_nodes(const response::SteadyState& state, const std::vector<bool>& released) {
  std::vector<bool> loaded(released.size());
  for (std::size_t i = 0; i < loaded.size(); ++i) loaded[i] = !released[i] && state.nodes[i].carries_load;
  return loaded;
}

Ending release_slipping(Release& release, double threshold, const AsymptoteOptions& options, const Control& control,
                        Passes& passes, Asymptote& result) {
  const std::size_t nodes = passes.released.size();
  for (int pass = 0;; ++pass) {
    const std::vector<bool> loaded = loaded_nodes(passes.state, passes.released);
    std::vector<bool> next = passes.released;
    bool slipping = false;
    bool held = false;
    for (std::size_t i = 0; i < nodes; ++i) {
      if (!loaded[i]) continue;
      const auto node = static_cast<Index>(i);
      const bool slips = passes.state.wear_rate[node] > threshold;
      next[i] = slips;
      if (slips)
        passes.excess[node] = slip_excess(release.model(), passes.state, node);
      else
        passes.margin[node] = std::min(passes.margin[node],
                                       friction_margin(passes.state, node, release.model().contact().friction[node]));
      slipping = slipping || slips;
      held = held || !slips;
    }
    result.passes = pass;
    if (!slipping) return Ending::settled;
    if (std::all_of(next.begin(), next.end(), [](bool worn) { return worn; })) return Ending::nothing_holds;
    if (pass == options.passes) {
      result.status = Status::iteration_limit;
      return Ending::failed;
    }
    response::SteadyState state = release.solve(next, passes.state.displacement, !held);
    if (state.status != Status::converged) {
      result.status = state.status;
      return held || state.status == Status::interrupted ? Ending::failed : Ending::nothing_holds;
    }
    passes.released = std::move(next);
    passes.state = std::move(state);
    const VectorXd depth = release.depth(passes.released, passes.state);
    control.report(pass + 1, worn_volume(release.model().contact(), depth), passes.state.wear_rate.maxCoeff());
  }
}

/// Depths and volumes with the edges of the worn zone between nodes.
void place_edges(Release& release, const AsymptoteOptions& options, const Passes& passes, Asymptote& result) {
  const reduction::ContactNodes& contact = release.model().contact();
  const std::vector<bool> loaded = loaded_nodes(passes.state, passes.released);
  result.edges = find_edges(contact, passes.released, loaded, passes.margin);
  if (result.edges.empty()) return;

  std::map<std::vector<bool>, VectorXd> known;
  const auto solve_without = [&](const std::vector<bool>& stuck) -> std::optional<response::SteadyState> {
    std::vector<bool> released = passes.released;
    std::vector<int> held;
    for (std::size_t i = 0; i < stuck.size(); ++i) {
      if (!stuck[i]) continue;
      held.push_back(result.edges[i].worn);
      released[static_cast<std::size_t>(held.back())] = false;
    }
    response::SteadyState state = release.solve_held(released, held, passes.state.displacement);
    if (state.status != Status::converged) {
      result.edge_status = state.status;
      return std::nullopt;
    }
    known[stuck] = release.depth(released, state);
    return state;
  };
  const auto depth_without = [&](const std::vector<bool>& stuck) -> std::optional<VectorXd> {
    if (!known.contains(stuck) && !solve_without(stuck)) return std::nullopt;
    return known.at(stuck);
  };

  // A node released early may not slip once the rest is worn: then the slip that released it counts, scaled well below
  // the excess of a held node (which it overestimates, the node's own stiffness being an upper bound).
  constexpr double kSlipShare = 0.1;
  for (std::size_t i = 0; i < result.edges.size(); ++i) {
    Edge& edge = result.edges[i];
    std::vector<bool> stuck(result.edges.size(), false);
    stuck[i] = true;
    const std::optional<response::SteadyState> state = solve_without(stuck);
    if (!state) return;
    edge.excess = std::max(
        {0.0, kSlipShare * passes.excess[edge.worn], -friction_margin(*state, edge.worn, contact.friction[edge.worn])});
    edge.place();
  }

  const std::optional<VectorXd> depth =
      interpolate_edges(result.edges, result.depth, options.tensor_edges, depth_without);
  std::vector<Edge> retracted = result.edges;
  for (Edge& edge : retracted) edge.theta = 0.0;
  const std::optional<VectorXd> least = interpolate_edges(retracted, result.depth, options.tensor_edges, depth_without);
  if (!depth || !least) return;
  result.interpolated_depth = *depth;
  result.interpolated_volume = worn_volume(contact, *depth);
  result.interpolated_largest_depth = depth->maxCoeff();
  const double other = worn_volume(contact, *least);
  result.volume_bracket[0] = std::min(result.worn_volume, other);
  result.volume_bracket[1] = std::max(result.worn_volume, other);
}

void set_depth(const reduction::ContactNodes& contact, const VectorXd& depth, Asymptote& result) {
  result.depth = result.interpolated_depth = depth;
  result.worn_volume = result.interpolated_volume = worn_volume(contact, depth);
  result.volume_bracket[0] = result.volume_bracket[1] = result.worn_volume;
  result.largest_depth = result.interpolated_largest_depth = depth.size() == 0 ? 0.0 : depth.maxCoeff();
}

/// Release found nothing that holds: nodes can stop wearing while they still carry load, which only a history sees.
void ask_history(const std::shared_ptr<const response::CondensedModel>& model, double omega, Release& release,
                 double threshold, const response::SteadyOptions& steady, const AsymptoteOptions& options,
                 const Control& control, Asymptote& result) {
  double penetration = 0.0;
  for (Index i = 0; i < model->nodes(); ++i)
    penetration = std::max(penetration, result.unworn.nodes[static_cast<std::size_t>(i)].max_normal_force /
                                            model->local_stiffness()[i * model->directions()]);
  constexpr double kDied = 1e-3;
  const HistoryOptions history_options{.increment = options.confirm_increment * penetration,
                                       .steps = options.confirm_steps,
                                       .rate_fraction = kDied,
                                       .rate_threshold = threshold};
  const History past = history(model, omega, release.start(), steady, history_options, {}, control);
  release.count(past.solves, past.jacobians);
  const Index states = past.cycles.size();
  result.status = past.status;
  if (states == 0 || past.status != Status::converged) {
    result.verdict = Verdict::not_converged;
    return;
  }
  set_depth(model->contact(), past.depth.row(states - 1).transpose(), result);
  result.rate = past.rate.row(states - 1).transpose();
  result.steady = past.steady;
  result.confirmed_by_history = true;
  // Under a dead load the rate levels out; otherwise it still falls when the steps are used up, and nothing is known.
  const bool level = past.rate.row(states - 1).maxCoeff() > 0.5 * past.rate.row((states - 1) / 2).maxCoeff();
  if (past.end == HistoryEnd::worn_out) {
    result.verdict = Verdict::asymptote;
  } else {
    result.verdict = level ? Verdict::no_asymptote : Verdict::not_converged;
    if (!level) result.status = Status::iteration_limit;
  }
}

}  // namespace

std::string_view to_string(Verdict verdict) {
  switch (verdict) {
    case Verdict::asymptote:
      return "asymptote";
    case Verdict::no_asymptote:
      return "no_asymptote";
    case Verdict::not_converged:
      return "not_converged";
  }
  return "unknown";
}

Asymptote asymptote(const std::shared_ptr<const response::CondensedModel>& model, double omega,
                    const response::ContactCondition& start, const response::SteadyOptions& steady,
                    const AsymptoteOptions& options, const response::SteadyState* unworn, const Control& control) {
  if (std::vector<Violation> wrong = violations(options, "asymptote"); !wrong.empty())
    throw InputError(std::move(wrong));

  const auto nodes = static_cast<std::size_t>(model->nodes());
  const reduction::ContactNodes& contact = model->contact();
  Release release(model, omega, start, steady, control);
  Asymptote result;
  result.certificate = std::numeric_limits<double>::quiet_NaN();
  Passes passes{.released = std::vector<bool>(nodes, false),
                .margin = VectorXd::Constant(model->nodes(), std::numeric_limits<double>::infinity()),
                .excess = VectorXd::Zero(model->nodes()),
                .state = {}};
  const auto finish = [&] {
    result.released = passes.released;
    result.solves = release.solves();
    result.jacobians = release.jacobians();
    return std::move(result);
  };

  set_depth(contact, release.start().wear_depth, result);
  result.rate = VectorXd::Zero(model->nodes());
  passes.state = unworn != nullptr ? *unworn : release.solve(passes.released, {});
  result.unworn = passes.state;
  result.status = passes.state.status;
  if (passes.state.status != Status::converged) return finish();
  result.unworn_rate = passes.state.wear_rate;
  const double fastest = result.unworn_rate.size() == 0 ? 0.0 : result.unworn_rate.maxCoeff();
  const double threshold = std::max(options.rate_threshold, options.relative_threshold * fastest);

  const Ending ending = release_slipping(release, threshold, options, control, passes, result);
  result.steady = passes.state;
  result.rate = passes.state.wear_rate;
  if (ending == Ending::failed) return finish();
  if (ending == Ending::nothing_holds) {
    result.rate = result.unworn_rate;
    result.verdict = Verdict::no_asymptote;
    result.status = Status::converged;
    if (options.confirm_by_history) ask_history(model, omega, release, threshold, steady, options, control, result);
    return finish();
  }

  result.verdict = Verdict::asymptote;
  set_depth(contact, release.depth(passes.released, passes.state), result);
  if (options.interpolate_edge) place_edges(release, options, passes, result);
  if (options.certify) {
    const response::SteadyState worn = release.solve_worn(result.depth, passes.state.displacement);
    if (worn.status == Status::converged) {
      result.rate = worn.wear_rate;
      result.steady = worn;
      result.certificate = fastest > 0.0 ? worn.wear_rate.maxCoeff() / fastest : 0.0;
    } else if (worn.status == Status::interrupted) {
      result.status = Status::interrupted;
      result.verdict = Verdict::not_converged;
    }
  }
  return finish();
}

}  // namespace dovetail::wear
