#include "paths/backbone.hpp"

namespace dovetail::paths {

BackboneFamily excitation_levels(const steady::Joint& joint) {
  return [joint](double level) {
    auto scaled = std::make_shared<dynamics::CondensedModel>(*joint.model);
    scaled->scale_excitation(level);
    steady::Joint member = joint;
    member.model = std::move(scaled);
    return member;
  };
}

BackboneFamily wear_levels(const steady::Joint& joint, const Eigen::VectorXd& growth) {
  if (growth.size() != joint.model->nodes())
    throw InputError({.file = {},
                      .key = "growth",
                      .value = "size " + std::to_string(growth.size()),
                      .allowed = "must have size " + std::to_string(joint.model->nodes())});
  return [joint, growth](double level) {
    const Eigen::VectorXd grown = level * growth;
    const Eigen::VectorXd& start = joint.condition.wear_depth;
    return joint.worn(start.size() == 0 ? grown : Eigen::VectorXd(start + grown));
  };
}

}  // namespace dovetail::paths
