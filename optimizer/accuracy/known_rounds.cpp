#include "optimizer/accuracy/known_rounds.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "optimizer/accuracy/params.hpp"

namespace dovetail::optimizer {

namespace {
constexpr SettingsParams kHeard;
}

void judge(std::vector<KnownRound>& rounds) {
  const auto contradicted = [&](const KnownRound& round) {
    return std::ranges::count_if(rounds, [&](const KnownRound& other) { return !round.alone.meets(other.alone); });
  };
  for (KnownRound& round : rounds)
    round.tried.out_of_line = rounds.size() > 2 && 2 * contradicted(round) > static_cast<int>(rounds.size()) - 1;
  if (std::ranges::all_of(rounds, [](const KnownRound& round) { return round.tried.out_of_line; }))
    for (KnownRound& round : rounds) round.tried.out_of_line = false;  // there is no line
  for (KnownRound& round : rounds) {
    round.forecast = round.alone;
    for (const KnownRound& other : rounds)
      if (!other.tried.out_of_line) round.forecast.reach(other.alone);
    round.tried.by = round.forecast.dominant();
    round.tried.excess = round.forecast.resolves() ? round.forecast.excess(round.tried.settings) : kInfinity;
  }
}

double known_excess(const KnownRound& round) {
  return round.forecast.knows() ? round.forecast.excess(round.tried.settings) : kInfinity;
}

const KnownRound& best_of(const std::vector<KnownRound>& rounds) {
  const auto resolves = [](const KnownRound& round) { return !round.tried.out_of_line && round.forecast.resolves(); };
  const bool resolved = std::ranges::any_of(rounds, resolves);
  const auto heard = [&](const KnownRound& round) { return resolved ? resolves(round) : !round.tried.out_of_line; };
  double least = kInfinity;
  for (const KnownRound& round : rounds)
    if (heard(round)) least = std::min(least, known_excess(round));
  const double limit = least <= 1 ? 1 : kHeard.hardly_worse * least;
  const auto rank = [&](const KnownRound& round) {
    return std::pair{!heard(round) || known_excess(round) > limit, std::isfinite(limit) ? round.tried.operations : 0};
  };
  return *std::ranges::min_element(rounds, {}, rank);
}

bool runs_idle(const std::vector<KnownRound>& rounds) {
  double least = kInfinity;
  int idle = 0;
  for (const KnownRound& round : rounds) {
    const double excess = round.alone.knows() ? round.alone.excess(round.tried.settings) : kInfinity;
    idle = excess < kHeard.progress * least || !std::isfinite(least) ? 0 : idle + 1;
    least = std::min(least, excess);
  }
  return idle >= kHeard.patience;
}

}  // namespace dovetail::optimizer
