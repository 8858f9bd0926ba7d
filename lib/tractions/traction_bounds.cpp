#include "tractions/traction_bounds.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <random>

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
      {.key = "starts", .member = &O::starts, .range = {.lower = 0}},
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
  Eigen::MatrixXd traction;  // m of the stuck nodes
  steady::State state;
};

class BoundSearch {
  static constexpr SearchParams kParams = {};

 public:
  BoundSearch(FamilyQuantity quantity, const TractionBoundsOptions& bounds)
      : quantity_(std::move(quantity)), bounds_(bounds), limit_(bounds.max_solves) {}

  TractionBounds run(const Eigen::MatrixXd& guess) {
    TractionBounds result;
    Member nominal{.value = 0, .traction = {}, .state = quantity_.solve({}, guess)};
    result.solves = quantity_.solves();
    result.status = nominal.state.status;
    if (nominal.state.status != Status::converged) {
      result.reason = "the state with the slip origin given did not converge";
      return result;
    }
    nominal.value = quantity_.value(nominal.state);
    scale_ = quantity_.scale(nominal.state);
    family_.emplace(nominal.state);
    nominal.traction = family_->nominal();
    result.nominal = result.minimum = result.maximum = attained(nominal);
    result.stuck_nodes = static_cast<int>(family_->nodes().size());
    if (family_->nodes().empty()) {
      result.reason = "no node stays stuck: there are no residual tractions";
      return result;
    }
    std::vector<Member> members = starts(nominal);
    bool cut_short = exhausted();
    for (const double sense : {-1.0, 1.0}) {
      std::stable_sort(members.begin(), members.end(),
                       [&](const Member& a, const Member& b) { return sense * a.value > sense * b.value; });
      family_.emplace(nominal.state);
      // Each side may use what is left in equal parts.
      limit_ = sense < 0 ? (quantity_.solves() + bounds_.max_solves) / 2 : bounds_.max_solves;
      // The most promising starts and the given state; others lead to the same ends more slowly.
      Member best = members.front();
      for (std::size_t i = 0; i < std::min(kParams.climbs, members.size()); ++i) climb(members[i], sense, best);
      climb(nominal, sense, best);
      poll(sense, best);
      recentre(sense, best);
      cut_short = cut_short || exhausted();
      (sense < 0 ? result.minimum : result.maximum) = attained(best);
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

  // The member with these tractions, or as near to them as the march lets it come.
  std::optional<Member> evaluate(const Eigen::MatrixXd& traction, const Member& from) {
    return evaluate_origin(family_->slip_origin(TractionFamily::admissible(traction)), from);
  }

  [[nodiscard]] static const Eigen::MatrixXd& origin_of(const Member& member) {
    return member.state.tangent->problem().condition().slip_origin;
  }

  // The same by slip origins, however far: a node is stopped by its friction limit.
  std::optional<Member> evaluate_origin(const Eigen::MatrixXd& origin, const Member& from) {
    if (exhausted()) return {};
    const Eigen::MatrixXd& before = origin_of(from);
    Member member;
    member.state =
        quantity_.solve(origin, from.state.displacement + response_to_slip_origin(from.state, origin - before));
    if (member.state.status == Status::converged && slid(member.state) && !exhausted()) {
      // Started from where it ended, the same state has derivatives with respect to all its tractions.
      // A hair inside, lest rounding slips a node that stands at its limit.
      const Eigen::MatrixXd relaxed = family_->slip_origin(0 * family_->nominal());
      Eigen::MatrixXd settled = origin;
      for (const Eigen::Index i : family_->nodes())
        settled.row(i) =
            member.state.slip_end.row(i) + kParams.inside * (relaxed.row(i) - member.state.slip_end.row(i));
      steady::State again = quantity_.solve(settled, member.state.displacement);
      if (again.status == Status::converged) member.state = std::move(again);
    }
    if (member.state.status != Status::converged || !member.state.tangent) {
      ++failed_;
      return {};
    }
    member.value = quantity_.value(member.state);
    member.traction = family_->traction(member.state);
    return member;
  }

  // A node of the family slipped before it stuck for good.
  [[nodiscard]] bool slid(const steady::State& state) const {
    return std::any_of(family_->nodes().begin(), family_->nodes().end(), [&](Eigen::Index i) {
      return state.nodes[static_cast<std::size_t>(i)].stuck &&
             !state.tangent->point().nodes[static_cast<std::size_t>(i)].always_stuck;
    });
  }

  // Few tractions are tried on a grid; many with all to one side, then in turn at random corners and inside them:
  // where nothing slips a response has no gradient to follow.
  std::vector<Member> starts(const Member& nominal) {
    std::vector<Member> members{nominal};
    const Eigen::Index rows = nominal.traction.rows(), columns = nominal.traction.cols(), size = rows * columns;
    std::vector<Eigen::MatrixXd> points{Eigen::MatrixXd::Zero(rows, columns)};
    if (size <= 2) {
      for (int p = 0; p < (size == 1 ? kParams.grid : kParams.grid * kParams.grid); ++p) {
        Eigen::MatrixXd point(rows, columns);
        for (Eigen::Index j = 0; j < size; ++j) point(j) = -1 + 0.5 * (j == 0 ? p % kParams.grid : p / kParams.grid);
        points.push_back(point);
      }
    } else {
      std::mt19937 random(1);
      std::uniform_real_distribution<double> uniform(-1, 1);
      for (int p = 0; p < bounds_.starts; ++p) {
        Eigen::MatrixXd point(rows, columns);
        for (Eigen::Index j = 0; j < size; ++j)
          point(j) = p < 2 * columns ? (j / rows == p / 2 ? (p % 2 == 0 ? 1.0 : -1.0) : 0.0)
                     : p % 2 == 0    ? (random() % 2 == 0 ? 1.0 : -1.0)
                                     : uniform(random);
        points.push_back(point);
      }
    }
    for (const Eigen::MatrixXd& point : points)
      if (std::optional<Member> member = evaluate(point, nominal)) members.push_back(std::move(*member));
    return members;
  }

  // Towards the corners that each node's gradient points to, in tractions and in slip origins, and along the gradient.
  // Moving tractions keeps the others where they are in a linear body; moving slip origins lets others follow, which at
  // their limits they do without slipping.
  void climb(Member at, double sense, Member& best) {
    for (int step = 0; step < kParams.steps && !exhausted(); ++step) {
      const Eigen::MatrixXd by_origin = sense * quantity_.gradient(at.state);
      const Eigen::MatrixXd slope = family_->gradient(by_origin);
      const double largest = slope.rowwise().norm().maxCoeff();
      if (!(largest > 0)) break;
      const Eigen::MatrixXd corner = directions(slope, at.traction);
      const Eigen::MatrixXd push = family_->reach().asDiagonal() * directions(by_origin, 0 * by_origin);
      bool gained = false;
      const auto take = [&](std::optional<Member> next) {
        if (!next || !gains(sense, next->value, at.value)) return false;
        at = std::move(*next);
        return gained = true;
      };
      for (const double part : {1.0, 0.5, 0.2})
        if (gained || take(evaluate(at.traction + part * (corner - at.traction), at))) break;
      for (const double part : {1.0, 0.2, 0.04})
        if (gained || take(evaluate_origin(origin_of(at) + part * push, at))) break;
      for (const double length : {0.2, 0.05, 0.01})
        if (gained || take(evaluate(at.traction + length / largest * slope, at))) break;
      if (!gained) break;
    }
    if (sense * (at.value - best.value) > 0) best = std::move(at);
  }

  // Each row of length 1, or that of `otherwise` where it is zero.
  static Eigen::MatrixXd directions(const Eigen::MatrixXd& rows, const Eigen::MatrixXd& otherwise) {
    Eigen::MatrixXd result = otherwise;
    for (Eigen::Index i = 0; i < rows.rows(); ++i)
      if (rows.row(i).norm() > 0) result.row(i) = rows.row(i).normalized();
    return result;
  }

  // At kinks, where nodes begin to slip, gradients lead nowhere: tries single slip origins and random tractions.
  void poll(double sense, Member& best) {
    std::mt19937 random(2);
    std::normal_distribution<double> normal;
    const auto take = [&](std::optional<Member> next) {
      if (!next || !gains(sense, next->value, best.value)) return false;
      best = std::move(*next);
      return true;
    };
    for (const double step : {1.0, 0.2, 0.04})
      for (int pass = 0; pass < kParams.polls; ++pass) {
        const double before = best.value;
        for (const Eigen::Index i : family_->nodes())
          for (Eigen::Index r = 0; r < best.traction.cols(); ++r) {
            Eigen::MatrixXd move = Eigen::MatrixXd::Zero(quantity_.model().nodes(), best.traction.cols());
            move(i, r) = step * family_->reach()(i);
            if (!take(evaluate_origin(origin_of(best) + move, best)))
              take(evaluate_origin(origin_of(best) - move, best));
            for (double& entry : move.reshaped()) entry = step * normal(random);
            const Eigen::MatrixXd direction = move(family_->nodes(), Eigen::all);
            if (!take(evaluate(best.traction + direction, best))) take(evaluate(best.traction - direction, best));
          }
        if (!gains(sense, best.value, before)) break;
      }
  }

  // Elsewhere in the family other nodes may stay stuck: their tractions are free there.
  void recentre(double sense, Member& best) {
    for (int round = 0; round < kParams.rounds && !exhausted(); ++round) {
      TractionFamily around(best.state);
      if (around.nodes() == family_->nodes() || around.nodes().empty()) return;
      family_.emplace(std::move(around));
      best.traction = family_->nominal();
      climb(Member(best), sense, best);
      poll(sense, best);
    }
  }

  [[nodiscard]] bool gains(double sense, double value, double over) const {
    return sense * (value - over) > bounds_.tolerance * std::max(std::abs(over), scale_);
  }

  [[nodiscard]] AttainedValue attained(const Member& member) const {
    return {.value = member.value,
            .omega = member.state.omega,
            .slip_origin = member.state.tangent->problem().condition().slip_origin,
            .traction = mean_tractions(member.state, quantity_.model())};
  }

  FamilyQuantity quantity_;
  const TractionBoundsOptions& bounds_;
  std::optional<TractionFamily> family_;
  double scale_ = 0;  // gains are measured against it when it is larger than the value
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
