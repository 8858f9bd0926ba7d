#pragma once

#include <Eigen/Core>
#include <numbers>
#include <vector>

#include "contact/march.hpp"
#include "core/status.hpp"
#include "numerics/fourier.hpp"

namespace dovetail::stability {

using contact::SampleState;

inline constexpr double kPeriod = 2 * std::numbers::pi;  ///< of tau

/// A change of contact state of one node at tau in [0, 2 pi).
struct ContactEvent {
  double tau = 0;
  SampleState mode = SampleState::separated;  ///< afterwards
  bool closing = false;                       ///< it was open before
  Eigen::Vector2d ratio = {0, 0};             ///< lambda_T' / lambda_N' just after closing, no longer than mu
  double sign = 1;                            ///< of lambda_T while it slips next, with one tangential direction
};

/// What the slip of one node is like at an instant. Rates are per tau.
struct SlipFrame {
  Eigen::Vector2d along = {1, 0};  ///< v = lambda_T / |lambda_T|
  double limit = 0;                ///< of the tangential force, N
  double speed = 0;                ///< |X_T'|, m
  double turning = 0;              ///< rate of the angle of v
};

/// The contact states of one node over the period, with instants located between samples: lambda_u is a trigonometric
/// polynomial, so closing and opening are zeros of lambda_u,N, the start of slip one of |pre_T| - limit with the
/// slip frozen, and its end one of the slip speed v.lambda_u,T' - limit'.
class ContactTimeline {
 public:
  /// `prediction` holds lambda_u of the node [d, 2H+1]; samples are those of `basis`. A `released` node is open.
  /// `options` are those of the solution; slip follows the second-order rule in any case.
  ContactTimeline(Eigen::MatrixXd prediction, const contact::NodeLaw& law, contact::MarchOptions options,
                  const numerics::FourierBasis& basis, bool released);

  [[nodiscard]] Status status() const { return march_.status; }  ///< not_periodic when the march did not repeat
  [[nodiscard]] bool rubs() const { return law_.rubs(); }
  [[nodiscard]] contact::FrictionLimit limit_at(double tau) const { return law_.limit(value(tau)(0)); }
  [[nodiscard]] const std::vector<ContactEvent>& events() const { return events_; }  ///< ascending in tau
  [[nodiscard]] SampleState start_mode() const { return start_; }                    ///< at tau = 0
  [[nodiscard]] double start_sign() const { return start_sign_; }                    ///< of slip at tau = 0
  [[nodiscard]] bool always(SampleState mode) const { return events_.empty() && start_ == mode; }
  [[nodiscard]] bool ever(SampleState mode) const;

  /// For two tangential directions, at an instant of slip.
  [[nodiscard]] SlipFrame frame(double tau) const;

 private:
  [[nodiscard]] Eigen::Vector3d value(double tau) const;  // lambda_u (N, T1, T2)
  [[nodiscard]] Eigen::Vector3d slope(double tau) const;  // d lambda_u / d tau
  [[nodiscard]] int wrapped(int sample) const;
  [[nodiscard]] double instant(int sample) const;
  [[nodiscard]] SampleState mode_at(int sample) const;
  [[nodiscard]] Eigen::Vector2d direction_at(int sample) const;  // of lambda_T at a slipping sample
  [[nodiscard]] Eigen::Vector2d turned_from(int sample, double tau) const;
  [[nodiscard]] SlipFrame frame_along(const Eigen::Vector2d& along, double tau) const;
  [[nodiscard]] double slip_start(double from, double to, const Eigen::Vector2d& slip_force) const;
  [[nodiscard]] double slip_end(int sample) const;
  [[nodiscard]] double touch(int sample) const;
  void locate_touches();
  void walk(int sample);
  void add(ContactEvent event);

  Eigen::MatrixXd prediction_;
  contact::NodeLaw law_;
  const numerics::FourierBasis& basis_;
  contact::MarchResult march_;
  std::vector<ContactEvent> events_;
  SampleState start_ = SampleState::separated;
  double start_sign_ = 1;
};

}  // namespace dovetail::stability
