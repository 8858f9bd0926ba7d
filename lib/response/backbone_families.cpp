#include "response/backbone.hpp"

namespace dovetail::response {

BackboneFamily excitation_levels(const std::shared_ptr<const CondensedModel>& model,
                                 const ContactCondition& condition) {
  return [model, condition](double level) {
    auto scaled = std::make_shared<CondensedModel>(*model);
    scaled->scale_excitation(level);
    return BackboneCase{.model = std::move(scaled), .condition = condition};
  };
}

BackboneFamily wear_levels(const std::shared_ptr<const CondensedModel>& model, const Eigen::VectorXd& growth,
                           const ContactCondition& condition) {
  if (growth.size() != model->nodes())
    throw InputError({.file = {},
                      .key = "growth",
                      .value = "size " + std::to_string(growth.size()),
                      .allowed = "must have size " + std::to_string(model->nodes())});
  return [model, growth, condition](double level) {
    BackboneCase worn{.model = model, .condition = condition};
    if (worn.condition.wear_depth.size() == 0) worn.condition.wear_depth = Eigen::VectorXd::Zero(growth.size());
    worn.condition.wear_depth += level * growth;
    return worn;
  };
}

}  // namespace dovetail::response
