#pragma once

#include <Eigen/Core>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "optimizer/candidate/matrices.hpp"

namespace dovetail::optimizer {

/// Everything that matrices follow from.
struct MatricesOf {
  Eigen::MatrixXd nodes;
  std::vector<int> connectivity, region;  ///< of the mesh
  std::vector<double> numbers;            ///< of bodies, loading, solver and the preload that the prestress comes from
  int modes = 0;
  [[nodiscard]] bool same_but_modes(const MatricesOf& other) const;
};

/// What the change by a design's own preload follows from, but for the matrices that it changes.
struct PreloadOf {
  std::vector<double> numbers;  ///< of contact, gaps and budget
  std::vector<fem::FlankCells> flanks;
  [[nodiscard]] bool operator==(const PreloadOf&) const = default;
};

/// Computes matrices and keeps the last ones, and what the last preload changed in them. May be called from several
/// threads.
class MatricesStore {
 public:
  /// - `friction`: of the preload that designs or cases share
  explicit MatricesStore(double friction) : friction_(friction) {}

  /// - `sector`: with its trace
  /// - `cells`: the grid of contact nodes to begin with
  /// - `timings_s`: of its stages, unless they were there already, are added
  [[nodiscard]] DesignMatrices matrices(const Scene& asked, const fem::SectorMesh& sector,
                                        const fem::ContactCells& cells, std::map<std::string, double>& timings_s);

 private:
  [[nodiscard]] std::shared_ptr<const Matrices> shared(const Scene& scene, const fem::SectorMesh& sector,
                                                       const fem::ContactCells& cells,
                                                       std::map<std::string, double>& timings_s);

  [[nodiscard]] KeptPatterns patterns(const fem::Mesh& mesh);

  /// With the last change, where it is that of the same preload.
  [[nodiscard]] DesignMatrices changed(const Scene& scene, const fem::SectorMesh& sector,
                                       const fem::ContactCells& cells, const std::shared_ptr<const Matrices>& shared);

  double friction_;
  std::mutex mutex_;
  KeptPatterns patterns_{.assembler = {}, .order = std::make_shared<numerics::EliminationOrder>()};
  MatricesOf of_;
  std::shared_ptr<const Matrices> last_;
  std::weak_ptr<const Matrices> changed_;  // by
  PreloadOf preload_;
  PreloadChange change_;
};

}  // namespace dovetail::optimizer
