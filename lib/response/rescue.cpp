#include "response/rescue.hpp"

#include <algorithm>
#include <limits>

#include "response/dashpots.hpp"
#include "response/problem.hpp"

namespace dovetail::response {
namespace {

class Rescue {
 public:
  Rescue(const std::shared_ptr<const CondensedModel>& model, const std::shared_ptr<const HarmonicSystem>& system,
         const ContactCondition& condition, const SteadyOptions& options, int max_iterations)
      : model_(model), system_(system), condition_(condition), options_(options), left_(max_iterations) {}

  Rescued run() {
    // Shares are of what the ways before have left; with another eps the cheap ways have been tried by the cascade.
    struct Way {
      bool (Rescue::*take)();
      double share, ratio;
    };
    bool found = false;
    for (const auto& [take, share, ratio] : {Way{&Rescue::open, 0.024, 1},
                                             {&Rescue::harmonics, 0.08, 1},
                                             {&Rescue::penalty, 0.03, 1},
                                             {&Rescue::frequency, 0.15, 1},
                                             {&Rescue::damping, 0.4, 1},
                                             {&Rescue::damping, 1, 0.1}}) {
      reserve_ = left_ - static_cast<int>(share * left_);
      ratio_ = ratio;
      if (!spent() && (this->*take)()) {
        found = true;
        break;
      }
    }
    if (found && ratio_ != 1) {
      // From there the most accurate eps is often within reach.
      const Attempt fallback = last_;
      const double ratio = ratio_;
      ratio_ = 1;
      reserve_ = -options_.max_iterations;
      if (!attempt(system_, 1, fallback.displacement)) {
        last_ = fallback;
        ratio_ = ratio;
      }
    }
    // A neighbour's solution is not the problem's.
    if (!found) {
      last_ = Attempt{};
      last_.residual = std::numeric_limits<double>::infinity();
    }
    last_.iterations = iterations_;
    last_.evaluations = evaluations_;
    return {.attempt = std::move(last_), .penalty_ratio = found ? ratio_ : 1};
  }

 private:
  [[nodiscard]] bool spent() const { return left_ <= reserve_ || dovetail::spent(options_.budget); }

  [[nodiscard]] SteadyResidual residual_of(const std::shared_ptr<const HarmonicSystem>& system, double ratio) const {
    const auto harmonics = static_cast<int>(system->harmonics.size()) - 1;
    const numerics::FourierBasis basis(harmonics, options_.samples);
    return steady_problem(model_, system, basis, condition_, options_, ratio);
  }

  // A neighbour of the problem asked for; `start` may be empty (closed contact). True when it converged, kept in last_.
  bool attempt(const std::shared_ptr<const HarmonicSystem>& system, double penalty_ratio,
               const Eigen::MatrixXd& start) {
    if (system->status != Status::converged) return false;
    const SteadyResidual residual = residual_of(system, penalty_ratio);
    last_ = solve(residual, start.size() > 0 ? start : residual.closed_start(), Method::newton, options_.tolerance,
                  std::min(options_.max_iterations, std::max(left_ - reserve_, 1)));
    iterations_ += last_.iterations;
    evaluations_ += last_.evaluations;
    left_ -= last_.iterations;
    return last_.status == Status::converged;
  }

  bool open() {
    ContactCondition released = condition_;
    released.released.assign(static_cast<std::size_t>(model_->nodes()), 1);
    const SteadyResidual free = steady_problem(
        model_, system_, numerics::FourierBasis(options_.harmonics, options_.samples), released, options_, 1);
    return attempt(system_, 1, free.closed_start());
  }

  bool harmonics() {
    Eigen::MatrixXd start;
    for (int h = 1; !spent(); h = std::min(options_.harmonics, h + 1 + h / 4)) {
      Eigen::MatrixXd padded = Eigen::MatrixXd::Zero(start.rows(), start.size() > 0 ? 2 * h + 1 : 0);
      if (start.size() > 0) padded.leftCols(std::min(start.cols(), padded.cols())) = start;
      const bool whole = h == options_.harmonics;
      const auto system =
          whole ? system_ : std::make_shared<const HarmonicSystem>(harmonic_system(*model_, h, system_->omega));
      const bool found = attempt(system, 1, padded);
      if (whole) return found;
      if (found) start = last_.displacement;
    }
    return false;
  }

  bool penalty() {
    constexpr double kSmallest = 1e-3, kFactor = 2;
    Eigen::MatrixXd start;
    for (double ratio = kSmallest; !spent(); ratio = std::min(1.0, ratio * kFactor)) {
      if (!attempt(system_, ratio, start)) return false;
      if (ratio == 1) return true;
      start = last_.displacement;
    }
    return false;
  }

  // In plain steps as far as they go, then along the curve through its turns.
  bool damping() {
    constexpr double kStrongest = 10, kWeakest = 1e-5, kLongest = 0.6, kShortest = 1e-2, kGrowth = 1.3, kCut = 2.5;
    const auto problem = [this](const std::shared_ptr<const HarmonicSystem>& system) {
      return residual_of(system, ratio_);
    };
    Eigen::VectorXd eps(model_->contact_size());
    const SteadyResidual whole = residual_of(system_, 1);
    for (Eigen::Index a = 0; a < eps.size(); ++a) eps(a) = whole.penalty_of(a);
    const Dashpots dashpots(system_, eps, problem);
    double alpha = kStrongest;
    for (int tries = 0; !attempt(dashpots.system(alpha), ratio_, {}); ++tries) {
      if (tries == 2 || spent()) return false;
      alpha /= 10;
    }
    Eigen::MatrixXd start = last_.displacement;
    for (double step = kLongest; !spent() && step > kShortest;) {
      const double next = alpha * (1 - step) < kWeakest ? 0 : alpha * (1 - step);
      if (attempt(dashpots.system(next), ratio_, start)) {
        if (next == 0) return true;
        start = last_.displacement;
        alpha = next;
        step = std::min(kLongest, step * kGrowth);
      } else {
        step /= kCut;
      }
    }
    if (spent()) return false;
    const Dashpots::Followed followed =
        dashpots.follow(alpha, start, options_.tolerance, left_ - reserve_,
                        [&](const Eigen::MatrixXd& near) { return attempt(system_, ratio_, near); });
    iterations_ += followed.jacobians;
    evaluations_ += followed.evaluations;
    left_ -= followed.jacobians;
    return followed.found;
  }

  bool frequency() {
    constexpr double kHighest = 3, kLongest = 0.15, kShortest = 3e-4, kGrowth = 1.3, kCut = 2.5;
    const auto at = [&](double omega) {
      return omega == system_->omega
                 ? system_
                 : std::make_shared<const HarmonicSystem>(harmonic_system(*model_, options_.harmonics, omega));
    };
    double omega = kHighest * system_->omega;
    for (int tries = 0; !attempt(at(omega), ratio_, {}); ++tries) {
      if (tries == 3 || spent()) return false;
      omega *= kGrowth;
    }
    // Each from the one before as it is: a predictor across the kinks of a contact state misleads more than it helps.
    Eigen::MatrixXd start = last_.displacement;
    double step = kLongest;
    while (!spent() && step > kShortest) {
      const double next = std::max(system_->omega, omega * (1 - step));
      if (attempt(at(next), ratio_, start)) {
        if (next == system_->omega) return true;
        start = last_.displacement;
        omega = next;
        step = std::min(kLongest, step * kGrowth);
      } else {
        step /= kCut;
      }
    }
    return false;
  }

  const std::shared_ptr<const CondensedModel>& model_;
  const std::shared_ptr<const HarmonicSystem>& system_;
  const ContactCondition& condition_;
  const SteadyOptions& options_;
  int left_, reserve_ = 0, iterations_ = 0, evaluations_ = 0;
  double ratio_ = 1;  // of eps, on the way being taken
  Attempt last_;
};

}  // namespace

Rescued rescue(const std::shared_ptr<const CondensedModel>& model, const std::shared_ptr<const HarmonicSystem>& system,
               const ContactCondition& condition, const SteadyOptions& options, int max_iterations) {
  return Rescue(model, system, condition, options, max_iterations).run();
}

}  // namespace dovetail::response
