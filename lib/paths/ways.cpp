#include "paths/ways.hpp"

#include <algorithm>

#include "contact/params.hpp"
#include "paths/dashpots.hpp"
#include "paths/steady_state.hpp"

namespace dovetail::paths {
namespace {

using steady::Way;

constexpr contact::PenaltyParams kPenalty;

steady::Method method_of(steady::Solver solver) {
  switch (solver) {
    case steady::Solver::automatic:
    case steady::Solver::newton:
      return steady::Method::newton;
    case steady::Solver::powell:
      return steady::Method::powell;
    case steady::Solver::powell_fd:
      return steady::Method::powell_fd;
  }
  return steady::Method::newton;
}

class Ways {
 public:
  Ways(const steady::Joint& joint, const std::shared_ptr<const steady::Problem>& problem, const WayParams& params)
      : joint_(joint),
        options_(joint.options),
        problem_(problem),
        params_(params),
        method_(method_of(options_.solver)),
        left_(options_.max_rescue_iterations) {}

  steady::Attempt run(const Eigen::MatrixXd& guess, const std::shared_ptr<const steady::Tangent>& reuse) {
    const Way way = way_to(guess, reuse);
    static_cast<steady::Work&>(best_) = {.iterations = iterations_, .evaluations = evaluations_, .way = way};
    return std::move(best_);
  }

 private:
  Way way_to(const Eigen::MatrixXd& guess, const std::shared_ptr<const steady::Tangent>& reuse) {
    const auto allowed = [&](Way way) { return way != params_.left_out; };
    if (guess.size() > 0 && allowed(Way::guess) && plain(problem_, guess, method_, reuse)) return Way::guess;
    if (allowed(Way::closed) && plain(problem_, problem_->closed_start(), method_)) return Way::closed;
    if (!options_.penalty_cascade) return Way::none;
    if (allowed(Way::other_penalty) && other_penalty()) return Way::other_penalty;
    if (options_.solver != steady::Solver::automatic) return Way::none;
    struct Rescue {
      Way way;
      bool (Ways::*take)();
      double share;
    };
    for (const auto& [way, take, share] : {Rescue{Way::harmonics, &Ways::harmonics, params_.harmonics},
                                           {Way::damping, &Ways::damping, params_.damping},
                                           {Way::softer_damping, &Ways::softer_damping, params_.softer_damping}}) {
      reserve_ = left_ - static_cast<int>(share * left_);
      if (!allowed(way) || exhausted() || !(this->*take)()) continue;
      best_ = std::move(last_);
      return way;
    }
    return Way::none;
  }

  // An attempt at the problem asked for; the best of those that fail is kept.
  bool plain(const std::shared_ptr<const steady::Problem>& problem, const Eigen::MatrixXd& start, steady::Method method,
             const std::shared_ptr<const steady::Tangent>& reuse = {}) {
    if (spent(options_.budget)) return false;
    steady::Attempt found = count(steady::solve(problem, start, method, options_.max_iterations, reuse));
    const bool converged = found.status == Status::converged;
    if (converged || best_.point.displacement.size() == 0 || found.residual < best_.residual) best_ = std::move(found);
    return converged;
  }

  // The answer depends slightly on eps: from that of another one the most accurate eps is often within reach.
  bool other_penalty() {
    for (const double ratio : kPenalty.cascade) {
      if (ratio == 1) continue;
      const auto other = std::make_shared<const steady::Problem>(problem_->with_penalty(ratio));
      if (!plain(other, other->closed_start(), method_)) continue;
      const steady::Attempt fallback = best_;
      if (!plain(problem_, fallback.point.displacement, method_)) best_ = fallback;
      return true;
    }
    return false;
  }

  steady::Attempt count(steady::Attempt found) {
    iterations_ += found.iterations;
    evaluations_ += found.evaluations;
    return found;
  }

  [[nodiscard]] bool exhausted() const { return left_ <= reserve_ || spent(options_.budget); }

  // A neighbour of the problem asked for; true when it converged, kept in last_.
  bool neighbour(const steady::Problem& problem, const Eigen::MatrixXd& start) {
    if (problem.system().status != Status::converged) return false;
    const auto shared = std::make_shared<const steady::Problem>(problem);
    last_ = count(steady::solve(shared, start.size() > 0 ? start : problem.closed_start(), steady::Method::newton,
                                std::min(options_.max_iterations, std::max(left_ - reserve_, 1))));
    left_ -= last_.iterations;
    return last_.status == Status::converged;
  }

  bool harmonics() {
    Eigen::MatrixXd start;
    for (int h = 1; !exhausted(); h = std::min(options_.harmonics, h + 1 + h / 4)) {
      steady::Joint joint = joint_;
      joint.options.harmonics = h;
      const auto system = h == options_.harmonics
                              ? problem_->shared_system()
                              : std::make_shared<const dynamics::HarmonicSystem>(
                                    dynamics::harmonic_system(*joint.model, h, problem_->system().omega));
      const bool found = neighbour(steady::Problem(joint, system), start.size() > 0 ? padded(start, h) : start);
      if (h == options_.harmonics) return found;
      if (found) start = last_.point.displacement;
    }
    return false;
  }

  bool damping() { return fade(*problem_); }

  bool softer_damping() {
    if (!fade(problem_->with_penalty(params_.softer))) return false;
    // From there the most accurate eps is often within reach.
    const steady::Attempt fallback = last_;
    reserve_ = -options_.max_iterations;
    if (!neighbour(*problem_, fallback.point.displacement)) last_ = fallback;
    return true;
  }

  // In plain steps as far as they go, then along the curve through its turns.
  bool fade(const steady::Problem& problem) {
    const Dashpots dashpots(problem, problem_->dof_penalty());
    double alpha = params_.strongest;
    const auto go = [&](double target, const Eigen::MatrixXd& start) {
      return neighbour(problem.at(dashpots.system(target)), start);
    };
    for (int tries = 0; !go(alpha, {}); ++tries) {
      if (tries == params_.weaker || exhausted()) return false;
      alpha *= params_.weaker_by;
    }
    Eigen::MatrixXd start = last_.point.displacement;
    // Each from the one before as it is: a predictor across the kinks of a contact state misleads more than it helps.
    for (double step = params_.longest; !exhausted() && step > params_.shortest;) {
      const double target = alpha * (1 - step) < params_.weakest ? 0 : alpha * (1 - step);
      if (!go(target, start)) {
        step /= params_.cut;
        continue;
      }
      if (target == 0) return true;
      start = last_.point.displacement;
      alpha = target;
      step = std::min(params_.longest, step * params_.growth);
    }
    if (exhausted()) return false;
    branches::FollowOptions curve = params_.curve;
    curve.max_jacobians = left_ - reserve_;
    const branches::Branch followed = dashpots.follow(alpha, start, curve);
    iterations_ += followed.jacobians;
    evaluations_ += followed.evaluations;
    left_ -= followed.jacobians;
    return followed.status == Status::converged && neighbour(problem, followed.points.back().state.displacement);
  }

  const steady::Joint& joint_;
  const steady::Options& options_;
  const std::shared_ptr<const steady::Problem>& problem_;
  const WayParams& params_;
  steady::Method method_;
  int left_, reserve_ = 0, iterations_ = 0, evaluations_ = 0;
  steady::Attempt best_, last_;
};

}  // namespace

steady::Attempt try_ways(const steady::Joint& joint, const std::shared_ptr<const steady::Problem>& problem,
                         const Eigen::MatrixXd& guess, const std::shared_ptr<const steady::Tangent>& reuse,
                         const WayParams& params) {
  return Ways(joint, problem, params).run(guess, reuse);
}

}  // namespace dovetail::paths
