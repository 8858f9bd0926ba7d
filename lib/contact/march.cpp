#include "contact/march.hpp"

#include <algorithm>
#include <cassert>

#include "contact/params.hpp"
#include "contact/sample_step.hpp"
#include "core/options.hpp"

namespace dovetail::contact {
namespace {

constexpr SettlingParams kSettling;

// Aitken's limit of a geometric sequence of slip states from its last two changes. Its ratio; 0 when it is not one.
template <int Directions>
double extrapolate(const double* change, const double* change_before, Memory& memory) {
  double dot = 0, square = 0, rest = 0, now = 0;
  for (int r = 0; r < Directions; ++r) {
    dot += change[r] * change_before[r];
    square += change_before[r] * change_before[r];
    now += change[r] * change[r];
  }
  const double ratio = dot / square;
  for (int r = 0; r < Directions; ++r) rest += std::pow(change[r] - ratio * change_before[r], 2);
  if (!(ratio > 0 && ratio < 0.9999 && rest <= 0.01 * now)) return 0;
  for (int r = 0; r < Directions; ++r) memory.slip_force[r] += change[r] * ratio / (1 - ratio);
  return ratio;
}

/// What changes of lambda_x over a period are measured by.
struct Scale {
  double limit = 0;     ///< largest friction limit; where there is none, largest tangential prediction
  double rounding = 0;  ///< what rounding of lambda_x leaves of a change
};

template <int Directions>
Scale scale_of(const double* prediction, const NodeLaw& law, int samples) {
  double limit = 0, largest_force = 0;
  for (int n = 0; n < samples; ++n) {
    const double* here = prediction + (1 + Directions) * n;
    limit = std::max(limit, law.limit(std::max(here[0], 0.0)).force);
    for (int r = 0; r < Directions; ++r) largest_force = std::max(largest_force, std::abs(here[1 + r]));
  }
  if (limit <= 0) limit = largest_force;
  return {.limit = limit,
          .rounding = std::max(kSettling.rounding * limit, kSettling.rounding / kSettling.errors * largest_force)};
}

/// One period from `memory`. `reset`: the last sample, counted from the beginning of the march, whose state does not
/// depend on those before.
template <int Directions>
void march_period(const double* prediction, const NodeLaw& law, SlipReturn rule, Memory& memory, DerivativeStart& reset,
                  MarchResult& result) {
  const int samples = static_cast<int>(result.state.size());
  for (int n = 0; n < samples; ++n) {
    const double *before = prediction + (1 + Directions) * ((n + samples - 1) % samples),
                 *here = prediction + (1 + Directions) * n;
    const Step step = sample_step<Directions>(before, here, law, rule, memory);
    for (int r = 0; r <= Directions; ++r) result.force(n, r) = step.force[r];
    for (int r = 0; r < Directions; ++r) {
      result.slip_force(n, 1 + r) = memory.slip_force[r];
      result.slip_step(n, r) = step.end[r] - step.origin[r];
    }
    result.slip_force(n, 0) = step.state == SampleState::separated ? here[0] : 0;
    result.state[static_cast<std::size_t>(n)] = step.state;
    result.always_stuck = result.always_stuck && step.state == SampleState::stuck;
    if (step.state == SampleState::separated || (Directions == 1 && step.state == SampleState::slipping))
      reset = {.sample = static_cast<long>(result.periods - 1) * samples + n, .memory = memory};
  }
}

/// Slip and loads of the last period: increments of X_T under load with trapezoidal normal forces; the sample before
/// the first is the last one.
template <int Directions>
void summarise(const NodeLaw& law, const Memory& memory, MarchResult& result) {
  const int samples = static_cast<int>(result.state.size());
  result.slip_distance = result.slip_load = result.dissipation = 0;
  result.always_closed = result.always_separated = true;
  for (int n = 0; n < samples; ++n) {
    const bool separated = result.state[static_cast<std::size_t>(n)] == SampleState::separated;
    result.always_closed = result.always_closed && !separated;
    result.always_separated = result.always_separated && separated;
    double square = 0;
    for (int r = 0; r < Directions; ++r) square += std::pow(result.slip_step(n, r), 2);
    const double now = result.force(n, 0), earlier = result.force((n + samples - 1) % samples, 0);
    const double load = (now + earlier) / 2;
    if (load <= 0 || square <= 0) continue;
    const double distance = std::sqrt(square) / law.tangential_penalty;
    result.slip_distance += distance;
    result.slip_load += load * distance;
    result.dissipation += (law.limit(now).force + law.limit(earlier).force) / 2 * distance;
  }
  result.slip_end.setZero();
  for (int r = 0; r < Directions; ++r) result.slip_end(r) = memory.slip_force[r] / law.tangential_penalty;
}

template <int Directions>
void march_node(const double* prediction, const NodeLaw& law, const MarchOptions& options, bool may_extrapolate,
                MarchResult& result) {
  Memory memory;
  for (int r = 0; r < Directions; ++r) memory.slip_force[r] = law.tangential_penalty * law.slip_origin(r);
  const auto [limit, rounding] = scale_of<Directions>(prediction, law, static_cast<int>(result.state.size()));
  const int periods = options.periodic ? options.max_periods : 1;
  double change_before[2] = {0, 0}, largest_before = 0, slowest = 0;
  result.extrapolated = false;
  result.always_stuck = true;
  DerivativeStart reset;
  result.status = options.periodic ? Status::not_periodic : Status::converged;
  for (result.periods = 1; result.periods <= periods; ++result.periods) {
    const Memory before = memory;
    result.start = reset;
    march_period<Directions>(prediction, law, options.slip_return, memory, reset, result);
    double change[2] = {0, 0}, largest = 0;
    for (int r = 0; r < Directions; ++r) {
      change[r] = memory.slip_force[r] - before.slip_force[r];
      largest = std::max(largest, std::abs(change[r]));
    }
    // Slip that dies out geometrically is as far from its orbit as the changes still to come: their sum counts. What an
    // extrapolation stirs up dies out faster than what it was made for, of which a little is left.
    double rest = largest;
    if (Directions == 2 && largest > kSettling.errors * rounding) {
      const double ratio = largest_before > 0 ? std::max(largest / largest_before, slowest) : 1;
      rest = ratio < 1 ? largest * std::max(1.0, ratio / (1 - ratio)) : kInfinity;
    }
    largest_before = largest;
    const bool repeats =
        options.periodic && rest <= std::max(std::min(options.tolerance * limit, options.resolution), rounding);
    // Extrapolated into a state that sticks for good, the orbit is one of many: only marching knows which.
    if (repeats && result.extrapolated && std::none_of(result.state.begin(), result.state.end(), [](SampleState state) {
          return state == SampleState::slipping;
        }))
      return march_node<Directions>(prediction, law, options, false, result);
    if (repeats) {
      result.status = Status::converged;
      result.start.orbit = before;
      break;
    }
    if (Directions == 2 && may_extrapolate && result.periods >= kSettling.patience &&
        result.periods % kSettling.interval == 0 && result.periods < periods) {
      const double ratio = extrapolate<Directions>(change, change_before, memory);
      if (ratio > 0) {
        result.extrapolated = true;
        largest_before = 0;
        slowest = std::max(slowest, ratio);
      }
    }
    std::copy(change, change + 2, change_before);
  }
  result.periods = std::min(result.periods, periods);
  summarise<Directions>(law, memory, result);
}

template <int Directions>
void run(const Eigen::Ref<const Eigen::MatrixXd>& prediction, const NodeLaw& law, const MarchOptions& options,
         MarchResult& result) {
  // Sample by sample in memory: the march visits all directions of a sample together.
  const Eigen::Matrix<double, Eigen::Dynamic, 1 + Directions, Eigen::RowMajor> rows = prediction;
  march_node<Directions>(rows.data(), law, options, true, result);
}

}  // namespace

void march(const Eigen::Ref<const Eigen::MatrixXd>& prediction, const NodeLaw& law, const MarchOptions& options,
           MarchResult& result) {
  const Eigen::Index samples = prediction.rows(), directions = prediction.cols();
  assert(directions == 2 || directions == 3);
  result.force.resize(samples, directions);
  result.slip_force.resize(samples, directions);
  result.slip_step.resize(samples, directions - 1);
  result.state.resize(static_cast<std::size_t>(samples));
  if (directions == 2)
    run<1>(prediction, law, options, result);
  else
    run<2>(prediction, law, options, result);
}

void carry_nothing(const Eigen::Ref<const Eigen::MatrixXd>& prediction, double tangential_penalty,
                   Eigen::Index coefficients, MarchResult& result) {
  const Eigen::Index d = prediction.cols(), m = d * coefficients, last = prediction.rows() - 1;
  result = MarchResult{};
  result.periods = 1;
  result.force.setZero(prediction.rows(), d);
  result.slip_force = prediction;
  result.slip_step.setZero(prediction.rows(), d - 1);
  result.state.assign(static_cast<std::size_t>(prediction.rows()), SampleState::separated);
  result.always_separated = true;
  for (Eigen::Index r = 0; r + 1 < d; ++r) result.slip_end(r) = prediction(last, 1 + r) / tangential_penalty;
  result.force_derivative.setZero(m, m);
  result.slip_load_derivative.setZero(m);
  result.dissipation_derivative.setZero(m);
}

}  // namespace dovetail::contact
