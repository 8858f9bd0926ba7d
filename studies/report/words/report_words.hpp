#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "studies/report/record/run_record.hpp"
#include "studies/report/words/units.hpp"

namespace dovetail::report {

/// The evaluation of the start and of the best feasible design, or null.
[[nodiscard]] const EvaluationRecord* baseline_of(const RunRecord& record);
[[nodiscard]] const EvaluationRecord* best_of(const RunRecord& record);

/// Value of a response, its error bar or its unit fit for reading; NaN when absent.
[[nodiscard]] double response(const EvaluationRecord& evaluation, const std::string& name);
[[nodiscard]] double error_bar(const EvaluationRecord& evaluation, const std::string& name);
[[nodiscard]] Unit response_unit(const std::string& name, double largest);

/// "1 evaluation", "2 evaluations".
[[nodiscard]] std::string counted(std::size_t count, const std::string& what);

/// " in its worst case", " in case idle"; nothing where a study has no cases.
[[nodiscard]] std::string over_words(const optimizer::Problem& problem, std::string_view over);

/// "peak_amplitude_m:upper" -> "the upper limit of the peak amplitude (8.0 mm)", or without its number.
[[nodiscard]] std::string limit_words(const std::string& name, const optimizer::Problem& problem,
                                      bool with_number = true);

/// That without its article and number: "peak amplitude, upper".
[[nodiscard]] std::string constraint_words(const optimizer::Problem& problem, const std::string& name);

/// Its name as people write it: "speed \u221210 %".
[[nodiscard]] std::string departure_words(const DepartureRecord& departure);

/// A sentence of the program with names of responses as words.
[[nodiscard]] std::string in_words(std::string text);

/// A value of a variable; what is nothing beside its range is 0.
[[nodiscard]] std::string variable_value(const optimizer::DesignVariable& variable, double value);

/// What a term of the objective is about: "size of the resonance drift in its worst case".
[[nodiscard]] std::string term_words(const optimizer::Problem& problem, const optimizer::ObjectiveTerm& term);

/// What a candidate's term comes to, in the unit of its response and as it is where more is better.
[[nodiscard]] optimizer::Barred shown_term(const optimizer::Problem& problem, const optimizer::ObjectiveTerm& term,
                                           const EvaluationRecord& evaluation);

/// "best", of a front "compromise".
[[nodiscard]] std::string best_word(const RunRecord& record);

/// The objective in words: "asymptotic wear volume" or "weighted sum of ...".
[[nodiscard]] std::string objective_words(const optimizer::Problem& problem);

/// The objective in the unit of its response, or as it is when it is a sum; of a front the first one.
struct ObjectiveScale {
  double factor = 1;  ///< shown = factor * objective
  std::string unit;
  std::string label = "objective";
};
[[nodiscard]] ObjectiveScale objective_scale(const RunRecord& record);

/// Whether a candidate keeps its limits and rules on the mesh of the search, whatever finer ones say.
[[nodiscard]] bool keeps_all(const EvaluationRecord& evaluation);

/// "with 96 edges along each flank"
[[nodiscard]] std::string mesh_words(const FinerRecord& look);

/// A limit, geometric rule or bound that holds the best design.
struct Holder {
  std::string what;   ///< "the upper limit of the peak amplitude (8 mm)"
  std::string where;  ///< of a limit that only a finer mesh makes one: "with 96 edges along each flank"
  [[nodiscard]] std::string words() const { return where.empty() ? what : what + " " + where; }
};

/// What holds the best design. A limit or rule counts within 0.5 % of its scale, a bound within 0.5 % of the variable's
/// range; on a finer mesh a limit from which the search kept away by what it changes there counts, too.
[[nodiscard]] std::vector<Holder> holding(const RunRecord& record);

/// What the objective or a limit rests on while its value at the best design has no error bar, though others have one.
[[nodiscard]] std::vector<std::string> without_bar(const RunRecord& record);

/// How the run ended, and how many candidates it saw.
[[nodiscard]] std::string ending(const RunRecord& record);

/// The wear law in a sentence, as "Archard wear".
[[nodiscard]] std::string wear_words(const RunRecord& record);

/// "lower" or "upper" when the value is at that bound, else empty.
[[nodiscard]] std::string at_bound(const optimizer::DesignVariable& variable, double value);

/// "a, b and c".
[[nodiscard]] std::string listed(const std::vector<std::string>& items);

}  // namespace dovetail::report
