#include "optimizer/candidate/load_on_grid.hpp"

#include <algorithm>

#include "optimizer/candidate/candidate_result.hpp"
#include "optimizer/candidate/carried_over.hpp"
#include "optimizer/candidate/params.hpp"
#include "paths/steady_state.hpp"

namespace dovetail::optimizer {

namespace {
constexpr GridResonanceParams kParams = {};
}  // namespace

paths::ResonanceOptions LoadOnGrid::resonance_roughly() const {
  paths::ResonanceOptions options = resonance_options(scene());
  options.frequency_tolerance = std::max(options.frequency_tolerance, kParams.frequency_tolerance);
  return options;
}

bool LoadOnGrid::find_resonance(double start, const Eigen::MatrixXd& guess) {
  paths::ResonanceOptions options = resonance_roughly();
  options.begins_near = guess.size() > 0;
  peak = paths::resonance(joint, start, options, guess);
  unworn = peak.state;
  return peak.status == Status::converged;
}

bool LoadOnGrid::find_first_resonance() {
  const auto& [near, strips, grid] = load->start;
  return (near.displacement.size() > 0 && find_resonance(near.omega, carried(near.displacement, strips))) ||
         find_resonance_from_glued();
}

bool LoadOnGrid::find_resonance_from_glued() {
  const double glued = model().glued_frequencies(scene().loading.mode - 1);
  steady::Joint fewer = joint;
  fewer.options.harmonics = std::min(kParams.harmonics, joint.options.harmonics);
  fewer.options.samples = std::min(kParams.samples, joint.options.samples);
  if (fewer.options.harmonics < joint.options.harmonics) {
    const paths::Resonance first = paths::resonance(fewer, glued, resonance_roughly());
    if (first.status == Status::converged &&
        find_resonance(first.omega, paths::padded(first.state.displacement, joint.options.harmonics)))
      return true;
  }
  return find_resonance(glued);
}

bool LoadOnGrid::find_unworn(const std::vector<fem::CellStrip>& before) {
  unworn = paths::steady_state(joint, peak.omega, carried(unworn.displacement, before));
  return unworn.status == Status::converged;
}

Eigen::MatrixXd LoadOnGrid::carried(const Eigen::MatrixXd& displacement,
                                    const std::vector<fem::CellStrip>& before) const {
  return paths::padded(carried_over(displacement, before, model().cells.strips(), model().condensed->directions()),
                       scene().solver.harmonics);
}

}  // namespace dovetail::optimizer
