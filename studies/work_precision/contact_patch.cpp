#include "studies/work_precision/contact_patch.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace dovetail::work_precision {
namespace {

struct Grid {
  Eigen::Index side = 1;
  explicit Grid(Eigen::Index nodes)
      : side(static_cast<Eigen::Index>(std::ceil(std::sqrt(static_cast<double>(nodes))))) {}
  // Position within the unit square.
  [[nodiscard]] Eigen::Vector2d at(Eigen::Index node) const {
    const Eigen::Index row = node / side, column = node % side;
    return Eigen::Vector2d(static_cast<double>(column) + 0.5, static_cast<double>(row) + 0.5) /
           static_cast<double>(side);
  }
};

// Inverse of the residual flexibility. The inverse multiquadric is positive definite and falls like 1 / distance.
Eigen::MatrixXd contact_stiffness(const Grid& grid, Eigen::Index nodes, Eigen::Index d) {
  const double radius = 0.6 / static_cast<double>(grid.side);
  Eigen::MatrixXd kernel(nodes, nodes);
  for (Eigen::Index i = 0; i < nodes; ++i)
    for (Eigen::Index j = 0; j < nodes; ++j)
      kernel(i, j) = 0.02 / std::sqrt((grid.at(i) - grid.at(j)).squaredNorm() + radius * radius);
  const Eigen::MatrixXd inverse = kernel.llt().solve(Eigen::MatrixXd::Identity(nodes, nodes));
  // Tangentially a half-space yields a little more; Poisson's coupling of the directions is left out.
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(nodes * d, nodes * d);
  for (Eigen::Index i = 0; i < nodes; ++i)
    for (Eigen::Index j = 0; j < nodes; ++j)
      for (Eigen::Index r = 0; r < d; ++r)
        stiffness(i * d + r, j * d + r) = (r == 0 ? 1.0 : 0.8) * (inverse(i, j) + inverse(j, i)) / 2;
  return stiffness;
}

// The first d modes move the patch as a rigid body, the others in waves of growing number; unit modal mass.
Eigen::MatrixXd mode_shapes(const Grid& grid, Eigen::Index nodes, Eigen::Index d, Eigen::Index modes) {
  Eigen::MatrixXd shapes = Eigen::MatrixXd::Zero(nodes * d, modes);
  for (Eigen::Index m = 0; m < modes; ++m)
    for (Eigen::Index i = 0; i < nodes; ++i)
      for (Eigen::Index r = 0; r < d; ++r) {
        const double number = static_cast<double>(m), direction = static_cast<double>(r);
        const Eigen::Vector2d x = grid.at(i);
        const double wave = m < d ? (m == (r + 1) % d ? 1.0 : 0.15)
                                  : std::cos(number * (1.1 * x(0) + 0.7 * x(1)) + 1.7 * direction + 0.3 * number);
        shapes(i * d + r, m) = 0.35 * wave / (1 + 0.1 * number);
      }
  return shapes;
}

// Nodes from the middle of the patch outwards.
std::vector<Eigen::Index> from_the_middle(const Grid& grid, Eigen::Index nodes) {
  std::vector<Eigen::Index> order(static_cast<std::size_t>(nodes));
  std::iota(order.begin(), order.end(), Eigen::Index{0});
  const Eigen::Vector2d middle(0.5, 0.5);
  std::stable_sort(order.begin(), order.end(), [&](Eigen::Index a, Eigen::Index b) {
    return (grid.at(a) - middle).squaredNorm() < (grid.at(b) - middle).squaredNorm();
  });
  return order;
}

}  // namespace

reduction::ReducedModel contact_patch(const PatchOptions& options) {
  const Eigen::Index nodes = options.nodes, d = 1 + options.tangential, nc = nodes * d, modes = options.modes;
  const Eigen::Index n = nc + modes;
  const Grid grid(nodes);
  const Eigen::MatrixXd contact = contact_stiffness(grid, nodes, d);
  const Eigen::MatrixXd shapes = mode_shapes(grid, nodes, d, modes);

  reduction::ReducedModel model;
  model.stiffness = Eigen::MatrixXd::Zero(n, n);
  model.stiffness.topLeftCorner(nc, nc) = contact;
  model.stiffness.topRightCorner(nc, modes) = -contact * shapes;
  model.stiffness.bottomLeftCorner(modes, nc) = model.stiffness.topRightCorner(nc, modes).transpose();
  model.stiffness.bottomRightCorner(modes, modes) = shapes.transpose() * contact * shapes;
  model.mass = model.damping = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index m = 0; m < modes; ++m) {
    const double frequency = 1 + 0.4 * static_cast<double>(m);
    model.stiffness(nc + m, nc + m) += frequency * frequency;
    model.mass(nc + m, nc + m) = 1;
    model.damping(nc + m, nc + m) = 0.02 * frequency;
  }

  model.contact.normal.resize(nodes);
  model.contact.tangential.resize(nodes, options.tangential);
  for (Eigen::Index i = 0; i < nodes; ++i) {
    model.contact.normal(i) = static_cast<int>(i * d);
    for (Eigen::Index r = 1; r < d; ++r) model.contact.tangential(i, r - 1) = static_cast<int>(i * d + r);
  }
  model.contact.area = Eigen::VectorXd::Constant(nodes, 1 / static_cast<double>(nodes));
  model.contact.gap = Eigen::VectorXd::Zero(nodes);
  model.contact.friction = Eigen::VectorXd::Constant(nodes, options.friction);
  model.contact.wear_coefficient = Eigen::VectorXd::Constant(nodes, 1e-3);
  model.contact.slip_origin = Eigen::MatrixXd::Zero(nodes, options.tangential);

  // Closed contact carries the static force node by node: pressures are what is asked for here.
  model.static_force = Eigen::VectorXd::Zero(n);
  const std::vector<Eigen::Index> order = from_the_middle(grid, nodes);
  const auto held = static_cast<std::size_t>(std::lround(options.held * static_cast<double>(nodes)));
  for (std::size_t p = 0; p < order.size(); ++p) {
    const double variation = 1 + 0.8 * std::sin(2.3 * static_cast<double>(order[p]));
    model.static_force(model.contact.normal(order[p])) = (p < held ? 60 : 0.6 * variation) / static_cast<double>(nodes);
  }
  model.cosine_force = model.sine_force = Eigen::MatrixXd::Zero(1, n);
  for (Eigen::Index m = 0; m < modes; ++m) {
    const double number = static_cast<double>(m);
    model.cosine_force(0, nc + m) = options.load * std::cos(1.3 * number) / (1 + number);
    model.sine_force(0, nc + m) = options.load * std::sin(2.1 * number) / (1 + number);
  }
  model.output_vectors = Eigen::MatrixXd::Zero(1, n);
  model.output_vectors(0, nc) = 1;
  model.output_names = {"first_mode"};
  return model;
}

}  // namespace dovetail::work_precision
