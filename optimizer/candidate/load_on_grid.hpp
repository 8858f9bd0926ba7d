#pragma once

#include <Eigen/Core>
#include <vector>

#include "optimizer/candidate/contact_fit.hpp"
#include "paths/resonance.hpp"
#include "steady/state.hpp"

namespace dovetail::optimizer {

/// A load on the grid of contact nodes at hand, while one is looked for.
struct LoadOnGrid {
  const FlankLoad* load;
  steady::Joint joint;
  GridResonanceOptions options = {};
  paths::Resonance peak = {};  ///< of the first grid, or of the last one
  steady::State unworn = {};   ///< at that frequency

  [[nodiscard]] const Scene& scene() const { return *load->scene; }
  [[nodiscard]] CandidateModel& model() const { return *load->model; }

  /// From where the load says, or from the glued joint. False where there is none.
  [[nodiscard]] bool find_first_resonance();
  /// Next to the last one.
  [[nodiscard]] bool find_resonance_again();
  /// The unworn state on the nodes there are now, from that on those before.
  [[nodiscard]] bool find_unworn(const std::vector<fem::CellStrip>& before);

 private:
  [[nodiscard]] bool find_resonance(const NearResonance& near);
  [[nodiscard]] paths::ResonanceOptions roughly() const;
  /// With few harmonics, where there are more: most of the way from the glued joint at a fraction of the cost.
  [[nodiscard]] NearResonance with_fewer_harmonics() const;
  [[nodiscard]] Eigen::MatrixXd carried(const Eigen::MatrixXd& displacement,
                                        const std::vector<fem::CellStrip>& before) const;
};

}  // namespace dovetail::optimizer
