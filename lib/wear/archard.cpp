#include "wear/archard.hpp"

#include <limits>

namespace dovetail::wear {

double worn_volume(const reduction::ContactNodes& contact, const Eigen::VectorXd& depth) {
  return depth.size() == 0 ? 0.0 : contact.area.dot(depth);
}

reduction::ReducedModel worn_model(const reduction::ReducedModel& model, const Eigen::VectorXd& depth) {
  reduction::ReducedModel worn = model;
  if (depth.size() != 0) worn.contact.gap += depth;
  return worn;
}

double cycle_jump(const Eigen::VectorXd& rate, double increment) {
  const double largest = rate.size() == 0 ? 0.0 : rate.maxCoeff();
  return largest > 0.0 ? increment / largest : std::numeric_limits<double>::infinity();
}

}  // namespace dovetail::wear
