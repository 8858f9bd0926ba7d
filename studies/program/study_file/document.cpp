#include "studies/program/study_file/document.hpp"

#include <toml++/toml.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <utility>

#include "core/options.hpp"
#include "studies/program/study_file/refusal.hpp"

namespace dovetail::studies {
namespace {

Position position(const toml::source_position& place) {
  return {.line = static_cast<int>(place.line), .column = static_cast<int>(place.column)};
}

Node converted(const toml::node& source) {
  Node node;
  node.begin = position(source.source().begin);
  node.end = position(source.source().end);
  if (const auto* table = source.as_table()) {
    node.kind = Node::Kind::table;
    for (const auto& [key, value] : *table) node.members.push_back({std::string(key.str()), converted(value)});
    std::stable_sort(node.members.begin(), node.members.end(), [](const Member& a, const Member& b) {
      return std::pair(a.value.begin.line, a.value.begin.column) < std::pair(b.value.begin.line, b.value.begin.column);
    });
  } else if (const auto* list = source.as_array()) {
    node.kind = Node::Kind::list;
    for (const toml::node& item : *list) node.items.push_back(converted(item));
  } else if (const auto* truth = source.as_boolean()) {
    node.kind = Node::Kind::truth;
    node.truth = truth->get();
  } else if (const auto* whole = source.as_integer()) {
    node.kind = Node::Kind::whole;
    node.whole = whole->get();
    node.real = static_cast<double>(node.whole);
  } else if (const auto* real = source.as_floating_point()) {
    node.kind = Node::Kind::real;
    node.real = real->get();
  } else if (const auto* text = source.as_string()) {
    node.kind = Node::Kind::text;
    node.text = text->get();
  } else {
    std::ostringstream date;
    source.visit([&](const auto& value) {
      if constexpr (toml::is_chronological<decltype(value)>) date << value.get();
    });
    node.text = date.str();
  }
  return node;
}

/// The typed value as TOML if it is one value, else as the text it is.
Node value_of(const Override& given) {
  Node node;
  node.kind = Node::Kind::text;
  node.text = given.value;
  try {
    const toml::table parsed = toml::parse("value = " + given.value);
    if (parsed.size() == 1) node = converted(*parsed.get("value"));
  } catch (const toml::parse_error&) {
  }
  const auto mark = [&](auto& self, Node& n) -> void {
    n.origin = given.origin;
    n.begin = n.end = {};
    for (Node& item : n.items) self(self, item);
    for (Member& member : n.members) self(self, member.value);
  };
  mark(mark, node);
  return node;
}

Node& member(Node& table, const std::string& key) {
  for (Member& m : table.members)
    if (m.key == key) return m.value;
  table.members.push_back({.key = key, .value = {}});
  return table.members.back().value;
}

}  // namespace

std::string one_line(std::string text) {
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
  return text;
}

std::string real_text(double value) {
  std::string text = shortest(value);
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return text;
}

std::string Node::shown() const {
  switch (kind) {
    case Kind::truth:
      return truth ? "true" : "false";
    case Kind::whole:
      return std::to_string(whole);
    case Kind::real:
      return shortest(real);
    case Kind::text:
      return '"' + one_line(text.size() > 60 ? text.substr(0, 57) + "..." : text) + '"';
    case Kind::list:
      return items.empty() ? "[]" : "[...]";
    case Kind::table:
      return members.empty() ? "{}" : "{...}";
    case Kind::other:
      return text;
  }
  return {};
}

const Node* Node::find(std::string_view key) const {
  for (const Member& m : members)
    if (m.key == key) return &m.value;
  return nullptr;
}

const Node* Node::at(std::string_view path) const {
  const Node* node = this;
  while (node && !path.empty()) {
    const std::size_t dot = path.find('.');
    node = node->find(path.substr(0, dot));
    path = dot == std::string_view::npos ? std::string_view() : path.substr(dot + 1);
  }
  return node;
}

Override parse_override(const std::string& assignment) {
  const std::size_t equals = assignment.find('=');
  const auto trimmed = [](const std::string& text) {
    const std::size_t first = text.find_first_not_of(" \t");
    if (first == std::string::npos) return std::string();
    return text.substr(first, text.find_last_not_of(" \t") - first + 1);
  };
  Override result;
  if (equals != std::string::npos) {
    result.key = trimmed(assignment.substr(0, equals));
    result.value = trimmed(assignment.substr(equals + 1));
  }
  result.origin = "--set " + one_line(assignment);
  if (result.key.empty() || result.value.empty())
    refuse(result.origin, "must be KEY=VALUE, as in --set geometry.neck_width_mm=8.5");
  return result;
}

Document load_document(const std::string& file) {
  const auto unreadable = [&](const std::string& why) { refuse(file, "cannot be read: " + why); };
  std::error_code error;
  if (std::filesystem::is_directory(file, error)) unreadable("it is a directory; name a study file");
  errno = 0;
  std::ifstream stream(file, std::ios::binary);
  if (!stream) unreadable(errno != 0 ? std::strerror(errno) : "it does not open");
  std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  if (stream.bad()) unreadable("reading failed");
  return parse_document(std::move(text), file);
}

Document parse_document(std::string text, std::string file) {
  Document document{.file = std::move(file), .text = std::move(text), .root = {}};
  if (document.text.find('\0') != std::string::npos)
    refuse(document.file, "is not a study file: it contains binary data");
  try {
    document.root = converted(toml::parse(document.text));
  } catch (const toml::parse_error& error) {
    throw InputError(Violation{.file = document.file,
                               .line = static_cast<int>(error.source().begin.line),
                               .key = "not valid TOML",
                               .value = {},
                               .allowed = one_line(std::string(error.description()))});
  }
  return document;
}

void apply_overrides(Document& document, std::span<const Override> overrides) {
  std::vector<Violation> refused;
  for (const Override& given : overrides) {
    Node* table = &document.root;
    std::string rest = given.key;
    std::string passed;
    for (std::size_t dot = rest.find('.'); table && dot != std::string::npos; dot = rest.find('.')) {
      const std::string section = rest.substr(0, dot);
      passed += (passed.empty() ? "" : ".") + section;
      rest.erase(0, dot + 1);
      const bool created = !table->find(section);
      table = &member(*table, section);
      if (created) {
        table->kind = Node::Kind::table;
        table->origin = given.origin;
      } else if (table->kind != Node::Kind::table) {
        refused.push_back({.file = document.file,
                           .key = given.origin,
                           .value = {},
                           .allowed = passed + " is not a section; change it in the file"});
        table = nullptr;
      }
    }
    if (table) member(*table, rest) = value_of(given);
  }
  refuse(std::move(refused));
}

namespace {

/// All values by their dotted keys, of lists by their numbers, too.
void collect_values(const Node& node, const std::string& path, std::map<std::string, std::string>& values) {
  for (const Member& member : node.members)
    collect_values(member.value, path.empty() ? member.key : path + "." + member.key, values);
  for (std::size_t i = 0; i < node.items.size(); ++i)
    collect_values(node.items[i], path + "[" + std::to_string(i) + "]", values);
  if (node.members.empty() && node.items.empty()) values[path] = node.shown();
}

}  // namespace

std::vector<std::string> changed_values(const Document& before, const Document& now) {
  std::map<std::string, std::string> old_values, values;
  collect_values(before.root, "", old_values);
  collect_values(now.root, "", values);
  std::vector<std::string> changed;
  for (const auto& [key, value] : values)
    if (const auto old = old_values.find(key); old == old_values.end())
      changed.push_back(key + " = " + value + " (it was not given)");
    else if (old->second != value)
      changed.push_back(key + " = " + value + " (it was " + old->second + ")");
  for (const auto& [key, value] : old_values)
    if (!values.contains(key)) changed.push_back(key + " missing (it was " + value + ")");
  return changed;
}

}  // namespace dovetail::studies
