#include "dynamics/harmonic_matrices.hpp"

#include <algorithm>
#include <utility>

#include "dynamics/harmonic_blocks.hpp"
#include "numerics/dense_product.hpp"

namespace dovetail::dynamics {

using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;

namespace {

template <class Product>
MatrixXd applied_to_all(const MatrixXd& x, int harmonics, Index in, Index out, const Product& product) {
  const Index coefficients = 2 * harmonics + 1;
  // Coefficient by coefficient: a view.
  const Eigen::Map<const MatrixXd> columns(x.data(), in, coefficients * x.cols());
  std::vector<Index> there;
  for (Index j = 0; j < columns.cols(); ++j)
    if (!columns.col(j).isZero(0)) there.push_back(j);
  MatrixXd result;
  if (static_cast<Index>(there.size()) == columns.cols()) {
    result = product(columns);
  } else {
    result = MatrixXd::Zero(out, columns.cols());
    if (!there.empty()) result(Eigen::all, there) = product(MatrixXd(columns(Eigen::all, there)));
  }
  result.resize(out * coefficients, x.cols());
  return result;
}

/// Neighbouring dofs among those listed: the first one's place in the list, and how many.
struct Run {
  Index place = 0, first = 0, count = 0;
};

std::vector<Run> runs_of(const std::vector<Index>& dofs) {
  std::vector<Run> runs;
  for (std::size_t p = 0; p < dofs.size(); ++p)
    if (p > 0 && dofs[p] == dofs[p - 1] + 1)
      ++runs.back().count;
    else
      runs.push_back({.place = static_cast<Index>(p), .first = dofs[p], .count = 1});
  return runs;
}

}  // namespace

MatrixXd apply_to_all(const MatrixXd& a, const MatrixXd& x, int harmonics) {
  return applied_to_all(x, harmonics, a.cols(), a.rows(),
                        [&a](const Eigen::Ref<const MatrixXd>& columns) { return numerics::product(a, columns); });
}

MatrixXd apply_transposed_to_all(const MatrixXd& a, const MatrixXd& x, int harmonics) {
  return applied_to_all(x, harmonics, a.rows(), a.cols(), [&a](const Eigen::Ref<const MatrixXd>& columns) {
    return numerics::transposed_product(a, columns);
  });
}

MatrixXd apply_low_rank(const LowRank& of, const MatrixXd& x, bool conjugated) {
  std::vector<const MatrixXcd*> inner;
  for (const MatrixXcd& matrix : of.inner) inner.push_back(&matrix);
  const int harmonics = static_cast<int>(inner.size()) - 1;
  const MatrixXd seen = apply_transposed_to_all(of.right, x, harmonics);
  return apply_to_all(of.left, apply_harmonics(inner, conjugated ? Form::conjugated : Form::plain, seen), harmonics);
}

HarmonicMatrices::HarmonicMatrices(std::vector<MatrixXcd> dense) : dense_(std::move(dense)) {}

HarmonicMatrices::HarmonicMatrices(std::shared_ptr<const MatrixXd> base, std::shared_ptr<const MatrixXd> coupling,
                                   std::vector<MatrixXcd> inner)
    : base_(std::move(base)), coupling_(std::move(coupling)), inner_(std::move(inner)) {}

bool HarmonicMatrices::all_finite() const {
  const auto finite = [](const MatrixXcd& matrix) { return matrix.allFinite(); };
  return std::ranges::all_of(base_ ? inner_ : dense_, finite);
}

double HarmonicMatrices::entries() const {
  const auto n = static_cast<double>(size()), count = static_cast<double>(harmonics() + 1);
  if (!base_) return 2 * count * n * n;
  const auto m = static_cast<double>(coupling_->cols());
  return n * (n + 2 * m) + 2 * count * m * m;
}

MatrixXcd HarmonicMatrices::rows(int h, Index first, Index count) const {
  const auto at = static_cast<std::size_t>(h);
  if (!base_) return dense_[at].middleRows(first, count);
  const MatrixXcd seen = coupling_->middleRows(first, count) * inner_[at];
  MatrixXcd result(count, size());
  // Columns of K are its rows and stand together.
  result.real() =
      (base_->middleCols(first, count) + numerics::product(*coupling_, seen.real().transpose())).transpose();
  if (h == 0)
    result.imag().setZero();
  else
    result.imag() = numerics::product(*coupling_, seen.imag().transpose()).transpose();
  return result;
}

MatrixXd HarmonicMatrices::mean() const {
  if (!base_) return matrix(0).real();
  MatrixXd result = *base_;
  numerics::add_product(numerics::product(*coupling_, MatrixXd(inner_[0].real())), MatrixXd(coupling_->transpose()),
                        result);
  return result;
}

MatrixXd HarmonicMatrices::apply_at(const std::vector<Index>& dofs, const MatrixXd& x) const {
  const Index n = size(), k = coefficients(), rows = static_cast<Index>(dofs.size());
  MatrixXd result(rows * k, x.cols());
  const std::vector<Run> runs = runs_of(dofs);
  if (base_) {
    // Symmetric: its columns, which stand together, are the rows.
    const Eigen::Map<const MatrixXd> columns(x.data(), n, k * x.cols());
    Eigen::Map<MatrixXd> all(result.data(), rows, k * x.cols());
    for (const Run& run : runs)
      all.middleRows(run.place, run.count) =
          numerics::transposed_product(base_->middleCols(run.first, run.count), columns);
    const MatrixXd left = (*coupling_)(dofs, Eigen::all);
    return result + apply_low_rank({.left = left, .inner = inner_, .right = *coupling_}, x, false);
  }
  for (Index h = 0; h <= harmonics(); ++h) {
    const MatrixXcd there = amplitude(x, n, h, false);
    MatrixXcd applied(rows, x.cols());
    for (const Run& run : runs)
      applied.middleRows(run.place, run.count) =
          numerics::transposed_product(dense_[static_cast<std::size_t>(h)].middleCols(run.first, run.count), there);
    put_amplitude(applied, h, false, result);
  }
  return result;
}

MatrixXd HarmonicMatrices::apply_from(const std::vector<Index>& dofs, const MatrixXd& x, bool conjugated) const {
  const Index n = size(), k = coefficients();
  MatrixXd result = MatrixXd::Zero(n * k, x.cols());
  const std::vector<Run> runs = runs_of(dofs);
  if (base_) {
    const Eigen::Map<const MatrixXd> columns(x.data(), n, k * x.cols());
    Eigen::Map<MatrixXd> all(result.data(), n, k * x.cols());
    for (const Run& run : runs)
      numerics::add_product(base_->middleCols(run.first, run.count), columns.middleRows(run.first, run.count), all);
    return result + apply_low_rank({.left = *coupling_, .inner = inner_, .right = *coupling_}, x, conjugated);
  }
  for (Index h = 0; h <= harmonics(); ++h) {
    const MatrixXcd there = amplitude(x, n, h, conjugated);
    MatrixXcd applied = MatrixXcd::Zero(n, x.cols());
    for (const Run& run : runs)
      applied += numerics::product(dense_[static_cast<std::size_t>(h)].middleCols(run.first, run.count),
                                   there.middleRows(run.first, run.count));
    put_amplitude(applied, h, conjugated, result);
  }
  return result;
}

MatrixXd HarmonicMatrices::apply(const MatrixXd& x, bool conjugated) const {
  // Where few dofs move their columns are all that is read.
  const Index n = size();
  std::vector<Index> moved;
  for (Index a = 0; a < n && 4 * static_cast<Index>(moved.size()) <= n; ++a) {
    bool moves = false;
    for (Index k = 0; k < coefficients() && !moves; ++k) moves = !x.row(k * n + a).isZero(0);
    if (moves) moved.push_back(a);
  }
  if (4 * static_cast<Index>(moved.size()) <= n) return apply_from(moved, x, conjugated);
  if (base_)
    // K is symmetric, and its columns stand together.
    return apply_transposed_to_all(*base_, x, harmonics()) +
           apply_low_rank({.left = *coupling_, .inner = inner_, .right = *coupling_}, x, conjugated);
  std::vector<const MatrixXcd*> matrices;
  for (const MatrixXcd& matrix : dense_) matrices.push_back(&matrix);
  return apply_harmonics(matrices, conjugated ? Form::conjugated : Form::plain, x);
}

MatrixXd HarmonicMatrices::apply_to_blocks(const std::vector<MatrixXd>& local, bool conjugated) const {
  const Index n = size(), k = coefficients(), blocks = static_cast<Index>(local.size());
  MatrixXd result(n * k, blocks);
  if (blocks == 0) return result;
  const Index d = local.front().rows();
  if (base_) {
    MatrixXd seen(coupling_->cols() * k, blocks);
    for (Index i = 0; i < blocks; ++i) {
      const MatrixXd& at = local[static_cast<std::size_t>(i)];
      result.col(i).reshaped(n, k).noalias() = base_->middleCols(i * d, d) * at;
      seen.col(i).reshaped(coupling_->cols(), k).noalias() = coupling_->middleRows(i * d, d).transpose() * at;
    }
    std::vector<const MatrixXcd*> inner;
    for (const MatrixXcd& matrix : inner_) inner.push_back(&matrix);
    return result + apply_to_all(*coupling_, apply_harmonics(inner, conjugated ? Form::conjugated : Form::plain, seen),
                                 harmonics());
  }
  const double sign = conjugated ? 1 : -1;
  for (Index h = 0; 2 * h < k; ++h) {
    const MatrixXcd& matrix = dense_[static_cast<std::size_t>(h)];
    const Index cosine = std::max<Index>(2 * h - 1, 0), sine = 2 * h;
    for (Index i = 0; i < blocks; ++i) {
      Eigen::VectorXcd amplitude(d);
      amplitude.real() = local[static_cast<std::size_t>(i)].col(cosine);
      if (h == 0)
        amplitude.imag().setZero();
      else
        amplitude.imag() = sign * local[static_cast<std::size_t>(i)].col(sine);
      const Eigen::VectorXcd applied = matrix.middleCols(i * d, d) * amplitude;
      result.col(i).segment(cosine * n, n) = applied.real();
      if (h > 0) result.col(i).segment(sine * n, n) = sign * applied.imag();
    }
  }
  return result;
}

void HarmonicMatrices::add_to_diagonal(int h, const Eigen::VectorXcd& values) {
  if (base_) {
    for (int k = 0; k <= harmonics(); ++k) dense_.push_back(matrix(k));
    base_ = coupling_ = nullptr;
    inner_.clear();
  }
  dense_[static_cast<std::size_t>(h)].diagonal() += values;
}

}  // namespace dovetail::dynamics
