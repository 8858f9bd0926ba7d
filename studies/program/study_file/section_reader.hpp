#pragma once

#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/options.hpp"
#include "studies/program/study_file/document.hpp"

namespace dovetail::studies {

/// Collects everything wrong with a document, each with the place it comes from.
class Problems {
 public:
  explicit Problems(std::string file) : file_(std::move(file)) {}

  /// `key = VALUE: allowed` for a value that was found.
  void add(const Node& value, const std::string& key, const std::string& allowed);
  /// `key: allowed` for something absent; `near` is the table it is missing from, or nullptr.
  void missing(const Node* near, const std::string& key, const std::string& allowed);

  [[nodiscard]] bool has(const std::string& key) const { return keys_.contains(key); }
  [[nodiscard]] bool empty() const { return found_.empty(); }
  /// Throws InputError with all of them, in the order of the file, unless there are none.
  void raise() const;

 private:
  std::string file_;
  std::vector<Violation> found_;
  std::set<std::string> keys_;
};

/// Reads one table of a document key by key; what nobody asked for is reported by finish().
class SectionReader {
 public:
  /// `table` may be nullptr: the section is absent. A node that is no table is reported.
  SectionReader(const Node* table, std::string path, Problems& problems);

  /// The value of that key or nullptr; either way the key is a valid one from now on.
  const Node* take(const std::string& key);
  /// Numbers in the range, in the file's unit; nullopt when absent or wrong (then reported).
  std::optional<double> number(const std::string& key, const Range& range, bool required = false);
  std::optional<int> whole(const std::string& key, const Range& range, bool required = false);
  std::optional<bool> truth(const std::string& key, bool required = false);
  std::optional<std::string> text(const std::string& key, const std::vector<std::string_view>& choices = {},
                                  bool required = false);
  /// Every field of the struct; what is absent keeps its value. `needed` false: nothing is required here.
  template <class S>
  void fields(S& object, std::span<const Field<S>> table, bool needed = true);
  /// Reports keys that are not valid here, with the nearest valid one.
  void finish();

  [[nodiscard]] bool present() const { return table_ != nullptr; }
  [[nodiscard]] const Node* node() const { return table_; }
  [[nodiscard]] std::string path(const std::string& key) const { return path_.empty() ? key : path_ + "." + key; }

 private:
  const Node* table_;
  std::string path_;
  Problems& problems_;
  std::vector<std::string> valid_;
};

/// The tables of `[[kind]]`, each with its path "kind[0]"; anything else of that name is reported.
[[nodiscard]] std::vector<std::pair<const Node*, std::string>> entries(SectionReader& root, const std::string& kind,
                                                                       Problems& problems);

template <class S>
void SectionReader::fields(S& object, std::span<const Field<S>> table, bool needed) {
  for (const Field<S>& field : table) {
    const std::string key(field.key);
    const bool required = needed && field.required;
    if (const auto* real = std::get_if<double S::*>(&field.member)) {
      if (const auto value = number(key, field.range, required)) object.*(*real) = *value * field.si_per_unit;
    } else if (const auto* count = std::get_if<int S::*>(&field.member)) {
      if (const auto value = whole(key, field.range, required)) object.*(*count) = *value;
    } else if (const auto* flag = std::get_if<bool S::*>(&field.member)) {
      if (const auto value = truth(key, required)) object.*(*flag) = *value;
    } else if (const auto value = text(key, choices_of(field), required)) {
      set_text(object, field, *value);
    }
  }
}

}  // namespace dovetail::studies
