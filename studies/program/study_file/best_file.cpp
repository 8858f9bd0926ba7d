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

std::string value_text(const std::string& key, double value) {
  return is_whole(key, value) ? std::to_string(std::llround(value)) : real_text(value);
}

std::string edited(const Document& document, const std::map<std::string, double>& values) {
  struct Edit {
    std::size_t begin, end;
    std::string text;
  };
  std::vector<Edit> edits;
  std::string text = document.text;
  std::map<std::string, std::string> appended;  // lines by section
  for (const auto& [key, value] : values) {
    const std::size_t dot = key.rfind('.');
    const std::string line = key.substr(dot + 1) + " = " + value_text(key, value);
    if (const Node* node = document.root.at(key)) {
      edits.push_back({offset(text, node->begin), offset(text, node->end), value_text(key, value)});
    } else if (const std::size_t header = end_of_header(text, key.substr(0, dot)); header != std::string::npos) {
      edits.push_back({header, header, "\n" + line});
    } else {
      appended[key.substr(0, dot)] += line + "\n";
    }
  }
  std::stable_sort(edits.begin(), edits.end(), [](const Edit& a, const Edit& b) { return a.begin > b.begin; });
  for (const Edit& edit : edits) text.replace(edit.begin, edit.end - edit.begin, edit.text);
  if (!appended.empty() && !text.empty() && text.back() != '\n') text += '\n';
  for (const auto& [section, lines] : appended) text += "\n[" + section + "]\n" + lines;
  return text;
}

std::string rewritten(const Document& document, const std::map<std::string, double>& values) {
  toml::table root = toml::parse(document.text);
  for (const auto& [key, value] : values) {
    toml::table* table = &root;
    std::string rest = key;
    for (std::size_t dot = rest.find('.'); dot != std::string::npos; dot = rest.find('.')) {
      table = table->emplace<toml::table>(rest.substr(0, dot)).first->second.as_table();
      assert(table);
      rest.erase(0, dot + 1);
    }
    if (is_whole(key, value))
      table->insert_or_assign(rest, std::int64_t{std::llround(value)});
    else
      table->insert_or_assign(rest, value);
  }
  std::ostringstream stream;
  stream << toml::toml_formatter{root, toml::toml_formatter::default_flags} << "\n";
  return stream.str();
}

bool reads_back(const Document& original, const std::string& text, const std::map<std::string, double>& values) {
  try {
    const Document document = parse_document(text, original.file);
    for (const auto& [key, value] : values) {
      const Node* node = document.root.at(key);
      if (!node || !node->is_number() || node->real != value) return false;
    }
    return read_study(document).problem.space.size() == read_study(original).problem.space.size();
  } catch (const InputError&) {
    return false;
  }
}

}  // namespace

std::string with_values(const Document& document, const std::map<std::string, double>& values) {
  std::string text = edited(document, values);
  if (reads_back(document, text, values)) return text;
  text = rewritten(document, values);
  assert(reads_back(document, text, values));
  return text;
}

}  // namespace dovetail::studies
