#include "studies/program/commands/kept_rounds.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace dovetail::studies {

namespace {

/// What a record is of: a round's evaluation, or what the mesh beside the flanks leaves of its responses.
enum class Of { evaluation, beside };

/// What tells records apart: the design, the settings and what they are of.
std::vector<double> numbers(int design, const optimizer::Settings& settings, Of of) {
  const auto& [mesh, beside, harmonics, samples, modes, resonance_tolerance, history_tolerance] = settings;  // all
  return {static_cast<double>(design),
          mesh,
          beside,
          static_cast<double>(harmonics),
          static_cast<double>(samples),
          static_cast<double>(modes),
          resonance_tolerance,
          history_tolerance,
          static_cast<double>(of)};
}

}  // namespace

KeptRounds::KeptRounds(std::filesystem::path file, const std::string& question)
    : file_(std::move(file)), journal_(optimizer::Journal::renew(file_, question)) {}

optimizer::AccuracyMemory KeptRounds::at(int design) {
  return [this, design](const optimizer::Settings& settings, const auto& compute) -> optimizer::AccuracyAnswer {
    const auto record = [&](Of of) -> const optimizer::Evaluation* {
      const auto found =
          std::ranges::find(journal_.records(), numbers(design, settings, of), &optimizer::JournalRecord::x);
      return found == journal_.records().end() ? nullptr : &found->evaluation;
    };
    const optimizer::Evaluation *known = record(Of::evaluation), *known_beside = record(Of::beside);
    if (known != nullptr && known_beside != nullptr) return {*known, known_beside->responses};
    optimizer::AccuracyAnswer answer = compute();
    optimizer::Evaluation beside;
    beside.responses = answer.beside;
    // The same bits each time: one of the two alone, where the program ended between them, is as good as new.
    journal_.append(numbers(design, settings, Of::beside), beside);
    journal_.append(numbers(design, settings, Of::evaluation), answer.evaluation);
    return answer;
  };
}

void KeptRounds::forget() const {
  std::filesystem::remove(file_);
}

}  // namespace dovetail::studies
