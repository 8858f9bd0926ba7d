#include <Eigen/Cholesky>
#include <cmath>
#include <numbers>

#include "empty_model.hpp"
#include "scenes.hpp"

namespace dovetail::wear::scenes {

using Eigen::Index;

reduction::ReducedModel empty_model(Eigen::Index size, Eigen::Index nodes, Eigen::Index harmonics,
                                    Eigen::Index tangential) {
  reduction::ReducedModel model;
  model.mass = model.damping = model.stiffness = Eigen::MatrixXd::Zero(size, size);
  model.static_force = Eigen::VectorXd::Zero(size);
  model.cosine_force = model.sine_force = Eigen::MatrixXd::Zero(harmonics, size);
  model.output_vectors = Eigen::MatrixXd::Zero(1, size);
  model.output_names = {"slide"};
  reduction::ContactNodes& contact = model.contact;
  contact.normal.resize(nodes);
  contact.tangential.resize(nodes, tangential);
  for (int i = 0; i < nodes; ++i) {
    const int first = static_cast<int>(tangential + 1) * i;
    contact.normal[i] = first;
    for (int r = 0; r < tangential; ++r) contact.tangential(i, r) = first + 1 + r;
  }
  contact.area = Eigen::VectorXd::Ones(nodes);
  contact.gap = Eigen::VectorXd::Zero(nodes);
  contact.friction = Eigen::VectorXd::Zero(nodes);
  contact.wear_coefficient = Eigen::VectorXd::Zero(nodes);
  contact.position = Eigen::MatrixX3d::Zero(nodes, 3);
  contact.group = Eigen::VectorXi::Zero(nodes);
  contact.slip_origin = Eigen::MatrixXd::Zero(nodes, tangential);
  return model;
}

reduction::ReducedModel space_punch(const SpacePunch& data) {
  constexpr double kTangential = 1.2;
  const Index side = data.side, nodes = side * side;
  const double step = 2.0 * data.half_length / static_cast<double>(side - 1);
  const auto place = [&](Index i) {
    return Eigen::Vector2d(step * static_cast<double>(i % side) - data.half_length,
                           step * static_cast<double>(i / side) - data.half_length);
  };
  Eigen::MatrixXd flexibility(nodes, nodes);
  for (Index i = 0; i < nodes; ++i)
    for (Index j = 0; j < nodes; ++j)
      flexibility(i, j) =
          (i == j ? 4.0 * std::log(1.0 + std::numbers::sqrt2) / step : 1.0 / (place(i) - place(j)).norm()) /
          (std::numbers::pi * data.modulus);
  const Eigen::MatrixXd stiffness = flexibility.llt().solve(Eigen::MatrixXd::Identity(nodes, nodes));
  const Eigen::VectorXd row_sums = stiffness.rowwise().sum();

  reduction::ReducedModel model = empty_model(3 * nodes + 3, nodes, 1, 2);
  for (Index direction = 0; direction < 3; ++direction) {
    const double factor = direction == 0 ? 1.0 : 1.0 / kTangential;
    const Index rigid = 3 * nodes + direction;
    for (Index i = 0; i < nodes; ++i) {
      for (Index j = 0; j < nodes; ++j)
        model.stiffness(3 * i + direction, 3 * j + direction) = factor * 0.5 * (stiffness(i, j) + stiffness(j, i));
      model.stiffness(3 * i + direction, rigid) = model.stiffness(rigid, 3 * i + direction) = -factor * row_sums[i];
    }
    model.stiffness(rigid, rigid) = factor * row_sums.sum() + (direction > 0 ? data.tangential_spring : 0.0);
  }
  model.static_force[3 * nodes] = data.normal_load;
  model.sine_force(0, 3 * nodes) = data.breathing_load;
  model.cosine_force(0, 3 * nodes + 1) = data.first_load;
  model.sine_force(0, 3 * nodes + 2) = data.second_load;
  model.output_vectors(0, 3 * nodes + 1) = 1.0;
  for (Index i = 0; i < nodes; ++i) {
    model.contact.position.row(i).head(2) = place(i).transpose();
    model.contact.gap[i] = (place(i) - Eigen::Vector2d(data.offset, 0.0)).squaredNorm() / (2.0 * data.radius);
  }
  model.contact.area.setConstant(step * step);
  model.contact.friction.setConstant(data.friction);
  model.contact.wear_coefficient.setConstant(data.wear_coefficient);
  return model;
}

}  // namespace dovetail::wear::scenes
