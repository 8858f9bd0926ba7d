#include "response/traction_bounds.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <random>

#include "response/slip_origin_sensitivity.hpp"
#include "response/traction_family.hpp"

namespace dovetail {

using response::TractionBoundsOptions;

template <>
std::span<const Field<TractionBoundsOptions>> option_table<TractionBoundsOptions>() {
  using Options = TractionBoundsOptions;
  static const std::array fields{
      Field<Options>{.key = "output", .member = &Options::output, .range = {.lower = 0}, .help = "monitored output"},
      Field<Options>{.key = "corners",
                     .member = &Options::corners,
                     .range = {.lower = 0},
                     .help = "corners of the admissible tractions tried as starts"},
      Field<Options>{.key = "max_solves",
                     .member = &Options::max_solves,
                     .range = {.lower = 2},
                     .help = "steady states or resonances at most"},
      Field<Options>{.key = "tolerance",
                     .member = &Options::tolerance,
                     .range = kPositive,
                     .help = "relative gain below which a climb ends"},
      Field<Options>{.key = "resonance_search_range",
                     .member = &Options::resonance_search_range,
                     .range = {.lower = 0, .upper = 1, .lower_open = true, .upper_open = true},
                     .help = "largest relative move of a resonance"},
  };
  return fields;
}

}  // namespace dovetail

namespace dovetail::response {
namespace {

// A member of the family that was solved for.
struct Member {
  double value = 0;
  Eigen::MatrixXd traction;  // m of the stuck nodes
  SteadyState state;
};

class Search {
 public:
  Search(std::shared_ptr<const CondensedModel> model, double omega, ContactCondition condition, SteadyOptions options,
         BoundedQuantity quantity, const TractionBoundsOptions& bounds)
      : model_(std::move(model)),
        omega_(omega),
        condition_(std::move(condition)),
        options_(std::move(options)),
        quantity_(quantity),
        bounds_(bounds) {
    options_.linearise = true;
  }

  TractionBounds run(const Eigen::MatrixXd& guess) {
    TractionBounds result;
    Member nominal{.value = 0, .traction = {}, .state = solve(condition_.slip_origin, guess)};
    result.solves = solves_;
    result.status = nominal.state.status;
    if (nominal.state.status != Status::converged) {
      result.reason = "the state with the slip origin given did not converge";
      return result;
    }
    nominal.value = value(nominal.state);
    omega_ = nominal.state.omega;
    family_.emplace(nominal.state);
    nominal.traction = family_->nominal();
    result.nominal = result.minimum = result.maximum = attained(nominal);
    result.stuck_nodes = static_cast<int>(family_->nodes().size());
    if (family_->nodes().empty()) {
      result.reason = "no node stays stuck: there are no residual tractions";
      return result;
    }
    std::vector<Member> members = starts(nominal);
    for (const double sense : {-1.0, 1.0}) {
      std::stable_sort(members.begin(), members.end(),
                       [&](const Member& a, const Member& b) { return sense * a.value > sense * b.value; });
      // The most promising starts and the given state; others lead to the same ends more slowly.
      constexpr std::size_t kClimbs = 3;
      Member best = members.front();
      for (std::size_t i = 0; i < std::min(kClimbs, members.size()); ++i) climb(members[i], sense, best);
      climb(nominal, sense, best);
      (sense < 0 ? result.minimum : result.maximum) = attained(best);
    }
    result.solves = solves_;
    result.failed = failed_;
    result.status = exhausted() ? Status::iteration_limit : Status::converged;
    result.reason = exhausted() ? "attained values; the search was ended by max_solves"
                                : "attained values: the true range contains them and may be larger";
    return result;
  }

 private:
  [[nodiscard]] bool exhausted() const { return solves_ >= bounds_.max_solves; }

  SteadyState solve(const Eigen::MatrixXd& origin, const Eigen::MatrixXd& guess) {
    ++solves_;
    ContactCondition condition = condition_;
    condition.slip_origin = origin;
    if (quantity_ != BoundedQuantity::resonance_amplitude && quantity_ != BoundedQuantity::resonance_frequency)
      return steady_state(model_, omega_, condition, options_, guess);
    // Members are tracked from the nominal resonance: another peak is no answer.
    const ResonanceOptions near{
        .output = bounds_.output, .search_range = bounds_.resonance_search_range, .sweep_range = 0};
    Resonance found = resonance(model_, omega_, condition, options_, near, guess);
    found.state.status = found.status;
    return std::move(found.state);
  }

  [[nodiscard]] Eigen::VectorXd weights() const {
    const reduction::ContactNodes& contact = model_->contact();
    // Volume is area times depth, so areas cancel.
    return quantity_ == BoundedQuantity::wear_rate ? contact.wear_coefficient : contact.friction;
  }

  [[nodiscard]] double value(const SteadyState& state) const {
    switch (quantity_) {
      case BoundedQuantity::friction_energy:
        return state.friction_energy;
      case BoundedQuantity::wear_rate:
        return model_->contact().area.dot(state.wear_rate);
      case BoundedQuantity::resonance_frequency:
        return state.omega;
      case BoundedQuantity::amplitude:
      case BoundedQuantity::resonance_amplitude:
        break;
    }
    return state.amplitudes(bounds_.output);
  }

  // dq/dm. The amplitude at a resonance is stationary in frequency, so its gradient is that at constant frequency.
  Eigen::MatrixXd gradient(const Member& member) {
    switch (quantity_) {
      case BoundedQuantity::friction_energy:
      case BoundedQuantity::wear_rate:
        return family_->gradient(slip_load_to_slip_origin(member.state, weights()));
      case BoundedQuantity::resonance_frequency:
        return family_->gradient(frequency_gradient(member));
      case BoundedQuantity::amplitude:
      case BoundedQuantity::resonance_amplitude:
        break;
    }
    return family_->gradient(amplitude_to_slip_origin(member.state, bounds_.output));
  }

  // dw/dX = -(d2A/dw dX) / (d2A/dw2), both by central differences of exact first derivatives.
  Eigen::MatrixXd frequency_gradient(const Member& member) {
    Eigen::MatrixXd mixed = Eigen::MatrixXd::Zero(model_->nodes(), model_->directions() - 1);
    double curvature = 0;
    constexpr double kStep = 1e-5;
    for (const double side : {-1.0, 1.0}) {
      ContactCondition condition = condition_;
      condition.slip_origin = member.state.linearisation->residual().condition().slip_origin;
      const SteadyState near =
          steady_state(model_, member.state.omega * (1 + side * kStep), condition, options_, member.state.displacement);
      ++solves_;
      if (near.status != Status::converged) return Eigen::MatrixXd::Zero(mixed.rows(), mixed.cols());
      mixed += side * amplitude_to_slip_origin(near, bounds_.output);
      curvature += side * amplitude_slope(near, bounds_.output).slope;
    }
    return curvature < 0 ? Eigen::MatrixXd(mixed / -curvature) : Eigen::MatrixXd::Zero(mixed.rows(), mixed.cols());
  }

  // The member with these tractions, or as near to them as the march lets it come.
  std::optional<Member> evaluate(const Eigen::MatrixXd& traction, const Member& from) {
    if (exhausted()) return {};
    const Eigen::MatrixXd origin = family_->slip_origin(traction);
    const Eigen::MatrixXd before = from.state.linearisation->residual().condition().slip_origin;
    Member member;
    member.state = solve(origin, from.state.displacement + response_to_slip_origin(from.state, origin - before));
    if (member.state.status == Status::converged && slid(member.state) && !exhausted()) {
      // Started from where it ended, the same state has derivatives with respect to all its tractions.
      Eigen::MatrixXd settled = origin;
      for (const Eigen::Index i : family_->nodes()) settled.row(i) = member.state.slip_end.row(i);
      SteadyState again = solve(settled, member.state.displacement);
      if (again.status == Status::converged) member.state = std::move(again);
    }
    if (member.state.status != Status::converged || !member.state.linearisation) {
      ++failed_;
      return {};
    }
    member.value = value(member.state);
    member.traction = family_->traction(member.state);
    return member;
  }

  // A node of the family slipped before it stuck for good.
  [[nodiscard]] bool slid(const SteadyState& state) const {
    return std::any_of(family_->nodes().begin(), family_->nodes().end(), [&](Eigen::Index i) {
      return state.nodes[static_cast<std::size_t>(i)].stuck &&
             !state.linearisation->state().nodes[static_cast<std::size_t>(i)].always_stuck;
    });
  }

  // Few tractions are tried on a grid; many at corners: all to one side, and random ones.
  std::vector<Member> starts(const Member& nominal) {
    std::vector<Member> members{nominal};
    const Eigen::Index rows = nominal.traction.rows(), columns = nominal.traction.cols(), size = rows * columns;
    std::vector<Eigen::MatrixXd> points{Eigen::MatrixXd::Zero(rows, columns)};
    if (size <= 2) {
      constexpr int kGrid = 5;
      for (int p = 0; p < (size == 1 ? kGrid : kGrid * kGrid); ++p) {
        Eigen::MatrixXd point(rows, columns);
        for (Eigen::Index j = 0; j < size; ++j) point(j) = -1 + 0.5 * (j == 0 ? p % kGrid : p / kGrid);
        points.push_back(point);
      }
    } else {
      std::mt19937 random(1);
      for (int p = 0; p < bounds_.corners; ++p) {
        Eigen::MatrixXd point(rows, columns);
        for (Eigen::Index j = 0; j < size; ++j)
          point(j) = p < 2 * columns ? (j / rows == p / 2 ? (p % 2 == 0 ? 1.0 : -1.0) : 0.0)
                                     : (random() % 2 == 0 ? 1.0 : -1.0);
        points.push_back(point);
      }
    }
    for (const Eigen::MatrixXd& point : points)
      if (std::optional<Member> member = evaluate(TractionFamily::admissible(point), nominal))
        members.push_back(std::move(*member));
    return members;
  }

  // The corner each node's gradient points to, then shorter ways to it and steps along the gradient itself.
  void climb(Member at, double sense, Member& best) {
    constexpr int kSteps = 40;
    for (int step = 0; step < kSteps && !exhausted(); ++step) {
      const Eigen::MatrixXd slope = sense * gradient(at);
      const double largest = slope.rowwise().norm().maxCoeff();
      if (!(largest > 0)) break;
      Eigen::MatrixXd corner = at.traction;
      for (Eigen::Index i = 0; i < corner.rows(); ++i)
        if (slope.row(i).norm() > 0) corner.row(i) = slope.row(i).normalized();
      bool gained = false;
      const auto take = [&](const Eigen::MatrixXd& traction) {
        std::optional<Member> next = evaluate(TractionFamily::admissible(traction), at);
        if (!next || !(sense * (next->value - at.value) > bounds_.tolerance * std::abs(at.value))) return false;
        at = std::move(*next);
        return gained = true;
      };
      for (const double part : {1.0, 0.5, 0.2})
        if (take(at.traction + part * (corner - at.traction))) break;
      for (const double length : {0.2, 0.05, 0.01})
        if (gained || take(at.traction + length / largest * slope)) break;
      if (!gained) break;
    }
    if (sense * (at.value - best.value) > 0) best = std::move(at);
  }

  [[nodiscard]] AttainedValue attained(const Member& member) const {
    return {.value = member.value,
            .omega = member.state.omega,
            .slip_origin = member.state.linearisation->residual().condition().slip_origin,
            .traction = mean_tractions(member.state, model_->contact().friction)};
  }

  std::shared_ptr<const CondensedModel> model_;
  double omega_;
  ContactCondition condition_;
  SteadyOptions options_;
  BoundedQuantity quantity_;
  const TractionBoundsOptions& bounds_;
  std::optional<TractionFamily> family_;
  int solves_ = 0, failed_ = 0;
};

}  // namespace

std::string_view to_string(BoundedQuantity quantity) {
  switch (quantity) {
    case BoundedQuantity::amplitude:
      return "amplitude";
    case BoundedQuantity::friction_energy:
      return "friction_energy";
    case BoundedQuantity::wear_rate:
      return "wear_rate";
    case BoundedQuantity::resonance_amplitude:
      return "resonance_amplitude";
    case BoundedQuantity::resonance_frequency:
      return "resonance_frequency";
  }
  return "unknown";
}

TractionBounds traction_bounds(const std::shared_ptr<const CondensedModel>& model, double omega,
                               const ContactCondition& condition, const SteadyOptions& options,
                               BoundedQuantity quantity, const TractionBoundsOptions& bounds,
                               const Eigen::MatrixXd& guess) {
  std::vector<Violation> found = violations(bounds);
  const bool needs_output = quantity != BoundedQuantity::friction_energy && quantity != BoundedQuantity::wear_rate;
  const auto outputs = static_cast<Eigen::Index>(model->output_names().size());
  if (needs_output && bounds.output >= outputs)
    found.push_back({.file = {},
                     .key = "output",
                     .value = std::to_string(bounds.output),
                     .allowed = "must be < " + std::to_string(outputs)});
  if (!found.empty()) throw InputError(std::move(found));
  return Search(model, omega, condition, options, quantity, bounds).run(guess);
}

}  // namespace dovetail::response
