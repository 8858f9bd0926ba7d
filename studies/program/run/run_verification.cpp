#include "studies/program/run/run_verification.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <ostream>
#include <system_error>

#include "optimizer/cases.hpp"
#include "studies/program/engine/engine.hpp"
#include "studies/program/engine/json_values.hpp"
#include "studies/program/engine/pieces.hpp"
#include "studies/program/run/run_output.hpp"
#include "studies/report/record/record_tables.hpp"

namespace dovetail::studies {
namespace {

namespace fs = std::filesystem;
using report::VerificationRecord;

/// Closer than this fraction of every range two designs are one to the eye.
constexpr double kSame = 0.1;

bool alike(const optimizer::DesignSpace& space, const std::vector<double>& a, const std::vector<double>& b) {
  const std::vector<optimizer::DesignVariable>& variables = space.variables();
  for (std::size_t i = 0; i < variables.size(); ++i)
    if (std::abs(a[i] - b[i]) > kSame * (variables[i].upper - variables[i].lower)) return false;
  return true;
}

struct Kept {
  std::vector<double> x;
  VerificationRecord record;
};

std::string line_of(const std::string& fingerprint, const Kept& kept) {
  Json json{{"fingerprint", fingerprint}, {"x", kept.x}};
  json.update(json_of(kept.record));
  json.erase("evaluation");  // another one when the run is resumed
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::vector<Kept> kept_before(const fs::path& file, const std::string& fingerprint) {
  std::vector<Kept> all;
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);) try {
      Json json = Json::parse(line);
      if (json.at("fingerprint") != fingerprint) continue;
      json["evaluation"] = 0;
      Kept kept{.x = json.at("x").get<std::vector<double>>(), .record = {}};
      optimizer::read_json(json, kept.record);
      // A bar that is not known is infinite.
      for (double* bar : {&kept.record.search_bar_m3, &kept.record.history_bar_m3})
        if (std::isnan(*bar)) *bar = kInfinity;
      if (!optimizer::lost_with_its_process(kept.record.status)) all.push_back(std::move(kept));
    } catch (const std::exception&) {
      // Cut short when the program was ended: it is computed again.
    }
  return all;
}

void keep(const fs::path& file, const std::string& line) {
  // Behind a line that was cut short, on a line of its own.
  bool torn = false;
  if (std::ifstream before(file, std::ios::binary | std::ios::ate); before && before.tellg() > 0) {
    before.seekg(-1, std::ios::end);
    torn = before.get() != '\n';
  }
  std::ofstream stream(file, std::ios::app);
  stream << (torn ? "\n" : "") << line << "\n" << std::flush;
  if (!stream) throw std::system_error(errno, std::generic_category(), file.string());
}

}  // namespace

std::vector<std::size_t> best_designs(const optimizer::Problem& problem, const optimizer::OptimizationResult& result,
                                      int count) {
  const std::vector<optimizer::Candidate>& all = result.evaluations;
  std::vector<std::size_t> order, chosen;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (all[i].judgement.feasible) order.push_back(i);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return optimizer::better(all[a].judgement, all[b].judgement); });
  // The best was looked at more closely than the others.
  if (result.best && count > 0) chosen.push_back(*result.best);
  if (result.front) {
    for (std::size_t i = 0; i < problem.objective.size() && static_cast<int>(chosen.size()) < count; ++i) {
      const std::size_t end = *std::ranges::min_element(
          result.front->points, {}, [&](std::size_t point) { return all[point].judgement.terms[i]; });
      if (std::ranges::find(chosen, end) == chosen.end()) chosen.push_back(end);
    }
    return chosen;
  }
  for (const std::size_t i : order) {
    if (static_cast<int>(chosen.size()) >= count) break;
    if (std::none_of(chosen.begin(), chosen.end(),
                     [&](std::size_t better) { return alike(problem.space, all[i].x, all[better].x); }))
      chosen.push_back(i);
  }
  return chosen;
}

std::vector<VerificationRecord> verify_best(const RunSite& site, const optimizer::OptimizationResult& result,
                                            const Study* finer, const std::string& fingerprint,
                                            const OrderlyInterrupt& interrupt) {
  const Study& study = site.study;
  std::vector<VerificationRecord> records;
  if (!site.engine.verify) return records;
  const fs::path file = site.directory / "verification.jsonl";
  const std::vector<Kept> before = kept_before(file, fingerprint);
  const std::vector<std::size_t> chosen = best_designs(study.problem, result, study.optimizer.verify);
  const std::vector<optimizer::LoadCase> alone(1);
  const std::vector<optimizer::LoadCase>& cases = study.problem.cases.empty() ? alone : study.problem.cases;
  std::vector<Verified> wanted;
  std::vector<std::size_t> open;
  for (const std::size_t index : chosen)
    for (std::size_t load = 0; load < cases.size(); ++load) {
      wanted.push_back({.x = result.evaluations[index].x, .load = load});
      VerificationRecord& record = records.emplace_back();
      record.load_case = cases[load].name;
      const auto known = std::ranges::find_if(before, [&](const Kept& kept) {
        return kept.x == wanted.back().x && kept.record.load_case == record.load_case;
      });
      if (known != before.end())
        record = known->record;
      else
        open.push_back(records.size() - 1);
      record.evaluation = static_cast<std::int64_t>(index);
    }
  std::vector<bool> there(records.size(), true);
  for (const std::size_t place : open) there[place] = false;
  int done = 0;
  const auto told = [&](std::size_t place, VerificationRecord found) {
    site.teller.step(++done);
    site.teller.event("verification", {{"evaluation", records[open[place]].evaluation + 1}, {"status", found.status}});
    const std::size_t at = open[place];
    found.load_case = records[at].load_case;
    found.evaluation = records[at].evaluation;
    keep(file, line_of(fingerprint, {.x = wanted[at].x, .record = found}));
    records[at] = std::move(found);
    there[at] = true;
    return !interrupt.requested();
  };
  const auto begins = [&](std::size_t at) {
    const std::string& load = records[at].load_case;
    site.teller.remark() << fmt::format("dovetail: verifying evaluation {}{} by its wear history ({} of {})\n",
                                        records[at].evaluation + 1, load.empty() ? "" : " in case " + load, at + 1,
                                        records.size())
                         << std::flush;
  };
  if (!open.empty())
    site.teller.begin("verifying designs by their wear history", expected_s(site, result, Work::verify, open.size()),
                      static_cast<int>(open.size()));
  if (site.pool != nullptr) {
    std::vector<Verified> asked;
    for (const std::size_t at : open) {
      begins(at);
      asked.push_back(wanted[at]);
    }
    site.pool->prepare(description_of(study, finer));
    verify_at_once(asked, *site.pool, told);
  } else {
    wear::Watcher watcher;
    watcher.stop = [&] { return interrupt.requested(); };
    for (std::size_t place = 0; place < open.size() && !interrupt.requested(); ++place) {
      const Verified& one = wanted[open[place]];
      begins(open[place]);
      const auto scene_of = [&](const Study& of) { return optimizer::in_case(scene_at(of, one.x), cases[one.load]); };
      const optimizer::FinerDesign there_too = finer != nullptr
                                                   ? optimizer::FinerDesign{scene_of(*finer), reference_scene(*finer)}
                                                   : optimizer::FinerDesign{};
      VerificationRecord found = site.engine.verify(scene_of(study), finer != nullptr ? &there_too : nullptr, watcher);
      if (!interrupt.requested()) told(place, std::move(found));  // else not finished: computed again when resumed
    }
  }
  std::vector<VerificationRecord> finished;
  for (std::size_t at = 0; at < records.size(); ++at)
    if (there[at]) finished.push_back(std::move(records[at]));
  return finished;
}

}  // namespace dovetail::studies
