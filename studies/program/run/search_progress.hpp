#pragma once

#include <chrono>
#include <string>

#include "optimizer/search/run.hpp"
#include "studies/program/answers/teller.hpp"

namespace dovetail::studies {

/// The limits and rules that a candidate breaks, and by how much: "peak_amplitude_m:upper by 3.2 % of its limit", the
/// sentences of rules; empty where none is broken.
[[nodiscard]] std::string broken_words(const optimizer::Problem& problem, const optimizer::Evaluation& evaluation,
                                       const std::vector<double>& constraints);

/// The progress of a search for people, "evaluation 12/100: 1.31e-10; best 1.23e-10 (feasible); 41 s, about 300 s to
/// go", and for programs.
class SearchProgress {
 public:
  /// @param at_once  several candidates are computed at a time
  SearchProgress(Teller& teller, const optimizer::Problem& problem, int evaluations, std::string directory,
                 bool at_once);

  void operator()(const optimizer::Progress& progress);

 private:
  using Clock = std::chrono::steady_clock;
  [[nodiscard]] std::string standing(const optimizer::Progress& progress) const;

  Teller& teller_;
  const optimizer::Problem& problem_;
  int evaluations_;
  std::string directory_;
  bool at_once_;
  int computed_ = 0, feasible_ = 0;
  double best_ = 0;
  bool has_best_ = false;
  Clock::time_point begin_ = Clock::now();
};

}  // namespace dovetail::studies
