#include "dynamics/contact_model_check.hpp"

#include <vector>

#include "core/errors.hpp"
#include "core/options.hpp"
#include "reduction/validation.hpp"

namespace dovetail::dynamics {
namespace {

class Findings {
 public:
  void size(const char* key, Eigen::Index found, Eigen::Index wanted) {
    if (found != wanted) add(key, std::to_string(found), "must have size " + std::to_string(wanted));
  }
  void matrix(const char* key, const Eigen::MatrixXd& m, Eigen::Index rows, Eigen::Index cols) {
    if (m.rows() != rows || m.cols() != cols)
      add(key, std::to_string(m.rows()) + " x " + std::to_string(m.cols()),
          "must be " + std::to_string(rows) + " x " + std::to_string(cols));
    else if (!m.allFinite())
      add(key, "nan or inf", "must be finite numbers");
  }
  void at_least(const char* key, const Eigen::VectorXd& v, double lower, bool open, Eigen::Index count) {
    size(key, v.size(), count);
    for (Eigen::Index i = 0; i < v.size(); ++i)
      if (!(open ? v(i) > lower : v(i) >= lower)) {
        add(key, shortest(v(i)), open ? "must be > 0" : "must be >= 0");
        return;
      }
  }
  void add(const std::string& key, const std::string& value, const std::string& allowed) {
    found_.push_back({.file = {}, .key = key, .value = value, .allowed = allowed});
  }
  void raise() {
    if (!found_.empty()) throw InputError(std::move(found_));
  }

 private:
  std::vector<Violation> found_;
};

}  // namespace

void check(const reduction::ReducedModel& model) {
  Findings findings;
  const Eigen::Index n = model.size(), nodes = model.contact.count();
  findings.matrix("stiffness", model.stiffness, n, n);
  findings.matrix("mass", model.mass, n, n);
  findings.matrix("damping", model.damping, n, n);
  findings.matrix("force.static", model.static_force, n, 1);
  if (model.cosine_force.rows() > 0) findings.matrix("force.cosine", model.cosine_force, model.cosine_force.rows(), n);
  if (model.sine_force.rows() > 0) findings.matrix("force.sine", model.sine_force, model.sine_force.rows(), n);
  if (model.output_vectors.rows() > 0)
    findings.matrix("output.vectors", model.output_vectors, model.output_vectors.rows(), n);
  const reduction::ContactNodes& contact = model.contact;
  findings.at_least("contact.area", contact.area, 0, true, nodes);
  findings.at_least("contact.friction", contact.friction, 0, false, nodes);
  findings.at_least("contact.wear_coefficient", contact.wear_coefficient, 0, false, nodes);
  if (contact.wear_threshold.size() > 0)
    findings.at_least("contact.wear_threshold", contact.wear_threshold, 0, false, nodes);
  for (const Violation& of_wear : reduction::wear_law_violations(contact, "contact."))
    findings.add(of_wear.key, of_wear.value, of_wear.allowed);
  findings.matrix("contact.gap", contact.gap, nodes, 1);
  findings.size("contact.tangential", contact.tangential.rows(), nodes);
  if (contact.tangential.cols() < 1 || contact.tangential.cols() > 2)
    findings.add("contact.tangential", std::to_string(contact.tangential.cols()) + " columns", "must have 1 or 2");
  if (contact.slip_origin.size() > 0)
    findings.matrix("contact.slip_origin", contact.slip_origin, nodes, contact.tangential.cols());
  std::vector<char> used(static_cast<std::size_t>(n), 0);
  const auto claim = [&](const char* key, int dof) {
    if (dof < 0 || dof >= n)
      findings.add(key, std::to_string(dof), "must be >= 0 and < " + std::to_string(n));
    else if (used[static_cast<std::size_t>(dof)]++ != 0)
      findings.add(key, std::to_string(dof), "must not name a dof twice");
  };
  for (int dof : contact.normal.reshaped()) claim("contact.normal", dof);
  for (int dof : contact.tangential.reshaped()) claim("contact.tangential", dof);
  findings.raise();
}

}  // namespace dovetail::dynamics
