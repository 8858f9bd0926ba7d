#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "optimizer/accuracy/settings.hpp"
#include "optimizer/problem/evaluation.hpp"
#include "optimizer/responses/response.hpp"

namespace dovetail::optimizer {

/// How accurate which responses have to be: bar over value.
struct AccuracyGoal {
  double relative = 0.02;                   ///< > 0, of all that are held to it
  std::map<std::string, double> of = {};    ///< > 0, of single responses instead
  std::vector<std::string> responses = {};  ///< held to it; empty: all with a value, a bar and a limit
  std::set<std::string> fixed = {};         ///< keys that stay as they are
  /// Of harmonics and samples alone: parts of bars by anything else count neither for nor against.
  bool of_truncation = false;
  /// One of `responses` that a mesh does not resolve is looked for on finer ones; false: it is left out.
  bool resolves = true;
  /// Many evaluations follow at those settings: cheaper ones are worth a round where these are accurate enough.
  bool many = true;

  [[nodiscard]] double asked(const std::string& response) const {
    const auto own = of.find(response);
    return own == of.end() ? relative : own->second;
  }
};

/// The part of a bar that counts most.
struct Dominant {
  std::string response = {}, source = {};
  double relative = 0;  ///< what settings buy of the bar of the response, over its value; infinite where the mesh does
                        ///< not resolve it
  double whole = 0;     ///< the same with what no setting buys, but what a history would settle
  double asked = 0;     ///< the same that was asked for
};

/// Which of the settings a part of a bar falls with.
enum class Knob { none, mesh, beside, harmonics, samples, modes, resonance };

/// Of every knob, over what it is elsewhere: larger is finer.
[[nodiscard]] double finer(Knob knob, const Settings& there, const Settings& here);

/// Parts of the bars of responses, over the values of these, by their sources.
using BarParts = std::map<std::string, std::map<std::string, double>>;

/// Makes bars of an evaluation at least as large as these; responses that have none, or are not resolved, stay so.
void raise_bars(const BarParts& least, Evaluation& evaluation);

/// What evaluations with bars foresee of other settings: bars by the orders in which their parts fall, operations by
/// the powers in which theirs grow.
class Forecast {
 public:
  /// @param scene, goal  outlive it
  Forecast(const Scene& scene, const AccuracyGoal& goal);

  /// The last one is what others are foreseen from. Where one before it differs in a knob the two say the order of a
  /// part. A part that is smaller than its order lets expect after each of the two before counts for the (geometric)
  /// mean of that and of itself.
  /// - `beside`: of each response's bar by the mesh: what the mesh beside the flanks leaves, where it is known
  void add(const Settings& at, const Evaluation& evaluation, const std::map<std::string, double>& beside = {});

  /// Whether the bars of two designs that are the same but for their settings meet, as far as the two evaluations alone
  /// say.
  [[nodiscard]] bool meets(const Forecast& other) const;
  /// Raises bars to where those of `other` begin.
  void reach(const Forecast& other);
  /// Parts that were raised.
  [[nodiscard]] BarParts raised() const;
  /// The orders that a later one came to.
  void take_orders(const Forecast& later);

  /// Responses asked for by name of which nothing is known.
  [[nodiscard]] std::vector<std::string> not_held() const;
  /// Whether the mesh resolves all that is asked of.
  [[nodiscard]] bool resolves() const { return unresolved_.empty(); }
  /// Whether anything is known of what settings buy.
  [[nodiscard]] bool knows() const { return !last_.parts.empty(); }
  /// Largest bar over what is allowed of it, of all that have one.
  [[nodiscard]] double excess(const Settings& there) const;
  [[nodiscard]] std::optional<Dominant> dominant() const;
  /// Of an evaluation without bars, to compare settings by. Counted and not timed, so that the same is chosen on every
  /// machine.
  [[nodiscard]] double operations(const Settings& there) const;

 private:
  struct Part {
    const Response* response;
    std::string source;
    Knob knob;
    double order;
    double share;  ///< of the bar that is allowed
    bool raised = false;
  };

  struct Round {
    Settings at;
    std::vector<Part> parts;  // those of a response one after the other
    [[nodiscard]] const Part* find(const Part& like) const;
  };
  /// By an evaluation alone.
  struct Known {
    double value, bar;
  };

  void add(const Response& response, const Evaluation& evaluation, std::optional<double> beside);
  [[nodiscard]] double order(const Response& response, const std::string& source, Knob knob) const;
  /// Share of a part of the last round by another one; infinite where that says nothing.
  [[nodiscard]] double expected(const Part& of, const Round& by) const;
  void raise(Part& part, double share);

  const Scene* scene_;
  const AccuracyGoal* goal_;
  bool in_space_;
  Round last_, before_;
  std::vector<const Response*> unresolved_;  // responses asked of that the last mesh does not resolve
  double dofs_ = 0;                          // unknowns of the mesh
  double contact_ = 0;                       // operations of all that follows the matrices
  std::map<std::string, Known> known_;
  std::map<std::string, double> whole_;  // bars over values, with what no setting buys but what a history would settle
};

}  // namespace dovetail::optimizer
