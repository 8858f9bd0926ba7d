#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <ostream>

#include "paths/frequency_response.hpp"
#include "studies/program/answers/teller.hpp"
#include "studies/program/commands/commands.hpp"
#include "studies/program/engine/interrupt.hpp"
#include "studies/program/engine/loaded_model.hpp"
#include "studies/program/engine/number_constants.hpp"
#include "studies/program/engine/response_curve.hpp"
#include "studies/program/engine/truncation_choice.hpp"
#include "studies/program/study_file/refusal.hpp"

namespace dovetail::studies {
namespace {

std::vector<double> frequencies(const ResponseOptions& options) {
  if (options.arclength && options.from_hz == options.to_hz)
    refuse("--arclength", "needs an interval to follow the response through: --to must differ from --from");
  return evenly_spaced(options.from_hz, options.to_hz, options.points);
}

/// Points that a branch may take.
int most_points(int points) {
  return std::max(branches::FollowOptions{}.max_points, 20 * points);
}

/// Computes the curve point by point, with what is asked for at each; shows progress and stops when asked to.
class CurveRun {
 public:
  CurveRun(const LoadedModel& loaded, const ResponseOptions& options, Teller& teller)
      : loaded_(loaded), options_(options), teller_(teller) {
    curve_.output_names = loaded.model.output_names;
    curve_.settings = loaded.joint.options;
    curve_.choice = options.choice;
    curve_.penalty =
        contact::pseudo_penalty(loaded.joint.model->local_stiffness(), loaded.joint.model->directions(),
                                loaded.joint.options.normal_penalty, loaded.joint.options.tangential_penalty);
  }
  ~CurveRun() { teller_.end(); }
  CurveRun(const CurveRun&) = delete;
  CurveRun& operator=(const CurveRun&) = delete;

  ResponseCurve at(const std::vector<double>& hz, const OrderlyInterrupt& interrupt) {
    std::vector<double> omega;
    for (const double f : hz) omega.push_back(kTurn * f);
    curve_.frequency_hz = hz;
    teller_.begin("frequencies", 0, static_cast<int>(hz.size()));
    curve_.states = paths::frequency_response(
        loaded_.joint, omega, [&](std::size_t, const steady::State& state) { return take(state, interrupt); });
    curve_.analyses.resize(curve_.states.size());
    return std::move(curve_);
  }

  ResponseCurve along(const OrderlyInterrupt& interrupt) {
    steady::Options steady = loaded_.joint.options;
    steady.linearise = false;
    branches::FollowOptions follow;
    if (options_.points > 1)
      follow.largest_parameter_step = std::min(follow.largest_parameter_step, 1.0 / (options_.points - 1));
    follow.max_points = most_points(options_.points);
    teller_.begin("following the response");
    curve_.branch =
        paths::continuation({loaded_.joint.model, {}, steady}, kTurn * options_.from_hz, kTurn * options_.to_hz, follow,
                            [&](const branches::BranchPoint& point) { return take(point.state, interrupt); });
    require_end();
    for (branches::BranchPoint& point : curve_.branch->points) {
      curve_.frequency_hz.push_back(hertz(point.state.omega));
      curve_.states.push_back(std::move(point.state));
    }
    curve_.analyses.resize(curve_.states.size());
    return std::move(curve_);
  }

 private:
  bool take(const steady::State& state, const OrderlyInterrupt& interrupt) {
    teller_.step(++done_);
    if (options_.choice.any()) curve_.analyses.push_back(analyse(loaded_, state, options_.choice));
    return !interrupt.requested();
  }

  /// A branch that claims to have left the interval has its last point on an end of it.
  void require_end() {
    branches::Branch& branch = *curve_.branch;
    const double last = branch.points.back().state.omega;
    if (branch.status == Status::converged && last != kTurn * options_.from_hz && last != kTurn * options_.to_hz)
      branch.status = Status::stalled;
  }

  /// Exactly as asked for at the ends of the interval.
  [[nodiscard]] double hertz(double omega) const {
    for (const double hz : {options_.from_hz, options_.to_hz})
      if (omega == kTurn * hz) return hz;
    return omega / kTurn;
  }

  const LoadedModel& loaded_;
  const ResponseOptions& options_;
  Teller& teller_;
  int done_ = 0;
  ResponseCurve curve_;
};

/// "3 of 8 frequencies did not converge: 2 stalled, 1 singular", or nothing.
std::string failures(const ResponseCurve& curve) {
  std::map<std::string_view, int> counts;
  std::size_t failed = 0;
  for (const steady::State& state : curve.states)
    if (state.status != Status::converged) {
      ++counts[to_string(state.status)];
      ++failed;
    }
  if (failed == 0) return {};
  std::string text = fmt::format("{} of {} frequencies did not converge: ", failed, curve.states.size());
  for (bool first = true; const auto& [status, count] : counts) {
    text += fmt::format("{}{} {}", first ? "" : ", ", count, status);
    first = false;
  }
  return text;
}

/// How a branch that was not followed to its end may be.
std::string advice(const ResponseCurve& curve, const ResponseOptions& options) {
  const int points = static_cast<int>(curve.states.size());
  if (points < most_points(options.points)) return "more --samples make the branch smoother there";
  return fmt::format("its {} points are as many as --points {} allows, --points {} allows {} and shorter steps", points,
                     options.points, points / 10, most_points(points / 10));
}

/// Whether some node slips or separates in a state that converged.
bool contact_changes(const ResponseCurve& curve) {
  return std::ranges::any_of(curve.states, [](const steady::State& state) {
    return state.status == Status::converged && std::ranges::any_of(state.nodes, [](const steady::NodeSummary& node) {
             return node.slips || node.separates;
           });
  });
}

}  // namespace

int run_response(const ResponseOptions& options, Teller& teller, const Streams& streams) {
  return answer_response(options, frequencies(options), teller, streams);
}

int answer_response(const ResponseOptions& options, const std::vector<double>& hz, Teller& teller,
                    const Streams& streams) {
  return answer_response(options, hz, told_model(options.input, options.set, options.solver, teller), teller, streams);
}

int answer_response(const ResponseOptions& options, const std::vector<double>& hz, LoadedModel loaded, Teller& teller,
                    const Streams& streams) {
  const auto complain = [&](const std::string& what) { return not_converged(options.input, what, streams); };
  if (!loaded.failure.empty()) return complain("not converged: " + loaded.failure);

  const OrderlyInterrupt interrupt;
  const std::optional<Status> automatic = choose_truncation(loaded, hz, options.solver);
  ResponseCurve curve = options.arclength ? CurveRun(loaded, options, teller).along(interrupt)
                                          : CurveRun(loaded, options, teller).at(hz, interrupt);
  curve.automatic = automatic;
  curve.accuracy = accuracy(options.solver);
  deliver_json(options.json, response_json(curve), streams);
  if (options.json.empty()) streams.out << response_table(curve);
  if (interrupt.requested())
    return interrupted(fmt::format("{} of {} frequencies", curve.states.size(), hz.size()), streams);
  if (!loaded.joint.model->massless_contact() && contact_changes(curve))
    teller.remark()
        << "dovetail: " << options.input
        << ": remark: contact dofs carry mass and slip or lift off: the harmonics converge slowly there and "
           "lift-off has no unique answer; move that mass inward, or look at --error-bars\n";

  int status = kDone;
  if (const std::string failed = failures(curve); !failed.empty()) status = complain(failed);
  if (curve.branch && curve.branch->status != Status::converged && status == kDone)
    status = complain(fmt::format("the response was followed to {:.9g} Hz and not to its end: {}; {}",
                                  curve.frequency_hz.back(), to_string(curve.branch->status), advice(curve, options)));
  if (const std::string failed = analysis_failures(curve.analyses); !failed.empty()) status = complain(failed);
  if (automatic && *automatic != Status::converged && status == kDone)
    status = complain(truncation_complaint(*automatic, loaded.joint.options, options.solver));
  return status;
}

}  // namespace dovetail::studies
