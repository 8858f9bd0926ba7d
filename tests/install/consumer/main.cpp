// Uses the installed package: a section, its mesh, and the steady state of a one-node contact model.
#include <cstdio>
#include <memory>

#include "geometry/mesh/mesh_motion.hpp"
#include "paths/steady_state.hpp"
#include "reduction/reduced_model.hpp"

namespace {

/// A mass of 1 kg on a spring of 1 N/m and a massless sliding contact pressed on by 1 N.
dovetail::reduction::ReducedModel slider() {
  dovetail::reduction::ReducedModel model;
  model.stiffness = Eigen::Matrix3d{{2, -1, 0}, {-1, 1, 0}, {0, 0, 1}};  // mass, contact T, contact N
  model.mass = Eigen::Vector3d(1, 0, 0).asDiagonal();
  model.damping = Eigen::Vector3d(0.01, 0, 0).asDiagonal();
  model.contact.normal = Eigen::VectorXi::Constant(1, 2);
  model.contact.tangential = Eigen::MatrixXi::Constant(1, 1, 1);
  model.contact.area = model.contact.friction = Eigen::VectorXd::Ones(1);
  model.contact.gap = model.contact.wear_coefficient = Eigen::VectorXd::Zero(1);
  model.contact.slip_origin = Eigen::MatrixXd::Zero(1, 1);
  model.static_force = Eigen::Vector3d(0, 0, 1);
  model.cosine_force = Eigen::RowVector3d(1, 0, 0);
  model.sine_force = Eigen::RowVector3d::Zero();
  model.output_vectors = Eigen::RowVector3d(1, 0, 0);
  model.output_names = {"mass"};
  return model;
}

}  // namespace

int main() {
  const dovetail::geometry::MeshedSector mesh = dovetail::geometry::mesh_sector({});
  const auto model = std::make_shared<const dovetail::dynamics::CondensedModel>(slider());
  const dovetail::steady::State state = dovetail::paths::steady_state({model, {}, {}}, 1.2);
  std::printf("%d nodes, %s\n", mesh.sector.mesh.node_count(), std::string(to_string(state.status)).c_str());
  const bool good =
      mesh.quality.inverted_elements == 0 && state.status == dovetail::Status::converged && state.friction_energy > 0;
  return good ? 0 : 1;
}
