#include "scenes.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "empty_model.hpp"

namespace dovetail::wear::scenes {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

reduction::ReducedModel den_hartog(double friction, double normal_load, double normal_stiffness,
                                   double wear_coefficient) {
  reduction::ReducedModel model = empty_model(2, 1, 1);
  model.stiffness.diagonal() << normal_stiffness, 1.0;
  model.mass(1, 1) = 1.0;
  model.static_force[0] = normal_load;
  model.cosine_force(0, 1) = 1.0;
  model.output_vectors(0, 1) = 1.0;
  model.contact.friction[0] = friction;
  model.contact.wear_coefficient[0] = wear_coefficient;
  return model;
}

reduction::ReducedModel rubbing_oscillator(double normal_load, double normal_stiffness, double tangential_stiffness,
                                           double damping) {
  reduction::ReducedModel model = empty_model(3, 1, 1);
  model.stiffness(0, 0) = normal_stiffness;
  model.stiffness.bottomRightCorner(2, 2) << tangential_stiffness, -tangential_stiffness, -tangential_stiffness,
      1.0 + tangential_stiffness;
  model.mass(2, 2) = 1.0;
  model.damping(2, 2) = damping;
  model.static_force[0] = normal_load;
  model.cosine_force(0, 2) = 0.1;
  model.output_vectors(0, 2) = 1.0;
  model.contact.friction[0] = 0.5;
  model.contact.wear_coefficient[0] = 1e-3;
  return model;
}

reduction::ReducedModel punch(const Punch& data) {
  const Index nodes = data.nodes;
  const double step = 2.0 * data.half_length / static_cast<double>(nodes - 1);
  const double reference = 20.0 * data.half_length;  // depth of the elastic support: fixes the rigid approach
  const auto twice_integrated = [reference](double t) {
    const double size = std::abs(t);
    return size == 0.0 ? 0.0 : 0.5 * t * t * std::log(size / reference) - 0.75 * t * t;
  };
  MatrixXd flexibility(nodes, nodes);
  for (Index i = 0; i < nodes; ++i)
    for (Index j = 0; j < nodes; ++j) {
      const double t = step * static_cast<double>(i - j);
      flexibility(i, j) = -2.0 / (std::numbers::pi * data.modulus) *
                          (twice_integrated(t + step) - 2.0 * twice_integrated(t) + twice_integrated(t - step)) /
                          (step * step);
    }
  const MatrixXd stiffness = flexibility.llt().solve(MatrixXd::Identity(nodes, nodes));
  const VectorXd row_sums = stiffness.rowwise().sum();

  reduction::ReducedModel model = empty_model(2 * nodes + 2, nodes, 1);
  for (Index direction = 0; direction < 2; ++direction) {
    const Index rigid = 2 * nodes + direction;
    for (Index i = 0; i < nodes; ++i) {
      for (Index j = 0; j < nodes; ++j)
        model.stiffness(2 * i + direction, 2 * j + direction) = 0.5 * (stiffness(i, j) + stiffness(j, i));
      model.stiffness(2 * i + direction, rigid) = model.stiffness(rigid, 2 * i + direction) = -row_sums[i];
    }
    model.stiffness(rigid, rigid) = row_sums.sum();
  }
  model.static_force[2 * nodes] = data.normal_load;
  model.cosine_force(0, 2 * nodes + 1) = data.tangential_load;
  model.output_vectors(0, 2 * nodes + 1) = 1.0;
  for (Index i = 0; i < nodes; ++i) {
    const double x = -data.half_length + step * static_cast<double>(i);
    model.contact.position(i, 0) = x;
    model.contact.gap[i] = (x - data.offset) * (x - data.offset) / (2.0 * data.radius) + data.tilt * x;
  }
  model.contact.area.setConstant(step);
  model.contact.friction.setConstant(data.friction);
  model.contact.wear_coefficient.setConstant(data.wear_coefficient);
  return model;
}

reduction::ReducedModel block(const Block& data) {
  constexpr double kPoisson = 0.3;
  const int columns = data.columns;
  const int rows = data.rows;
  const double width = data.length / columns;
  const double height = data.height / rows;
  Eigen::Matrix3d law;
  law << 1.0 - kPoisson, kPoisson, 0.0, kPoisson, 1.0 - kPoisson, 0.0, 0.0, 0.0, 0.5 - kPoisson;
  law /= (1.0 + kPoisson) * (1.0 - 2.0 * kPoisson);

  Eigen::Matrix<double, 8, 8> element = Eigen::Matrix<double, 8, 8>::Zero();
  const double point = 1.0 / std::sqrt(3.0);
  for (double xi : {-point, point})
    for (double eta : {-point, point}) {
      Eigen::Matrix<double, 3, 8> strain = Eigen::Matrix<double, 3, 8>::Zero();
      const std::array<std::array<double, 2>, 4> corners{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};
      for (int a = 0; a < 4; ++a) {
        const std::array<double, 2>& corner = corners[static_cast<std::size_t>(a)];
        const double dx = 0.25 * corner[0] * (1.0 + corner[1] * eta) * 2.0 / width;
        const double dy = 0.25 * corner[1] * (1.0 + corner[0] * xi) * 2.0 / height;
        strain(0, 2 * a) = dx;
        strain(1, 2 * a + 1) = dy;
        strain(2, 2 * a) = dy;
        strain(2, 2 * a + 1) = dx;
      }
      element += strain.transpose() * law * strain * (0.25 * width * height);
    }

  const int nodes = columns + 1;
  const Index size = 2 * static_cast<Index>(nodes) * (rows + 1);
  MatrixXd stiffness = MatrixXd::Zero(size, size);
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const int first = row * nodes + column;
      const std::array<int, 4> corner{first, first + 1, first + 1 + nodes, first + nodes};
      for (std::size_t a = 0; a < 4; ++a)
        for (std::size_t b = 0; b < 4; ++b)
          stiffness.block<2, 2>(2 * corner[a], 2 * corner[b]) +=
              element.block<2, 2>(2 * static_cast<Index>(a), 2 * static_cast<Index>(b));
    }

  // Consistent loads on the top face: uniform shear, linear pressure with the eccentricity asked for.
  MatrixXd loads = MatrixXd::Zero(size, 3);  // static, cosine, sine
  for (int i = 0; i < nodes; ++i) {
    const Index dof = 2 * (static_cast<Index>(rows) * nodes + i);
    const double share = (i == 0 || i == columns ? 0.5 : 1.0) / columns;
    const double s = 2.0 * i / columns - 1.0;
    loads(dof + 1, 0) = -data.normal_load * share * (1.0 + 6.0 * data.eccentricity * s);
    loads(dof, 1) = data.tangential_load * share;
    loads(dof + 1, 1) = 3.0 * s * data.couple * data.tangential_load * data.height / (0.5 * data.length) * share;
    loads(dof + 1, 2) = -data.breathing_load * share;
  }

  const Index kept = 2 * static_cast<Index>(nodes);
  const Index inner = size - kept;
  const MatrixXd coupling = stiffness.topRightCorner(kept, inner);
  const Eigen::LLT<MatrixXd> factor(stiffness.bottomRightCorner(inner, inner));
  MatrixXd condensed = stiffness.topLeftCorner(kept, kept) - coupling * factor.solve(coupling.transpose());
  condensed = (0.5 * (condensed + condensed.transpose())).eval();
  MatrixXd forces = loads.topRows(kept) - coupling * factor.solve(loads.bottomRows(inner));

  // Closing is downwards: u_N = -u_y.
  reduction::ReducedModel model = empty_model(kept, nodes, 1);
  VectorXd sign(kept);
  std::vector<Index> source(static_cast<std::size_t>(kept));
  for (Index i = 0; i < nodes; ++i) {
    source[static_cast<std::size_t>(2 * i)] = 2 * i + 1;
    source[static_cast<std::size_t>(2 * i + 1)] = 2 * i;
    sign[2 * i] = -1.0;
    sign[2 * i + 1] = 1.0;
  }
  for (Index i = 0; i < kept; ++i) {
    const Index from = source[static_cast<std::size_t>(i)];
    for (Index j = 0; j < kept; ++j)
      model.stiffness(i, j) = sign[i] * sign[j] * condensed(from, source[static_cast<std::size_t>(j)]);
    model.static_force[i] = sign[i] * forces(from, 0);
    model.cosine_force(0, i) = sign[i] * forces(from, 1);
    model.sine_force(0, i) = sign[i] * forces(from, 2);
  }
  for (int i = 0; i < nodes; ++i) {
    const double s = 2.0 * i / columns - 1.0;
    model.contact.position(i, 0) = i * width;
    model.contact.area[i] = (i == 0 || i == columns ? 0.5 : 1.0) * width;
    model.contact.gap[i] = data.crown * s * s + data.tilt * (s + 1.0) - data.interference;
    model.output_vectors(0, 2 * i + 1) = 1.0 / nodes;
  }
  for (Index i = 0; i < kept; ++i)
    for (Index j = 0; j < kept; ++j)
      if ((i + j) % 2 != 0) model.stiffness(i, j) *= data.coupling;
  for (Index i = 0; i < kept; i += 2) {
    model.stiffness(i, i) += data.normal_spring / nodes;
    model.stiffness(i + 1, i + 1) += data.tangential_spring / nodes;
  }
  model.contact.friction.setConstant(data.friction);
  model.contact.wear_coefficient.setConstant(data.wear_coefficient);
  return model;
}

Block random_block(unsigned number) {
  std::mt19937 generator(20090u + number);
  const auto between = [&generator](double low, double high) {
    // std::uniform_real_distribution is not the same everywhere; this is.
    return low + (high - low) * static_cast<double>(generator()) / 4294967296.0;
  };
  Block data;
  data.length = 1.0;
  data.height = between(0.5, 0.65);
  data.friction = between(0.3, 0.7);
  data.normal_load = 1e-3;
  data.eccentricity = between(-0.02, 0.02);
  data.tangential_load = between(0.4, 0.58) * data.friction * data.normal_load;
  data.crown = between(1.8, 2.6) * 1e-3 * data.height;
  data.coupling = 0.0;
  return data;
}

}  // namespace dovetail::wear::scenes
