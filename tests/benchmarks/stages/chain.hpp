#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "optimizer/evaluator.hpp"
#include "reduction/boundary_basis.hpp"
#include "tests/benchmarks/stages/kernels.hpp"
#include "tests/benchmarks/stages/scenes.hpp"
#include "wear/asymptote/rest.hpp"

namespace dovetail::benchmarks {

/// What the stages of an evaluation leave for those after them. Stages hold references to it.
struct Chain {
  explicit Chain(const BenchmarkScene& of);
  Chain(const Chain&) = delete;
  Chain& operator=(const Chain&) = delete;

  optimizer::Scene scene, previous;  ///< the design, and the one evaluated before it, whose mesh is the reference
  optimizer::Mesher mesher;
  std::vector<fem::FlankCells> grid;    ///< the first one of contact nodes
  optimizer::CandidateModel candidate;  ///< with contact nodes on the first grid
  optimizer::PreloadedContact by;       ///< what stresses the matrices
  optimizer::KeptPatterns patterns{.assembler = {}, .order = std::make_shared<numerics::EliminationOrder>()};
  std::optional<optimizer::MatricesStages> matrices;

  struct Parts {  ///< of a reduction to the trace
    reduction::FullModel full;
    std::shared_ptr<numerics::PartialCholesky> factors;
    std::optional<reduction::FloatingInverse> inverse;
    reduction::FreeModes modes;
    reduction::RitzBasis basis;
    Eigen::Index responses = 0;  ///< static ones, in the basis
  } parts;

  reduction::Reduction reduction;  ///< to the first grid of contact nodes
  optimizer::CandidateModel fitted;
  optimizer::ContactFit fit;
  std::optional<paths::Resonance> unworn, worn;
  std::optional<wear::Rest> rest;

  std::optional<optimizer::SceneEvaluator> evaluator;  ///< of whole evaluations
  std::optional<optimizer::OtherMeshes> others;
  optimizer::CandidateResult result, with_bars;

  [[nodiscard]] bool shares_matrices() const { return scene.solver.prestress == optimizer::Prestress::shared; }
  [[nodiscard]] double trace_size() const;    ///< contact dofs of the trace
  [[nodiscard]] double contact_size() const;  ///< of the first grid of contact nodes
};

/// A stage of an evaluation that can be run alone once those before it have been.
struct Stage {
  Work work;
  std::function<Needs()> needs;  ///< what it cannot do without; asked after it has run
};

/// Geometry to preload; those that an evaluation of the scene does not come through are left out.
[[nodiscard]] std::vector<Stage> model_stages(Chain& chain);
/// Contact fit to worn resonance.
[[nodiscard]] std::vector<Stage> contact_stages(Chain& chain);
/// The whole evaluation as in a search, and error bars.
[[nodiscard]] std::vector<Stage> whole_stages(Chain& chain);

/// Those of which the needs are made, at the sizes of a chain whose contact stages have been run.
[[nodiscard]] std::vector<Kernel> kernels(const Chain& chain);

/// Throws when a stage did not come to its end.
void require(bool done, std::string_view stage, std::string_view status);

}  // namespace dovetail::benchmarks
