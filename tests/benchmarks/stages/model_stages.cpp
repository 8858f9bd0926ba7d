#include "fem/flank_trace.hpp"
#include "numerics/nearest_modes.hpp"
#include "optimizer/candidate/contact_nodes.hpp"
#include "optimizer/scene/scene_kind.hpp"
#include "reduction/params.hpp"
#include "tests/benchmarks/stages/chain.hpp"

namespace dovetail::benchmarks {

namespace {

using Sparse = Eigen::SparseMatrix<double>;

double cube(double size) {
  return size * size * size;
}

void lay_mesh(Chain& chain) {
  chain.candidate.mesh = chain.mesher(chain.scene);
  fem::SectorMesh& sector = chain.candidate.mesh.sector;
  sector = fem::with_trace(sector);
  chain.grid = optimizer::cell_grid(chain.scene, sector, optimizer::cell_lengths(chain.scene));
  chain.candidate.cells = fem::contact_cells(sector, chain.grid);
}

/// Of K and M over all nodes, and of both in independent coordinates: each number with its row is written once.
double assembled_bytes(const fem::SectorSystem& system) {
  const auto entries = system.full.stiffness.nonZeros() + system.full.mass.nonZeros() + system.stiffness.nonZeros() +
                       system.mass.nonZeros();
  return static_cast<double>(entries) * static_cast<double>(sizeof(double) + sizeof(int));
}

/// The order of elimination is kept from design to design: found here, it is in no stage.
void find_order(Chain& chain) {
  Eigen::SparseMatrix<double> stiffness = chain.matrices->matrices()->system.stiffness;
  const reduction::FullModel full = chain.matrices->full_model(
      std::move(stiffness), Eigen::SparseMatrix<double>(chain.matrices->matrices()->system.mass));
  (void)numerics::PartialCholesky().factorise(full.stiffness, full.contact_size(), chain.patterns.order.get());
}

void take_matrices(Chain& chain) {
  chain.candidate.matrices =
      optimizer::of_design(chain.scene, chain.candidate.mesh.sector, chain.candidate.cells, chain.matrices->matrices());
  require(chain.candidate.matrices.status == "converged", "matrices", chain.candidate.matrices.status);
}

void factorise(Chain::Parts& parts) {
  parts.factors = std::make_shared<numerics::PartialCholesky>();
  const Status status =
      parts.factors->factorise(parts.full.stiffness, parts.full.contact_size(), parts.full.order.get());
  require(status == Status::converged, "factorisation", to_string(status));
}

void find_modes(const Chain& chain, Chain::Parts& parts) {
  const reduction::FullModel& full = parts.full;
  const Eigen::Index limit = full.internal_size();
  parts.inverse.emplace(*parts.factors, parts.full.mass);
  parts.modes = reduction::free_modes(*parts.inverse, chain.scene.solver.modes, limit,
                                      reduction::ReductionOptions{}.eigen_tolerance);
  require(parts.modes.status == Status::converged, "modes", to_string(parts.modes.status));
  const Eigen::MatrixXd responses =
      reduction::static_responses(full, *parts.inverse, parts.modes, limit - parts.modes.vectors.cols());
  parts.responses = responses.cols();
  Eigen::MatrixXd vectors(full.size(), parts.modes.vectors.cols() + responses.cols());
  vectors << parts.modes.vectors, responses;
  parts.basis = reduction::rayleigh_ritz(full.stiffness, parts.full.mass, vectors);
}

/// Columns that the search for modes solves for, counted in a search of its own.
double solves_for_modes(const Chain& chain, const Chain::Parts& parts) {
  Eigen::Index columns = 0;
  const numerics::ShiftInverse<double> counting{.rows = parts.full.mass.rows(), .solve = [&](const Eigen::MatrixXd& b) {
                                                  columns += b.cols();
                                                  return parts.inverse->apply(b);
                                                }};
  const auto wanted = static_cast<int>(chain.scene.solver.modes - parts.inverse->rigid_modes().cols());
  (void)numerics::nearest_modes(counting, parts.full.mass,
                                {.count = wanted + 1,
                                 .tolerance = reduction::ReductionOptions{}.eigen_tolerance,
                                 .vector_limit = reduction::FloatingParams{}.vector_limit});
  return static_cast<double>(columns + parts.modes.vectors.cols() + parts.responses);
}

Needs sum(Needs a, const Needs& b) {
  for (const auto& [kernel, units] : b) a[kernel] += units;
  return a;
}

/// Of designs with matrices of their own. The parts of a reduction come before the whole of it, whose needs are theirs.
std::vector<Stage> matrices_stages(Chain& chain) {
  Chain::Parts& parts = chain.parts;
  const auto modes = [&] {
    return Needs{{kBackSolve, solves_for_modes(chain, parts)}, {kDenseInverse, cube(chain.trace_size())}};
  };
  // Loads along the soft modes are eliminated, and not substituted.
  const auto trace = [&] {
    return Needs{{kBackSolve, 0.5 * static_cast<double>(parts.modes.soft())},
                 {kDenseInverse, cube(chain.trace_size())}};
  };
  const auto full = [&] {
    const optimizer::Matrices& made = *chain.matrices->matrices();
    if (parts.full.stiffness.size() == 0)
      parts.full = chain.matrices->full_model(fem::constrain(made.stiffness, made.system.constraints),
                                              Eigen::SparseMatrix<double>(made.system.mass));
  };
  const auto flexibility = [&] {
    const reduction::ResidualFlexibility structure(parts.factors, parts.full.mass, parts.basis, parts.modes.soft());
    require(structure.status() == Status::converged, "trace", to_string(structure.status()));
  };
  return {
      {{"assembly", [&] { chain.matrices->assemble(); }},
       [&] {
         return Needs{{kTraffic, assembled_bytes(chain.matrices->matrices()->system)}};
       }},
      // It uses up what was assembled.
      {{"prestress", [&] { chain.matrices->add_prestress(); },
        [&] {
          chain.matrices->assemble();
          find_order(chain);
        }},
       [] {
         return Needs{{kFactorisation, 1}, {kBackSolve, 2}};
       }},
      {{"factorisation", [&] { factorise(parts); }, full},
       [] {
         return Needs{{kFactorisation, 1}};
       }},
      {{"modes", [&] { find_modes(chain, parts); }}, modes},
      {{"trace", flexibility}, trace},
      {{"reduction", [&] { chain.matrices->reduce(); }},
       [=] {
         return sum(sum({{kFactorisation, 1}}, modes()), trace());
       }},
  };
}

/// Of a design that has its matrices from the one before: what its own preload changes in them.
std::vector<Stage> shared_stages(Chain& chain) {
  const auto before = [&] {
    if (chain.candidate.matrices.shared) return;
    chain.matrices->assemble();
    chain.matrices->add_prestress();
    chain.matrices->reduce();
    take_matrices(chain);
  };
  const auto change = [&] {
    chain.candidate.matrices = optimizer::of_design(chain.scene, chain.candidate.mesh.sector, chain.candidate.cells,
                                                    chain.candidate.matrices.shared);
  };
  return {{{"prestress", change, before}, [] { return Needs{{kBackSolve, 1}}; }}};
}

void condense(Chain& chain) {
  chain.reduction = reduction::reduce(chain.candidate.matrices.trace, chain.candidate.cells.average,
                                      optimizer::contact_nodes(chain.candidate.cells, 0, chain.scene.contact),
                                      chain.scene.loading.damping_ratio);
  require(chain.reduction.status == Status::converged, "condensation", chain.reduction.message);
}

void preload(Chain& chain) {
  chain.candidate.preload = steady::quasi_static(
      std::make_shared<const dynamics::CondensedModel>(chain.reduction.model), {.budget = chain.candidate.budget});
  require(chain.candidate.preload.status == Status::converged, "preload", to_string(chain.candidate.preload.status));
}

}  // namespace

std::vector<Stage> model_stages(Chain& chain) {
  const auto feasibility = [&] {
    chain.candidate.feasibility = chain.scene.kind->feasibility(chain.scene, chain.scene.limits);
  };
  const auto matrices_made = [&] {
    if (!chain.candidate.matrices.shared) take_matrices(chain);
    optimizer::renew_budget(chain.scene.solver, chain.candidate);
  };
  const auto none = [] { return Needs{}; };
  const auto begin_matrices = [&] {
    if (chain.matrices) return;
    chain.by = optimizer::stressed(chain.scene, chain.candidate.cells, chain.previous.contact.friction);
    // What designs share is in no stage.
    chain.patterns.assembler = std::make_shared<const fem::Assembler>(chain.candidate.mesh.sector.mesh);
    chain.matrices.emplace(chain.scene, chain.candidate.mesh.sector, chain.candidate.cells, chain.by, chain.patterns);
  };
  std::vector<Stage> stages{{{"feasibility", feasibility}, none}, {{"mesh", [&] { lay_mesh(chain); }}, none}};
  std::vector<Stage> matrices = chain.shares_matrices() ? shared_stages(chain) : matrices_stages(chain);
  std::function<void()>& first = matrices.front().work.prepare;
  first = [begin_matrices, then = first] {
    begin_matrices();
    if (then) then();
  };
  for (Stage& stage : matrices) stages.push_back(std::move(stage));
  stages.push_back({{"condensation", [&] { condense(chain); }, matrices_made}, [&] {
                      return Needs{{kDenseInverse, cube(chain.contact_size())}};
                    }});
  stages.push_back({{"preload", [&] { preload(chain); }, matrices_made}, [&] {
                      const Budget& budget = *chain.candidate.budget;
                      return Needs{{kDenseLu, budget.on_factors()}, {kMarch, budget.used() - budget.on_factors()}};
                    }});
  return stages;
}

}  // namespace dovetail::benchmarks
