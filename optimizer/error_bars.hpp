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
///   d / (r^p - 1) is left, of which the larger counts (of volume, depth and drift the first): p = 1 for worn volume
///   and depth, 1.15 for slip next to the sharp ends of flanks, 1.7 for drift, 1.8 for the amplitude of the worn joint,
///   2.5 for fillet stresses and frequencies, 4.3 for resultants. Of fillet stresses, what the free surface corrects
///   besides.
/// - contact_grid: d to contact nodes 1.5 times as long on the same mesh: 1.03 d, of the worn amplitude 0.63 d. Worn
///   volumes of zero are asked for on nodes half as long, too, and what a zone as narrow as the nodes at the ends of
///   the contact would wear unseen counts besides.
/// - harmonics, samples: d to 2H+1 and to 2N; errors fall at least like 1/H and 1/N: 2 d.
/// - pseudo_penalty: 1/2 d to half of it, or to twice as much where half has no answer, which acts through the
///   harmonics left out.
/// - modes: d to twice as many: 1.5 d, as the error falls like the square of the first frequency left out.
/// - edge: ends of worn zones that went to and fro between two grids, in proportion to how far.
/// - history: where the wear history decided against the direct method, by how much they differ; where it confirmed
///   what was in doubt, a part of a node at the ends of worn zones, as the history wears off whole nodes; all of the
///   worn shape where it was in doubt and no history came to an end.
/// - search: what the tolerance of the resonance search leaves.
///
/// Harmonics, samples, pseudo-penalty and modes are asked of the first coarse companion that converged, at a fraction
/// of the cost; where they have no answer there, of the next, in the end on the design's own mesh. The bar is the sum.
/// A response without a limit is `unbounded`: the pressure peak at sharp ends of the flanks, and whatever companions
/// none of which converged leave open (with a message).
/// @param builder  of the design's own mesh
/// Cost: six evaluations on coarser meshes and one or two on other grids of contact nodes; each has a budget of its
/// own.
void add_error_bars(const Scene& scene, const ModelBuilder& builder, const CoarseBuilders& builders,
                    CandidateResult& result);

}  // namespace dovetail::optimizer
