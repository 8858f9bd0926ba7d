#include "paths/resonance.hpp"

#include "paths/params.hpp"
#include "paths/peak_search.hpp"
#include "paths/peak_sweep.hpp"

namespace dovetail::paths {
namespace {

constexpr ClosingInParams kClosingIn;

/// Where the search begins: the frequency and, unless empty, the displacement there.
struct PeakStart {
  double omega = 0;
  Eigen::MatrixXd guess;
  int solves = 0, jacobians = 0;  ///< spent on finding it
};

/// With many harmonics the way to the peak is found with half of them, at an eighth of the cost of a step; what is left
/// is a short way on which Newton's method does not have to find out which nodes slip.
PeakStart with_fewer_harmonics(steady::Joint joint, PeakStart start, const ResonanceOptions& peak) {
  if (joint.options.harmonics < kClosingIn.many_harmonics) return start;
  const Eigen::Index all = 2 * joint.options.harmonics + 1;
  joint.options.harmonics = (joint.options.harmonics / 2) | 1;  // even ones hardly move of flanks under pressure
  const Eigen::Index few = 2 * joint.options.harmonics + 1;
  PeakStart first = start;
  if (first.guess.cols() > few) first.guess.conservativeResize(Eigen::NoChange, few);
  first = with_fewer_harmonics(joint, std::move(first), peak);
  const Resonance found = search_peak(joint, first.omega, peak, first.guess);
  start.solves = first.solves + found.solves;
  start.jacobians = first.jacobians + found.jacobians;
  if (found.status != Status::converged) return start;
  Eigen::MatrixXd guess = Eigen::MatrixXd::Zero(found.state.displacement.rows(), all);
  guess.leftCols(few) = found.state.displacement;
  start.omega = found.omega;
  start.guess = std::move(guess);
  return start;
}

/// A peak that only another pseudo-penalty led to may be one of another branch: it is looked for again from frequencies
/// beside it. One found with the pseudo-penalty asked for counts where it is no lower.
void look_again(const steady::Joint& joint, const ResonanceOptions& peak, Resonance& found) {
  const double omega = found.omega;
  for (const double start : {omega * (1 - kClosingIn.beside), omega * (1 + kClosingIn.beside)}) {
    if (found.status != Status::converged || found.state.penalty_ratio == 1) return;
    Resonance other = search_peak(joint, start, peak, {});
    other.solves += found.solves;
    other.jacobians += found.jacobians;
    const bool counts = other.status == Status::converged && other.state.penalty_ratio == 1 &&
                        other.amplitude >= kClosingIn.no_lower * found.amplitude;
    if (counts)
      found = std::move(other);
    else
      found.solves = other.solves, found.jacobians = other.jacobians;
  }
}

}  // namespace

Resonance resonance(const steady::Joint& joint, double omega_start, const ResonanceOptions& resonance_options,
                    const Eigen::MatrixXd& guess) {
  std::vector<Violation> found = violations(resonance_options);
  const auto outputs = static_cast<int>(joint.model->output_names().size());
  if (resonance_options.output >= outputs)
    found.push_back({.file = {},
                     .key = "output",
                     .value = std::to_string(resonance_options.output),
                     .allowed = "must be < " + std::to_string(outputs)});
  if (!found.empty()) throw InputError(std::move(found));
  PeakStart start{.omega = omega_start, .guess = guess, .solves = 0, .jacobians = 0};
  if (!resonance_options.begins_near) start = with_fewer_harmonics(joint, std::move(start), resonance_options);
  Resonance near = search_peak(joint, start.omega, resonance_options, start.guess);
  near.solves += start.solves;
  near.jacobians += start.jacobians;
  look_again(joint, resonance_options, near);
  if (near.status == Status::converged || cut_short(near.status) || resonance_options.sweep_range == 0) return near;
  Resonance far = peak_sweep(joint, omega_start * (1 - resonance_options.sweep_range),
                             omega_start * (1 + resonance_options.search_range), resonance_options);
  far.swept = true;
  far.solves += near.solves;
  far.jacobians += near.jacobians;
  // A point higher than the highest maximum found has one beside it that was not.
  if (far.status == Status::converged && far.unresolved > 0) far.status = Status::no_bracket;
  if (far.status == Status::converged) return far;
  near.solves = far.solves;
  near.jacobians = far.jacobians;
  if (cut_short(far.status)) near.status = far.status;
  return near;
}

}  // namespace dovetail::paths
