#include "response/steady_state.hpp"

#include <string>

#include "response/problem.hpp"
#include "response/rescue.hpp"
#include "response/solve.hpp"

namespace dovetail::response {
namespace {

// Everything tried for one steady state, in order, until something converges.
class Search {
 public:
  Search(const std::shared_ptr<const CondensedModel>& model, std::shared_ptr<const HarmonicSystem> system,
         const ContactCondition& condition, const SteadyOptions& options)
      : model_(model),
        system_(std::move(system)),
        condition_(condition),
        options_(options),
        basis_(options.harmonics, options.samples) {}

  [[nodiscard]] SteadyResidual problem(double ratio) const {
    return steady_problem(model_, system_, basis_, condition_, options_, ratio);
  }

  // Tries one start; true when it converged. Keeps the attempt if it is the best so far.
  bool attempt(double ratio, const Eigen::MatrixXd& start, Method method,
               const std::shared_ptr<const Linearisation>& reuse = {}) {
    if (spent(options_.budget)) return false;
    const SteadyResidual residual = problem(ratio);
    return keep(solve(residual, start.size() > 0 ? start : residual.closed_start(), method, options_.tolerance,
                      options_.max_iterations, reuse),
                ratio);
  }

  bool keep(Attempt found, double ratio) {
    iterations_ += found.iterations;
    evaluations_ += found.evaluations;
    if (found.status == Status::converged || best_.displacement.size() == 0 || found.residual < best_.residual) {
      best_ = std::move(found);
      ratio_ = ratio;
      return best_.status == Status::converged;
    }
    return false;
  }

  void run(const Eigen::MatrixXd& guess, const std::shared_ptr<const Linearisation>& reuse) {
    const Method first = options_.solver == "powell"      ? Method::powell
                         : options_.solver == "powell_fd" ? Method::powell_fd
                                                          : Method::newton;
    if (guess.size() > 0 && attempt(1, guess, first, reuse)) return;
    if (attempt(1, {}, first)) return;
    if (!options_.penalty_cascade) return;
    for (const double ratio : contact::kPenaltyCascade) {
      if (ratio == 1 || !attempt(ratio, {}, first)) continue;
      // The answer depends slightly on eps: from this one the most accurate eps is often within reach.
      const Attempt fallback = best_;
      if (!attempt(1, fallback.displacement, first)) {
        best_ = fallback;
        ratio_ = ratio;
      }
      return;
    }
    if (options_.solver != "auto" || attempt(1, {}, Method::powell)) return;
    if (options_.max_rescue_iterations > 0) {
      Rescued rescued = rescue(model_, system_, condition_, options_, options_.max_rescue_iterations);
      keep(std::move(rescued.attempt), rescued.penalty_ratio);
    }
  }

  [[nodiscard]] SteadyState result() const {
    const AtSolution jacobian = options_.linearise      ? AtSolution::linearise
                                : options_.show_regular ? AtSolution::show_regular
                                                        : AtSolution::trust;
    SteadyState steady =
        described(problem(ratio_), best_.displacement, best_.status, jacobian, best_.linearisation.get());
    steady.status = within(options_.budget, steady.status);
    steady.iterations = iterations_;
    steady.evaluations = evaluations_;
    steady.penalty_ratio = ratio_;
    return steady;
  }

 private:
  std::shared_ptr<const CondensedModel> model_;
  std::shared_ptr<const HarmonicSystem> system_;
  const ContactCondition& condition_;
  const SteadyOptions& options_;
  numerics::FourierBasis basis_;
  Attempt best_;
  double ratio_ = 1;
  int iterations_ = 0, evaluations_ = 0;
};

}  // namespace

SteadyState steady_state(const std::shared_ptr<const CondensedModel>& model, double omega,
                         const ContactCondition& condition, const SteadyOptions& options, const Eigen::MatrixXd& guess,
                         const std::shared_ptr<const Linearisation>& reuse) {
  validate(options);
  if (!kPositive.contains(omega))
    throw InputError({.file = {}, .key = "omega", .value = shortest(omega), .allowed = kPositive.phrase()});
  const Eigen::Index columns = 2 * options.harmonics + 1;
  if (guess.size() > 0 && (guess.rows() != model->contact_size() || guess.cols() != columns))
    throw InputError({.file = {},
                      .key = "guess",
                      .value = std::to_string(guess.rows()) + " x " + std::to_string(guess.cols()),
                      .allowed = "must be " + std::to_string(model->contact_size()) + " x " + std::to_string(columns)});
  SteadyState without;
  without.omega = omega;
  without.status = Status::budget_spent;
  if (spent(options.budget)) return without;
  auto system = std::make_shared<const HarmonicSystem>(harmonic_system(*model, options.harmonics, omega));
  if (system->status != Status::converged) {
    without.status = system->status;
    return without;
  }
  Search search(model, std::move(system), condition, options);
  search.run(guess, reuse);
  return search.result();
}

}  // namespace dovetail::response
