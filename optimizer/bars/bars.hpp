#pragma once

#include <functional>
#include <set>
#include <string>
#include <vector>

#include "optimizer/problem/evaluation.hpp"

namespace dovetail::optimizer {

/// How much of the change of a response by other settings may be left as its error.
using Factor = std::function<double(const std::string& response)>;

[[nodiscard]] Factor same_for_all(double factor);

/// With an error of order p, d to settings `ratio` times as coarse (as fine below 1) leaves d / |ratio^p - 1|.
[[nodiscard]] double left_over(double order, double ratio);

/// The design at other settings, and what its distance from the reference says.
struct Companion {
  const Evaluation* evaluation;
  Factor factor;
};

/// Gathers the parts of the error bars of an evaluation.
class Bars {
 public:
  explicit Bars(Evaluation& evaluation) : evaluation_(evaluation) {}

  /// The largest that the companions say against `reference`, for every response of the evaluation; of those that ended
  /// early, for what they had come to. Where none has an answer the evaluation is not finished.
  void add(const char* source, const std::vector<Companion>& companions, const Evaluation& reference);
  void add(const char* source, const std::string& response, double bar);
  /// Sum of what has been added for a response.
  [[nodiscard]] double sum(const std::string& response) const;
  void leave_open(const std::string& response) { open_.insert(response); }
  /// Makes them error_estimates, unbounded and status of the evaluation.
  void total();

 private:
  Evaluation& evaluation_;
  std::set<std::string> open_;
  std::string missing_;  ///< how the companion ended that has no answer for a response
};

}  // namespace dovetail::optimizer
