#include "studies/robust/results.hpp"

#include "optimizer/problem/problem.hpp"

namespace dovetail::robust {

optimizer::Barred worst_volume(const studies::Study& study, const optimizer::Evaluation& evaluation) {
  return optimizer::term_value(study.problem, study.problem.objective.front(), evaluation.responses,
                               evaluation.error_estimates);
}

std::vector<LimitLeft> limits(const studies::Study& study, const optimizer::Evaluation& evaluation) {
  const optimizer::JudgementBars bars =
      optimizer::judgement_bars(study.problem, evaluation.responses, evaluation.error_estimates);
  const std::vector<std::string> names = optimizer::constraint_names(study.problem);
  std::vector<LimitLeft> all;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto found = evaluation.constraints.find(names[i]);
    all.push_back({.name = names[i],
                   .value = found == evaluation.constraints.end() ? std::nan("") : found->second,
                   .bar = bars.constraints[i]});
  }
  return all;
}

}  // namespace dovetail::robust
