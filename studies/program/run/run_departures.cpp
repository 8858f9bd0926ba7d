#include "studies/program/run/run_departures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <ostream>

#include "optimizer/candidate/matrices.hpp"
#include "optimizer/departures.hpp"
#include "optimizer/journal/journal.hpp"

namespace dovetail::studies {

std::vector<report::DepartureRecord> departures_of(const RunSite& site, const optimizer::OptimizationResult& result,
                                                   const std::string& fingerprint, const OrderlyInterrupt& interrupt) {
  std::vector<report::DepartureRecord> records;
  const Study& study = site.study;
  if (!site.engine.departed || !study.optimizer.departures || !result.best || interrupt.requested()) return records;
  optimizer::Journal journal = optimizer::Journal::renew(site.directory / "departures.jsonl", fingerprint);
  std::vector<std::size_t> designs{*result.best};
  if (*result.best != 0) designs.push_back(0);
  site.teller.remark() << fmt::format(
                              "dovetail: looking how far {} where friction, force, speed and mismatch are others\n",
                              designs.size() == 1 ? "the best design holds" : "best design and start hold")
                       << std::flush;
  const auto departures = optimizer::usual_departures();
  std::vector<Departed> wanted;
  std::vector<optimizer::Evaluation> found;
  std::vector<bool> known;
  const auto key_of = [](const Departed& one) {
    std::vector<double> key = one.x;
    key.push_back(one.departure);
    return key;
  };
  for (const std::size_t index : designs)
    for (int i = 0; i < static_cast<int>(departures.size()); ++i) {
      wanted.push_back({.x = result.evaluations[index].x, .departure = i});
      const auto record = std::ranges::find(journal.records(), key_of(wanted.back()), &optimizer::JournalRecord::x);
      known.push_back(record != journal.records().end());
      found.push_back(known.back() ? record->evaluation : optimizer::Evaluation{});
    }
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < wanted.size(); ++i)
    if (!known[i]) places.push_back(i);
  // One after the other what has the same matrices: all that leaves those of a design, then one departure of both.
  std::ranges::stable_sort(places, {}, [&](std::size_t place) {
    const int number = wanted[place].departure;
    return optimizer::share_matrices(departures[static_cast<std::size_t>(number)], {}) ? -1 : number;
  });
  std::vector<Departed> asked;
  for (const std::size_t place : places) asked.push_back(wanted[place]);
  int done = 0;
  const auto told = [&](std::size_t place, optimizer::Evaluation evaluation) {
    site.teller.step(++done);
    annotate(study.problem, study.optimizer.constraint_tolerance, evaluation);
    journal.append(key_of(asked[place]), evaluation);
    found[places[place]] = std::move(evaluation);
    known[places[place]] = true;
    return !interrupt.requested();
  };
  if (!asked.empty())
    site.teller.begin("looking where friction, force, speed and mismatch are others",
                      expected_s(site, result, Work::evaluate, asked.size()), static_cast<int>(asked.size()));
  if (site.engine.departed_at_once)
    site.engine.departed_at_once(asked, told);
  else
    for (std::size_t i = 0; i < asked.size(); ++i)
      if (!told(i, site.engine.departed(asked[i].x, asked[i].departure))) break;
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    if (!known[i]) continue;
    const optimizer::Judgement judgement = judge(study.problem, found[i], study.optimizer.constraint_tolerance);
    records.push_back({.evaluation = static_cast<std::int64_t>(designs[i / departures.size()]),
                       .departure = departures[i % departures.size()].name,
                       .status = found[i].status,
                       .objective = judgement.objective,
                       .constraints = judgement.constraints});
  }
  return records;
}

}  // namespace dovetail::studies
