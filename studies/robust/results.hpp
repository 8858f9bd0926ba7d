#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "optimizer/problem/evaluation.hpp"
#include "optimizer/problem/load_case.hpp"
#include "studies/program/study_file/study.hpp"
#include "studies/ready_study/program.hpp"

namespace dovetail::robust {

/// One of the designs held against each other.
struct Design {
  std::string name;                                ///< "start", "nominal optimum", "robust optimum"
  std::vector<double> x;                           ///< of the variables, in the unit of the file
  bool keeps_limits = true;                        ///< at the end of its search; else it is the one nearest to them
  std::string end = {};                            ///< how the search ended
  optimizer::Evaluation corners = {};              ///< in every case of the study, with bars, judged
  optimizer::Evaluation samples = {};              ///< in cases of which the search knew nothing
  std::vector<optimizer::Evaluation> forces = {};  ///< in the corners of everything but the force, over it
};

/// Everything the page shows. The studies are one file looked at in other places.
struct Results {
  studies::Study study, samples;
  std::vector<double> forces_n = {};
  std::vector<studies::Study> at_force = {};
  std::vector<Design> designs = {};
  ready_study::Made made = {};
};

/// Worst of the cases of a study, by its first objective; NaN where one is not known.
[[nodiscard]] optimizer::Barred worst_volume(const studies::Study& study, const optimizer::Evaluation& evaluation);

/// A limit over all cases: how far the worst of them is from it, of the limit; NaN where that is not known.
struct LimitLeft {
  std::string name;
  double value = 0, bar = 0;
  [[nodiscard]] bool met() const { return value <= 0; }
  [[nodiscard]] bool met_with_bar() const { return value + (std::isnan(bar) ? 0 : bar) <= 0; }
};
[[nodiscard]] std::vector<LimitLeft> limits(const studies::Study& study, const optimizer::Evaluation& evaluation);

/// Page, table and JSON into a folder.
void write(const std::string& folder, const Results& results);

}  // namespace dovetail::robust
