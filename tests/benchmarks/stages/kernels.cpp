#include "tests/benchmarks/stages/kernels.hpp"

#include <fmt/format.h>
#include <lapacke.h>

#include <memory>
#include <stdexcept>

#include "numerics/elimination_order.hpp"
#include "numerics/partial_cholesky.hpp"
#include "steady/work.hpp"

namespace dovetail::benchmarks {

namespace {

/// Positive definite, and with large entries away from the diagonal, so that rows are exchanged.
Eigen::MatrixXd dense_matrix(Eigen::Index n) {
  const Eigen::MatrixXd vectors = Eigen::MatrixXd::Random(n, 4);
  Eigen::MatrixXd matrix = vectors * vectors.transpose();
  matrix.diagonal().array() += 1;
  return matrix;
}

}  // namespace

std::vector<Kernel> sparse_kernels(const Eigen::SparseMatrix<double>& stiffness, Eigen::Index border) {
  const auto matrix = std::make_shared<const Eigen::SparseMatrix<double>>(stiffness);
  const auto upper = std::make_shared<const Eigen::SparseMatrix<double>>(stiffness.triangularView<Eigen::Upper>());
  const auto order = std::make_shared<numerics::EliminationOrder>();
  const auto cholesky = std::make_shared<numerics::PartialCholesky>();
  const auto factorise = [=] { return cholesky->factorise(*matrix, border, order.get()); };
  if (factorise() != Status::converged)
    throw std::runtime_error("the stiffness of the limits is not positive definite");
  const Eigen::Index columns = KernelParams{}.columns;
  const auto loads = std::make_shared<const Eigen::MatrixXd>(Eigen::MatrixXd::Random(matrix->rows(), columns));
  return {{.work = {.name = kOrder, .run = [=] { (void)numerics::EliminationOrder().of(*upper, border); }},
           .units = 1,
           .words = "orders of elimination"},
          {.work = {.name = kFactorisation, .run = [=] { (void)factorise(); }},
           .units = 1,
           .words = fmt::format("factorisations of {} unknowns, {} of them last", matrix->rows(), border)},
          {.work = {.name = kBackSolve, .run = [=] { (void)cholesky->substitute(cholesky->eliminate(*loads)); }},
           .units = static_cast<double>(columns),
           .words = fmt::format("back-solves, of {} at once", columns),
           .per = 1}};
}

Kernel dense_lu_kernel(Eigen::Index unknowns) {
  const auto original = std::make_shared<const Eigen::MatrixXd>(dense_matrix(unknowns));
  const auto matrix = std::make_shared<Eigen::MatrixXd>();
  const auto pivots = std::make_shared<std::vector<lapack_int>>(static_cast<std::size_t>(unknowns));
  const auto n = static_cast<lapack_int>(unknowns);
  return {.work = {.name = kDenseLu,
                   .run = [=] { LAPACKE_dgetrf_work(LAPACK_COL_MAJOR, n, n, matrix->data(), n, pivots->data()); },
                   .prepare = [=] { *matrix = *original; }},
          .units = steady::factorisation_operations(unknowns),
          .words = fmt::format("dgetrf of {} unknowns", unknowns)};
}

Kernel dense_inverse_kernel(Eigen::Index unknowns) {
  const auto original = std::make_shared<const Eigen::MatrixXd>(dense_matrix(unknowns));
  const auto matrix = std::make_shared<Eigen::MatrixXd>();
  const auto n = static_cast<lapack_int>(unknowns);
  const auto invert = [=] {
    LAPACKE_dpotrf_work(LAPACK_COL_MAJOR, 'L', n, matrix->data(), n);
    LAPACKE_dpotri_work(LAPACK_COL_MAJOR, 'L', n, matrix->data(), n);
  };
  const auto size = static_cast<double>(unknowns);
  return {.work = {.name = kDenseInverse, .run = invert, .prepare = [=] { *matrix = *original; }},
          .units = size * size * size,
          .words = fmt::format("dpotrf and dpotri of {} unknowns", unknowns)};
}

Kernel traffic_kernel() {
  const Eigen::Index numbers = KernelParams{}.streamed;
  const auto from = std::make_shared<const Eigen::VectorXd>(Eigen::VectorXd::Ones(numbers));
  const auto to = std::make_shared<Eigen::VectorXd>(Eigen::VectorXd::Zero(numbers));
  return {.work = {.name = kTraffic, .run = [=] { *to = 2 * *from; }},
          .units = static_cast<double>(2 * sizeof(double)) * static_cast<double>(numbers),
          .words = "MB from or to memory",
          .per = 1e6};
}

}  // namespace dovetail::benchmarks
