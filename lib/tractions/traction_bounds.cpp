#include "tractions/traction_bounds.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlopt.hpp>
#include <optional>
#include <stdexcept>
#include <vector>

#include "tractions/params.hpp"
#include "tractions/slip_origin_sensitivity.hpp"
#include "tractions/traction_family.hpp"

namespace dovetail {

using tractions::TractionBoundsOptions;

template <>
std::span<const Field<TractionBoundsOptions>> option_table<TractionBoundsOptions>() {
  using O = TractionBoundsOptions;
  static const std::vector<Field<O>> fields{
      {.key = "output", .member = &O::output, .range = {.lower = 0}},
      {.key = "max_solves", .member = &O::max_solves, .range = {.lower = 2}},
      {.key = "tolerance", .member = &O::tolerance, .range = kPositive},
  };
  return fields;
}

}  // namespace dovetail

namespace dovetail::tractions {
namespace {

// A member of the family that was solved for.
struct Member {
  double value = 0;
  steady::State state;
};

class BoundSearch {
  static constexpr SearchParams kParams = {};

 public:
  BoundSearch(FamilyQuantity quantity, const TractionBoundsOptions& bounds)
      : quantity_(std::move(quantity)), bounds_(bounds), limit_(bounds.max_solves) {}

  TractionBounds run(const Eigen::MatrixXd& guess) {
    TractionBounds result;
    Member nominal{.value = 0, .state = quantity_.solve({}, guess)};
    result.solves = quantity_.solves();
    result.status = nominal.state.status;
    if (nominal.state.status != Status::converged) {
      result.reason = "the state with the slip origin given did not converge";
      return result;
    }
    nominal.value = quantity_.value(nominal.state);
    result.nominal = result.minimum = result.maximum = attained(nominal);
    family_.emplace(nominal.state);
    result.stuck_nodes = static_cast<int>(family_->nodes().size());
    if (family_->nodes().empty()) {
      result.reason = "no node stays stuck: there are no residual tractions";
      return result;
    }
    bool cut_short = false;
    for (const double sense : {-1.0, 1.0}) {
      sense_ = sense;
      best_ = nominal;
      // Each side may use what is left in equal parts.
      limit_ = sense < 0 ? (quantity_.solves() + bounds_.max_solves) / 2 : bounds_.max_solves;
      search();
      cut_short = cut_short || exhausted();
      (sense < 0 ? result.minimum : result.maximum) = attained(best_);
    }
    result.solves = quantity_.solves();
    result.failed = failed_;
    result.status = cut_short ? Status::iteration_limit : Status::converged;
    result.reason = cut_short ? "attained values; the search was ended by max_solves"
                              : "attained values: the true range contains them and may be larger";
    return result;
  }

 private:
  [[nodiscard]] bool exhausted() const { return quantity_.solves() >= limit_; }

  // The best member of the family, then of that around it while other nodes stay stuck there: their tractions are free
  // then. Along gradients from many starts first; kinks, where nodes begin to slip, want a search without them.
  void search() {
    for (int round = 0; round < kParams.rounds && !exhausted(); ++round) {
      const double before = best_.value;
      family_.emplace(best_.state);
      if (family_->nodes().empty()) return;
      optimise(nlopt::G_MLSL_LDS, static_cast<int>(kParams.global_share * (limit_ - quantity_.solves())));
      family_.emplace(best_.state);
      if (family_->nodes().empty()) return;
      optimise(nlopt::LN_SBPLX, static_cast<int>(kParams.local_share * (limit_ - quantity_.solves())));
      const double size = std::max(std::abs(before), quantity_.scale(best_.state));
      if (!(sense_ * (best_.value - before) > bounds_.tolerance * size)) return;
    }
  }

  void optimise(nlopt::algorithm algorithm, int solves) {
    const Eigen::MatrixXd& start = family_->nominal();
    nlopt::opt search(algorithm, static_cast<unsigned>(start.size()));
    search.set_lower_bounds(-1);
    search.set_upper_bounds(1);
    search.set_max_objective(&BoundSearch::objective, this);
    search.set_ftol_rel(bounds_.tolerance);
    search.set_maxeval(std::max(solves, 1));
    nlopt::opt climb(nlopt::LD_SLSQP, static_cast<unsigned>(start.size()));
    climb.set_ftol_rel(kParams.climb_gain);
    climb.set_xtol_abs(kParams.climb_step);
    search.set_local_optimizer(climb);
    nlopt_srand(1);
    const Eigen::MatrixXd inside = start.cwiseMax(-1).cwiseMin(1);
    std::vector<double> traction(inside.data(), inside.data() + inside.size());
    double value = 0;
    try {
      search.optimize(traction, value);
    } catch (const nlopt::forced_stop&) {       // what it found is in best_
    } catch (const nlopt::roundoff_limited&) {  // the same
    } catch (const std::runtime_error&) {       // a local search that came to no end: the same
    }
  }

  static double objective(const std::vector<double>& traction, std::vector<double>& gradient, void* self) {
    return static_cast<BoundSearch*>(self)->evaluate(traction, gradient);
  }

  // The member with these tractions, or as near to them as the march lets it come.
  double evaluate(const std::vector<double>& traction, std::vector<double>& gradient) {
    if (exhausted()) throw nlopt::forced_stop();
    const Eigen::Index rows = family_->nominal().rows(), columns = family_->nominal().cols();
    const Eigen::MatrixXd origin = family_->slip_origin(
        TractionFamily::admissible(Eigen::Map<const Eigen::MatrixXd>(traction.data(), rows, columns)));
    const Eigen::MatrixXd change = origin - origin_of(best_);
    Member member{
        .value = 0,
        .state = quantity_.solve(origin, best_.state.displacement + response_to_slip_origin(best_.state, change))};
    std::fill(gradient.begin(), gradient.end(), 0.0);
    if (member.state.status != Status::converged || !member.state.tangent) {
      ++failed_;
      return -std::numeric_limits<double>::max();
    }
    member.value = quantity_.value(member.state);
    const double value = sense_ * member.value;
    if (!gradient.empty()) {
      const Eigen::MatrixXd slope = sense_ * family_->gradient(quantity_.gradient(member.state));
      std::copy(slope.data(), slope.data() + slope.size(), gradient.begin());
    }
    if (value > sense_ * best_.value) best_ = std::move(member);
    return value;
  }

  [[nodiscard]] static const Eigen::MatrixXd& origin_of(const Member& member) {
    return member.state.tangent->problem().condition().slip_origin;
  }

  [[nodiscard]] AttainedValue attained(const Member& member) const {
    return {.value = member.value,
            .omega = member.state.omega,
            .slip_origin = origin_of(member),
            .traction = mean_tractions(member.state, quantity_.model())};
  }

  FamilyQuantity quantity_;
  const TractionBoundsOptions& bounds_;
  std::optional<TractionFamily> family_;
  double sense_ = 1;
  Member best_;
  int failed_ = 0, limit_ = 0;
};

}  // namespace

TractionBounds traction_bounds(const steady::Joint& joint, double omega, BoundedQuantity quantity,
                               const TractionBoundsOptions& bounds, const Eigen::MatrixXd& guess) {
  std::vector<Violation> found = violations(bounds);
  const auto outputs = static_cast<Eigen::Index>(joint.model->output_names().size());
  if (quantity == BoundedQuantity::amplitude && bounds.output >= outputs)
    found.push_back({.file = {},
                     .key = "output",
                     .value = std::to_string(bounds.output),
                     .allowed = "must be < " + std::to_string(outputs)});
  if (!found.empty()) throw InputError(std::move(found));
  return BoundSearch({joint, quantity, bounds.output, omega}, bounds).run(guess);
}

}  // namespace dovetail::tractions
