#pragma once

#include <string>
#include <vector>

#include "optimizer/problem/evaluation.hpp"
#include "optimizer/problem/problem.hpp"

/// Dakota's files: the parameters at which it asks, and the results that it reads.
namespace dovetail::studies {

/// A parameters file, in Dakota's own or in aprepro format.
struct DakotaQuestion {
  struct Function {
    std::string response;
    int asked = 1;  ///< bits of the active set vector: 1 value, 2 gradient, 4 Hessian
  };
  std::string file;
  std::vector<std::string> set;  ///< KEY=VALUE of its variables
  std::vector<Function> functions;

  [[nodiscard]] bool asks_for_derivatives() const;
};

/// Reads the file. A variable is a key of the study file, perhaps with '_' in place of '.'. Throws InputError when it
/// is something else or names keys or responses there are not.
[[nodiscard]] DakotaQuestion read_dakota(const std::string& file);

/// The results: a value for each function that was asked for; "fail" and why where derivatives were, or the evaluation
/// has no answer.
[[nodiscard]] std::string dakota_results(const DakotaQuestion& question, const optimizer::Evaluation& evaluation,
                                         const optimizer::Problem& problem);

}  // namespace dovetail::studies
