#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace dovetail {

/// One thing wrong with an input: where it is, what was found and what is allowed.
struct Violation {
  std::string file;     ///< empty when the input is not a file
  int line = 0;         ///< 0 when unknown
  std::string key;      ///< dotted path of the key or name of the data set
  std::string value;    ///< as found
  std::string allowed;  ///< what would be right, as a phrase

  /// "study.toml:12: geometry.neck_width_mm = -3: must be > 0"
  [[nodiscard]] std::string sentence() const;
};

/// The input is wrong. Carries every violation found, not only the first; what() is one sentence per line.
class InputError : public std::runtime_error {
 public:
  explicit InputError(std::vector<Violation> violations);
  explicit InputError(Violation violation) : InputError(std::vector{std::move(violation)}) {}
  [[nodiscard]] const std::vector<Violation>& violations() const { return violations_; }

 private:
  std::vector<Violation> violations_;
};

}  // namespace dovetail
