#include "optimizer/candidate/load_on_grid.hpp"

#include <algorithm>

#include "optimizer/candidate/candidate_result.hpp"
#include "optimizer/candidate/carried_over.hpp"
#include "paths/steady_state.hpp"

namespace dovetail::optimizer {

paths::ResonanceOptions LoadOnGrid::roughly() const {
  paths::ResonanceOptions result = resonance_options(scene());
  result.frequency_tolerance =
      std::max(result.frequency_tolerance, options.of_half_width * scene().loading.damping_ratio);
  return result;
}

bool LoadOnGrid::find_resonance(const NearResonance& near) {
  peak = unworn_resonance(scene(), model(), joint, near, roughly());
  unworn = peak.state;
  return peak.status == Status::converged;
}

NearResonance LoadOnGrid::with_fewer_harmonics() const {
  steady::Joint fewer = joint;
  fewer.options.harmonics = std::min(options.harmonics, joint.options.harmonics);
  fewer.options.samples = std::min(options.samples, joint.options.samples);
  if (fewer.options.harmonics == joint.options.harmonics) return {};
  // Another peak, which a sweep may find, is no way to that of all harmonics.
  paths::ResonanceOptions beside = roughly();
  beside.sweep_range = 0;
  const paths::Resonance found = paths::resonance(fewer, model().glued_frequencies(scene().loading.mode - 1), beside);
  if (found.status != Status::converged) return {};
  return {.omega = found.omega, .displacement = paths::padded(found.state.displacement, joint.options.harmonics)};
}

bool LoadOnGrid::find_first_resonance() {
  const auto& [near, strips, grid] = load->start;
  if (near.displacement.size() == 0) return find_resonance(with_fewer_harmonics());
  return find_resonance({.omega = near.omega, .displacement = carried(near.displacement, strips)});
}

bool LoadOnGrid::find_resonance_again() {
  return find_resonance({.omega = peak.omega, .displacement = unworn.displacement});
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
