#include "steady/jacobian.hpp"

#include <algorithm>
#include <cassert>
#include <span>

#include "numerics/dense_product.hpp"

namespace dovetail::steady {
namespace {

// Nodes written together: their rows fill whole cache lines of a column.
constexpr std::size_t kBatch = 8;

// Rows of one node that are asked for: their place in the node's block and in the result.
struct NodeRows {
  Eigen::Index node = 0;
  std::vector<Eigen::Index> local, place;
  Eigen::MatrixXd complement;  // their rows of I - D
};

std::vector<NodeRows> by_node(const JacobianBlocks& blocks, const std::vector<Eigen::Index>& rows,
                              double regularisation) {
  const Eigen::Index n = blocks.size(), d = blocks.directions();
  std::vector<NodeRows> groups(blocks.derivative.size());
  for (std::size_t p = 0; p < rows.size(); ++p) {
    const Eigen::Index k = rows[p] / n, a = rows[p] % n;
    NodeRows& group = groups[static_cast<std::size_t>(a / d)];
    group.node = a / d;
    group.local.push_back(k * d + a % d);
    group.place.push_back(static_cast<Eigen::Index>(p));
  }
  std::erase_if(groups, [](const NodeRows& group) { return group.local.empty(); });
  for (NodeRows& group : groups) {
    group.complement = -(*blocks.derivative[static_cast<std::size_t>(group.node)])(group.local, Eigen::all);
    for (std::size_t p = 0; p < group.local.size(); ++p)
      group.complement(static_cast<Eigen::Index>(p), group.local[p]) += 1;
    group.complement *= 1 - regularisation;
  }
  return groups;
}

// Neighbouring rows of a product that go to neighbouring rows of the result.
struct Run {
  std::size_t product = 0;
  Eigen::Index from = 0, to = 0, length = 0;
};

std::vector<Run> runs_of(std::span<const NodeRows> batch) {
  std::vector<Run> runs;
  for (std::size_t g = 0; g < batch.size(); ++g)
    for (std::size_t p = 0; p < batch[g].place.size(); ++p) {
      const auto from = static_cast<Eigen::Index>(p);
      if (p > 0 && batch[g].place[p] == batch[g].place[p - 1] + 1)
        ++runs.back().length;
      else
        runs.push_back({.product = g, .from = from, .to = batch[g].place[p], .length = 1});
    }
  std::ranges::sort(runs, {}, &Run::to);
  return runs;
}

// The rows of `batch` in the columns of harmonic h. Cosine columns are E_c Re - E_s Im and sine columns E_c Im + E_s Re
// with E = I - D: one product per node gives both.
void write_harmonic(const JacobianBlocks& blocks, std::span<const NodeRows> batch, std::span<const Run> runs, int h,
                    const std::vector<double*>& columns, std::vector<Eigen::MatrixXd>& products) {
  const Eigen::Index n = blocks.size(), d = blocks.directions();
  const Eigen::Index first = h == 0 ? 0 : 2 * h - 1;
  std::vector<Eigen::Index> wanted;
  for (Eigen::Index a = 0; a < n; ++a)
    if (columns[static_cast<std::size_t>(first * n + a)] ||
        (h > 0 && columns[static_cast<std::size_t>((first + 1) * n + a)]))
      wanted.push_back(a);
  if (wanted.empty()) return;
  const bool all = static_cast<Eigen::Index>(wanted.size()) == n;
  // Nodes of a batch stand together but for those that have no rows.
  const Eigen::Index begin = batch.front().node * d, end = (batch.back().node + 1) * d;
  const Eigen::MatrixXcd stiffness = blocks.stiffness->rows(h, begin, end - begin);
  Eigen::MatrixXd left, right;
  for (std::size_t g = 0; g < batch.size(); ++g) {
    const Eigen::MatrixXd& complement = batch[g].complement;
    const Eigen::Index rows = complement.rows(), top = batch[g].node * d;
    const auto on_cosine = complement.middleCols(first * d, d);
    const auto z = stiffness.middleRows(top - begin, d);
    if (h == 0) {
      left = on_cosine;
      right = all ? Eigen::MatrixXd(z.real()) : Eigen::MatrixXd(z.real()(Eigen::all, wanted));
    } else {
      const auto on_sine = complement.middleCols((first + 1) * d, d);
      left.resize(2 * rows, 2 * d);
      left << on_cosine, -on_sine, on_sine, on_cosine;
      right.resize(2 * d, static_cast<Eigen::Index>(wanted.size()));
      for (Eigen::Index q = 0; q < right.cols(); ++q) {
        const Eigen::Index a = wanted[static_cast<std::size_t>(q)];
        for (Eigen::Index r = 0; r < d; ++r) {
          right(r, q) = z(r, a).real();
          right(d + r, q) = z(r, a).imag();
        }
      }
    }
    numerics::product(left, right, products[g]);
  }
  const auto copy_column = [&](double* to, Eigen::Index q, bool sine) {
    if (!to) return;
    for (const Run& run : runs) {
      const Eigen::Index skip = sine ? batch[run.product].complement.rows() : 0;
      const double* from = products[run.product].col(q).data() + skip + run.from;
      std::copy(from, from + run.length, to + run.to);
    }
  };
  for (std::size_t q = 0; q < wanted.size(); ++q)
    copy_column(columns[static_cast<std::size_t>(first * n + wanted[q])], static_cast<Eigen::Index>(q), false);
  if (h == 0) return;
  for (std::size_t q = 0; q < wanted.size(); ++q)
    copy_column(columns[static_cast<std::size_t>((first + 1) * n + wanted[q])], static_cast<Eigen::Index>(q), true);
}

// + D eps on the node's own columns; D = I - complement.
void add_penalty(const JacobianBlocks& blocks, const NodeRows& group, const std::vector<double*>& columns) {
  const Eigen::Index n = blocks.size(), d = blocks.directions(), m = d * blocks.coefficients();
  for (Eigen::Index l = 0; l < m; ++l) {
    const Eigen::Index dof = group.node * d + l % d;
    double* column = columns[static_cast<std::size_t>((l / d) * n + dof)];
    if (!column) continue;
    for (std::size_t p = 0; p < group.local.size(); ++p)
      column[group.place[p]] +=
          blocks.penalty(dof) * ((group.local[p] == l ? 1.0 : 0.0) - group.complement(static_cast<Eigen::Index>(p), l));
  }
}

}  // namespace

void assemble(const JacobianBlocks& blocks, const std::vector<Eigen::Index>& rows, const std::vector<double*>& columns,
              double regularisation) {
  assert(static_cast<Eigen::Index>(columns.size()) == blocks.size() * blocks.coefficients());
  const std::vector<NodeRows> groups = by_node(blocks, rows, regularisation);
  std::vector<Eigen::MatrixXd> products(kBatch);
  for (std::size_t start = 0; start < groups.size(); start += kBatch) {
    const std::span<const NodeRows> batch(groups.data() + start, std::min(kBatch, groups.size() - start));
    const std::vector<Run> runs = runs_of(batch);
    for (int h = 0; h <= blocks.stiffness->harmonics(); ++h) write_harmonic(blocks, batch, runs, h, columns, products);
    for (const NodeRows& group : batch) add_penalty(blocks, group, columns);
  }
}

Eigen::MatrixXd apply_derivative(const JacobianBlocks& blocks, const Eigen::MatrixXd& x, bool adjoint) {
  const Eigen::Index n = blocks.size(), d = blocks.directions(), k = blocks.coefficients();
  Eigen::MatrixXd result(x.rows(), x.cols()), local(d * k, x.cols()), changed;
  for (std::size_t i = 0; i < blocks.derivative.size(); ++i) {
    const Eigen::Index top = static_cast<Eigen::Index>(i) * d;
    for (Eigen::Index j = 0; j < k; ++j) local.middleRows(j * d, d) = x.middleRows(j * n + top, d);
    if (adjoint)
      changed.noalias() = blocks.derivative[i]->transpose() * local;
    else
      changed.noalias() = *blocks.derivative[i] * local;
    for (Eigen::Index j = 0; j < k; ++j) result.middleRows(j * n + top, d) = changed.middleRows(j * d, d);
  }
  return result;
}

Eigen::MatrixXd apply_jacobian(const JacobianBlocks& blocks, const Eigen::MatrixXd& x) {
  const Eigen::VectorXd penalty = blocks.penalty.replicate(blocks.coefficients(), 1);
  const Eigen::MatrixXd z = blocks.stiffness->apply(x);
  return z + apply_derivative(blocks, penalty.asDiagonal() * x - z, false);
}

Eigen::MatrixXd apply_jacobian_transposed(const JacobianBlocks& blocks, const Eigen::MatrixXd& x) {
  const Eigen::VectorXd penalty = blocks.penalty.replicate(blocks.coefficients(), 1);
  const Eigen::MatrixXd by_force = apply_derivative(blocks, x, true);
  return blocks.stiffness->apply(x - by_force, true) + penalty.asDiagonal() * by_force;
}

}  // namespace dovetail::steady
