#include "tests/verification/steady/time_integration.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace dovetail::verification {
namespace {

// One contact node between two ends of a step: find u, lambda with A u + lambda = b and the contact law.
struct Node {
  Eigen::Vector3d u = Eigen::Vector3d::Zero(), force = Eigen::Vector3d::Zero();  // now; (N, T1, T2)
  Eigen::Vector3d u_before = Eigen::Vector3d::Zero(), force_before = Eigen::Vector3d::Zero();
  double direction = 0, direction_before = 0;  // of the friction force, radians
  bool slides = false, slid_before = false, separated = false;

  void accept() {
    u_before = u;
    force_before = force;
    direction_before = direction;
    slid_before = slides;
  }
};

void slide_along_line(const Eigen::Matrix3d& a, const Eigen::Vector3d& b, double gap, double mu, double sign,
                      Node& node) {
  node.u(0) = gap;
  // b_T - A_TN g - A_TT u = mu sign (b_N - A_NN g - A_NT u)
  node.u(1) = (b(1) - a(1, 0) * gap - mu * sign * (b(0) - a(0, 0) * gap)) / (a(1, 1) - mu * sign * a(0, 1));
  node.u(2) = 0;
}

// Newton on the length of the slip increment and the direction of the force.
bool slide_in_plane(const Eigen::Matrix3d& a, const Eigen::Vector3d& b, double gap, double mu, Node& node) {
  const Eigen::Vector3d stick(gap, node.u_before(1), node.u_before(2));
  const Eigen::Vector3d trial = b - a * stick;
  double length = 0, angle = node.slides ? node.direction : std::atan2(trial(2), trial(1));
  if (node.slides) length = (node.u - stick).tail<2>().norm();
  for (int iteration = 0; iteration < 50; ++iteration) {
    const Eigen::Vector2d along(std::cos(angle), std::sin(angle)), across(-along(1), along(0));
    Eigen::Vector2d path = along, path_slope = across;
    if (node.slid_before) {
      // The bisector turns half as fast.
      const double half =
          node.direction_before + std::remainder(angle - node.direction_before, 2 * std::numbers::pi) / 2;
      path = {std::cos(half), std::sin(half)};
      path_slope = Eigen::Vector2d(-path(1), path(0)) / 2;
    }
    const Eigen::Vector2d slip = length * path;
    const double normal = trial(0) - a.row(0).tail<2>() * slip;
    const Eigen::Vector2d rest = trial.tail<2>() - a.bottomRightCorner<2, 2>() * slip - mu * normal * along;
    Eigen::Matrix2d jacobian;
    jacobian.col(0) = -a.bottomRightCorner<2, 2>() * path + mu * along * (a.row(0).tail<2>() * path);
    const Eigen::Vector2d turned = length * path_slope;
    jacobian.col(1) =
        -a.bottomRightCorner<2, 2>() * turned + mu * along * (a.row(0).tail<2>() * turned) - mu * normal * across;
    const Eigen::Vector2d change = jacobian.partialPivLu().solve(-rest);
    length += change(0);
    angle += change(1);
    if (rest.norm() <= 1e-14 * (trial.norm() + 1e-300)) break;
    if (iteration == 49) return false;
  }
  Eigen::Vector2d path(std::cos(angle), std::sin(angle));
  if (node.slid_before) {
    const double half = node.direction_before + std::remainder(angle - node.direction_before, 2 * std::numbers::pi) / 2;
    path = {std::cos(half), std::sin(half)};
  }
  node.u = stick;
  node.u.tail<2>() += length * path;
  node.direction = angle;
  return length > 0;
}

void satisfy_law(const Eigen::Matrix3d& a, const Eigen::Vector3d& b, Eigen::Index d, double gap, double mu,
                 Node& node) {
  Eigen::Matrix3d full = a;
  if (d == 2) full(2, 2) = 1;
  const Eigen::Vector3d open = full.ldlt().solve(b);
  node.separated = open(0) <= gap;
  if (node.separated) {
    node.u = open;
    node.force.setZero();
    node.slides = false;
    return;
  }
  Eigen::Vector3d stick(gap, node.u_before(1), node.u_before(2));
  const Eigen::Vector3d trial = b - full * stick;
  if (trial(0) >= 0 && trial.tail<2>().norm() <= mu * trial(0)) {
    node.u = stick;
    node.force = trial;
    node.slides = false;
    return;
  }
  if (d == 2) {
    slide_along_line(full, b, gap, mu, std::copysign(1.0, trial(1)), node);
    node.slides = true;
  } else {
    node.slides = slide_in_plane(full, b, gap, mu, node);
    if (!node.slides && node.slid_before) {
      // The slip turned back on itself: its direction before says nothing.
      node.slid_before = false;
      node.slides = slide_in_plane(full, b, gap, mu, node);
    }
  }
  node.force = b - full * node.u;
}

}  // namespace

Periodic march_in_time(const reduction::ReducedModel& model, double omega, int steps_per_period, double tolerance,
                       int max_periods) {
  const Eigen::Index nodes = model.contact.count(), d = model.contact.directions(), nc = nodes * d;
  std::vector<Eigen::Index> c, in;
  for (Eigen::Index i = 0; i < nodes; ++i) {
    c.push_back(model.contact.normal(i));
    for (Eigen::Index r = 0; r + 1 < d; ++r) c.push_back(model.contact.tangential(i, r));
  }
  for (Eigen::Index dof = 0; dof < model.size(); ++dof)
    if (std::find(c.begin(), c.end(), dof) == c.end()) in.push_back(dof);
  const Eigen::MatrixXd mass = model.mass(in, in), damping = model.damping(in, in), stiffness = model.stiffness(in, in);
  const Eigen::MatrixXd coupling = model.stiffness(in, c), own = model.stiffness(c, c);
  const double dt = 2 * std::numbers::pi / (omega * steps_per_period);
  const Eigen::LDLT<Eigen::MatrixXd> step_matrix(mass + dt / 2 * damping + dt * dt / 4 * stiffness);
  const Eigen::MatrixXd follows = dt * dt / 4 * step_matrix.solve(coupling);  // q = predicted - follows u
  const Eigen::MatrixXd seen = own - coupling.transpose() * follows;
  const auto load = [&](int n) {
    Eigen::VectorXd f = model.static_force;
    const double tau = 2 * std::numbers::pi * n / steps_per_period;
    for (Eigen::Index h = 0; h < model.cosine_force.rows(); ++h)
      f += std::cos(static_cast<double>(h + 1) * tau) * model.cosine_force.row(h).transpose() +
           std::sin(static_cast<double>(h + 1) * tau) * model.sine_force.row(h).transpose();
    return f;
  };
  std::vector<Eigen::VectorXd> loads;
  for (int n = 0; n < steps_per_period; ++n) loads.push_back(load(n));

  Eigen::VectorXd q = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(in.size())), v = q, a = q;
  Eigen::VectorXd u = Eigen::VectorXd::Zero(nc), force = u;
  std::vector<Node> contact(static_cast<std::size_t>(nodes));
  Periodic result;
  Eigen::VectorXd before = Eigen::VectorXd::Zero(model.size());
  for (int period = 1; period <= max_periods; ++period) {
    result = Periodic{};
    Eigen::VectorXd low = Eigen::VectorXd::Constant(model.size(), 1e300), high = -low, now(model.size());
    for (int n = 1; n <= steps_per_period; ++n) {
      const Eigen::VectorXd& f = loads[static_cast<std::size_t>(n % steps_per_period)];
      const Eigen::VectorXd& f_before = loads[static_cast<std::size_t>(n - 1)];
      const Eigen::VectorXd half_q = q + dt * v + dt * dt / 4 * a, half_v = v + dt / 2 * a;
      const Eigen::VectorXd free = step_matrix.solve(f(in) - stiffness * half_q - damping * half_v);
      const Eigen::VectorXd right = f(c) - coupling.transpose() * (half_q + dt * dt / 4 * free);
      const Eigen::VectorXd u_before = u, force_before = force, q_before = q, v_before = v;
      for (int sweep = 0; sweep < 500; ++sweep) {
        const Eigen::VectorXd last = u;
        for (Eigen::Index i = 0; i < nodes; ++i) {
          Node& node = contact[static_cast<std::size_t>(i)];
          Eigen::Matrix3d block = Eigen::Matrix3d::Zero();
          block.topLeftCorner(d, d) = seen.block(i * d, i * d, d, d);
          Eigen::Vector3d b = Eigen::Vector3d::Zero();
          b.head(d) = right.segment(i * d, d) - seen.middleRows(i * d, d) * u +
                      seen.block(i * d, i * d, d, d) * u.segment(i * d, d);
          satisfy_law(block, b, d, model.contact.gap(i), model.contact.friction(i), node);
          u.segment(i * d, d) = node.u.head(d);
          force.segment(i * d, d) = node.force.head(d);
        }
        if ((u - last).norm() <= 1e-15 * u.norm()) break;
      }
      const Eigen::VectorXd a_new = free - step_matrix.solve(coupling * u);
      q = half_q + dt * dt / 4 * a_new;
      v = half_v + dt / 2 * a_new;
      a = a_new;
      for (Node& node : contact) {
        result.slips = result.slips || node.slides;
        result.separates = result.separates || node.separated;
        node.accept();
      }
      result.friction_energy += (force + force_before).dot(u - u_before) / 2;
      result.damping_energy += dt * (v + v_before).dot(damping * (v + v_before)) / 4;
      const Eigen::VectorXd mean = (f + f_before) / 2;
      result.input_energy += mean(in).dot(q - q_before) + mean(c).dot(u - u_before);
      now(in) = q;
      now(c) = u;
      low = low.cwiseMin(now);
      high = high.cwiseMax(now);
    }
    result.amplitudes = (high - low) / 2;
    result.slip_end = u.reshaped(d, nodes).bottomRows(d - 1).transpose();
    if ((now - before).norm() <= tolerance * result.amplitudes.norm()) {
      result.periods = period;
      return result;
    }
    before = now;
  }
  return result;
}

}  // namespace dovetail::verification
