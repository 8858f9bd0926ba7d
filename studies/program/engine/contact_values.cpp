#include "studies/program/engine/contact_values.hpp"

#include "contact/wear_law.hpp"

namespace dovetail::studies {

void read_version(SectionReader& root, Problems& problems) {
  const Node* node = root.take("version");
  if (!node)
    problems.missing(nullptr, "version", "is missing; it must be 1");
  else if (node->kind == Node::Kind::whole && node->whole > 1)
    problems.add(*node, "version", "the file is newer than this program, which reads version 1");
  else if (node->kind != Node::Kind::whole || node->whole != 1)
    problems.add(*node, "version", "must be 1");
}

const Node* required(SectionReader& section, Problems& problems, const std::string& key, const char* what) {
  const Node* node = section.take(key);
  if (!node) problems.missing(section.node(), section.path(key), std::string("is missing; it must be ") + what);
  return node;
}

void read_contact_values(SectionReader& section, Lists& lists, Problems& problems, reduction::ContactNodes& contact,
                         Eigen::Index count) {
  const auto path = [&](const char* key) { return section.path(key); };
  const auto numbers = [&](const char* key, Eigen::VectorXd& target) {
    if (const Node* node =
            required(section, problems, key, "a list of numbers, one for each contact node, or one for all"))
      target = lists.numbers(*node, path(key), count);
  };
  numbers("area", contact.area);
  numbers("gap", contact.gap);
  numbers("friction", contact.friction);
  numbers("wear_coefficient", contact.wear_coefficient);
  std::vector<std::string_view> laws;
  for (const dovetail::contact::WearLaw* law : dovetail::contact::wear_laws()) laws.push_back(law->name);
  if (const auto law = section.text("wear_law", laws)) contact.wear_law = *law;
  if (const Node* node = section.take("wear_threshold"))
    contact.wear_threshold = lists.numbers(*node, path("wear_threshold"), count);
  const auto table = [&](const char* key, Eigen::Index columns, auto& target) {
    if (const Node* node = section.take(key)) {
      target.setZero(count, columns);
      lists.rows(*node, path(key), count, columns,
                 [&](const Node& value, const std::string& place, Eigen::Index i, Eigen::Index k) {
                   target(i, k) = lists.number(value, place).value_or(0);
                 });
    }
  };
  const Eigen::Index tangents = contact.directions() - 1;
  contact.slip_origin.setZero(count, tangents);
  table("slip_origin", tangents, contact.slip_origin);
  table("position", 3, contact.position);
  if (const Node* node = section.take("group")) {
    lists.rows(*node, path("group"), count, 1, [](const Node&, const std::string&, Eigen::Index, Eigen::Index) {});
    contact.group = lists.indices(*node, path("group"), "the number of a flank, from 0");
  }
}

}  // namespace dovetail::studies
