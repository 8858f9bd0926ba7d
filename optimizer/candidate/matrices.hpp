#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "fem/contact_cells.hpp"
#include "fem/sector_system.hpp"
#include "optimizer/problem/outcome.hpp"
#include "optimizer/scene/scene.hpp"
#include "reduction/massless_boundary.hpp"

namespace dovetail::optimizer {

/// What of a candidate follows from its mesh, materials, speed and tip force: the same for designs that differ in the
/// form of their flanks, friction and wear alone. Members after the stage that failed are empty.
struct Matrices {
  std::string status = status_of(Outcome::converged);
  fem::SectorSystem system;               ///< on the trace
  Eigen::SparseMatrix<double> stiffness;  ///< over all nodes, at speed: K + K_g - Omega^2 M
  reduction::TraceModel trace;
};

/// Everything that they follow from.
struct MatricesOf {
  Eigen::MatrixXd nodes;
  std::vector<int> connectivity, region;  ///< of the mesh
  std::vector<double> numbers;            ///< of bodies, loading, solver and the preload that the prestress comes from
  bool operator==(const MatricesOf& other) const;
};

/// Computes matrices and keeps the last ones. May be called from several threads.
class MatricesStore {
 public:
  /// @param friction  of the preload that the prestress comes from, where it is not the design's own
  explicit MatricesStore(double friction) : friction_(friction) {}

  /// @param sector  with its trace
  /// @param cells  the grid of contact nodes to begin with
  /// @param timings_s  of its stages, unless they were there already, are added
  [[nodiscard]] std::shared_ptr<const Matrices> matrices(const Scene& scene, const fem::SectorMesh& sector,
                                                         const fem::ContactCells& cells,
                                                         std::map<std::string, double>& timings_s);

 private:
  double friction_;
  std::mutex mutex_;
  MatricesOf of_;
  std::shared_ptr<const Matrices> last_;
};

}  // namespace dovetail::optimizer
