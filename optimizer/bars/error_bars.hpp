#pragma once

#include "optimizer/bars/other_meshes.hpp"

namespace dovetail::optimizer {

struct CandidateResult;
struct Computation;

/// Fills error_sources, error_estimates and unbounded of a converged evaluation. How far a response may be from that of
/// infinitely fine settings is asked of companions of the same design, each coarser or finer in one respect. With d the
/// change of a response:
///
/// - mesh: d to a mesh with 1.5 times the edges, with contact nodes of its own, of which an error of order p leaves
///   d / (1 - 1.5^-p). Where a mesh is fine, and in space, d to meshes r = 1.5 and 2 times as coarse, of which d / (r^p
///   - 1) is left; the larger counts, as a response may by accident change little from one to the next; d to a mesh
///   with the same flanks in a section 1.5 times as fine, before wear, counts besides, both on few layers. Orders stand
///   with the responses.
/// - contact_grid: d to contact nodes 1.5 times as long on the same mesh, by the response's order; a quarter of that
///   beside a finer mesh, whose nodes are shorter, too. Worn volumes of zero are asked for on nodes half as long, and
///   what a zone as narrow as the nodes at the ends of the contact would wear unseen counts besides.
/// - harmonics, samples, pseudo_penalty: d to 2H+1, to 2N and to half of the penalty, or to twice as much where half
///   has no answer, by quality::truncation_factors.
/// - modes: d to twice as many: 1.5 d, as the error falls like the square of the first frequency left out.
/// - prestress: d to matrices assembled with the design's own preload, where designs or cases share theirs.
/// - edge: ends of worn zones that went to and fro between two grids, in proportion to how far.
/// - history: where the wear history decided against the direct method, by how much they differ; where it confirmed
///   what was in doubt, a part of a node at the ends of worn zones, as the history wears off whole nodes; all of the
///   worn shape where it was in doubt and no history came to an end.
/// - search: what the tolerance of the resonance search leaves.
///
/// Harmonics, samples, pseudo-penalty, modes and prestress are asked of the coarsest companion that converged, at
/// a fraction of the cost; where they have no answer there, of the next, in the end on the design's own mesh. The bar
/// is the sum. Responses add what their own computation knows of its error. One without a limit is `unbounded`, and
/// whatever companions none of which converged leave open (with a message).
/// - `builder`: of the design's own mesh; `others`: null: bars by harmonics, samples and pseudo-penalty alone, which
/// the design's own mesh is asked for
/// - `how`: the design was computed: what it leaves out has no bars, and companions leave it out, too
///
/// Cost: an evaluation on a finer mesh, six on coarser ones and one or two on other grids of contact nodes; on fine
/// meshes none on a finer one; in space five on coarser meshes and four or five on the design's own. Each has a budget
/// of its own.
void add_error_bars(const Scene& scene, const ModelBuilder& builder, const OtherMeshes* others, const Computation& how,
                    CandidateResult& result);

}  // namespace dovetail::optimizer
