#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/errors.hpp"

namespace dovetail::studies {

/// Place in a text: line and column from 1, the column in code points. Line 0: not in the text.
struct Position {
  int line = 0;
  int column = 0;
};

struct Member;

/// A value of a study file as it was found, with the place it came from.
struct Node {
  enum class Kind { truth, whole, real, text, list, table, other };
  Kind kind = Kind::other;
  bool truth = false;
  std::int64_t whole = 0;
  double real = 0;  ///< also set for whole numbers
  std::string text;
  std::vector<Node> items;      ///< of a list
  std::vector<Member> members;  ///< of a table, in the order of the file
  Position begin, end;          ///< where the value stands, end exclusive
  std::string origin;           ///< "--set KEY=VALUE" when it does not come from the file

  [[nodiscard]] bool is_number() const { return kind == Kind::whole || kind == Kind::real; }
  /// The value as a message shows it: -3, "text", [...], {...}.
  [[nodiscard]] std::string shown() const;
  /// Member of a table, or nullptr.
  [[nodiscard]] const Node* find(std::string_view key) const;
  /// The value at a dotted path below this table, or nullptr.
  [[nodiscard]] const Node* at(std::string_view path) const;
};

struct Member {
  std::string key;
  Node value;
};

/// A value given on the command line for a key of the file.
struct Override {
  std::string key;     ///< dotted path
  std::string value;   ///< as typed
  std::string origin;  ///< what the user typed: "--set KEY=VALUE", "--harmonics 5"
};

/// A study file, parsed and not yet interpreted.
struct Document {
  std::string file;  ///< as the user named it
  std::string text;  ///< verbatim
  Node root;         ///< a table
};

/// Splits "KEY=VALUE". Throws InputError when there is no key or no value.
[[nodiscard]] Override parse_override(const std::string& assignment);

/// Reads and parses the file. Throws InputError when it cannot be read or is not TOML.
[[nodiscard]] Document load_document(const std::string& file);

/// Parses the text; `file` names it in messages. Throws InputError.
[[nodiscard]] Document parse_document(std::string text, std::string file);

/// What the study at hand says otherwise than another one did: "contact.friction = 0.6 (it was 0.5)".
[[nodiscard]] std::vector<std::string> changed_values(const Document& before, const Document& now);

/// A number as TOML writes it: with a point or an exponent, so that it is no whole number and -0 keeps its sign.
[[nodiscard]] std::string real_text(double value);

/// The text without line breaks, for a message.
[[nodiscard]] std::string one_line(std::string text);

/// Replaces or creates the values, later ones winning. Throws InputError for a path through something
/// that is not a section; keys that do not exist are found when the study is read.
void apply_overrides(Document& document, std::span<const Override> overrides);

}  // namespace dovetail::studies
