#include "stability/stability.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <numbers>
#include <string>

#include "numerics/dense_general.hpp"
#include "paths/steady_state.hpp"
#include "tests/verification/steady/rod.hpp"

namespace dovetail::verification {
namespace {

using stability::local_stability;
using stability::Stability;
using stability::StabilityVerdict;
using steady::State;
using Complex = std::complex<double>;

constexpr double kTwoPi = 2 * std::numbers::pi;

// Distance of each multiplier of `exact` from the nearest of `found`, largest over those of modulus > 0.02 (those of
// smaller ones are ill-conditioned in the finite differences they are compared with).
double mismatch(const Eigen::VectorXcd& found, const Eigen::VectorXcd& exact) {
  double largest = 0;
  for (const Complex& e : exact) {
    if (std::abs(e) < 0.02) continue;
    double nearest = 1e300;
    for (const Complex& f : found) nearest = std::min(nearest, std::abs(f - e));
    largest = std::max(largest, nearest);
  }
  return largest;
}

// exp(lambda T) of M q'' + C q' + K q = 0 with regular M.
Eigen::VectorXcd linear_multipliers(const Eigen::MatrixXd& m, const Eigen::MatrixXd& c, const Eigen::MatrixXd& k,
                                    double omega) {
  const Eigen::Index n = m.rows();
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(2 * n, 2 * n);
  a.topRightCorner(n, n).setIdentity();
  a.bottomLeftCorner(n, n) = -m.inverse() * k;
  a.bottomRightCorner(n, n) = -m.inverse() * c;
  const Eigen::VectorXcd rates = numerics::eigenvalues(a).values;
  return (rates * (kTwoPi / omega)).array().exp();
}

TEST(Stability, OfAGluedRodIsThatOfTheLinearSystem) {
  reduction::ReducedModel model = rod(5);
  model.contact.friction.setConstant(50);
  const double omega = 2.2;
  const steady::State state = paths::steady_state({condensed(model), {}, {}}, omega);
  const stability::Stability found = stability::local_stability(model, state);
  ASSERT_EQ(found.verdict, stability::StabilityVerdict::stable) << found.reason;
  EXPECT_EQ(found.neutral, 5);
  EXPECT_EQ(found.events, 0);
  ASSERT_EQ(found.multipliers.size(), 10);
  const Eigen::VectorXcd exact =
      linear_multipliers(model.mass.topLeftCorner<5, 5>(), model.damping.topLeftCorner<5, 5>(),
                         model.stiffness.topLeftCorner<5, 5>(), omega);
  // One exponential of a matrix of norm 2 pi 6 / 2.2.
  EXPECT_LT(mismatch(found.multipliers, exact), 1e-12);
  EXPECT_NEAR(found.largest_modulus, std::exp(-0.02 * kTwoPi / omega), 1e-12);
}

TEST(Stability, OfASeparatedRodIsThatOfTheFreeSystem) {
  const reduction::ReducedModel model = rod(5);
  const double omega = 2.2;
  const steady::Condition far{.wear_depth = Eigen::VectorXd::Constant(5, 100.0)};
  const stability::Stability found =
      stability::local_stability(model, paths::steady_state({condensed(model), far, {}}, omega));
  ASSERT_EQ(found.verdict, stability::StabilityVerdict::stable) << found.reason;
  EXPECT_EQ(found.neutral, 0);
  const Eigen::MatrixXd free = model.stiffness.topLeftCorner<5, 5>() - 2 * Eigen::MatrixXd::Identity(5, 5);
  EXPECT_LT(mismatch(found.multipliers, linear_multipliers(model.mass.topLeftCorner<5, 5>(),
                                                           model.damping.topLeftCorner<5, 5>(), free, omega)),
            1e-12);
}

TEST(Stability, WithoutDampingIsMarginal) {
  reduction::ReducedModel model = rod(3);
  model.contact.friction.setConstant(50);
  model.damping.setZero();
  const stability::Stability found =
      stability::local_stability(model, paths::steady_state({condensed(model), {}, {}}, 2.2));
  EXPECT_EQ(found.verdict, stability::StabilityVerdict::marginal) << found.reason;
  EXPECT_NEAR(found.largest_modulus, 1, 1e-11);
}

TEST(Stability, SaysWhereItMeansNothing) {
  // Contact with mass that lifts off: a mass on a wall behind a gap.
  reduction::ReducedModel lifting = den_hartog(0.1);
  lifting.mass(1, 1) = 1;
  lifting.contact.friction.setZero();
  lifting.static_force(1) = 0.2;
  lifting.cosine_force(0, 1) = 1;
  lifting.damping(1, 1) = lifting.damping(0, 0) = 0.2;
  steady::State state = paths::steady_state({condensed(lifting), {}, {.harmonics = 7, .tolerance = 1e-2}}, 0.7);
  ASSERT_EQ(state.status, Status::converged);
  ASSERT_TRUE(state.nodes[0].separates && state.nodes[0].carries_load);
  EXPECT_EQ(stability::local_stability(lifting, state).verdict, stability::StabilityVerdict::not_meaningful);
  EXPECT_EQ(stability::local_stability(lifting, state).multipliers.size(), 0);

  reduction::ReducedModel quasi_static = rod(3);
  quasi_static.mass.setZero();
  quasi_static.damping.setZero();
  state = paths::steady_state({condensed(quasi_static), {}, {}}, 1);
  ASSERT_EQ(state.status, Status::converged);
  EXPECT_EQ(stability::local_stability(quasi_static, state).verdict, stability::StabilityVerdict::not_meaningful);

  const reduction::ReducedModel sliding = den_hartog(0.4);
  state = paths::steady_state({condensed(sliding), {}, {.harmonics = 15}}, 0.8);
  ASSERT_EQ(state.status, Status::converged);
  EXPECT_EQ(stability::local_stability(sliding, state).verdict, stability::StabilityVerdict::undetermined);

  state.tangent = nullptr;
  EXPECT_EQ(stability::local_stability(sliding, state).verdict, stability::StabilityVerdict::undetermined);
  state.status = Status::stalled;
  EXPECT_FALSE(stability::local_stability(sliding, state).reason.empty());
  EXPECT_THROW((void)stability::local_stability(sliding, state, {.samples = 1}), InputError);
}

// x'' + 0.04 x' + x + 1.5 max(x - 1, 0) = 0.12 cos: a massless node behind a spring touches a wall at 1.
constexpr double kDamping = 0.04, kWall = 1.5, kForce = 0.12;

reduction::ReducedModel clearance() {
  reduction::ReducedModel model = empty_model(3, 1, 1);
  model.mass(0, 0) = 1;
  model.damping(0, 0) = kDamping;
  model.stiffness << 1 + kWall, -kWall, 0, -kWall, kWall, 0, 0, 0, 1;
  model.contact.normal << 1;
  model.contact.tangential << 2;
  model.contact.gap << 1;
  model.cosine_force(0, 0) = kForce;
  model.output_vectors = Eigen::MatrixXd::Identity(1, 3);
  model.output_names = {"x"};
  return model;
}

// Amplitudes x that balance the first harmonic: starts for all branches.
std::vector<double> one_harmonic_amplitudes(double omega) {
  const auto excess = [&](double a) {
    double stiffness = 1;
    if (a > 1) {
      const double angle = std::acos(1 / a);
      stiffness += kWall / std::numbers::pi * (angle - std::sin(2 * angle) / 2);
    }
    return std::hypot((stiffness - omega * omega) * a, kDamping * omega * a) - kForce;
  };
  std::vector<double> found;
  for (double a = 0.01; a < 6; a += 0.01)
    if (excess(a) * excess(a + 0.01) <= 0) found.push_back(a + 0.005);
  return found;
}

// Contact displacements [2, 2H+1] for x = amplitude cos(tau - phase): u_N follows the mass up to the wall.
Eigen::MatrixXd clearance_guess(double amplitude, double omega, int harmonics) {
  const numerics::FourierBasis basis(harmonics, 256);
  const double sine = std::min(1.0, kDamping * omega * std::abs(amplitude) / kForce);
  // Below resonance the mass follows the excitation, above (a negative amplitude here) it opposes it.
  const double phase = amplitude > 0 ? std::asin(sine) : std::numbers::pi - std::asin(sine);
  Eigen::MatrixXd samples = Eigen::MatrixXd::Zero(256, 2);
  for (int n = 0; n < 256; ++n) samples(n, 0) = std::min(1.0, std::abs(amplitude) * std::cos(kTwoPi * n / 256 - phase));
  return basis.analyse(samples);
}

// The period map of the exact equation and its derivative, by Runge-Kutta with 4000 steps.
struct ClearanceMap {
  Eigen::Vector2d end;
  Eigen::Matrix2d derivative;
};
ClearanceMap clearance_map(const Eigen::Vector2d& start, double omega) {
  using Perturbed = Eigen::Matrix<double, 6, 1>;
  Perturbed y;
  y << start, 1, 0, 0, 1;
  const int steps = 4000;
  const double h = kTwoPi / omega / steps;
  const auto rate = [&](double t, const Perturbed& at) {
    const double k = at(0) > 1 ? 1 + kWall : 1;
    Perturbed r;
    r << at(1), kForce * std::cos(omega * t) - kDamping * at(1) - at(0) - kWall * std::max(at(0) - 1, 0.0), at(3),
        -k * at(2) - kDamping * at(3), at(5), -k * at(4) - kDamping * at(5);
    return r;
  };
  for (int n = 0; n < steps; ++n) {
    const double t = n * h;
    const Perturbed k1 = rate(t, y), k2 = rate(t + h / 2, y + h / 2 * k1), k3 = rate(t + h / 2, y + h / 2 * k2),
                    k4 = rate(t + h, y + h * k3);
    y += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
  }
  ClearanceMap map;
  map.end = y.head<2>();
  map.derivative << y(2), y(4), y(3), y(5);
  return map;
}

TEST(Stability, FindsTheMiddleBranchOfAClearanceUnstable) {
  const reduction::ReducedModel model = clearance();
  const auto reduced = condensed(model);
  const double omega = 1.12;
  const int harmonics = 25;
  const std::vector<double> starts = one_harmonic_amplitudes(omega);
  ASSERT_EQ(starts.size(), 3u);
  std::vector<double> amplitudes;
  for (std::size_t i = 0; i < 3; ++i) {
    steady::State state;
    for (const double sign : {1.0, -1.0}) {
      state = paths::steady_state({reduced, {}, {.harmonics = harmonics, .samples = 1024}}, omega,
                                  clearance_guess(sign * starts[i], omega, harmonics));
      if (state.status == Status::converged && std::abs(state.amplitudes(0) - starts[i]) < 0.3 * starts[i]) break;
    }
    ASSERT_EQ(state.status, Status::converged);
    // One harmonic without a mean is a rough start.
    ASSERT_NEAR(state.amplitudes(0), starts[i], 0.3 * starts[i]);
    amplitudes.push_back(state.amplitudes(0));
    const stability::Stability found = stability::local_stability(model, state);
    EXPECT_EQ(found.verdict, i == 1 ? stability::StabilityVerdict::unstable : stability::StabilityVerdict::stable)
        << found.reason;
    // The exact orbit by shooting from the series, and its multipliers.
    Eigen::Vector2d orbit(0, 0);
    for (int h = 0; h <= harmonics; ++h) {
      orbit(0) += state.outputs(0, h == 0 ? 0 : 2 * h - 1);
      if (h > 0) orbit(1) += omega * h * state.outputs(0, 2 * h);
    }
    ClearanceMap map;
    for (int k = 0; k < 6; ++k) {
      map = clearance_map(orbit, omega);
      orbit -= (map.derivative - Eigen::Matrix2d::Identity()).inverse() * (map.end - orbit);
    }
    const Eigen::VectorXcd exact = numerics::eigenvalues(map.derivative).values;
    // The series of 25 harmonics moves the instants of contact by about its truncation error, 1e-4.
    EXPECT_LT(mismatch(found.multipliers, exact), 1e-3);
  }
  EXPECT_LT(amplitudes[0] + 0.2, amplitudes[1]);
  EXPECT_LT(amplitudes[1] + 0.2, amplitudes[2]);
}

// One massless node behind springs on a mass of three directions, integrated step by step: an independent march of the
// exact law in which the slip X_T is a state.
class NodeSimulation {
 public:
  using State = Eigen::Matrix<double, 8, 1>;  // q, q', X_T

  NodeSimulation(const reduction::ReducedModel& model, double omega, int steps)
      : omega_(omega), h_(kTwoPi / omega / steps), steps_(steps), friction_(model.contact.friction(0)) {
    mass_ = model.mass.topLeftCorner<3, 3>();
    damping_ = model.damping.topLeftCorner<3, 3>();
    spring_ = model.stiffness.diagonal().tail<3>();
    stiffness_ = model.stiffness.topLeftCorner<3, 3>();
    stiffness_.diagonal() -= spring_;
    static_ = model.static_force.head<3>();
    cosine_ = model.cosine_force.row(0).head<3>();
    sine_ = model.sine_force.row(0).head<3>();
    gap_ = model.contact.gap(0);
  }

  // Velocity Verlet-like trapezoids: implicit in the structure, the slip corrected to the limit at each new instant.
  [[nodiscard]] State period(State y) const {
    const Eigen::Matrix3d left = mass_ + h_ / 2 * damping_ + h_ * h_ / 4 * stiffness_;
    const Eigen::PartialPivLU<Eigen::Matrix3d> lu(left);
    Eigen::Vector3d q = y.head<3>(), v = y.segment<3>(3);
    Eigen::Vector2d x = y.tail<2>();
    Eigen::Vector3d a = mass_.inverse() * (load(0) - damping_ * v - stiffness_ * q - force(q, x));
    for (int n = 1; n <= steps_; ++n) {
      const Eigen::Vector3d q_free = q + h_ * v + h_ * h_ / 4 * a, v_free = v + h_ / 2 * a;
      const Eigen::Vector3d outer = load(n * h_) - damping_ * v_free - stiffness_ * q_free;
      Eigen::Vector3d next = a;
      // The contact force changes little over a step: fixed-point iterations to rounding.
      Eigen::Vector2d slip = x;
      for (int i = 0; i < 12; ++i) {
        const Eigen::Vector3d position = q_free + h_ * h_ / 4 * next;
        slip = touch(q, position, x);
        const Eigen::Vector3d contact = force(position, slip);
        const Eigen::Vector3d updated = lu.solve(outer - contact);
        const double change = (updated - next).norm();
        next = updated;
        if (change < 1e-15) break;
      }
      q = q_free + h_ * h_ / 4 * next;
      v = v_free + h_ / 2 * next;
      a = next;
      x = slip;
    }
    State end;
    end << q, v, x;
    return end;
  }

 private:
  [[nodiscard]] Eigen::Vector3d load(double t) const {
    return static_ + cosine_ * std::cos(omega_ * t) + sine_ * std::sin(omega_ * t);
  }
  [[nodiscard]] double closing(const Eigen::Vector3d& q) const { return -q(2) - gap_; }
  // A node that closes between two instants starts to stick where it was when it touched: were it where it was at the
  // last instant, the derivative of the map would not be that of the motion however small the step.
  [[nodiscard]] Eigen::Vector2d touch(const Eigen::Vector3d& before, const Eigen::Vector3d& after,
                                      const Eigen::Vector2d& x) const {
    if (!(closing(before) <= 0 && closing(after) > 0)) return x;
    const double part = closing(before) / (closing(before) - closing(after));
    return (before + part * (after - before)).head<2>();
  }
  // Force of the contact on the mass (subtracted from the loads); moves the slip to where the limit allows.
  Eigen::Vector3d force(const Eigen::Vector3d& q, Eigen::Vector2d& x) const {
    // z opens: u_N = -z up to the gap.
    const double normal = spring_(2) * closing(q);
    if (normal <= 0) {
      x = q.head<2>();
      return Eigen::Vector3d::Zero();
    }
    Eigen::Vector2d t = spring_.head<2>().cwiseProduct(q.head<2>() - x);
    const double limit = friction_ * normal;
    if (t.norm() > limit) {
      // Equal springs: the return is radial.
      t *= limit / t.norm();
      x = q.head<2>() - t.cwiseQuotient(spring_.head<2>());
    }
    return {t(0), t(1), -normal};
  }

  double omega_, h_;
  int steps_;
  double friction_, gap_ = 0;
  Eigen::Matrix3d mass_, damping_, stiffness_;
  Eigen::Vector3d spring_, static_, cosine_, sine_;
};

struct Case {
  std::string name;
  double friction, normal_amplitude, omega;
  stability::StabilityVerdict verdict;
};

class NodeInSpace : public testing::TestWithParam<Case> {};

TEST_P(NodeInSpace, HasTheMultipliersOfItsPerturbedMotion) {
  const Case c = GetParam();
  reduction::ReducedModel model = single_node();
  // Equal tangential springs keep the simulation's return simple.
  const double change = 2 - model.stiffness(4, 4);
  for (const int i : {1, 4}) model.stiffness(i, i) += change;
  model.stiffness(1, 4) -= change;
  model.stiffness(4, 1) -= change;
  model.contact.friction << c.friction;
  model.cosine_force(0, 2) *= c.normal_amplitude;
  model.sine_force(0, 2) *= c.normal_amplitude;
  const steady::State state = paths::steady_state(
      {condensed(model), {}, {.harmonics = 31, .samples = 1024, .slip_return = contact::SlipReturn::second_order}},
      c.omega);
  ASSERT_EQ(state.status, Status::converged);
  const stability::Stability found = stability::local_stability(model, state);
  EXPECT_EQ(found.verdict, c.verdict) << found.reason;

  const NodeSimulation simulation(model, c.omega, 8000);
  // The exact orbit near the series, by shooting; nodes that stay stuck leave directions in which there are many.
  NodeSimulation::State orbit = NodeSimulation::State::Zero();
  for (int h = 0; h <= 31; ++h) {
    orbit.head<3>() += state.outputs.col(h == 0 ? 0 : 2 * h - 1);
    if (h > 0) orbit.segment<3>(3) += c.omega * h * state.outputs.col(2 * h);
  }
  orbit.tail<2>() = state.slip_end.row(0);
  Eigen::MatrixXd map(8, 8);
  const double step = 1e-5;
  for (int k = 0; k < 6; ++k) {
    for (int j = 0; j < 8; ++j) {
      const NodeSimulation::State unit = NodeSimulation::State::Unit(j) * step;
      map.col(j) = (simulation.period(orbit + unit) - simulation.period(orbit - unit)) / (2 * step);
    }
    const NodeSimulation::State moved = simulation.period(orbit) - orbit;
    if (moved.norm() < 1e-7) break;
    const Eigen::MatrixXd shooting = map - Eigen::MatrixXd::Identity(8, 8);
    orbit -= numerics::least_squares(shooting, moved, 1e-14);
  }
  const Eigen::VectorXcd exact = numerics::eigenvalues(map).values;
  Eigen::VectorXcd all = Eigen::VectorXcd::Ones(found.multipliers.size() + found.neutral);
  all.head(found.multipliers.size()) = found.multipliers;
  // The simulation returns slip radially, first order in its 8000 steps; two turning touches in a period feel it most.
  EXPECT_LT(mismatch(all, exact), 3e-3);
}

INSTANTIATE_TEST_SUITE_P(Cases, NodeInSpace,
                         testing::Values(Case{"always_stuck", 1.2, 1, 0.6, stability::StabilityVerdict::stable},
                                         Case{"always_slips", 0.4, 1, 0.6, stability::StabilityVerdict::stable},
                                         Case{"sticks_and_slips", 0.4, 1, 1.1, stability::StabilityVerdict::stable},
                                         Case{"lifts_off", 0.4, 5, 1.5, stability::StabilityVerdict::stable},
                                         Case{"closes_sticking", 0.7, 5, 2.0, stability::StabilityVerdict::stable},
                                         Case{"touches_twice", 0.4, 8, 0.8, stability::StabilityVerdict::stable},
                                         Case{"loses_a_neighbour", 0.4, 5, 1.1, stability::StabilityVerdict::unstable},
                                         Case{"loses_slip", 0.7, 8, 0.6, stability::StabilityVerdict::unstable},
                                         Case{"flips", 1.2, 8, 0.6, stability::StabilityVerdict::unstable}),
                         [](const testing::TestParamInfo<Case>& instance) { return instance.param.name; });

}  // namespace
}  // namespace dovetail::verification
