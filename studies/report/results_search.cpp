// The problem and the evaluations by their places in the results file.
#include <limits>
#include <set>

#include "studies/report/results_archive.hpp"

namespace dovetail::report {

namespace {

using NamedValues = std::map<std::string, double>;

/// A column of a list of structs.
template <class T, class Get>
auto column(const std::vector<T>& rows, Get&& get) {
  std::vector<std::decay_t<decltype(get(rows.front()))>> result;
  result.reserve(rows.size());
  for (const T& row : rows) result.push_back(get(row));
  return result;
}

/// Maps of all evaluations as one table: values [E, R], and which of them there are.
void write_maps(Writer& w, const std::string& group, const std::vector<EvaluationRecord>& evaluations,
                NamedValues EvaluationRecord::*member) {
  std::set<std::string> names;
  for (const EvaluationRecord& e : evaluations)
    for (const auto& [name, value] : e.*member) names.insert(name);
  Numbers values, present;
  for (const EvaluationRecord& e : evaluations)
    for (const std::string& name : names) {
      const auto found = (e.*member).find(name);
      const bool known = found != (e.*member).end();
      values.push_back(known ? found->second : std::numeric_limits<double>::quiet_NaN());
      present.push_back(known ? 1 : 0);
    }
  w.texts(group + "/names", {names.begin(), names.end()});
  w.table(group + "/values", values, names.size());
  w.table(group + "/present", present, names.size());
}

void read_maps(const Reader& r, const std::string& group, std::vector<EvaluationRecord>& evaluations,
               NamedValues EvaluationRecord::*member) {
  std::vector<std::string> names;
  Numbers values, present;
  r.texts(group + "/names", names);
  r.table(group + "/values", values, names.size());
  r.table(group + "/present", present, names.size());
  r.require_size(group + "/values", values.size(), names.size() * evaluations.size());
  r.require_size(group + "/present", present.size(), values.size());
  for (std::size_t i = 0; i < values.size(); ++i)
    if (present[i] != 0) (evaluations[i / names.size()].*member)[names[i % names.size()]] = values[i];
}

}  // namespace

void write_problem(Writer& w, const optimizer::Problem& problem) {
  using optimizer::DesignVariable, optimizer::ObjectiveTerm, optimizer::ResponseConstraint;
  const std::vector<DesignVariable>& v = problem.space.variables();
  w.texts("/problem/variables/key", column(v, [](const DesignVariable& d) { return d.key; }));
  w.numbers("/problem/variables/lower", column(v, [](const DesignVariable& d) { return d.lower; }));
  w.numbers("/problem/variables/upper", column(v, [](const DesignVariable& d) { return d.upper; }));
  w.numbers("/problem/variables/start", column(v, [](const DesignVariable& d) { return d.start; }));
  const std::vector<ObjectiveTerm>& o = problem.objective;
  w.texts("/problem/objective/response", column(o, [](const ObjectiveTerm& t) { return t.response; }));
  w.numbers("/problem/objective/weight", column(o, [](const ObjectiveTerm& t) { return t.weight; }));
  w.numbers("/problem/objective/scale", column(o, [](const ObjectiveTerm& t) { return t.scale; }));
  w.wholes("/problem/objective/absolute", column(o, [](const ObjectiveTerm& t) { return std::int64_t{t.absolute}; }));
  const std::vector<ResponseConstraint>& c = problem.constraints;
  constexpr static double kNone = std::numeric_limits<double>::quiet_NaN();
  w.texts("/problem/constraints/response", column(c, [](const ResponseConstraint& r) { return r.response; }));
  w.numbers("/problem/constraints/lower",
            column(c, [](const ResponseConstraint& r) { return r.lower.value_or(kNone); }));
  w.numbers("/problem/constraints/upper",
            column(c, [](const ResponseConstraint& r) { return r.upper.value_or(kNone); }));
  w.wholes("/problem/constraints/has_lower",
           column(c, [](const ResponseConstraint& r) { return std::int64_t{r.lower.has_value()}; }));
  w.wholes("/problem/constraints/has_upper",
           column(c, [](const ResponseConstraint& r) { return std::int64_t{r.upper.has_value()}; }));
  w.numbers("/problem/constraints/scale", column(c, [](const ResponseConstraint& r) { return r.scale; }));
  w.wholes("/problem/constraints/absolute",
           column(c, [](const ResponseConstraint& r) { return std::int64_t{r.absolute}; }));
  w.texts("/problem/constraint_names", constraint_names(problem));
}

void read_problem(const Reader& r, optimizer::Problem& problem) {
  std::vector<std::string> names;
  Numbers a, b, c;
  std::vector<std::int64_t> has_lower, has_upper, absolute;
  const auto require = [&](const std::string& group, std::initializer_list<std::size_t> sizes) {
    for (const std::size_t size : sizes) r.require_size(group, size, names.size());
  };
  r.texts("/problem/variables/key", names);
  r.numbers("/problem/variables/lower", a);
  r.numbers("/problem/variables/upper", b);
  r.numbers("/problem/variables/start", c);
  require("/problem/variables", {a.size(), b.size(), c.size()});
  std::vector<optimizer::DesignVariable> variables;
  for (std::size_t i = 0; i < names.size(); ++i)
    variables.push_back({.key = names[i], .lower = a[i], .upper = b[i], .start = c[i]});
  problem.space = optimizer::DesignSpace(std::move(variables));

  r.texts("/problem/objective/response", names);
  r.numbers("/problem/objective/weight", a);
  r.numbers("/problem/objective/scale", b);
  r.wholes("/problem/objective/absolute", absolute);
  require("/problem/objective", {a.size(), b.size(), absolute.size()});
  for (std::size_t i = 0; i < names.size(); ++i)
    problem.objective.push_back({.response = names[i], .weight = a[i], .scale = b[i], .absolute = absolute[i] != 0});

  r.texts("/problem/constraints/response", names);
  r.numbers("/problem/constraints/lower", a);
  r.numbers("/problem/constraints/upper", b);
  r.numbers("/problem/constraints/scale", c);
  r.wholes("/problem/constraints/has_lower", has_lower);
  r.wholes("/problem/constraints/has_upper", has_upper);
  r.wholes("/problem/constraints/absolute", absolute);
  require("/problem/constraints", {a.size(), b.size(), c.size(), has_lower.size(), has_upper.size(), absolute.size()});
  for (std::size_t i = 0; i < names.size(); ++i) {
    optimizer::ResponseConstraint constraint{
        .response = names[i], .lower = {}, .upper = {}, .scale = c[i], .absolute = absolute[i] != 0};
    if (has_lower[i] != 0) constraint.lower = a[i];
    if (has_upper[i] != 0) constraint.upper = b[i];
    problem.constraints.push_back(std::move(constraint));
  }
}

void write_evaluations(Writer& w, const RunRecord& record) {
  using E = EvaluationRecord;
  const std::vector<E>& all = record.evaluations;
  const std::size_t variables = record.problem.space.size(), limits = constraint_names(record.problem).size();
  Numbers x, constraints;
  std::vector<std::int64_t> message_evaluation;
  std::vector<std::string> message_text;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all[i].x.size() != variables || all[i].constraints.size() != limits)
      throw InputError({.file = {},
                        .key = "evaluation " + std::to_string(i),
                        .value = {},
                        .allowed = "must have one value for each variable and limit of the problem"});
    x.insert(x.end(), all[i].x.begin(), all[i].x.end());
    constraints.insert(constraints.end(), all[i].constraints.begin(), all[i].constraints.end());
    for (const std::string& message : all[i].messages) {
      message_evaluation.push_back(static_cast<std::int64_t>(i));
      message_text.push_back(message);
    }
  }
  w.table("/evaluations/x", x, variables);
  w.table("/evaluations/constraints", constraints, limits);
  w.texts("/evaluations/phase", column(all, [](const E& e) { return e.phase; }));
  w.texts("/evaluations/status", column(all, [](const E& e) { return e.status; }));
  w.wholes("/evaluations/feasible", column(all, [](const E& e) { return std::int64_t{e.feasible}; }));
  w.numbers("/evaluations/objective", column(all, [](const E& e) { return e.objective; }));
  w.numbers("/evaluations/violation", column(all, [](const E& e) { return e.violation; }));
  w.numbers("/evaluations/seconds", column(all, [](const E& e) { return e.seconds; }));
  w.wholes("/evaluations/messages/evaluation", message_evaluation);
  w.texts("/evaluations/messages/text", message_text);
  write_maps(w, "/evaluations/responses", all, &E::responses);
  write_maps(w, "/evaluations/error_estimates", all, &E::error_estimates);
  write_maps(w, "/evaluations/rules", all, &E::rules);
}

void read_evaluations(const Reader& r, RunRecord& record) {
  const std::size_t variables = record.problem.space.size(), limits = constraint_names(record.problem).size();
  Numbers x, constraints, objective, violation, seconds;
  std::vector<std::string> phase, status, message_text;
  std::vector<std::int64_t> feasible, message_evaluation;
  r.table("/evaluations/x", x, variables);
  r.table("/evaluations/constraints", constraints, limits);
  r.texts("/evaluations/phase", phase);
  r.texts("/evaluations/status", status);
  r.wholes("/evaluations/feasible", feasible);
  r.numbers("/evaluations/objective", objective);
  r.numbers("/evaluations/violation", violation);
  r.numbers("/evaluations/seconds", seconds);
  r.wholes("/evaluations/messages/evaluation", message_evaluation);
  r.texts("/evaluations/messages/text", message_text);
  const std::size_t count = status.size();
  r.require_size("/evaluations/x", x.size(), count * variables);
  r.require_size("/evaluations/constraints", constraints.size(), count * limits);
  for (const std::size_t size : {phase.size(), feasible.size(), objective.size(), violation.size(), seconds.size()})
    r.require_size("/evaluations", size, count);
  r.require_size("/evaluations/messages", message_text.size(), message_evaluation.size());

  std::vector<EvaluationRecord>& all = record.evaluations;
  all.resize(count);
  const auto row = [](const Numbers& table, std::size_t i, std::size_t columns) {
    const auto begin = table.begin() + static_cast<std::ptrdiff_t>(i * columns);
    return Numbers(begin, begin + static_cast<std::ptrdiff_t>(columns));
  };
  for (std::size_t i = 0; i < count; ++i) {
    all[i].x = row(x, i, variables);
    all[i].constraints = row(constraints, i, limits);
    all[i].phase = phase[i];
    all[i].status = status[i];
    all[i].feasible = feasible[i] != 0;
    all[i].objective = objective[i];
    all[i].violation = violation[i];
    all[i].seconds = seconds[i];
  }
  for (std::size_t i = 0; i < message_text.size(); ++i) {
    if (message_evaluation[i] < 0 || message_evaluation[i] >= static_cast<std::int64_t>(count))
      r.refuse("/evaluations/messages/evaluation", std::to_string(message_evaluation[i]),
               "must be indices of evaluations");
    all[static_cast<std::size_t>(message_evaluation[i])].messages.push_back(message_text[i]);
  }
  read_maps(r, "/evaluations/responses", all, &EvaluationRecord::responses);
  read_maps(r, "/evaluations/error_estimates", all, &EvaluationRecord::error_estimates);
  read_maps(r, "/evaluations/rules", all, &EvaluationRecord::rules);
}

}  // namespace dovetail::report
