#include "reduction/rough_interface.hpp"

#include <utility>
#include <vector>

namespace dovetail::reduction {

Eigen::VectorXd spring_flexibility(const InterfaceStiffness& stiffness, const Eigen::VectorXd& area,
                                   Eigen::Index directions) {
  Eigen::VectorXd flexibility = Eigen::VectorXd::Zero(area.size() * directions);
  for (Eigen::Index i = 0; i < area.size(); ++i)
    for (Eigen::Index d = 0; d < directions; ++d)
      if (const double per_area = d == 0 ? stiffness.normal : stiffness.tangential; per_area > 0)
        flexibility(directions * i + d) = 1 / (per_area * area(i));
  return flexibility;
}

void add_interface(const InterfaceStiffness& stiffness, ReducedModel& model, Recovery* recovery) {
  if (stiffness.rigid()) return;
  const Eigen::Index old = model.size();
  struct Spring {
    int dof = 0;
    double stiffness = 0;
  };
  std::vector<Spring> springs;
  const auto place = [&](int& dof, double per_area, double area) {
    if (per_area == 0) return;
    springs.push_back({.dof = dof, .stiffness = per_area * area});
    dof = static_cast<int>(old + static_cast<Eigen::Index>(springs.size()) - 1);
  };
  ContactNodes& contact = model.contact;
  for (Eigen::Index i = 0; i < contact.count(); ++i) {
    place(contact.normal(i), stiffness.normal, contact.area(i));
    for (int& dof : contact.tangential.row(i)) place(dof, stiffness.tangential, contact.area(i));
  }
  const Eigen::Index n = old + static_cast<Eigen::Index>(springs.size());
  for (Eigen::MatrixXd* matrix : {&model.mass, &model.damping, &model.stiffness}) {
    Eigen::MatrixXd larger = Eigen::MatrixXd::Zero(n, n);
    larger.topLeftCorner(old, old) = *matrix;
    *matrix = std::move(larger);
  }
  for (std::size_t s = 0; s < springs.size(); ++s) {
    const Eigen::Index a = springs[s].dof, b = old + static_cast<Eigen::Index>(s);
    model.stiffness(a, a) += springs[s].stiffness;
    model.stiffness(b, b) += springs[s].stiffness;
    model.stiffness(a, b) = model.stiffness(b, a) = -springs[s].stiffness;
  }
  model.static_force.conservativeResizeLike(Eigen::VectorXd::Zero(n));
  for (Eigen::MatrixXd* rows : {&model.cosine_force, &model.sine_force, &model.output_vectors})
    rows->conservativeResizeLike(Eigen::MatrixXd::Zero(rows->rows(), n));
  if (recovery != nullptr && recovery->linear)
    recovery->linear = [inner = recovery->linear, old](const Recovery::Columns& q, const Recovery::Columns& lambda) {
      return inner(q.topRows(old), lambda);
    };
}

}  // namespace dovetail::reduction
