#include "optimizer/candidate/load_on_grid.hpp"

#include "optimizer/candidate/candidate_result.hpp"
#include "optimizer/candidate/carried_over.hpp"
#include "paths/steady_state.hpp"

namespace dovetail::optimizer {

bool LoadOnGrid::find_resonance(double start, const Eigen::MatrixXd& guess) {
  paths::ResonanceOptions options = resonance_options(scene());
  options.begins_near = guess.size() > 0;
  peak = paths::resonance(joint, start, options, guess);
  unworn = peak.state;
  return peak.status == Status::converged;
}

bool LoadOnGrid::find_first_resonance() {
  const auto& [near, strips, grid] = load->start;
  const auto glued = [this] { return model().glued_frequencies(scene().loading.mode - 1); };
  if (near.displacement.size() == 0) return find_resonance(glued());
  return find_resonance(near.omega, carried(near.displacement, strips)) || find_resonance(glued());
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
