#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace dovetail::calculix {

/// Stress at an integration point, SI, (xx, yy, zz, xy, xz, yz).
struct PointStress {
  int element = 0;  ///< of the mesh, from 0
  Eigen::Vector3d position;
  Eigen::Matrix<double, 6, 1> stress;
};

/// What ccx printed, SI; of the last increment where there are several.
struct Answer {
  std::map<int, std::vector<double>> frequencies;  ///< by nodal diameter, Hz, each mode once
  std::map<int, Eigen::Vector3d> displacement;     ///< by node of the mesh, from 0
  std::vector<PointStress> stress;
  std::vector<double> normal_force, shear_force;  ///< of the contact pairs, N; pressing > 0
  std::map<int, double> pressure;                 ///< by node of the mesh, Pa
};

/// Whether the program ccx is installed.
[[nodiscard]] bool is_installed();

/// Runs ccx on that deck in a folder of its own, with one thread. Throws std::runtime_error with the end of its output
/// when it does not finish.
[[nodiscard]] Answer run(const std::string& deck);

/// The same in that folder, whose files stay: deck.sti and others. Throws std::runtime_error.
void run_in(const std::filesystem::path& folder, const std::string& deck);

}  // namespace dovetail::calculix
