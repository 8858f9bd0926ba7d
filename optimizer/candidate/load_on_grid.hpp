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
  paths::Resonance peak = {};  ///< of the first grid, or of the last one
  steady::State unworn = {};   ///< at that frequency

  [[nodiscard]] const Scene& scene() const { return *load->scene; }
  [[nodiscard]] CandidateModel& model() const { return *load->model; }

  /// As closely as edges of worn zones ask for. False where there is none.
  [[nodiscard]] bool find_resonance(double start, const Eigen::MatrixXd& guess = {});
  /// From where the load says, or from the glued joint.
  [[nodiscard]] bool find_first_resonance();
  /// The unworn state on the nodes there are now, from that on those before.
  [[nodiscard]] bool find_unworn(const std::vector<fem::CellStrip>& before);

 private:
  [[nodiscard]] paths::ResonanceOptions resonance_roughly() const;
  /// With few harmonics at first: that is where most of the way is.
  [[nodiscard]] bool find_resonance_from_glued();
  [[nodiscard]] Eigen::MatrixXd carried(const Eigen::MatrixXd& displacement,
                                        const std::vector<fem::CellStrip>& before) const;
};

}  // namespace dovetail::optimizer
