#include "studies/program/answers/run_verification.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <ostream>
#include <system_error>

#include "studies/program/answers/run_output.hpp"
#include "studies/program/engine/engine.hpp"
#include "studies/program/engine/json_values.hpp"
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
      all.push_back(std::move(kept));
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
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return all[a].judgement.objective < all[b].judgement.objective;
  });
  // The best was looked at more closely than the others.
  if (result.best && count > 0) chosen.push_back(*result.best);
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
  wear::Watcher watcher;
  watcher.stop = [&] { return interrupt.requested(); };
  for (const std::size_t index : chosen) {
    const optimizer::Candidate& candidate = result.evaluations[index];
    const auto known =
        std::find_if(before.begin(), before.end(), [&](const Kept& kept) { return kept.x == candidate.x; });
    VerificationRecord record;
    if (known != before.end()) {
      record = known->record;
    } else {
      if (interrupt.requested()) break;
      site.err << fmt::format("dovetail: verifying evaluation {} by its wear history ({} of {})\n", index + 1,
                              records.size() + 1, chosen.size())
               << std::flush;
      const optimizer::FinerDesign there =
          finer != nullptr ? optimizer::FinerDesign{scene_of(*finer, candidate), reference_scene(*finer)}
                           : optimizer::FinerDesign{};
      record = site.engine.verify(scene_of(study, candidate), finer != nullptr ? &there : nullptr, watcher);
      if (interrupt.requested()) break;  // not finished: computed again when resumed
      keep(file, line_of(fingerprint, {.x = candidate.x, .record = record}));
    }
    record.evaluation = static_cast<std::int64_t>(index);
    records.push_back(std::move(record));
  }
  return records;
}

}  // namespace dovetail::studies
