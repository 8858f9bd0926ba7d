#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "fem/assembly.hpp"
#include "fem/contact_cells.hpp"
#include "fem/sector_system.hpp"
#include "numerics/partial_cholesky.hpp"
#include "optimizer/problem/load_case.hpp"
#include "optimizer/problem/outcome.hpp"
#include "optimizer/scene/scene.hpp"
#include "reduction/massless_boundary.hpp"
#include "reduction/static_condensation.hpp"

namespace dovetail::optimizer {

/// What meshes of one topology share: patterns, and orders of elimination.
struct KeptPatterns {
  std::shared_ptr<const fem::Assembler> assembler;
  std::shared_ptr<numerics::EliminationOrder> order;
};

/// What follows from mesh, materials, speed and the preload that stresses them.
struct Matrices {
  std::string status = status_of(Outcome::converged);
  std::shared_ptr<const fem::Assembler> assembler;
  fem::SectorSystem system;  ///< on the trace; `stiffness` and `full.stiffness` are empty after add_prestress()
  Eigen::SparseMatrix<double> stiffness;  ///< over all nodes, at speed: K + K_g - Omega^2 M
  reduction::TraceModel trace;            ///< of a tip force of 1 N
  double friction = 0;                    ///< of the preload that stresses them
  // To add what the preload of another design changes:
  reduction::StaticCondensation at_rest;  ///< of K; its factors are kept for designs that share the matrices alone
  Eigen::VectorXd preloaded;              ///< displacement of all nodes
  Eigen::MatrixXd forced;                 ///< to unit forces on the trace, transposed [nt, n]
};

/// What the preload that stresses the matrices acts on.
struct PreloadedContact {
  ContactProperties contact;
  Eigen::VectorXd gap;  ///< of contact nodes
};

/// The design's own; with one friction where designs or cases share matrices, and without gaps where all designs do.
[[nodiscard]] PreloadedContact stressed(const Scene& scene, const fem::ContactCells& cells, double friction);

/// The stages in which matrices are computed, in this order: each goes on from what the one before left. What it is
/// given must outlive it.
class MatricesStages {
 public:
  /// - `sector`: with its trace
  /// - `cells`: the grid of contact nodes to begin with
  MatricesStages(const Scene& scene, const fem::SectorMesh& sector, const fem::ContactCells& cells,
                 const PreloadedContact& by, const KeptPatterns& patterns);

  /// Those of the same scene and mesh but for the number of modes: all but reduce() is done then.
  void go_on_from(const Matrices& same);
  void assemble();
  void add_prestress();  ///< preload without geometric stiffness, and the stiffness that its stress leaves
  void reduce();         ///< to the trace

  [[nodiscard]] const std::shared_ptr<Matrices>& matrices() const { return matrices_; }
  /// What is reduced, with stiffness and mass in independent coordinates.
  [[nodiscard]] reduction::FullModel full_model(Eigen::SparseMatrix<double>&& stiffness,
                                                Eigen::SparseMatrix<double>&& mass) const;

 private:
  void condense();

  const Scene& scene_;
  const fem::SectorMesh& sector_;
  const fem::ContactCells& cells_;
  const PreloadedContact& by_;
  std::shared_ptr<numerics::EliminationOrder> order_;
  std::shared_ptr<Matrices> matrices_ = std::make_shared<Matrices>();
};

/// The matrices of a candidate, of its own or shared by designs that differ in the form of their flanks, friction, wear
/// and tip force alone. Members after the stage that failed are empty.
struct DesignMatrices {
  std::string status = status_of(Outcome::converged);
  std::shared_ptr<const Matrices> shared;
  bool by_other = false;               ///< stressed by another preload, with the design's own to first order at most
  Eigen::SparseMatrix<double> change;  ///< of the stiffness over all nodes, or empty: by the design's own preload
  reduction::TraceModel trace;         ///< with the change, of the design's tip force

  /// At speed, over all nodes.
  [[nodiscard]] Eigen::SparseMatrix<double> stiffness() const;
};

/// How designs are stressed: as the scene asks, unless what would be kept to add the preload of each is too large.
[[nodiscard]] Prestress prestress_of(const Scene& scene, const fem::SectorMesh& sector);

/// What the preload of a design changes in the matrices that it shares.
struct PreloadChange {
  Eigen::SparseMatrix<double> stiffness;                       ///< over all nodes
  std::shared_ptr<const reduction::StiffnessChange> on_trace;  ///< null: not known
};

/// Those of a design from the ones that it shares: with its tip force, and what its own preload changes.
[[nodiscard]] DesignMatrices of_design(const Scene& scene, const fem::SectorMesh& sector,
                                       const fem::ContactCells& cells, std::shared_ptr<const Matrices> shared,
                                       const PreloadChange& known = {});

/// Whether designs that differ by this key of a study file alone share their matrices.
[[nodiscard]] bool shares_matrices(std::string_view key);

/// Whether a design has the same in both cases, but for what its own preload changes.
[[nodiscard]] bool share_matrices(const LoadCase& one, const LoadCase& other);

/// Into how many groups cases fall that have their matrices in common when they are stressed so.
[[nodiscard]] std::size_t kinds_of_matrices(std::span<const LoadCase> cases, Prestress prestress);

/// The places of cases as they are computed with least work: beginning with the first, those that share their matrices
/// in a row, and of them those that share the preload, too.
[[nodiscard]] std::vector<std::size_t> by_what_they_share(std::span<const LoadCase> cases);

}  // namespace dovetail::optimizer
