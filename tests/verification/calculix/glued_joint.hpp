#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

#include "fem/diameter_frequencies.hpp"
#include "fem/sector_system.hpp"
#include "tests/verification/calculix/calculix.hpp"

namespace dovetail::calculix {

constexpr double kSpeed = 1047.1975511965977;  // 10 000 rpm
constexpr std::array<int, 4> kDiameters{0, 1, 5, 23};

/// Our own answer for a glued sector.
struct GluedJoint {
  fem::SectorMesh sector;
  std::vector<fem::Material> materials;
  fem::SectorSystem system;
  Eigen::VectorXd displacement;  ///< [d n] under the centrifugal load, m
  double speed = 0;              ///< rad/s

  GluedJoint(const fem::SectorMesh& mesh, double omega);

  /// [diameters, modes] Hz, at rest or at speed (geometric stiffness of the glued state, spin softening).
  [[nodiscard]] Eigen::MatrixXd frequencies(std::span<const int> nodal_diameters, int modes, bool at_speed) const;

  /// Largest distance of a node's displacement from ccx's over the largest displacement.
  [[nodiscard]] double displacement_error(const Answer& answer) const;

  /// At ccx's integration points.
  struct StressErrors {
    double largest = 0;  ///< largest difference of a component over the largest von Mises stress
    double mean = 0;     ///< root mean square of the differences over that of the stresses
  };
  [[nodiscard]] StressErrors stress_errors(const Answer& answer) const;
};

/// Largest relative difference of each nodal diameter's modes.
[[nodiscard]] double frequency_error(const Eigen::MatrixXd& ours, std::span<const int> nodal_diameters,
                                     const Answer& answer);

}  // namespace dovetail::calculix
