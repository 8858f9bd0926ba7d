#include "studies/program/run/run_front.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <ostream>
#include <set>
#include <system_error>

#include "core/replace_file.hpp"
#include "optimizer/journal/journal.hpp"
#include "studies/program/run/candidate_table.hpp"
#include "studies/program/study_file/best_file.hpp"
#include "studies/report/words/report_words.hpp"

namespace dovetail::studies {
namespace {

namespace fs = std::filesystem;
using optimizer::Evaluation;
using report::FrontRecord;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// What the column of an objective holds: its response, or how far that is from where it is wanted.
std::string column_name(const optimizer::ObjectiveTerm& term) {
  std::string name = term.response;
  if (term.absolute && term.target != 0)
    name += fmt::format(" {} {}", term.target > 0 ? "-" : "+", shortest(std::abs(term.target)));
  if (term.absolute) name = "|" + name + "|";
  const bool by_worst = term.over == to_string(optimizer::Over::worst);
  return optimizer::of_case(name, by_worst ? "" : term.over);
}

std::string point_file(std::size_t point, std::size_t points) {
  const auto digits = std::max<std::size_t>(2, std::to_string(points).size());
  return fmt::format("point_{:0{}}.toml", point + 1, digits);
}

double value_in(const std::map<std::string, double>& values, const std::string& name) {
  const auto found = values.find(name);
  return found == values.end() ? kNaN : found->second;
}

}  // namespace

void add_front_bars(const RunSite& site, const std::string& fingerprint, const OrderlyInterrupt& interrupt,
                    optimizer::OptimizationResult& result) {
  if (!result.front || !site.engine.barred || interrupt.requested()) return;
  std::vector<std::vector<double>> terms;
  for (const std::size_t index : result.front->points) terms.push_back(result.evaluations[index].judgement.terms);
  optimizer::Journal journal = optimizer::Journal::renew(site.directory / "front.jsonl", fingerprint);
  std::vector<std::vector<double>> asked;
  std::vector<std::size_t> places;
  // The search takes the direct worn state; what a history makes of it is within the bar.
  const auto take = [&](std::size_t index, const Evaluation& barred) {
    if (!barred.converged()) {  // parts of bars are none
      site.teller.remark() << fmt::format("dovetail: no error bars of evaluation {}: {}\n", index + 1, barred.status)
                           << std::flush;
      return;
    }
    Evaluation& own = result.evaluations[index].evaluation;
    own.error_estimates = barred.error_estimates;
    for (auto& [name, bar] : own.error_estimates) {
      const double moved = value_in(barred.responses, name) - value_in(own.responses, name);
      if (std::isfinite(moved)) bar += std::abs(moved);
    }
    own.error_sources = barred.error_sources;
    own.unbounded = barred.unbounded;
  };
  std::vector<std::size_t> wanted;
  for (const std::size_t point : optimizer::spread(terms, static_cast<std::size_t>(site.study.optimizer.front_points)))
    wanted.push_back(result.front->points[point]);
  if (std::ranges::find(wanted, result.front->compromise) == wanted.end()) wanted.push_back(result.front->compromise);
  for (const std::size_t index : wanted) {
    const std::vector<double>& x = result.evaluations[index].x;
    const auto known = std::ranges::find(journal.records(), x, &optimizer::JournalRecord::x);
    if (known != journal.records().end()) {
      take(index, known->evaluation);
    } else {
      asked.push_back(x);
      places.push_back(index);
    }
  }
  if (asked.empty()) return;
  site.teller.remark() << fmt::format("dovetail: error bars of {} of the {} points of the front\n", asked.size(),
                                      terms.size())
                       << std::flush;
  int done = 0;
  site.teller.begin("error bars of the front", expected_s(site, result, Work::bars, asked.size()),
                    static_cast<int>(asked.size()));
  const auto told = [&](std::size_t place, const Evaluation& evaluation) {
    site.teller.step(++done);
    journal.append(asked[place], evaluation);
    take(places[place], evaluation);
    return !interrupt.requested();
  };
  if (site.engine.barred_at_once)
    site.engine.barred_at_once(asked, told);
  else
    for (std::size_t i = 0; i < asked.size(); ++i)
      if (!told(i, optimizer::evaluated_or_refused([&] { return site.engine.barred(asked[i]); }))) break;
}

FrontRecord front_record(const optimizer::Problem& problem, const optimizer::OptimizationResult& result) {
  FrontRecord record;
  const optimizer::Front& front = *result.front;
  for (std::size_t i = 0; i < problem.objective.size(); ++i) {
    const optimizer::ObjectiveTerm& term = problem.objective[i];
    record.objectives.push_back(column_name(term));
    record.ideal.push_back(as_response(term, {.value = front.ideal[i]}).value);
    record.reference.push_back(as_response(term, {.value = front.reference[i]}).value);
  }
  record.hypervolume = front.hypervolume;
  for (const optimizer::ObjectiveTerm& term : problem.objective)
    record.hypervolume *= (term.scale > 0 ? term.scale : 1) / std::abs(term.weight);
  for (const std::size_t index : front.points) {
    if (index == front.compromise) record.compromise = static_cast<std::int64_t>(record.evaluation.size());
    record.evaluation.push_back(static_cast<std::int64_t>(index));
    const optimizer::Candidate& point = result.evaluations[index];
    const optimizer::JudgementBars bars =
        judgement_bars(problem, point.evaluation.responses, point.evaluation.error_estimates);
    for (std::size_t i = 0; i < problem.objective.size(); ++i) {
      const optimizer::ObjectiveTerm& term = problem.objective[i];
      const auto [value, bar] = as_response(term, {.value = point.judgement.terms[i], .bar = bars.terms[i]});
      record.values.push_back(value);
      record.bars.push_back(bar);
    }
  }
  return record;
}

void write_front(const fs::path& directory, const Study& study, const optimizer::OptimizationResult& result) {
  const fs::path folder = directory / "front";
  std::error_code none;
  std::vector<fs::path> older;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, none))
    if (entry.path().filename().string().starts_with("point_")) older.push_back(entry.path());
  for (const fs::path& file : older) fs::remove(file, none);
  if (!result.front) {
    fs::remove(directory / "front.csv", none);
    return;
  }
  const FrontRecord front = front_record(study.problem, result);
  const std::size_t points = front.evaluation.size();
  std::set<std::string> responses, barred;
  for (const std::int64_t index : front.evaluation) {
    const Evaluation& at = result.evaluations[static_cast<std::size_t>(index)].evaluation;
    for (const auto& [name, value] : at.responses) responses.insert(name);
    for (const auto& [name, bar] : at.error_estimates) barred.insert(name);
  }
  const std::vector<std::string> keys = study.problem.space.keys(), limits = constraint_names(study.problem);
  std::string text = "point,evaluation,study";
  for (const std::string& name : front.objectives) text += ",objective " + name + ",objective " + name + "_bar";
  for (const std::string& key : keys) text += "," + key;
  for (const std::string& name : responses) text += "," + name + (barred.contains(name) ? "," + name + "_bar" : "");
  for (const std::string& name : limits) text += ",constraint " + name;
  text += "\n";
  fs::create_directories(folder);
  const Document document = parse_document(study.text, study.file);
  for (std::size_t point = 0; point < points; ++point) {
    const auto index = static_cast<std::size_t>(front.evaluation[point]);
    const optimizer::Candidate& at = result.evaluations[index];
    const std::string file = point_file(point, points);
    replace_file(folder / file, with_values(document, settings_at(study, at.x)));
    text += fmt::format("{},{},front/{}", point + 1, index + 1, file);
    for (std::size_t i = 0; i < front.columns(); ++i)
      text += "," + table_number(front.value(point, i)) + "," + table_number(front.bar(point, i));
    for (const double x : at.x) text += "," + table_number(x);
    for (const std::string& name : responses) {
      text += "," + table_number(value_in(at.evaluation.responses, name));
      if (barred.contains(name)) text += "," + table_number(value_in(at.evaluation.error_estimates, name));
    }
    for (const double c : at.judgement.constraints) text += "," + table_number(c);
    text += "\n";
  }
  replace_file(directory / "front.csv", text);
}

std::string front_words(const report::RunRecord& record) {
  if (!record.front) return {};
  const FrontRecord& front = *record.front;
  const std::size_t points = front.evaluation.size();
  std::string text =
      fmt::format("front of {}, hypervolume {:.6g} against", report::counted(points, "design"), front.hypervolume);
  for (std::size_t i = 0; i < front.columns(); ++i)
    text += fmt::format("{} {} = {:.4g}", i == 0 ? "" : ",", front.objectives[i], front.reference[i]);
  if (front.hypervolume == 0) text += ", which no point beats in all objectives: give a reference";
  text += "\n";
  for (std::size_t i = 0; i < front.columns(); ++i) {
    double least = kInfinity, most = -kInfinity;
    for (std::size_t point = 0; point < points; ++point) {
      least = std::min(least, front.value(point, i));
      most = std::max(most, front.value(point, i));
    }
    text += fmt::format("  {} from {:.4g} to {:.4g}\n", front.objectives[i], least, most);
  }
  return text;
}

}  // namespace dovetail::studies
