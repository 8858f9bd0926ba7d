#include "paths/ways.hpp"

#include <algorithm>

#include "contact/params.hpp"
#include "paths/dashpots.hpp"

namespace dovetail::paths {
namespace {

using steady::Way;

constexpr contact::PenaltyParams kPenalty;

class Ways {
 public:
  Ways(const steady::Joint& joint, const std::shared_ptr<const steady::Problem>& problem, const WayParams& params)
      : joint_(joint),
        options_(joint.options),
        problem_(problem),
        params_(params),
        method_(options_.solver == "powell"      ? steady::Method::powell
                : options_.solver == "powell_fd" ? steady::Method::powell_fd
                                                 : steady::Method::newton),
        left_(options_.max_rescue_iterations) {}

  Found run(const Eigen::MatrixXd& guess, const std::shared_ptr<const steady::Tangent>& reuse) {
    Found found{.attempt = {}, .way = way_to(guess, reuse)};
    found.attempt = std::move(best_);
    found.attempt.iterations = iterations_;
    found.attempt.evaluations = evaluations_;
    return found;
  }

 private:
  Way way_to(const Eigen::MatrixXd& guess, const std::shared_ptr<const steady::Tangent>& reuse) {
    const auto allowed = [&](Way way) { return way != params_.left_out; };
    if (guess.size() > 0 && allowed(Way::guess) && plain(problem_, guess, method_, reuse)) return Way::guess;
    if (allowed(Way::closed) && plain(problem_, problem_->closed_start(), method_)) return Way::closed;
    if (!options_.penalty_cascade) return Way::none;
    if (allowed(Way::other_penalty) && other_penalty()) return Way::other_penalty;
    if (options_.solver != "auto") return Way::none;
    if (allowed(Way::powell) && plain(problem_, problem_->closed_start(), steady::Method::powell)) return Way::powell;
    struct Rescue {
      Way way;
      bool (Ways::*take)();
      double share;
    };
    for (const auto& [way, take, share] : {Rescue{Way::open, &Ways::open, params_.open},
                                           {Way::harmonics, &Ways::harmonics, params_.harmonics},
                                           {Way::growing_penalty, &Ways::growing_penalty, params_.growing_penalty},
                                           {Way::frequency, &Ways::frequency, params_.frequency},
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

  [[nodiscard]] std::shared_ptr<const dynamics::HarmonicSystem> system(int harmonics, double omega) const {
    if (harmonics == options_.harmonics && omega == problem_->system().omega) return problem_->shared_system();
    return std::make_shared<const dynamics::HarmonicSystem>(dynamics::harmonic_system(*joint_.model, harmonics, omega));
  }

  bool open() {
    steady::Joint joint = joint_;
    joint.condition.released.assign(static_cast<std::size_t>(joint.model->nodes()), 1);
    return neighbour(*problem_, steady::Problem(joint, problem_->shared_system()).closed_start());
  }

  bool harmonics() {
    Eigen::MatrixXd start;
    for (int h = 1; !exhausted(); h = std::min(options_.harmonics, h + 1 + h / 4)) {
      Eigen::MatrixXd padded = Eigen::MatrixXd::Zero(start.rows(), start.size() > 0 ? 2 * h + 1 : 0);
      if (start.size() > 0) padded.leftCols(std::min(start.cols(), padded.cols())) = start;
      steady::Joint joint = joint_;
      joint.options.harmonics = h;
      const bool found = neighbour(steady::Problem(joint, system(h, problem_->system().omega)), padded);
      if (h == options_.harmonics) return found;
      if (found) start = last_.point.displacement;
    }
    return false;
  }

  bool growing_penalty() {
    Eigen::MatrixXd start;
    for (double ratio = params_.smallest_penalty; !exhausted(); ratio = std::min(1.0, 2 * ratio)) {
      if (!neighbour(problem_->with_penalty(ratio), start)) return false;
      if (ratio == 1) return true;
      start = last_.point.displacement;
    }
    return false;
  }

  // From the last solution through the neighbours at `next(step)` to the one at its end; false when steps become too
  // short. `go(target)` tries a neighbour, `here` is where the last solution stands.
  template <class Next, class Go>
  bool step_towards(double end, double& here, const Steps& steps, const Next& next, const Go& go) {
    Eigen::MatrixXd start = last_.point.displacement;
    // Each from the one before as it is: a predictor across the kinks of a contact state misleads more than it helps.
    for (double step = steps.longest; !exhausted() && step > steps.shortest;) {
      const double target = next(step);
      if (!go(target, start)) {
        step /= steps.cut;
        continue;
      }
      if (target == end) return true;
      start = last_.point.displacement;
      here = target;
      step = std::min(steps.longest, step * steps.growth);
    }
    // What the last success left is where another way may go on.
    last_.point.displacement = start;
    return false;
  }

  bool frequency() {
    const double end = problem_->system().omega;
    double omega = params_.highest_frequency * end;
    const auto go = [&](double target, const Eigen::MatrixXd& start) {
      return neighbour(problem_->at(system(options_.harmonics, target)), start);
    };
    for (int tries = 0; !go(omega, {}); ++tries) {
      if (tries == params_.higher || exhausted()) return false;
      omega *= params_.down.growth;
    }
    return step_towards(
        end, omega, params_.down, [&](double step) { return std::max(end, omega * (1 - step)); }, go);
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
      alpha /= 10;
    }
    const auto next = [&](double step) { return alpha * (1 - step) < params_.weakest ? 0 : alpha * (1 - step); };
    if (step_towards(0, alpha, params_.fade, next, go)) return true;
    if (exhausted()) return false;
    branches::FollowOptions curve = params_.curve;
    curve.max_jacobians = left_ - reserve_;
    const Dashpots::Followed followed = dashpots.follow(alpha, last_.point.displacement, curve);
    iterations_ += followed.jacobians;
    evaluations_ += followed.evaluations;
    left_ -= followed.jacobians;
    return followed.displacement.size() > 0 && neighbour(problem, followed.displacement);
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

Found try_ways(const steady::Joint& joint, const std::shared_ptr<const steady::Problem>& problem,
               const Eigen::MatrixXd& guess, const std::shared_ptr<const steady::Tangent>& reuse,
               const WayParams& params) {
  return Ways(joint, problem, params).run(guess, reuse);
}

}  // namespace dovetail::paths
