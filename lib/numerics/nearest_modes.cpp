#include "numerics/nearest_modes.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>
#include <random>
#include <stdexcept>
#include <vector>

#include "numerics/block_modes.hpp"
#include "numerics/deflated_inverse.hpp"
#include "numerics/dense_product.hpp"
#include "numerics/dense_symmetric.hpp"
#include "numerics/lanczos.hpp"

namespace dovetail::numerics {

namespace {

struct RunOptions {
  LanczosOptions lanczos;
  unsigned seed = 1;
};

template <class Entry>
struct Run {
  Status status = Status::iteration_limit;
  Eigen::VectorXd values;  // lambda - sigma, by increasing magnitude
  Columns<Entry> vectors;
};

template <class Entry>
Column<Entry> start_vector(Eigen::Index rows, unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  Column<Entry> start(rows);
  double* reals = reinterpret_cast<double*>(start.data());
  for (Eigen::Index k = 0; k < kReals<Entry> * rows; ++k) reals[k] = uniform(random);
  return start;
}

// One run of Spectra on what is left of the problem.
template <class Entry>
Run<Entry> run_spectra(const ShiftInverse<Entry>& inverse, const Eigen::SparseMatrix<Entry>& mass,
                       const MassProduct<Entry>& mass_product, const Found<Entry>& found, const RunOptions& options) {
  Run<Entry> run;
  const Eigen::Index n = mass.rows();
  const auto norm = [&](const Column<Entry>& x) { return std::sqrt(std::max(0.0, std::real(x.dot(mass * x)))); };

  const Column<Entry> start = start_vector<Entry>(n, options.seed);
  double scale = found.size() == 0 ? 0 : std::abs(found.values.back());
  // Spectra compares Ritz values and residuals with absolute numbers near rounding: the operator is scaled. The
  // quotient of a random vector is below its largest eigenvalue by no more than some square root of n.
  if (scale == 0) {
    Column<Entry> image(n);
    inverse.perform_op((mass * start).eval().data(), image.data());
    scale = norm(start) / norm(image);
    if (!(std::isfinite(scale) && scale > 0)) {
      run.status = Status::not_finite;
      return run;
    }
  }

  const DeflatedInverse<Entry> deflated(inverse, found, scale);
  const LanczosPairs pairs =
      lanczos({.size = deflated.rows(), .apply = [&](const double* b, double* x) { deflated.perform_op(b, x); }},
              {.size = deflated.rows(), .apply = [&](const double* x, double* y) { mass_product.perform_op(x, y); }},
              reinterpret_cast<const double*>(start.data()), options.lanczos);
  run.status = pairs.status;
  run.values = pairs.values * scale;
  run.vectors.resize(n, pairs.vectors.cols());
  for (Eigen::Index k = 0; k < run.vectors.cols(); ++k)
    run.vectors.col(k) = vector_at<Entry>(pairs.vectors.col(k).data(), n);
  return run;
}

// All pairs with 1/(lambda - sigma) != 0 of M^(1/2) (K - sigma M)^{-1} M^(1/2); works for singular mass.
template <class Entry>
Found<Entry> dense_modes(const ShiftInverse<Entry>& inverse, const Eigen::SparseMatrix<Entry>& mass) {
  const Pairs<Entry> spectrum = all_pairs<Entry>(mass);
  // Rounding may leave eigenvalues of a singular mass matrix slightly below zero.
  const Columns<Entry> scaled = spectrum.vectors * spectrum.values.cwiseMax(0).cwiseSqrt().asDiagonal();
  const Columns<Entry> root = product(scaled, spectrum.vectors.adjoint());
  Columns<Entry> flexible(mass.rows(), mass.rows());
  for (Eigen::Index k = 0; k < root.cols(); ++k) inverse.perform_op(root.col(k).data(), flexible.col(k).data());
  const Columns<Entry> between = product(root, flexible);
  const Pairs<Entry> pairs = all_pairs<Entry>(0.5 * (between + between.adjoint()));
  Found<Entry> found;
  found.status = spectrum.status == Status::converged ? pairs.status : spectrum.status;
  found.vectors.resize(mass.rows(), 0);
  if (found.status != Status::converged) return found;
  const Eigen::VectorXd& theta = pairs.values;
  const double threshold = 1e-14 * theta.cwiseAbs().maxCoeff();
  std::vector<Eigen::Index> kept;
  for (Eigen::Index k = 0; k < theta.size(); ++k)
    if (std::abs(theta(k)) > threshold) kept.push_back(k);
  const Eigen::VectorXd values = theta(kept).cwiseInverse();
  found.values.assign(values.begin(), values.end());
  found.vectors = product(flexible, pairs.vectors(Eigen::all, kept)) * values.asDiagonal();
  found.sort();
  return found;
}

// Restarts that keep a run within `limit` applications of the operator.
Eigen::Index restarts_within(Eigen::Index limit, Eigen::Index vectors, Eigen::Index count) {
  return std::max<Eigen::Index>(1, (limit - vectors) / (vectors - count));
}

template <class Entry>
Status find_modes(const ShiftInverse<Entry>& inverse, const Eigen::SparseMatrix<Entry>& mass,
                  const ModesOptions& options, Found<Entry>& found) {
  constexpr unsigned kRounds = 12;  // every one but the last finds a mode
  // Of the look at what is left: relative accuracy of its largest value, and the vectors that usually give it.
  constexpr double kLook = 0.02;
  constexpr Eigen::Index kLookVectors = 10, kLookLimit = 120;
  // Beyond this range values are rounding.
  constexpr double kRange = 1e14;
  const MassProduct<Entry> mass_product(mass);
  const Eigen::Index wanted = options.count;
  const Eigen::Index limit = Eigen::Index{options.vector_limit} * wanted + 40;
  const Eigen::Index budget = 3 * limit + kRounds * kLookLimit;
  Eigen::Index applied = 0;
  // Spectra cannot be stopped otherwise; run_spectra turns it into a status.
  const ShiftInverse<Entry> bounded{.rows = inverse.rows, .perform_op = [&](const Entry* b, Entry* x) {
                                      if (++applied > budget) throw std::runtime_error("applications used up");
                                      inverse.perform_op(b, x);
                                    }};
  for (unsigned round = 0; round < kRounds; ++round) {
    const Eigen::Index missing = wanted - found.size();
    double last = 0;
    if (missing <= 0) {
      last = std::abs(found.values[static_cast<std::size_t>(wanted - 1)]);
      const Run<Entry> look = run_spectra(bounded, mass, mass_product, found,
                                          {.lanczos = {.count = 1,
                                                       .vectors = kLookVectors,
                                                       .restarts = restarts_within(kLookLimit, kLookVectors, 1),
                                                       .tolerance = kLook},
                                           .seed = round + 1});
      if (look.status != Status::converged) return look.status;
      if (std::abs(look.values(0)) > last * (1 + kLook)) return Status::converged;
    }
    const Eigen::Index count = std::max<Eigen::Index>(1, missing);
    // Fewer vectors mean more restarts, more vectors solves that were not needed: measured to be best.
    const Eigen::Index vectors = 2 * count + 4;
    const Run<Entry> run = run_spectra(bounded, mass, mass_product, found,
                                       {.lanczos = {.count = count,
                                                    .vectors = vectors,
                                                    .restarts = restarts_within(limit, vectors, count),
                                                    .tolerance = options.tolerance},
                                        .seed = round + 1});
    if (run.status != Status::converged) return run.status;
    const double nearest = std::abs(found.size() == 0 ? run.values(0) : found.values.front());
    for (Eigen::Index k = 0; k < run.values.size(); ++k) {
      if (std::abs(run.values(k)) > kRange * nearest) return Status::converged;
      found.add(run.values(k), run.vectors.col(k), mass);
    }
    found.sort();
    // A copy of the last one is no news: the set may end within a multiple eigenvalue.
    if (missing <= 0 && std::abs(run.values(0)) >= last * (1 - 1e-9)) return Status::converged;
  }
  return Status::iteration_limit;
}

}  // namespace

template <class Scalar>
Modes<Scalar> nearest_modes(const ShiftInverse<Scalar>& inverse, const Eigen::SparseMatrix<Scalar>& mass,
                            const ModesOptions& options) {
  assert(options.count >= 1 && options.count <= inverse.rows && mass.rows() == inverse.rows);
  constexpr Eigen::Index kDenseSize = 200;
  // Factors of larger bodies are read from memory for every solve.
  constexpr Eigen::Index kLarge = 30000;
  ModesOptions in_blocks = options;
  if (inverse.rows >= kLarge) in_blocks.block = std::max(options.block, kLargeBlock);
  const bool dense = inverse.rows <= kDenseSize || 3 * Eigen::Index{options.count} > inverse.rows;
  if (!dense && in_blocks.block > 0 && inverse.perform_block) return block_modes(inverse, mass, in_blocks);
  Modes<Scalar> modes;
  modes.shift = options.shift;
  Found<Scalar> found;
  found.vectors.resize(inverse.rows, 0);
  found.weighted.resize(inverse.rows, 0);
  if (dense) {
    found = dense_modes(inverse, mass);
    modes.status = found.status;
  } else {
    modes.status = find_modes(inverse, mass, options, found);
  }
  if (modes.status != Status::converged) return modes;

  const Eigen::Index kept = std::min<Eigen::Index>(options.count, found.size());
  std::vector<Eigen::Index> order(static_cast<std::size_t>(kept));
  std::iota(order.begin(), order.end(), Eigen::Index{0});
  const Eigen::Map<const Eigen::VectorXd> values(found.values.data(), found.size());
  std::sort(order.begin(), order.end(), [&](Eigen::Index a, Eigen::Index b) { return values(a) < values(b); });
  modes.eigenvalues = values(order).array() + modes.shift;
  modes.vectors = found.vectors(Eigen::all, order);
  return modes;
}

template Modes<double> nearest_modes(const ShiftInverse<double>&, const Eigen::SparseMatrix<double>&,
                                     const ModesOptions&);
template Modes<std::complex<double>> nearest_modes(const ShiftInverse<std::complex<double>>&,
                                                   const Eigen::SparseMatrix<std::complex<double>>&,
                                                   const ModesOptions&);

}  // namespace dovetail::numerics
