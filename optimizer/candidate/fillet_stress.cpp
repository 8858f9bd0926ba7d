#include "optimizer/candidate/fillet_stress.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <vector>

#include "dynamics/extremes.hpp"
#include "fem/element.hpp"
#include "fem/stress.hpp"
#include "fem/stress_aggregate.hpp"
#include "optimizer/candidate/params.hpp"

namespace dovetail::optimizer {

namespace {

/// Complex amplitude c - i s of harmonic h of coefficients [rows, 2H+1].
Eigen::VectorXcd amplitude(const Eigen::MatrixXd& coefficients, Eigen::Index h) {
  if (h == 0) return coefficients.col(0).cast<std::complex<double>>();
  Eigen::VectorXcd result(coefficients.rows());
  result.real() = coefficients.col(2 * h - 1);
  result.imag() = -coefficients.col(2 * h);
  return result;
}

/// Largest over a period at every node, of Fourier coefficients of its stress [components nodes, 2H+1].
Eigen::VectorXd largest_von_mises(const Eigen::MatrixXd& coefficients, Eigen::Index components, double poisson_ratio) {
  Eigen::VectorXd largest = Eigen::VectorXd::Zero(coefficients.rows() / components);
  constexpr int kPhases = StressParams{}.phases;
  for (int phase = 0; phase < kPhases; ++phase) {
    const double tau = 2 * std::numbers::pi * phase / kPhases;
    const Eigen::VectorXd at = coefficients * dynamics::fourier_row(tau, coefficients.cols());
    for (Eigen::Index i = 0; i < largest.size(); ++i)
      largest(i) = std::max(largest(i), fem::von_mises(at.segment(components * i, components), poisson_ratio));
  }
  return largest;
}

/// Fourier coefficients of the reduced coordinates, [n, 2H+1], of a converged steady state with its tangent.
Eigen::MatrixXd reduced_coordinates(const steady::State& state) {
  assert(state.status == Status::converged && state.tangent);
  const steady::Problem& residual = state.tangent->problem();
  const std::vector<dynamics::CondensedHarmonic>& harmonics = residual.system().harmonics;
  Eigen::MatrixXd result(residual.model().size(), state.displacement.cols());
  for (std::size_t i = 0; i < harmonics.size(); ++i) {
    const auto h = static_cast<Eigen::Index>(i);
    const Eigen::VectorXcd field = residual.model().recover(harmonics[i], amplitude(state.displacement, h));
    if (h == 0) {
      result.col(0) = field.real();
    } else {
      result.col(2 * h - 1) = field.real();
      result.col(2 * h) = -field.imag();
    }
  }
  return result;
}

}  // namespace

Eigen::MatrixXd displacement_field(const CandidateModel& candidate, const steady::State& state) {
  return candidate.matrices.shared->system.constraints.transformation *
         candidate.reduction.recovery.apply(reduced_coordinates(state), state.force);
}

FilletStress fillet_stress(const Scene& scene, const CandidateModel& candidate, const Eigen::MatrixXd& field,
                           std::span<const int> nodes, const Eigen::VectorXd& share, double poisson_ratio) {
  const fem::Mesh& mesh = candidate.mesh.sector.mesh;
  const std::vector<fem::Material> bodies = materials(scene);
  Eigen::MatrixXd coefficients = fem::nodal_stress_operator(mesh, bodies, nodes) * field;
  const Eigen::Index components = fem::stress_components(mesh.kind);
  const Eigen::VectorXd weights = fem::boundary_weights(mesh, nodes).cwiseProduct(share);
  const auto at_peak = [&] {
    FilletStress peak;
    peak.nodal = largest_von_mises(coefficients, components, poisson_ratio);
    peak.aggregate = fem::kreisselmeier_steinhauser(peak.nodal, weights).value;
    for (Eigen::Index i = 0; i < peak.nodal.size(); ++i)
      if (share(i) == 1) peak.maximum = std::max(peak.maximum, peak.nodal(i));
    return peak;
  };
  const FilletStress of_elements = at_peak();
  const Eigen::MatrixXd normals = fem::boundary_normals(mesh, nodes);
  for (Eigen::Index i = 0; i < normals.cols(); ++i)
    for (Eigen::Index c = 0; c < coefficients.cols(); ++c) {
      auto stress = coefficients.col(c).segment(components * i, components);
      stress = fem::on_free_surface(stress, normals.col(i), poisson_ratio);
    }
  FilletStress result = at_peak();
  result.aggregate_error = std::abs(result.aggregate - of_elements.aggregate);
  result.maximum_error = std::abs(result.maximum - of_elements.maximum);
  return result;
}

}  // namespace dovetail::optimizer
