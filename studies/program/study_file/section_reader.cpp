#include "studies/program/study_file/section_reader.hpp"

#include <algorithm>
#include <cmath>

#include "optimizer/scene/scene.hpp"

namespace dovetail::studies {
namespace {

/// "must be a number > 0 and <= 5", "must be a number: 0 (rigid) or >= 5"; `noun` is "number" or "whole number".
std::string phrase(const std::string& noun, const Range& range) {
  const std::string bounds = range.phrase();
  const std::string start = "must be ";
  if (!std::isfinite(range.lower) && !std::isfinite(range.upper)) return start + "a finite " + noun;
  return start + "a " + noun + (range.zero.empty() ? " " : ": ") + bounds.substr(start.size());
}

std::string choice_phrase(const std::vector<std::string_view>& choices) {
  return choices.empty() ? "must be a text in quotes" : one_of(choices);
}

/// What is said of a key that there was before.
std::string retired(const std::string& key) {
  return key == "optimizer.threads" ? "is gone: `dovetail run --jobs N` has N processes work at once" : "";
}

/// The full key of the same name in another section, or empty.
std::string elsewhere(const std::string& leaf) {
  for (const optimizer::Parameter& p : optimizer::scene_parameters())
    if (p.key.size() > leaf.size() && p.key.ends_with("." + leaf)) return p.key;
  return {};
}

}  // namespace

void Problems::add(const Node& value, const std::string& key, const std::string& allowed) {
  keys_.insert(key);
  if (!value.origin.empty())
    found_.push_back({.file = file_, .key = value.origin, .value = {}, .allowed = allowed});
  else
    found_.push_back({.file = file_, .line = value.begin.line, .key = key, .value = value.shown(), .allowed = allowed});
}

void Problems::missing(const Node* near, const std::string& key, const std::string& allowed) {
  keys_.insert(key);
  found_.push_back({.file = file_, .line = near ? near->begin.line : 0, .key = key, .value = {}, .allowed = allowed});
}

void Problems::raise() const {
  if (found_.empty()) return;
  std::vector<Violation> sorted = found_;
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const Violation& a, const Violation& b) { return a.line < b.line; });
  throw InputError(std::move(sorted));
}

SectionReader::SectionReader(const Node* table, std::string path, Problems& problems)
    : table_(table), path_(std::move(path)), problems_(problems) {
  if (table_ && table_->kind != Node::Kind::table) {
    problems_.add(*table_, path_, "must be a section, [" + path_ + "]");
    table_ = nullptr;
  }
}

const Node* SectionReader::take(const std::string& key) {
  valid_.push_back(key);
  return table_ ? table_->find(key) : nullptr;
}

std::optional<double> SectionReader::number(const std::string& key, const Range& range, bool required) {
  const Node* node = take(key);
  if (!node) {
    if (required) problems_.missing(table_, path(key), "is missing; it " + phrase("number", range));
    return std::nullopt;
  }
  if (!node->is_number() || !std::isfinite(node->real)) {
    problems_.add(*node, path(key), phrase("number", range));
    return std::nullopt;
  }
  if (!range.contains(node->real)) {
    problems_.add(*node, path(key), range.phrase());
    return std::nullopt;
  }
  return node->real;
}

std::optional<int> SectionReader::whole(const std::string& key, const Range& range, bool required) {
  const Node* node = take(key);
  Range narrow = range;
  narrow.lower = std::max(range.lower, -2147483648.0);
  narrow.upper = std::min(range.upper, 2147483647.0);
  if (!node) {
    if (required) problems_.missing(table_, path(key), "is missing; it " + phrase("whole number", range));
    return std::nullopt;
  }
  if (node->kind != Node::Kind::whole) {
    problems_.add(*node, path(key), phrase("whole number", range));
    return std::nullopt;
  }
  if (!narrow.contains(node->real)) {
    problems_.add(*node, path(key), narrow.phrase());
    return std::nullopt;
  }
  return static_cast<int>(node->whole);
}

std::optional<bool> SectionReader::truth(const std::string& key, bool required) {
  const Node* node = take(key);
  if (!node) {
    if (required) problems_.missing(table_, path(key), "is missing; it must be true or false");
    return std::nullopt;
  }
  if (node->kind != Node::Kind::truth) {
    problems_.add(*node, path(key), "must be true or false");
    return std::nullopt;
  }
  return node->truth;
}

std::optional<std::string> SectionReader::text(const std::string& key, const std::vector<std::string_view>& choices,
                                               bool required) {
  const Node* node = take(key);
  if (!node) {
    if (required) problems_.missing(table_, path(key), "is missing; it " + choice_phrase(choices));
    return std::nullopt;
  }
  const bool fits = node->kind == Node::Kind::text &&
                    (choices.empty() || std::find(choices.begin(), choices.end(), node->text) != choices.end());
  if (!fits) {
    problems_.add(*node, path(key), choice_phrase(choices));
    return std::nullopt;
  }
  return node->text;
}

void SectionReader::finish() {
  if (!table_) return;
  for (const Member& member : table_->members) {
    if (std::find(valid_.begin(), valid_.end(), member.key) != valid_.end()) continue;
    if (const std::string gone = retired(path(member.key)); !gone.empty()) {
      problems_.add(member.value, path(member.key), gone);
      continue;
    }
    const std::string what = member.value.kind == Node::Kind::table ? "unknown section" : "unknown key";
    std::string near = elsewhere(member.key);
    if (near.empty()) {
      near = nearest(member.key, valid_);
      if (!near.empty()) near = path(near);
    }
    problems_.add(member.value, path(member.key), what + (near.empty() ? "" : "; did you mean " + near + "?"));
  }
}

std::vector<std::pair<const Node*, std::string>> entries(SectionReader& root, const std::string& kind,
                                                         Problems& problems) {
  std::vector<std::pair<const Node*, std::string>> found;
  const Node* list = root.take(kind);
  if (!list) return found;
  if (list->kind != Node::Kind::list) {
    problems.add(*list, kind, "must be written as [[" + kind + "]], once for each");
    return found;
  }
  for (const Node& item : list->items) {
    const std::string path = kind + "[" + std::to_string(found.size()) + "]";
    if (item.kind == Node::Kind::table)
      found.emplace_back(&item, path);
    else
      problems.add(item, path, "must be a section, [[" + kind + "]]");
  }
  return found;
}

}  // namespace dovetail::studies
