#pragma once

#include <chrono>
#include <iosfwd>
#include <string>

#include "optimizer/search/run.hpp"

namespace dovetail::studies {

/// The progress of a run for people: "evaluation 12/100, best 1.23e-10 (feasible), 41 s, about 300 s to go". One line
/// that is renewed on a terminal, plain lines elsewhere.
class RunProgress {
 public:
  /// @param front  several objectives are wanted, each for itself
  RunProgress(std::ostream& stream, bool terminal, int evaluations, bool front = false);
  /// Ends the renewed line.
  ~RunProgress();
  RunProgress(const RunProgress&) = delete;
  RunProgress& operator=(const RunProgress&) = delete;

  void operator()(const optimizer::Progress& progress);

  /// What is under way beside candidates.
  void note(const std::string& text);

  /// The line after `done` candidates, `computed` of them not from the journal, `seconds` after the start.
  [[nodiscard]] std::string line(const optimizer::Progress& progress, double seconds) const;

 private:
  void show(const std::string& text);

  std::ostream& stream_;
  bool terminal_;
  int evaluations_;
  int computed_ = 0;
  bool open_ = false;
  bool front_;
  int feasible_ = 0;
  double best_ = 0;
  bool has_best_ = false;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

/// Whether what is written there is seen on a terminal.
[[nodiscard]] bool is_terminal(const std::ostream& stream);

}  // namespace dovetail::studies
