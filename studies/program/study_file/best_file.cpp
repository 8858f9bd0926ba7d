#include "studies/program/study_file/best_file.hpp"

#include <toml++/toml.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <optional>
#include <sstream>

namespace dovetail::studies {
namespace {

/// Offset in bytes of a position whose column counts code points.
std::size_t offset(const std::string& text, Position position) {
  std::size_t at = 0;
  for (int line = 1; line < position.line && at < text.size(); ++at)
    if (text[at] == '\n') ++line;
  for (int column = 1; column < position.column && at < text.size(); ++column) {
    ++at;
    while (at < text.size() && (static_cast<unsigned char>(text[at]) & 0xC0U) == 0x80U) ++at;
  }
  return at;
}

/// The section's header line "[section]" as written, or npos.
std::size_t end_of_header(const std::string& text, const std::string& section) {
  std::size_t line = 0;
  while (line < text.size()) {
    const std::size_t end = std::min(text.find('\n', line), text.size());
    std::string content = text.substr(line, end - line);
    content.erase(std::remove_if(content.begin(), content.end(), [](char c) { return c == ' ' || c == '\t'; }),
                  content.end());
    if (content.starts_with("[" + section + "]")) return end;
    line = end + 1;
  }
  return std::string::npos;
}

/// Of keys that are no parameters of the scene a whole number may stand for any.
bool is_whole(const std::string& key, double value) {
  const optimizer::Parameter* parameter = optimizer::find_parameter(key);
  return parameter ? parameter->kind == optimizer::Parameter::Kind::whole : value == std::rint(value);
}

/// What the file says of keys, as TOML: a number, "a text", a list.
using Texts = std::map<std::string, std::string>;

std::string edited(const Document& document, const Texts& values) {
  struct Edit {
    std::size_t begin, end;
    std::string text;
  };
  std::vector<Edit> edits;
  std::string text = document.text;
  Texts appended;  // lines by section
  std::string first;
  for (const auto& [key, value] : values) {
    const std::size_t dot = key.rfind('.');
    const std::string section = dot == key.npos ? "" : key.substr(0, dot);
    const std::string line = key.substr(dot == key.npos ? 0 : dot + 1) + " = " + value;
    if (const Node* node = document.root.at(key)) {
      edits.push_back({offset(text, node->begin), offset(text, node->end), value});
    } else if (section.empty()) {
      first += line + "\n";  // before any section
    } else if (const std::size_t header = end_of_header(text, section); header != std::string::npos) {
      edits.push_back({header, header, "\n" + line});
    } else {
      appended[section] += line + "\n";
    }
  }
  std::stable_sort(edits.begin(), edits.end(), [](const Edit& a, const Edit& b) { return a.begin > b.begin; });
  for (const Edit& edit : edits) text.replace(edit.begin, edit.end - edit.begin, edit.text);
  if (!appended.empty() && !text.empty() && text.back() != '\n') text += '\n';
  for (const auto& [section, lines] : appended) text += "\n[" + section + "]\n" + lines;
  return first + text;
}

std::string rewritten(const Document& document, const Texts& values) {
  toml::table root = toml::parse(document.text);
  for (const auto& [key, value] : values) {
    toml::table* table = &root;
    std::string rest = key;
    for (std::size_t dot = rest.find('.'); dot != std::string::npos; dot = rest.find('.')) {
      table = table->emplace<toml::table>(rest.substr(0, dot)).first->second.as_table();
      assert(table);
      rest.erase(0, dot + 1);
    }
    const toml::table parsed = toml::parse("value = " + value);
    table->insert_or_assign(rest, *parsed.get("value"));
  }
  std::ostringstream stream;
  stream << toml::toml_formatter{root, toml::toml_formatter::default_flags} << "\n";
  return stream.str();
}

bool alike(const Node& a, const Node& b) {
  return a.kind == b.kind && a.shown() == b.shown() && a.real == b.real && a.text == b.text &&
         std::ranges::equal(a.items, b.items, alike);
}

bool reads_back(const Document& original, const std::string& text, const Texts& values) {
  try {
    const Document document = parse_document(text, original.file);
    for (const auto& [key, value] : values) {
      const Node* node = document.root.at(key);
      const Document wanted = parse_document("value = " + value, {});
      if (!node || !alike(*node, *wanted.root.find("value"))) return false;
    }
    return read_study(document).problem.space.size() == read_study(original).problem.space.size();
  } catch (const InputError&) {
    return false;
  }
}

std::string with_texts(const Document& document, const Texts& values) {
  std::string text = edited(document, values);
  if (reads_back(document, text, values)) return text;
  text = rewritten(document, values);
  assert(reads_back(document, text, values));
  return text;
}

/// A value of the command line as TOML: what is none is a text.
std::string as_toml(const std::string& typed) {
  try {
    static_cast<void>(parse_document("value = " + typed, {}));
    return typed;
  } catch (const InputError&) {
    std::ostringstream quoted;
    quoted << toml::value<std::string>(typed);
    return quoted.str();
  }
}

}  // namespace

std::string with_values(const Document& document, const std::map<std::string, double>& values) {
  Texts texts;
  for (const auto& [key, value] : values)
    texts[key] = is_whole(key, value) ? std::to_string(std::llround(value)) : real_text(value);
  return with_texts(document, texts);
}

Study load_rewritten_study(const std::string& file, std::span<const Override> overrides) {
  const Document document = load_document(file);
  if (overrides.empty()) return read_study(document);
  Document with = document;
  apply_overrides(with, overrides);
  static_cast<void>(read_study(with));  // what is wrong is told in the words of the command line
  Texts texts;
  for (const Override& given : overrides) texts[given.key] = as_toml(given.value);
  return read_study(parse_document(with_texts(document, texts), file));
}

}  // namespace dovetail::studies
