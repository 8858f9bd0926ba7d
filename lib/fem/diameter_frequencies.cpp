#include "fem/diameter_frequencies.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>
#include <utility>

#include "fem/glued_modes.hpp"
#include "fem/params.hpp"
#include "numerics/dense_product.hpp"
#include "numerics/dense_symmetric.hpp"

namespace dovetail::fem {

namespace {

using Complex = std::complex<double>;
using Sparse = Eigen::SparseMatrix<double>;
constexpr DiameterBasisParams kDiameterBasis = {};

/// A(phase) = A0 + e^{i phase} A1 + e^{-i phase} A1^T over the dofs of the glued joint.
struct PhaseMatrix {
  Sparse constant, turning;

  [[nodiscard]] Eigen::MatrixXcd times(double phase, const Eigen::MatrixXcd& vectors) const {
    const Eigen::MatrixXd re = vectors.real(), im = vectors.imag();
    Eigen::MatrixXcd result(vectors.rows(), vectors.cols());
    result.real() = constant * re;
    result.imag() = constant * im;
    const auto add = [&](const auto& matrix, Complex factor) {
      const Eigen::MatrixXd of_re = matrix * re, of_im = matrix * im;
      result.real() += factor.real() * of_re - factor.imag() * of_im;
      result.imag() += factor.real() * of_im + factor.imag() * of_re;
    };
    add(turning, std::polar(1.0, phase));
    add(turning.transpose(), std::polar(1.0, -phase));
    return result;
  }
};

/// T(phase) = Ta + e^{i phase} Tb: the parts from the glued transformation of one nodal diameter.
std::pair<Sparse, Sparse> transformation_parts(const SectorMesh& sector, const Eigen::SparseMatrix<Complex>& glued) {
  const double phase = 2 * std::numbers::pi / sector.sectors;
  const Sparse turning = Sparse(glued.imag()) / std::sin(phase);
  const Sparse constant = Sparse(glued.real()) - std::cos(phase) * turning;
  return {constant.pruned(1.0, kDiameterBasis.rounding), turning.pruned(1.0, kDiameterBasis.rounding)};
}

PhaseMatrix phase_matrix(const Sparse& full, const Sparse& a, const Sparse& b) {
  const Sparse full_a = full * a, full_b = full * b;
  const Sparse at = a.transpose(), bt = b.transpose();
  const Sparse of_a = at * full_a, of_b = bt * full_b;
  return {.constant = of_a + of_b, .turning = at * full_b};
}

/// Rayleigh-Ritz at any phase on a growing real basis.
class RitzBasis {
 public:
  RitzBasis(const SectorMesh& sector, const Sparse& stiffness, const Sparse& mass, BoreSupport bore,
            const Eigen::VectorXd& flexibility) {
    const GluedJoint<Complex> one = glued_joint(complex_constraints(sector, bore, 1), flexibility);
    const auto [a, b] = transformation_parts(sector, one.constraints.transformation);
    stiffness_ = phase_matrix(stiffness, a, b);
    if (one.springs.nonZeros() > 0) stiffness_.constant += one.springs;
    mass_ = phase_matrix(mass, a, b);
  }

  /// Real and imaginary parts of vectors, each as a direction alone, as far as it is a new one.
  template <class Vectors>
  void add(const Vectors& vectors) {
    Eigen::MatrixXd fresh(vectors.rows(), 2 * vectors.cols());
    Eigen::Index count = 0;
    const auto take = [&](const Eigen::VectorXd& direction) {
      if (const double length = direction.norm(); length > 0) fresh.col(count++) = direction / length;
    };
    for (Eigen::Index m = 0; m < vectors.cols(); ++m) {
      take(vectors.col(m).real());
      take(vectors.col(m).imag());
    }
    fresh.conservativeResize(Eigen::NoChange, count);
    for (int pass = 0; pass < 2 && basis_.cols() > 0; ++pass)
      numerics::add_product(basis_, -numerics::transposed_product(basis_, fresh), fresh);
    orthonormalise(fresh);
    const Eigen::Index old = basis_.cols();
    basis_.conservativeResize(vectors.rows(), old + fresh.cols());
    basis_.rightCols(fresh.cols()) = fresh;
    update(stiffness_, reduced_stiffness_);
    update(mass_, reduced_mass_);
  }

  /// The lowest `count` eigenvalues.
  [[nodiscard]] Eigen::VectorXd eigenvalues(double phase, Eigen::Index count) const {
    if (basis_.cols() < count) return {};  // nothing converged so far
    const numerics::Pairs<Complex> found =
        numerics::all_values<Complex>(reduced_stiffness_.at(phase), reduced_mass_.at(phase));
    if (found.status != Status::converged) return {};
    return found.values.head(count);
  }

  /// K V - M V diag(values) of the lowest `count` Ritz pairs; empty where there are none.
  [[nodiscard]] Eigen::MatrixXcd residuals(double phase, Eigen::Index count) const {
    count = std::min(count, basis_.cols());
    const numerics::Pairs<Complex> found =
        numerics::all_pairs<Complex>(reduced_stiffness_.at(phase), reduced_mass_.at(phase));
    if (found.status != Status::converged) return {};
    Eigen::MatrixXcd vectors(basis_.rows(), count);
    vectors.real() = numerics::product(basis_, Eigen::MatrixXd(found.vectors.leftCols(count).real()));
    vectors.imag() = numerics::product(basis_, Eigen::MatrixXd(found.vectors.leftCols(count).imag()));
    const Eigen::MatrixXcd of_mass = mass_.times(phase, vectors);
    return stiffness_.times(phase, vectors) - of_mass * found.values.head(count).asDiagonal();
  }

 private:
  struct Reduced {
    Eigen::MatrixXd constant, turning;
    [[nodiscard]] Eigen::MatrixXcd at(double phase) const {
      Eigen::MatrixXcd result(constant.rows(), constant.cols());
      result.real() = constant + std::cos(phase) * (turning + turning.transpose());
      result.imag() = std::sin(phase) * (turning - turning.transpose());
      return result;
    }
  };

  /// Gram-Schmidt, twice, of what is left of directions of length one beside the basis; less than a little is noise.
  static void orthonormalise(Eigen::MatrixXd& directions) {
    Eigen::Index count = 0;
    for (Eigen::Index k = 0; k < directions.cols(); ++k) {
      Eigen::VectorXd direction = directions.col(k);
      for (int pass = 0; pass < 2; ++pass)
        direction -= directions.leftCols(count) * (directions.leftCols(count).transpose() * direction);
      if (const double left = direction.norm(); left >= kDiameterBasis.fresh)
        directions.col(count++) = direction / left;
    }
    directions.conservativeResize(Eigen::NoChange, count);
  }

  void update(const PhaseMatrix& matrix, Reduced& reduced) const {
    const Eigen::Index old = reduced.constant.rows(), size = basis_.cols(), fresh = size - old;
    const Eigen::MatrixXd constant = matrix.constant * basis_.rightCols(fresh);
    const Eigen::MatrixXd turning = matrix.turning * basis_.rightCols(fresh);
    const Eigen::MatrixXd turned = matrix.turning.transpose() * basis_.rightCols(fresh);
    reduced.constant.conservativeResize(size, size);
    reduced.turning.conservativeResize(size, size);
    reduced.constant.rightCols(fresh) = numerics::transposed_product(basis_, constant);
    reduced.constant.bottomLeftCorner(fresh, old) = reduced.constant.topRightCorner(old, fresh).transpose();
    reduced.turning.rightCols(fresh) = numerics::transposed_product(basis_, turning);
    reduced.turning.bottomLeftCorner(fresh, old) = numerics::transposed_product(turned, basis_.leftCols(old));
  }

  PhaseMatrix stiffness_, mass_;
  Eigen::MatrixXd basis_;
  Reduced reduced_stiffness_, reduced_mass_;
};

double signed_hertz(double eigenvalue) {
  return std::copysign(std::sqrt(std::abs(eigenvalue)), eigenvalue) / (2 * std::numbers::pi);
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
  /// lies between them. Their modes begin the basis, their factors serve all.
  void solve_at_real_phases() {
    numerics::ModesOptions more = options_.modes;
    more.count += kDiameterBasis.spare;
    const auto add = [&](const Constraints<double>& constraints, numerics::SparseCholesky<double>& factors) {
      const auto modes = glued_modes(stiffness_, mass_, constraints, more, factors, options_.contact_flexibility);
      if (modes.status == Status::converged) basis_->add(modes.vectors);
      return modes;
    };
    const auto keep = [&](std::size_t k, const numerics::Modes<double>& modes) {
      if (modes.status != Status::converged) return;
      result_.solved[k] = true;
      store(k, modes.eigenvalues.head(options_.modes.count), modes.status);
    };
    const numerics::Modes<double> alike = add(real_constraints(sector_, bore_, 0), real_);
    if (result_.nodal_diameters.front() == 0) keep(0, alike);
    const numerics::Modes<double> against = add(alternating_constraints(sector_, bore_), alternating_);
    if (2 * result_.nodal_diameters.back() == sector_.sectors) keep(result_.nodal_diameters.size() - 1, against);
  }

  /// Block Davidson: residuals of the Ritz pairs, divided by the factors of the nearer real phase, join the basis until
  /// the values stay. Where they do not, or there are no factors, the sparse problem is solved.
  Eigen::VectorXd settle(std::size_t k) {
    const numerics::SparseCholesky<double>& factors = std::cos(phase(k)) >= 0 ? real_ : alternating_;
    Eigen::VectorXd before = predicted(k);
    for (int round = 0; round < kDiameterBasis.rounds && factors.factorised(); ++round) {
      const int followed = options_.modes.count + (round == 0 ? kDiameterBasis.spare : 0);
      const Eigen::MatrixXcd left = basis_->residuals(phase(k), followed);
      if (left.cols() == 0) break;
      Eigen::MatrixXd parts(left.rows(), 2 * left.cols());
      parts << left.real(), left.imag();
      basis_->add(Eigen::MatrixXd(factors.solve(parts)));
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
  std::optional<RitzBasis> basis_;
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
