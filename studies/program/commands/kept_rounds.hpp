#pragma once

#include <filesystem>
#include <string>

#include "optimizer/accuracy/choice.hpp"
#include "optimizer/journal/journal.hpp"

namespace dovetail::studies {

/// The rounds of a choice of settings in a file, so that one that was cut off goes on where it ended: each is written
/// before the next begins. Rounds of another question are forgotten.
class KeptRounds {
 public:
  KeptRounds(std::filesystem::path file, const std::string& question);

  /// The rounds at one of several designs that may be asked, by number.
  [[nodiscard]] optimizer::AccuracyMemory at(int design);
  /// The choice is made.
  void forget() const;

 private:
  std::filesystem::path file_;
  optimizer::Journal journal_;
};

}  // namespace dovetail::studies
