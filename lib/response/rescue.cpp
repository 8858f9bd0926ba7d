#include "response/rescue.hpp"

#include <algorithm>
#include <limits>

#include "response/problem.hpp"

namespace dovetail::response {
namespace {

class Rescue {
 public:
  Rescue(const std::shared_ptr<const CondensedModel>& model, const std::shared_ptr<const HarmonicSystem>& system,
         const ContactCondition& condition, const SteadyOptions& options, int max_iterations)
      : model_(model), system_(system), condition_(condition), options_(options), left_(max_iterations) {}

  Attempt run() {
    // The last way takes what the others leave, and is the one that most often succeeds.
    struct Way {
      bool (Rescue::*take)();
      double share;
    };
    bool found = false;
    for (const auto& [take, share] :
         {Way{&Rescue::open, 0.1}, {&Rescue::harmonics, 0.3}, {&Rescue::penalty, 0.1}, {&Rescue::frequency, 1.0}}) {
      reserve_ = left_ - static_cast<int>(share * left_);
      found = found || (!spent() && (this->*take)());
    }
    // A neighbour's solution is not the problem's.
    if (!found) {
      last_ = Attempt{};
      last_.residual = std::numeric_limits<double>::infinity();
    }
    last_.iterations = iterations_;
    last_.evaluations = evaluations_;
    return std::move(last_);
  }

 private:
  [[nodiscard]] bool spent() const { return left_ <= reserve_; }

  // A neighbour of the problem asked for; `start` may be empty (closed contact). True when it converged, kept in last_.
  bool attempt(const std::shared_ptr<const HarmonicSystem>& system, double penalty_ratio,
               const Eigen::MatrixXd& start) {
    if (system->status != Status::converged) return false;
    const auto harmonics = static_cast<int>(system->harmonics.size()) - 1;
    const SteadyResidual residual = steady_problem(model_, system, numerics::FourierBasis(harmonics, options_.samples),
                                                   condition_, options_, penalty_ratio);
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

  bool frequency() {
    constexpr double kHighest = 3, kLongest = 0.15, kShortest = 3e-4, kGrowth = 1.3, kCut = 2.5;
    const auto at = [&](double omega) {
      return omega == system_->omega
                 ? system_
                 : std::make_shared<const HarmonicSystem>(harmonic_system(*model_, options_.harmonics, omega));
    };
    double omega = kHighest * system_->omega;
    for (int tries = 0; !attempt(at(omega), 1, {}); ++tries) {
      if (tries == 3 || spent()) return false;
      omega *= kGrowth;
    }
    // Each from the one before as it is: a predictor across the kinks of a contact state misleads more than it helps.
    Eigen::MatrixXd start = last_.displacement;
    double step = kLongest;
    while (!spent() && step > kShortest) {
      const double next = std::max(system_->omega, omega * (1 - step));
      if (attempt(at(next), 1, start)) {
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
  Attempt last_;
};

}  // namespace

Attempt rescue(const std::shared_ptr<const CondensedModel>& model, const std::shared_ptr<const HarmonicSystem>& system,
               const ContactCondition& condition, const SteadyOptions& options, int max_iterations) {
  return Rescue(model, system, condition, options, max_iterations).run();
}

}  // namespace dovetail::response
