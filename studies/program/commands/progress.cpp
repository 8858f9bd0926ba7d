#include "studies/program/commands/progress.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <cmath>
#include <iostream>

namespace dovetail::studies {

RunProgress::RunProgress(std::ostream& stream, bool terminal, int evaluations, bool front)
    : stream_(stream), terminal_(terminal), evaluations_(evaluations), front_(front) {}

RunProgress::~RunProgress() {
  if (open_) stream_ << std::endl;
}

void RunProgress::operator()(const optimizer::Progress& progress) {
  if (!progress.candidate.replayed) ++computed_;
  feasible_ += progress.candidate.evaluation.feasible ? 1 : 0;
  if (progress.best == progress.index) {
    best_ = progress.candidate.judgement.objective;
    has_best_ = true;
  }
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
  show(line(progress, seconds));
}

void RunProgress::note(const std::string& text) {
  show(text);
}

void RunProgress::show(const std::string& text) {
  if (terminal_) {
    stream_ << "\r\033[K" << text << std::flush;
    open_ = true;
  } else {
    stream_ << text << std::endl;
  }
}

std::string RunProgress::line(const optimizer::Progress& progress, double seconds) const {
  const optimizer::Candidate& candidate = progress.candidate;
  const int done = static_cast<int>(progress.index) + 1;
  std::string here = "not computed";
  if (candidate.judgement.computed)
    here = fmt::format("{}{}",
                       front_ ? fmt::format("{:.4g}", fmt::join(candidate.judgement.terms, ", "))
                              : fmt::format("{:.4g}", candidate.judgement.objective),
                       candidate.judgement.feasible ? "" : ", not feasible");
  else if (!candidate.evaluation.converged())
    here = candidate.evaluation.status;
  const std::string best = front_      ? fmt::format("{} feasible", feasible_)
                           : has_best_ ? fmt::format("best {:.4g} (feasible)", best_)
                                       : std::string("best none feasible yet");
  const std::string count =
      fmt::format("evaluation {}/{}{}", done, evaluations_, candidate.replayed ? " (stored)" : "");
  std::string text = fmt::format("{}: {}; {}; {:.0f} s", count, here, best, seconds);
  if (computed_ > 0 && done < evaluations_)
    text += fmt::format(", about {:.0f} s to go", std::ceil(seconds / computed_ * (evaluations_ - done)));
  return text;
}

bool is_terminal(const std::ostream& stream) {
  return &stream == &std::cerr && ::isatty(STDERR_FILENO) != 0;
}

}  // namespace dovetail::studies
