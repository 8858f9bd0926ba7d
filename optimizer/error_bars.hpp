#pragma once

#include <array>
#include <vector>

#include "optimizer/candidate_model.hpp"

namespace dovetail::optimizer {

struct CandidateResult;

/// How much coarser the meshes are that error bars are asked of. Two, as a response may by accident change little from
/// one to the next.
inline constexpr std::array<double, 2> kCoarser{1.5, 2};

/// The design's scene on a coarser mesh: all sizes `ratio` times as large. In space those of the flanks, the layers and
/// the aerofoil: the rest is as coarse as elements of the sweep allow.
[[nodiscard]] Scene coarsened(Scene scene, double ratio);

/// Makes the models of a study's designs on the coarser meshes, in the order of kCoarser.
class CoarseBuilders {
 public:
  explicit CoarseBuilders(const Scene& reference);
  [[nodiscard]] const ModelBuilder& operator[](std::size_t index) const { return builders_[index]; }

 private:
  std::vector<ModelBuilder> builders_;
};

/// Fills error_sources, error_estimates and unbounded of a converged evaluation. How far a response may be from that of
/// infinitely fine settings is asked of companions of the same design, each coarser or finer in one respect. With d the
/// change of a response:
///
/// - mesh: d to meshes r = 1.5 and 2 times as coarse, with their own contact nodes. With an error of order p,
///   d / (r^p - 1) is left, of which the larger counts (of volume, depth and drift the first): p = 1 for slip next to
///   the sharp ends of flanks and the wear that comes of it, 5/3 for the amplitude of the worn joint, 2 for drift and
///   fillet stresses, 2.5 for frequencies, 4 for resultants. Of fillet stresses, what the free surface corrects
///   besides.
/// - contact_grid: d to contact nodes 1.5 times as long on the same mesh: 1.03 d, of the worn amplitude 0.63 d. Worn
///   volumes of zero are asked for on nodes half as long, too.
/// - harmonics, samples: d to 2H+1 and to 2N; errors fall at least like 1/H and 1/N: 2 d.
/// - pseudo_penalty: 1/2 d to half of it, or to twice as much where half has no answer, which acts through the
///   harmonics left out.
/// - modes: d to twice as many: 1.5 d, as the error falls like the square of the first frequency left out.
/// - edge: ends of worn zones that went to and fro between two grids, in proportion to how far.
/// - history: where the wear history decided against the direct method, by how much they differ, as nodes end where the
///   direct method has its edges; all of the worn shape where it was in doubt and no history came to an end.
/// - search: what the tolerance of the resonance search leaves.
///
/// Harmonics, samples, pseudo-penalty and modes are asked of the first coarse companion that converged, at a fraction
/// of the cost. The bar is the sum. A response without a limit is `unbounded`: the pressure peak at sharp ends of the
/// flanks, and whatever a companion that did not converge leaves open (with a message).
/// Cost: six evaluations on coarser meshes and one or two on other grids of contact nodes; each has a budget of its
/// own.
void add_error_bars(const Scene& scene, const CoarseBuilders& builders, CandidateResult& result);

}  // namespace dovetail::optimizer
