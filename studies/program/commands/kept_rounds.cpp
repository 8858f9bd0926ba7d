#include "studies/program/commands/kept_rounds.hpp"

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

namespace dovetail::studies {

namespace {

optimizer::Journal opened(const std::filesystem::path& file, const std::string& question) {
  try {
    return optimizer::Journal::resume(file, question);
  } catch (const InputError&) {
    std::filesystem::remove(file);  // of another question, or damaged: they can be computed again
  }
  return optimizer::Journal::resume(file, question);
}

/// What tells rounds apart: the design and the settings.
std::vector<double> numbers(int design, const optimizer::Settings& s) {
  return {static_cast<double>(design),
          s.mesh,
          s.beside,
          static_cast<double>(s.harmonics),
          static_cast<double>(s.samples),
          static_cast<double>(s.modes),
          s.resonance_tolerance,
          s.history_tolerance};
}

}  // namespace

KeptRounds::KeptRounds(std::filesystem::path file, const std::string& question)
    : file_(std::move(file)), journal_(opened(file_, question)) {}

// A round is two records one after the other: its evaluation, and what the mesh beside the flanks leaves of responses.
optimizer::AccuracyMemory KeptRounds::at(int design) {
  return [this, design](const optimizer::Settings& settings, const auto& compute) -> optimizer::AccuracyAnswer {
    const std::vector<double> place = numbers(design, settings);
    const std::vector<optimizer::JournalRecord>& known = journal_.records();
    const auto found = std::ranges::find(known, place, &optimizer::JournalRecord::x);
    if (found != known.end() && std::next(found) != known.end())
      return {found->evaluation, std::next(found)->evaluation.responses};
    optimizer::AccuracyAnswer answer = compute();
    optimizer::Evaluation beside;
    beside.responses = answer.beside;
    journal_.append(place, answer.evaluation);
    journal_.append(std::vector<double>(place.size(), -1), beside);
    return answer;
  };
}

void KeptRounds::forget() const {
  std::filesystem::remove(file_);
}

}  // namespace dovetail::studies
