// Writing of the reduced model's TOML file and its matrices.
#include <algorithm>
#include <bit>
#include <cstdint>
#include <filesystem>
#include <functional>

#include "contact/wear_law.hpp"
#include "core/options.hpp"
#include "core/replace_file.hpp"
#include "reduction/matrix_market.hpp"
#include "reduction/validation.hpp"
#include "studies/program/engine/model_toml.hpp"
#include "studies/program/study_file/refusal.hpp"

namespace dovetail::studies {
namespace {

/// Whether the entry has to be written: zeros are left out, but for those with a minus sign.
bool is_there(double value) {
  return std::bit_cast<std::uint64_t>(value) != 0;
}

std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      result += '\\';
      result += c;
    } else if (code < 0x20 || code == 0x7f) {
      constexpr const char* kDigits = "0123456789abcdef";
      result += std::string("\\u00") + kDigits[code >> 4] + kDigits[code & 15];
    } else {
      result += c;
    }
  }
  return result + "\"";
}

/// "[a, b, c]" with line breaks every few entries.
std::string list(Eigen::Index count, const std::function<std::string(Eigen::Index)>& entry) {
  constexpr Eigen::Index kPerLine = 8;
  std::string text = "[";
  for (Eigen::Index i = 0; i < count; ++i) {
    text += (i > 0 ? "," : "");
    text += i > 0 && i % kPerLine == 0 ? "\n  " : (i > 0 ? " " : "");
    text += entry(i);
  }
  return text + "]";
}

std::string numbers(const Eigen::VectorXd& values) {
  return list(values.size(), [&](Eigen::Index i) { return real_text(values[i]); });
}

template <class Matrix, class Entry>
std::string rows(const Matrix& matrix, const Entry& entry) {
  return list(matrix.rows(), [&](Eigen::Index i) {
    if (matrix.cols() == 1) return std::string(entry(matrix(i, 0)));
    std::string row = "[";
    for (Eigen::Index k = 0; k < matrix.cols(); ++k) row += (k > 0 ? ", " : "") + std::string(entry(matrix(i, k)));
    return row + "]";
  });
}

std::string contact_section(const reduction::ContactNodes& contact) {
  const auto whole = [](int value) { return std::to_string(value); };
  std::string text = "\n# One entry for each contact node. Dofs count from 0; m, m^2";
  for (const contact::WearParameter& of_law : contact::find_wear_law(contact.wear_law)->parameters)
    text += ", " + std::string(of_law.unit);
  text += ".\n[contact]\n";
  text += "normal = " + rows(contact.normal, whole) + "\n";
  text += "tangential = " + rows(contact.tangential, whole) + "\n";
  text += "area = " + numbers(contact.area) + "\n";
  text += "gap = " + numbers(contact.gap) + "\n";
  text += "friction = " + numbers(contact.friction) + "\n";
  text += "wear_coefficient = " + numbers(contact.wear_coefficient) + "\n";
  if (contact.wear_law != reduction::ContactNodes().wear_law) text += "wear_law = \"" + contact.wear_law + "\"\n";
  if (contact.wear_threshold.size() > 0) text += "wear_threshold = " + numbers(contact.wear_threshold) + "\n";
  if (contact.position.rows() > 0) text += "position = " + rows(contact.position, real_text) + "\n";
  if (contact.group.size() > 0) text += "group = " + rows(contact.group, whole) + "\n";
  const auto values = contact.slip_origin.reshaped();
  if (std::any_of(values.begin(), values.end(), is_there))
    text += "slip_origin = " + rows(contact.slip_origin, real_text) + "\n";
  return text;
}

std::string force_sections(const reduction::ReducedModel& model) {
  std::string text;
  const auto add = [&](Eigen::Index dof, Eigen::Index harmonic, double cosine, double sine) {
    if (!is_there(cosine) && !is_there(sine)) return;
    text += "\n[[force]]\ndof = " + std::to_string(dof) + "\nharmonic = " + std::to_string(harmonic) + "\n";
    if (is_there(cosine)) text += "cosine = " + real_text(cosine) + "\n";
    if (is_there(sine)) text += "sine = " + real_text(sine) + "\n";
  };
  for (Eigen::Index dof = 0; dof < model.static_force.size(); ++dof) add(dof, 0, model.static_force[dof], 0);
  for (Eigen::Index h = 0; h < model.cosine_force.rows(); ++h)
    for (Eigen::Index dof = 0; dof < model.cosine_force.cols(); ++dof)
      add(dof, h + 1, model.cosine_force(h, dof), model.sine_force(h, dof));
  return text.empty() ? text : "\n# Harmonic 0 is static; cosine and sine in N.\n" + text.substr(1);
}

std::string output_sections(const reduction::ReducedModel& model) {
  std::string text;
  for (std::size_t i = 0; i < model.output_names.size(); ++i) {
    std::string dofs, factors;
    for (Eigen::Index dof = 0; dof < model.output_vectors.cols(); ++dof) {
      const double factor = model.output_vectors(static_cast<Eigen::Index>(i), dof);
      if (!is_there(factor)) continue;
      dofs += (dofs.empty() ? "" : ", ") + std::to_string(dof);
      factors += (factors.empty() ? "" : ", ") + real_text(factor);
    }
    text += "\n[[output]]\nname = " + quoted(model.output_names[i]) + "\n";
    text += "dofs = [" + dofs + "]\nfactors = [" + factors + "]\n";
  }
  return text;
}

}  // namespace

void write_model_document(const std::string& file, const reduction::ReducedModel& model, const std::string& origin) {
  namespace fs = std::filesystem;
  const fs::path path(file);
  if (path.extension() != ".toml" || path.stem().empty())
    refuse(file, "must end with .toml; the matrices are written beside it");
  check_replaceable(path);
  std::vector<Violation> found = reduction::violations(model);
  for (Violation& violation : found) violation.file = file;
  refuse(std::move(found));

  const std::string comment = one_line(origin);
  std::string text = "# Reduced model: " + comment + "\n";
  text += "format = \"dovetail-reduced-model\"\nversion = 1\n";
  const auto matrix = [&](const std::string& name, const Eigen::MatrixXd& values) {
    const std::string beside = path.stem().string() + "." + name + ".mtx";
    reduction::write_matrix_market((path.parent_path() / beside).string(), values, name + " of " + comment);
    text += name + " = " + quoted(beside) + "\n";
  };
  matrix("mass", model.mass);
  matrix("damping", model.damping);
  matrix("stiffness", model.stiffness);
  if (model.cosine_force.rows() > 0) text += "force_harmonics = " + std::to_string(model.cosine_force.rows()) + "\n";
  text += contact_section(model.contact) + force_sections(model) + output_sections(model);
  replace_file(path, text);
}

}  // namespace dovetail::studies
