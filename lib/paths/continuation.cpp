#include "paths/continuation.hpp"

#include <cmath>

#include "paths/steady_state.hpp"

namespace dovetail::paths {

branches::Branch continuation(const steady::Joint& joint, double omega_from, double omega_to,
                              const branches::FollowOptions& options,
                              const std::function<bool(const branches::BranchPoint&)>& progress,
                              const Eigen::MatrixXd& guess) {
  std::vector<Violation> found = violations(options);
  for (const auto& [key, omega] : {std::pair{"omega_from", omega_from}, std::pair{"omega_to", omega_to}})
    if (!kPositive.contains(omega) || !std::isfinite(omega))
      found.push_back({.file = {}, .key = key, .value = shortest(omega), .allowed = kPositive.phrase()});
  if (omega_from == omega_to)
    found.push_back(
        {.file = {}, .key = "omega_to", .value = shortest(omega_to), .allowed = "must differ from omega_from"});
  if (!found.empty()) throw InputError(std::move(found));
  steady::Joint with_tangent = joint;
  with_tangent.options.linearise = true;
  steady::State start = steady_state(with_tangent, omega_from, guess);
  const branches::Equations equations(joint, start.penalty_ratio);
  return branches::follow(equations, std::move(start), {.from = omega_from, .to = omega_to, .back = omega_from},
                          options, progress);
}

}  // namespace dovetail::paths
