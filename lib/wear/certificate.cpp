#include "wear/certificate.hpp"

#include <limits>
#include <utility>

#include "response/refined_state.hpp"
#include "response/truncation.hpp"

namespace dovetail::wear {

response::SteadyOptions finer_settings(const response::SteadyOptions& steady) {
  response::SteadyOptions finer = response::more_harmonics(steady);
  if (finer.samples < 2 * steady.samples) finer = response::more_samples(std::move(finer));
  return finer;
}

Certificate certificate(const std::shared_ptr<const response::CondensedModel>& model,
                        const response::ContactCondition& start, const Eigen::VectorXd& depth, double fastest,
                        const response::SteadyState& from, response::SteadyOptions settings) {
  response::ContactCondition condition = start;
  condition.wear_depth = depth;
  settings.linearise = false;
  const response::SteadyState state = response::steady_state(model, from.omega, condition, settings,
                                                             response::padded(from.displacement, settings.harmonics));
  Certificate result{.status = state.status,
                     .remaining = std::numeric_limits<double>::quiet_NaN(),
                     .harmonics = settings.harmonics,
                     .samples = settings.samples,
                     .jacobians = state.iterations};
  if (state.status != Status::converged) return result;
  const double largest = state.wear_rate.size() == 0 ? 0.0 : state.wear_rate.maxCoeff();
  result.remaining = fastest > 0.0 ? largest / fastest : 0.0;
  return result;
}

}  // namespace dovetail::wear
