#include "stability/contact_timeline.hpp"

#include <algorithm>
#include <boost/math/tools/roots.hpp>
#include <cmath>
#include <cstdint>

#include "contact/sample_step.hpp"
#include "stability/params.hpp"

namespace dovetail::stability {
namespace {

// A zero of f between a and b; b when f does not change its sign.
template <class Function>
double zero(const Function& f, double a, double b) {
  const double at_a = f(a), at_b = f(b);
  if ((at_a > 0) == (at_b > 0)) return b;
  constexpr int kBits = 48;  // the last ones are roundings of f
  std::uintmax_t evaluations = 100;
  const auto [below, above] = boost::math::tools::toms748_solve(
      f, a, b, at_a, at_b, boost::math::tools::eps_tolerance<double>(kBits), evaluations);
  return (below + above) / 2;
}

Eigen::Vector2d normal_to(const Eigen::Vector2d& along) {
  return {-along(1), along(0)};
}

}  // namespace

ContactTimeline::ContactTimeline(Eigen::MatrixXd prediction, const contact::NodeLaw& law, contact::MarchOptions options,
                                 const numerics::FourierBasis& basis, bool released)
    : prediction_(std::move(prediction)), law_(law), basis_(basis) {
  if (released) return;
  options.slip_return = contact::SlipReturn::second_order;
  contact::march(basis.synthesise(prediction_), law, options, march_);
  if (march_.status != Status::converged) return;
  const int samples = basis.samples();
  if (!march_.always_closed && !march_.always_separated) locate_touches();
  // Shaken down to the limit: what still slips is what the march leaves of an adaptation that has ended.
  const double largest_limit = law.limit(march_.force.col(0).maxCoeff()).force;
  if (march_.always_closed && law.rubs() &&
      march_.slip_distance * law.tangential_penalty <= StabilityParams{}.settled * largest_limit) {
    start_ = SampleState::stuck;
    return;
  }
  // Begin where nothing happens, so that no event is moved across the ends of the walk.
  int first = 0;
  for (int n = 0; n < samples; ++n)
    if (mode_at(n) == mode_at(n - 1) && mode_at(n) == mode_at(n + 1)) first = n;
  for (int n = first; n < first + samples; ++n) walk(n);
  for (ContactEvent& event : events_) event.tau = std::fmod(event.tau + kPeriod, kPeriod);
  std::stable_sort(events_.begin(), events_.end(),
                   [](const ContactEvent& a, const ContactEvent& b) { return a.tau < b.tau; });
  start_ = events_.empty() ? mode_at(0) : events_.back().mode;
  start_sign_ = 1;
  for (const ContactEvent& event : events_)
    if (event.mode == SampleState::slipping) start_sign_ = event.sign;
  if (events_.empty() && start_ == SampleState::slipping) start_sign_ = direction_at(0)(0);
}

bool ContactTimeline::ever(SampleState mode) const {
  return start_ == mode ||
         std::any_of(events_.begin(), events_.end(), [&](const ContactEvent& event) { return event.mode == mode; });
}

Eigen::Vector3d ContactTimeline::value(double tau) const {
  Eigen::Vector3d result = Eigen::Vector3d::Zero();
  result.head(prediction_.rows()) = prediction_ * basis_.at(tau);
  return result;
}

Eigen::Vector3d ContactTimeline::slope(double tau) const {
  Eigen::Vector3d result = Eigen::Vector3d::Zero();
  result.head(prediction_.rows()) = prediction_ * basis_.derivative_at(tau);
  return result;
}

int ContactTimeline::wrapped(int sample) const {
  const int samples = basis_.samples();
  return (sample % samples + samples) % samples;
}

double ContactTimeline::instant(int sample) const {
  return kPeriod * sample / basis_.samples();
}

SampleState ContactTimeline::mode_at(int sample) const {
  return march_.state[static_cast<std::size_t>(wrapped(sample))];
}

Eigen::Vector2d ContactTimeline::direction_at(int sample) const {
  Eigen::Vector2d force(0, 0);
  force.head(prediction_.rows() - 1) = march_.force.row(wrapped(sample)).tail(prediction_.rows() - 1).transpose();
  const double length = force.norm();
  return length > 0 ? Eigen::Vector2d(force / length) : Eigen::Vector2d(1, 0);
}

SlipFrame ContactTimeline::frame_along(const Eigen::Vector2d& along, double tau) const {
  const Eigen::Vector3d rate = slope(tau);
  const contact::FrictionLimit limit = limit_at(tau);
  SlipFrame frame{.along = along, .limit = limit.force, .speed = 0, .turning = 0};
  // lambda_u,T' = lambda_T' + eps X_T' with lambda_T = limit v and X_T' along v.
  frame.speed = (along.dot(rate.tail<2>()) - limit.by_normal * rate(0)) / law_.tangential_penalty;
  frame.turning = normal_to(along).dot(rate.tail<2>()) / frame.limit;
  return frame;
}

Eigen::Vector2d ContactTimeline::turned_from(int sample, double tau) const {
  Eigen::Vector2d along = direction_at(sample);
  if (prediction_.rows() < 3) return along;
  const SlipFrame frame = frame_along(along, instant(sample));
  // Where the limit force is about to vanish the rate says nothing over a whole sample.
  const double turn = frame.turning * (tau - instant(sample));
  if (!(std::abs(turn) < StabilityParams{}.largest_turn)) return along;
  return std::cos(turn) * along + std::sin(turn) * normal_to(along);
}

SlipFrame ContactTimeline::frame(double tau) const {
  const int n = static_cast<int>(std::floor(tau / kPeriod * basis_.samples()));
  const bool before = mode_at(n) == SampleState::slipping, after = mode_at(n + 1) == SampleState::slipping;
  const double weight = (tau - instant(n)) / (instant(n + 1) - instant(n));
  Eigen::Vector2d along = slope(tau).tail<2>().normalized();
  if (before && after && direction_at(n).dot(direction_at(n + 1)) > 0) {
    const Eigen::Vector2d from = direction_at(n), to = direction_at(n + 1);
    const double turn = weight * std::atan2(normal_to(from).dot(to), from.dot(to));
    along = std::cos(turn) * from + std::sin(turn) * normal_to(from);
  } else if (before && (!after || weight < 0.5)) {
    along = turned_from(n, tau);
  } else if (after) {
    along = turned_from(n + 1, tau);
  }
  SlipFrame frame = frame_along(along, tau);
  frame.speed = std::max(frame.speed, 0.0);
  return frame;
}

// A node that closes between two samples starts from its slip at the touch, not at the last open sample: the march
// would slip a little at every touch otherwise. An open sample forgets all history, so one period from there is the
// orbit.
void ContactTimeline::locate_touches() {
  const int samples = basis_.samples();
  const Eigen::Index d = prediction_.rows();
  int first = 0;
  while (mode_at(first) != SampleState::separated) ++first;
  const Eigen::MatrixXd table = prediction_ * basis_.synthesis_table().transpose();
  contact::Memory memory;
  for (int k = 0; k < samples; ++k) {
    const int n = wrapped(first + k);
    if (k > 0 && mode_at(n - 1) == SampleState::separated && table(0, n) > 0) {
      const Eigen::Vector3d at = value(touch(first + k - 1));
      for (Eigen::Index r = 0; r + 1 < d; ++r) memory.slip_force[r] = at(1 + r);
      memory.separated = false;
    }
    const double *before = table.col(wrapped(n - 1)).data(), *here = table.col(n).data();
    const contact::Step step =
        d == 2 ? contact::sample_step<1>(before, here, law_, contact::SlipReturn::second_order, memory)
               : contact::sample_step<2>(before, here, law_, contact::SlipReturn::second_order, memory);
    march_.state[static_cast<std::size_t>(n)] = step.state;
    for (Eigen::Index r = 0; r < d; ++r) march_.force(n, r) = step.force[r];
    for (Eigen::Index r = 1; r < d; ++r) march_.slip_force(n, r) = memory.slip_force[r - 1];
  }
}

// Between a sample and the next, where lambda_u,N changes its sign.
double ContactTimeline::touch(int sample) const {
  return zero([&](double tau) { return value(tau)(0); }, instant(sample), instant(sample + 1));
}

// Slip frozen at lambda_x = slip_force: |pre_T| reaches the limit.
double ContactTimeline::slip_start(double from, double to, const Eigen::Vector2d& slip_force) const {
  const auto excess = [&](double tau) {
    const Eigen::Vector3d at = value(tau);
    return (at.tail<2>() - slip_force).norm() - law_.limit(at(0)).force;
  };
  return zero(excess, from, to);
}

// The last slipping sample is on either side of the instant at which the speed vanishes.
double ContactTimeline::slip_end(int sample) const {
  const auto speed = [&](double tau) { return frame_along(turned_from(sample, tau), tau).speed; };
  const double here = instant(sample), width = instant(1);
  if (speed(here) > 0) return zero(speed, here, here + width);
  const double begin = events_.empty() ? here - width : std::max(events_.back().tau, here - width);
  return speed(begin) > 0 ? zero(speed, begin, here) : here;
}

void ContactTimeline::add(ContactEvent event) {
  if (!events_.empty()) event.tau = std::max(event.tau, events_.back().tau);
  events_.push_back(event);
}

// What changes between one sample and the next.
void ContactTimeline::walk(int sample) {
  const SampleState from = mode_at(sample), to = mode_at(sample + 1);
  const double a = instant(sample), b = instant(sample + 1);
  const double sign = to == SampleState::slipping ? direction_at(sample + 1)(0) : 1;
  if (from == to) {
    // Slip that reverses within one sample rests at an instant.
    if (from != SampleState::slipping || direction_at(sample).dot(direction_at(sample + 1)) > 0) return;
    if (!law_.rubs()) return;
    const double end = slip_end(sample);
    add({.tau = end, .mode = SampleState::stuck});
    const Eigen::Vector3d at = value(end);
    add({.tau = slip_start(end, b, at.tail<2>() - law_.limit(at(0)).force * turned_from(sample, end)),
         .mode = SampleState::slipping,
         .sign = sign});
  } else if (to == SampleState::separated) {
    add({.tau = touch(sample), .mode = to});
  } else if (from == SampleState::separated) {
    ContactEvent event{.tau = touch(sample), .mode = to, .closing = true, .sign = sign};
    const Eigen::Vector3d rate = slope(event.tau);
    event.ratio = rate.tail<2>() / std::max(rate(0), 1e-300);
    const double length = event.ratio.norm();
    const double steepest = law_.limit(0).by_normal;
    if (to == SampleState::slipping || length > steepest) event.ratio *= steepest / std::max(length, 1e-300);
    add(event);
  } else if (to == SampleState::slipping) {
    Eigen::Vector2d slip_force(0, 0);
    slip_force.head(prediction_.rows() - 1) =
        march_.slip_force.row(wrapped(sample)).tail(prediction_.rows() - 1).transpose();
    add({.tau = slip_start(a, b, slip_force), .mode = to, .sign = sign});
  } else {
    add({.tau = slip_end(sample), .mode = to});
  }
}

}  // namespace dovetail::stability
