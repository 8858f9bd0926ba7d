#include "reduction/validation.hpp"

#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "core/options.hpp"
#include "reduction/params.hpp"

namespace dovetail::reduction {

namespace {

std::string shape(Eigen::Index rows, Eigen::Index columns) {
  return "[" + std::to_string(rows) + "," + std::to_string(columns) + "]";
}
std::string at(Eigen::Index row) {
  return "[" + std::to_string(row) + "]";
}
std::string at(Eigen::Index row, Eigen::Index column) {
  return shape(row, column);
}

class Checks {
 public:
  void add(std::string key, std::string value, std::string allowed) {
    found.push_back({.file = {}, .key = std::move(key), .value = std::move(value), .allowed = std::move(allowed)});
  }

  // `meaning` spells the shape in symbols, e.g. "[n,n]".
  bool sized(const std::string& key, Eigen::Index rows, Eigen::Index columns, Eigen::Index wanted_rows,
             Eigen::Index wanted_columns, const std::string& meaning) {
    if (rows == wanted_rows && columns == wanted_columns) return true;
    add(key, "shape " + shape(rows, columns), "must have shape " + shape(wanted_rows, wanted_columns) + " " + meaning);
    return false;
  }
  bool sized(const std::string& key, Eigen::Index size, Eigen::Index wanted, const std::string& meaning) {
    if (size == wanted) return true;
    add(key, "shape " + at(size), "must have shape " + at(wanted) + " " + meaning);
    return false;
  }

  template <class Matrix>
  bool finite(const std::string& key, const Matrix& matrix) {
    for (Eigen::Index column = 0; column < matrix.cols(); ++column)
      for (Eigen::Index row = 0; row < matrix.rows(); ++row)
        if (!std::isfinite(matrix(row, column))) {
          const bool vector = Matrix::ColsAtCompileTime == 1;
          add(key + (vector ? at(row) : at(row, column)), shortest(matrix(row, column)), "must be a finite number");
          return false;
        }
    return true;
  }

  void symmetric(const std::string& key, const Eigen::MatrixXd& matrix) {
    if (matrix.size() == 0) return;
    Eigen::Index row = 0, column = 0;
    const double difference = (matrix - matrix.transpose()).cwiseAbs().maxCoeff(&row, &column);
    if (difference <= ModelFileParams{}.asymmetry * matrix.cwiseAbs().maxCoeff()) return;
    add(key + at(row, column), shortest(matrix(row, column)),
        "must be symmetric, but the entry " + at(column, row) + " is " + shortest(matrix(column, row)));
  }

  void each_inside(const std::string& key, const Eigen::VectorXd& values, const Range& range) {
    for (Eigen::Index row = 0; row < values.size(); ++row)
      if (!range.contains(values(row))) {
        add(key + at(row), shortest(values(row)), std::isfinite(values(row)) ? range.phrase() : kAnyNumber.phrase());
        return;
      }
  }

  std::vector<Violation> found;
};

void check_contact(const ContactNodes& contact, Eigen::Index n, Checks& checks) {
  const Eigen::Index nodes = contact.count();
  const Eigen::Index tangents = contact.tangential.cols();
  if (tangents != 1 && tangents != 2) {
    checks.add("/contact/tangential", "shape " + shape(contact.tangential.rows(), tangents),
               "must have 1 column (plane) or 2 columns (space)");
  } else if (checks.sized("/contact/tangential", contact.tangential.rows(), tangents, nodes, tangents, "[Nc,d-1]")) {
    std::map<int, std::string> used;
    const auto claim = [&](const std::string& key, int index) {
      if (index < 0 || index >= n) {
        checks.add(key, std::to_string(index), "must be an index from 0 to " + std::to_string(n - 1));
      } else if (const auto [place, fresh] = used.emplace(index, key); !fresh) {
        checks.add(key, std::to_string(index), "must be a dof of its own, but " + place->second + " is the same one");
      }
    };
    for (Eigen::Index node = 0; node < nodes; ++node) claim("/contact/normal" + at(node), contact.normal(node));
    for (Eigen::Index node = 0; node < nodes; ++node)
      for (Eigen::Index t = 0; t < tangents; ++t)
        claim("/contact/tangential" + at(node, t), contact.tangential(node, t));
  }
  if (checks.sized("/contact/area", contact.area.size(), nodes, "[Nc]"))
    checks.each_inside("/contact/area", contact.area, kPositive);
  if (checks.sized("/contact/gap", contact.gap.size(), nodes, "[Nc]")) checks.finite("/contact/gap", contact.gap);
  if (checks.sized("/contact/friction", contact.friction.size(), nodes, "[Nc]"))
    checks.each_inside("/contact/friction", contact.friction, kNonNegative);
  if (checks.sized("/contact/wear_coefficient", contact.wear_coefficient.size(), nodes, "[Nc]"))
    checks.each_inside("/contact/wear_coefficient", contact.wear_coefficient, kNonNegative);
  if (contact.wear_threshold.size() > 0 &&
      checks.sized("/contact/wear_threshold", contact.wear_threshold.size(), nodes, "[Nc]"))
    checks.each_inside("/contact/wear_threshold", contact.wear_threshold, kNonNegative);
  for (Violation& of_wear : wear_law_violations(contact, "/contact/")) checks.found.push_back(std::move(of_wear));
  if (contact.position.rows() > 0 && checks.sized("/contact/position", contact.position.rows(), 3, nodes, 3, "[Nc,3]"))
    checks.finite("/contact/position", contact.position);
  if (contact.group.size() > 0) checks.sized("/contact/group", contact.group.size(), nodes, "[Nc]");
  if (contact.slip_origin.size() > 0 && checks.sized("/contact/slip_origin", contact.slip_origin.rows(),
                                                     contact.slip_origin.cols(), nodes, tangents, "[Nc,d-1]"))
    checks.finite("/contact/slip_origin", contact.slip_origin);
}

void check_names(const std::vector<std::string>& names, Eigen::Index outputs, Checks& checks) {
  if (!checks.sized("/output/names", static_cast<Eigen::Index>(names.size()), outputs, "[n_out]")) return;
  std::set<std::string> seen;
  for (std::size_t k = 0; k < names.size(); ++k) {
    const std::string key = "/output/names" + at(static_cast<Eigen::Index>(k));
    if (names[k].empty()) checks.add(key, "\"\"", "must not be empty");
    if (!seen.insert(names[k]).second) checks.add(key, names[k], "must be a name no other output has");
  }
}

/// "energy" or "another": the laws with a threshold.
std::string laws_with_threshold() {
  std::string text;
  for (const contact::WearLaw* law : contact::wear_laws())
    if (law->parameter(&contact::WearNumbers::threshold))
      text += (text.empty() ? "\"" : " or \"") + std::string(law->name) + "\"";
  return text;
}

}  // namespace

std::vector<Violation> wear_law_violations(const ContactNodes& contact, const std::string& section) {
  const contact::WearLaw* law = contact::find_wear_law(contact.wear_law);
  if (law == nullptr) {
    std::vector<std::string_view> names;
    for (const contact::WearLaw* known : contact::wear_laws()) names.push_back(known->name);
    return {{.file = {}, .key = section + "wear_law", .value = contact.wear_law, .allowed = one_of(names)}};
  }
  if (contact.wear_threshold.size() == 0 || law->parameter(&contact::WearNumbers::threshold)) return {};
  return {{.file = {},
           .key = section + "wear_threshold",
           .value = {},
           .allowed = "has no meaning unless wear_law = " + laws_with_threshold()}};
}

std::vector<Violation> violations(const ReducedModel& model) {
  Checks checks;
  const Eigen::Index n = model.stiffness.rows();
  if (n == 0) checks.add("/stiffness", "shape " + shape(n, model.stiffness.cols()), "must hold at least one dof");
  const auto square = [&](const std::string& key, const Eigen::MatrixXd& matrix) {
    if (checks.sized(key, matrix.rows(), matrix.cols(), n, n, "[n,n]") && checks.finite(key, matrix)) {
      checks.symmetric(key, matrix);
      return true;
    }
    return false;
  };
  square("/stiffness", model.stiffness);
  square("/damping", model.damping);
  if (square("/mass", model.mass)) checks.each_inside("/mass diagonal ", model.mass.diagonal(), kNonNegative);
  check_contact(model.contact, n, checks);
  if (checks.sized("/force/static", model.static_force.size(), n, "[n]"))
    checks.finite("/force/static", model.static_force);
  const auto lists = [&](const std::string& key, const Eigen::MatrixXd& rows, Eigen::Index count,
                         const std::string& meaning) {
    if (rows.rows() == 0 && count == 0) return;  // none, however wide
    if (checks.sized(key, rows.rows(), rows.cols(), count, n, meaning)) checks.finite(key, rows);
  };
  lists("/force/cosine", model.cosine_force, model.cosine_force.rows(), "[H_f,n]");
  lists("/force/sine", model.sine_force, model.cosine_force.rows(), "[H_f,n], as many harmonics as /force/cosine");
  lists("/output/vectors", model.output_vectors, model.output_vectors.rows(), "[n_out,n]");
  check_names(model.output_names, model.output_vectors.rows(), checks);
  return checks.found;
}

std::vector<Violation> violations(const FullModel& model) {
  Checks checks;
  const Eigen::Index n = model.stiffness.rows();
  checks.sized("stiffness", n, model.stiffness.cols(), n, n, "[n,n]");
  checks.sized("mass", model.mass.rows(), model.mass.cols(), n, n, "[n,n]");
  checks.sized("static_force", model.static_force.size(), n, "[n]");
  checks.sized("cosine_force", model.cosine_force.rows(), model.cosine_force.cols(), n, model.cosine_force.cols(),
               "[n,H_f]");
  checks.sized("sine_force", model.sine_force.rows(), model.sine_force.cols(), n, model.cosine_force.cols(), "[n,H_f]");
  checks.sized("outputs", model.outputs.rows(), model.outputs.cols(), n,
               static_cast<Eigen::Index>(model.output_names.size()), "[n,n_out]");
  check_contact(model.contact, n, checks);
  if (model.contact.count() == 0) checks.add("contact.normal", "shape [0]", "must hold at least one contact node");
  if (model.internal_size() <= 0)
    checks.add("stiffness", "shape " + shape(n, n), "must have internal dofs besides the contact dofs");
  if (!checks.found.empty()) return checks.found;
  const Eigen::Index d = model.contact.directions();
  for (Eigen::Index node = 0; node < model.contact.count(); ++node) {
    bool ordered = model.contact.normal(node) == model.internal_size() + d * node;
    for (Eigen::Index t = 0; t + 1 < d; ++t)
      ordered = ordered && model.contact.tangential(node, t) == model.internal_size() + d * node + 1 + t;
    if (!ordered) {
      checks.add("contact.normal" + at(node), std::to_string(model.contact.normal(node)),
                 "must be the last coordinates, N, T1[, T2] of each node in turn");
      break;
    }
  }
  return checks.found;
}

}  // namespace dovetail::reduction
