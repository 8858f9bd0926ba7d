#pragma once

#include "optimizer/evaluator.hpp"

namespace dovetail::optimizer {

/// The design's scene on a coarser mesh: all sizes 1.5 times as large. In space those of the flanks, the layers and the
/// aerofoil: the rest is as coarse as elements of the sweep allow.
[[nodiscard]] Scene coarsened(Scene scene);

/// Fills error_sources, error_estimates and unbounded of a converged evaluation. How far a response may be from that of
/// infinitely fine settings is asked of companions of the same design, each coarser or finer in one respect. With d the
/// change of a response:
///
/// - mesh: d to a mesh 1.5 times as coarse, with its own contact nodes. With an error of order p, d / (1.5^p - 1) is
///   left: p = 1 for slip next to the sharp ends of flanks and the wear that comes of it, 4/3 for the amplitude of the
///   worn joint, 2 for frequencies and fillet stresses, 4 for resultants. Of fillet stresses, what the free surface
///   corrects besides.
/// - contact_grid: d to contact nodes 1.5 times as long on the same mesh: 1.03 d, of the worn amplitude 0.63 d. Worn
///   volumes of zero are asked for on nodes half as long, too.
/// - harmonics, samples: d to 2H+1 and to 2N; errors fall at least like 1/H and 1/N: 2 d.
/// - pseudo_penalty: 1/2 d to half of it, which acts through the harmonics left out.
/// - modes: d to twice as many: 1.5 d, as the error falls like the square of the first frequency left out.
/// - edge: ends of worn zones that went to and fro between two grids, in proportion to how far.
/// - search: what the tolerance of the resonance search leaves.
///
/// The last four kinds are asked of the coarse companion, which costs a fraction. The bar is the sum. A response
/// without a limit is `unbounded`: the pressure peak at sharp ends of the flanks, and whatever a companion that did not
/// converge leaves open (with a message).
/// @param coarse  makes the models of coarsened(scene). Cost: five evaluations of the coarse scene and one or two on
/// other grids of contact nodes; each has a budget of its own.
void add_error_bars(const Scene& scene, const ModelBuilder& coarse, CandidateResult& result);

}  // namespace dovetail::optimizer
