#include "wear/asymptote.hpp"

#include <algorithm>
#include <iterator>
#include <limits>
#include <utility>

#include "wear/archard.hpp"
#include "wear/history.hpp"
#include "wear/partial_release.hpp"
#include "wear/passes.hpp"

namespace dovetail::wear {

namespace {

using Eigen::Index;
using Eigen::VectorXd;

void set_depth(const reduction::ContactNodes& contact, const VectorXd& depth, Asymptote& result) {
  result.depth = result.interpolated_depth = depth;
  result.worn_volume = result.interpolated_volume = worn_volume(contact, depth);
  result.volume_bracket[0] = result.volume_bracket[1] = result.worn_volume;
  result.largest_depth = result.interpolated_largest_depth = depth.size() == 0 ? 0.0 : depth.maxCoeff();
}

void place_edges(Release& release, double threshold, int limit, Asymptote& result) {
  const PartialRelease partial = release_partially(release, result.unworn, threshold, limit);
  result.edge_status = partial.status;
  if (!partial.settled) return;
  const reduction::ContactNodes& contact = release.model().contact();
  result.share = partial.share;
  result.interpolated_depth = partial.depth;
  result.interpolated_volume = worn_volume(contact, partial.depth);
  result.interpolated_largest_depth = partial.depth.size() == 0 ? 0.0 : partial.depth.maxCoeff();
  result.volume_bracket.fill(result.interpolated_volume);
  for (const bool outside : {false, true}) {
    const VectorXd whole = outside ? VectorXd(partial.share.array().ceil()) : VectorXd(partial.share.array().floor());
    if (whole == partial.share) continue;
    const response::SteadyState state = release.solve_shared(whole, partial.state.displacement);
    // Where nothing would hold with the edge outside, the other half of the bracket stands for both.
    if (state.status != Status::converged) continue;
    const double volume = worn_volume(contact, release.shared_depth(whole, state));
    result.volume_bracket[0] = std::min(result.volume_bracket[0], volume);
    result.volume_bracket[1] = std::max(result.volume_bracket[1], volume);
  }
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
  if (std::count(start.released.begin(), start.released.end(), 0) != std::ssize(start.released))
    throw InputError({.file = {},
                      .key = "start.released",
                      .value = "some nodes",
                      .allowed = "must release no node: which ones wear off is the answer"});

  const reduction::ContactNodes& contact = model->contact();
  Release release(model, omega, start, steady, control);
  Asymptote result;
  result.certificate = std::numeric_limits<double>::quiet_NaN();
  Passes passes(model->nodes());
  const auto finish = [&] {
    result.released = passes.released;
    result.passes = passes.count;
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

  const Ending ending = release_slipping(release, threshold, options.passes, control, passes);
  result.status = passes.status;
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
  if (options.interpolate_edge) place_edges(release, threshold, options.passes, result);
  if (options.certify) {
    const response::SteadyState worn = release.solve_worn(result.depth, passes.state.displacement);
    if (worn.status == Status::converged) {
      result.rate = worn.wear_rate;
      result.steady = worn;
      result.certificate = fastest > 0.0 ? worn.wear_rate.maxCoeff() / fastest : 0.0;
      if (!(worn.wear_rate.maxCoeff() <= std::max(options.certificate_limit * fastest, options.rate_threshold))) {
        result.verdict = Verdict::not_converged;
        result.status = Status::stalled;
      }
    } else {
      result.verdict = Verdict::not_converged;
      result.status = worn.status;
    }
  }
  return finish();
}

}  // namespace dovetail::wear
