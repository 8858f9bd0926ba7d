#include "wear/asymptote/certificate.hpp"

#include <limits>
#include <utility>

#include "paths/steady_state.hpp"
#include "quality/truncation.hpp"
#include "wear/measures.hpp"

namespace dovetail::wear {

steady::Options finer_settings(const steady::Options& steady) {
  steady::Options finer = quality::more_harmonics(steady);
  if (finer.samples < 2 * steady.samples) finer = quality::more_samples(std::move(finer));
  return finer;
}

Certificate certificate(steady::Joint joint, double fastest, const steady::State& from) {
  joint.options.linearise = joint.options.show_regular = false;  // `from` was shown to be regular
  const steady::State state =
      paths::steady_state(joint, from.omega, paths::padded(from.displacement, joint.options.harmonics));
  Certificate result{.status = state.status,
                     .remaining = std::numeric_limits<double>::quiet_NaN(),
                     .harmonics = joint.options.harmonics,
                     .samples = joint.options.samples,
                     .jacobians = state.iterations};
  if (state.status != Status::converged) return result;
  result.remaining = fastest > 0.0 ? largest(state.wear_rate) / fastest : 0.0;
  return result;
}

}  // namespace dovetail::wear
