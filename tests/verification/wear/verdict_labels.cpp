#include "verdict_labels.hpp"

#include <algorithm>
#include <cmath>

#include "paths/steady_state.hpp"
#include "wear/asymptote/asymptote.hpp"
#include "wear/history/history.hpp"
#include "wear/measures.hpp"

namespace dovetail::wear::scenes {

namespace {

constexpr double kLimit = 0.01, kMargin = 0.003;

}  // namespace

std::string_view to_string(Label label) {
  switch (label) {
    case Label::stops:
      return "stops";
    case Label::elsewhere:
      return "elsewhere";
    case Label::goes_on:
      return "goes_on";
    case Label::open:
      return "open";
  }
  return "unknown";
}

Label explicit_label(const std::shared_ptr<const dynamics::CondensedModel>& model, double omega,
                     steady::Options steady) {
  steady.samples *= 4;
  const steady::State first = paths::steady_state({model, {}, steady}, omega);
  if (first.status != Status::converged) return Label::open;
  const double penetration = largest_penetration(*model, first);
  AsymptoteOptions direct;
  direct.rate_threshold = 0.0;
  direct.certify_finer = false;
  direct.arbitration = Arbitration::never;
  const Asymptote released = asymptote({model, {}, steady}, omega, direct, &first);
  const bool settled = released.verdict == Verdict::asymptote;
  HistoryOptions options{.rate_fraction = 1e-6, .rate_threshold = 0.0, .finish = false};

  // Where wear never ends, coarse steps show it first.
  options.increment = 0.1 * penetration;
  options.steps = 1500;
  const History coarse = history({model, {}, steady}, {.omega = omega}, options);
  if (coarse.end == HistoryEnd::steps) {
    const Eigen::Index last = coarse.rate.rows() - 1;
    const double level = coarse.rate.row(last).maxCoeff() / coarse.rate.row(last / 2).maxCoeff();
    return std::abs(level - 1.0) < 1e-3 ? Label::goes_on : Label::open;
  }
  if (coarse.end != HistoryEnd::worn_out) return Label::open;
  if (!settled || coarse.final_depth.maxCoeff() == 0.0) return Label::stops;

  const double scale = std::min(std::max(penetration, 0.1 * released.largest_depth), released.largest_depth);
  options.steps = 12000;
  const auto away = [&](double increment) {
    options.increment = increment * scale;
    const History run = history({model, {}, steady}, {.omega = omega}, options);
    if (run.end != HistoryEnd::worn_out) return std::nan("");
    return (run.final_depth - released.depth).cwiseAbs().maxCoeff() /
           std::max(released.largest_depth, run.final_depth.maxCoeff());
  };
  const double fine = away(0.002);
  if (!(std::abs(fine - kLimit) > kMargin)) return Label::open;
  const double check = away(0.004);
  if (std::isnan(check) || (fine > kLimit) != (check > kLimit)) return Label::open;
  return fine > kLimit ? Label::elsewhere : Label::stops;
}

}  // namespace dovetail::wear::scenes
