#include "fem/diameter_frequencies.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>
#include <utility>

#include "fem/diameter_basis.hpp"
#include "fem/glued_modes.hpp"
#include "fem/params.hpp"

namespace dovetail::fem {

namespace {

using Complex = std::complex<double>;
using Sparse = Eigen::SparseMatrix<double>;
constexpr DiameterBasisParams kDiameterBasis = {};

double signed_hertz(double eigenvalue) {
  return std::copysign(std::sqrt(std::abs(eigenvalue)), eigenvalue) / (2 * std::numbers::pi);
}

Eigen::MatrixXcd divided(const Eigen::MatrixXcd& vectors, const numerics::SparseCholesky<double>& factors) {
  Eigen::MatrixXd parts(vectors.rows(), 2 * vectors.cols());
  parts << vectors.real(), vectors.imag();
  const Eigen::MatrixXd by_parts = factors.solve(parts);
  Eigen::MatrixXcd result(vectors.rows(), vectors.cols());
  result.real() = by_parts.leftCols(vectors.cols());
  result.imag() = by_parts.rightCols(vectors.cols());
  return result;
}

class Diameters {
 public:
  Diameters(const SectorMesh& sector, const Sparse& stiffness, const Sparse& mass, BoreSupport bore,
            const DiameterOptions& options, std::span<const int> list)
      : sector_(sector), stiffness_(stiffness), mass_(mass), bore_(bore), options_(options) {
    result_.nodal_diameters.assign(list.begin(), list.end());
    if (list.empty()) {
      result_.nodal_diameters.resize(static_cast<std::size_t>(sector.sectors / 2 + 1));
      std::iota(result_.nodal_diameters.begin(), result_.nodal_diameters.end(), 0);
    }
    result_.frequency.setConstant(static_cast<Eigen::Index>(result_.nodal_diameters.size()), options.modes.count,
                                  std::numeric_limits<double>::quiet_NaN());
    result_.status.assign(result_.nodal_diameters.size(), Status::iteration_limit);
    result_.solved.assign(result_.nodal_diameters.size(), false);
  }

  NodalDiameterFrequencies run() {
    const std::size_t count = result_.nodal_diameters.size();
    // Two samples and one between are worth a basis; one or two sectors have no phase to follow.
    const bool ritz = options_.tolerance > 0 && count > kDiameterBasis.few && sector_.sectors > 2;
    if (ritz) basis_.emplace(sector_, stiffness_, mass_, bore_, options_.contact_flexibility);
    if (!ritz) {
      for (std::size_t k = 0; k < count; ++k) solve(k);
      return std::move(result_);
    }
    solve_at_real_phases();
    for (const std::size_t end : {std::size_t{0}, count - 1})
      if (!result_.solved[end]) settle(end);
    bisect(0, count - 1);
    for (std::size_t k = 0; k < count; ++k) {
      if (result_.solved[k]) continue;
      if (const Eigen::VectorXd ritz_values = predicted(k); ritz_values.size() > 0)
        store(k, ritz_values, Status::converged);
      else
        solve(k);
    }
    return std::move(result_);
  }

 private:
  /// Solves in the middle of what lies between two solved diameters until the prediction there holds.
  void bisect(std::size_t from, std::size_t to) {
    if (to - from < 2) return;
    const std::size_t middle = from + (to - from) / 2;
    const Eigen::VectorXd expected = predicted(middle);
    const Eigen::VectorXd found = settle(middle);
    const bool holds = result_.status[middle] == Status::converged && expected.size() == found.size() &&
                       ((expected - found).array().abs() <= 2 * options_.tolerance * found.array().abs()).all();
    if (holds) return;  // an eigenvalue errs twice as much as its frequency
    bisect(from, middle);
    bisect(middle, to);
  }

  [[nodiscard]] double phase(std::size_t k) const {
    return 2 * std::numbers::pi * result_.nodal_diameters[k] / sector_.sectors;
  }

  [[nodiscard]] Eigen::VectorXd predicted(std::size_t k) const {
    return basis_->eigenvalues(phase(k), options_.modes.count);
  }

  /// Neighbours that move alike, and against each other: matrices of these two phases are real, and every other phase
  /// lies between them. Their modes begin the basis, as they are and turned half the way to each other, and their
  /// factors serve all.
  void solve_at_real_phases() {
    numerics::ModesOptions options = options_.modes;
    options.count += kDiameterBasis.spare;
    options.tolerance = std::max(options.tolerance, kDiameterBasis.modes_tolerance * options_.tolerance);
    const auto add = [&](const Sparse& stiffness, const Sparse& mass, double halfway, bool asked, std::size_t k,
                         numerics::SparseCholesky<double>& factors) {
      const numerics::Modes<double> modes = numerics::smallest_modes(stiffness, mass, options, factors);
      if (modes.status != Status::converged) return;
      basis_->add(modes.vectors);
      basis_->add(basis_->turned(halfway, modes.vectors.cast<Complex>()));
      if (!asked) return;
      result_.solved[k] = true;
      store(k, modes.eigenvalues.head(options_.modes.count), modes.status);
    };
    const PhaseMatrix &stiffness = basis_->stiffness(), &mass = basis_->mass();
    const std::vector<int>& diameters = result_.nodal_diameters;
    add(stiffness.alike(), mass.alike(), std::numbers::pi / 2, diameters.front() == 0, 0, real_);
    const Sparse against = stiffness.against();
    alternating_.analyse(against, real_);
    add(against, mass.against(), -std::numbers::pi / 2, 2 * diameters.back() == sector_.sectors, diameters.size() - 1,
        alternating_);
  }

  /// Block Davidson: residuals of the Ritz pairs, divided by the factors of the nearer real phase, join the basis until
  /// the values stay. Where they do not, or there are no factors, the sparse problem is solved.
  Eigen::VectorXd settle(std::size_t k) {
    const bool alike = std::cos(phase(k)) >= 0;
    const numerics::SparseCholesky<double>& factors = alike ? real_ : alternating_;
    const double from = alike ? phase(k) : phase(k) - std::numbers::pi;  // that of the factors
    Eigen::VectorXd before = predicted(k);
    for (int round = 0; round < kDiameterBasis.rounds && factors.factorised(); ++round) {
      const int followed = options_.modes.count + (round == 0 ? kDiameterBasis.spare : 0);
      const Eigen::MatrixXcd left = basis_->residuals(phase(k), followed);
      if (left.cols() == 0) break;
      basis_->add(basis_->turned(from, divided(basis_->turned(-from, left), factors)));
      Eigen::VectorXd after = predicted(k);
      if (after.size() == 0) break;
      const bool stay =
          before.size() == after.size() &&
          ((before - after).array().abs() <= kDiameterBasis.settled * options_.tolerance * after.array().abs()).all();
      if (stay) {
        result_.solved[k] = true;
        store(k, after, Status::converged);
        return after;
      }
      before = std::move(after);
    }
    return solve(k);
  }

  Eigen::VectorXd solve(std::size_t k) {
    const int diameter = result_.nodal_diameters[k];
    result_.solved[k] = true;
    const auto keep = [&](const auto& modes) -> Eigen::VectorXd {
      store(k, modes.eigenvalues, modes.status);
      if (basis_ && modes.status == Status::converged) basis_->add(modes.vectors);
      return modes.eigenvalues;
    };
    const auto modes = [&](const auto& constraints, auto& cholesky) {
      return glued_modes(stiffness_, mass_, constraints, options_.modes, cholesky, options_.contact_flexibility);
    };
    if (diameter == 0 || 2 * diameter == sector_.sectors)
      return keep(modes(real_constraints(sector_, bore_, diameter), real_));
    return keep(modes(complex_constraints(sector_, bore_, diameter), complex_));
  }

  void store(std::size_t k, const Eigen::VectorXd& eigenvalues, Status status) {
    result_.status[k] = status;
    for (Eigen::Index m = 0; m < eigenvalues.size(); ++m)
      result_.frequency(static_cast<Eigen::Index>(k), m) = signed_hertz(eigenvalues[m]);
  }

  const SectorMesh& sector_;
  const Sparse &stiffness_, &mass_;
  BoreSupport bore_;
  const DiameterOptions& options_;
  NodalDiameterFrequencies result_;
  std::optional<DiameterBasis> basis_;
  // One analysis per scalar type serves all diameters: the patterns do not depend on the phase.
  numerics::SparseCholesky<double> real_, alternating_;
  numerics::SparseCholesky<Complex> complex_;
};

}  // namespace

NodalDiameterFrequencies nodal_diameter_frequencies(const SectorMesh& sector, const Sparse& stiffness,
                                                    const Sparse& mass, BoreSupport bore,
                                                    const DiameterOptions& options,
                                                    std::span<const int> nodal_diameters) {
  return Diameters(sector, stiffness, mass, bore, options, nodal_diameters).run();
}

}  // namespace dovetail::fem
