#pragma once

#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "optimizer/candidate/candidate_result.hpp"
#include "optimizer/responses/response_table.hpp"

namespace dovetail::optimizer {

/// How much of the change of a response by other settings may be left as its error.
using Factor = std::function<double(const Response&)>;

[[nodiscard]] Factor same_for_all(double factor);

/// With an error of order p, d to settings `ratio` times as coarse (as fine below 1) leaves d / |ratio^p - 1|.
[[nodiscard]] double left_over(double order, double ratio);

/// The design at other settings, and what its distance from the reference says.
struct Companion {
  const Evaluation* evaluation;
  Factor factor;
};

/// Gathers the parts of the error bars of a candidate that came through its stages.
class Bars {
 public:
  Bars(const Scene& scene, CandidateResult& result) : scene_(scene), result_(result) {}

  /// The largest that the companions say against `reference`, for every response of the candidate; of those that ended
  /// early, for what they had come to. Where none has an answer the evaluation is not finished.
  void add(const char* source, const std::vector<Companion>& companions, const Evaluation& reference);
  /// For every response that hangs on what is open.
  void add(const char* source, const LeftOpen& open);
  void add(const char* source, const Response& response, double bar) { sources(response)[source] += bar; }
  /// What the computations of responses that have a limit know of their errors.
  void add_own_errors();
  /// All responses of that stage.
  void leave_open(Stage stage);
  /// A joint that does not wear vibrates as it did: its worn responses are at least as uncertain as the others. After
  /// all other bars of them.
  void match_unworn();
  /// Makes them error_estimates, unbounded and status of the evaluation.
  void total();

  /// Whether the candidate answers with it.
  [[nodiscard]] bool asked(const Response& response) const {
    return result_.evaluation.responses.contains(std::string(response.name));
  }
  /// Parts of the bar of a response by their sources.
  [[nodiscard]] std::map<std::string, double>& sources(const Response& response) {
    return result_.evaluation.error_sources[std::string(response.name)];
  }

 private:
  [[nodiscard]] double sum(const Response& response) const;
  /// Responses without a limit, and those whose bar says nothing.
  void leave_unresolved_open();

  const Scene& scene_;
  CandidateResult& result_;
  std::set<std::string> open_;
  std::string missing_;  ///< how the companion ended that has no answer for a response
};

}  // namespace dovetail::optimizer
