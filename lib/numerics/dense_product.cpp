#include "numerics/dense_product.hpp"

#include <cblas.h>

#include <algorithm>
#include <cassert>
#include <complex>
#include <cstddef>
#include <type_traits>

namespace dovetail::numerics {
namespace {

void gemm(CBLAS_TRANSPOSE form, int rows, int columns, int inner, const double* a, int lda, const double* b, int ldb,
          double* c, int ldc) {
  cblas_dgemm(CblasColMajor, form, CblasNoTrans, rows, columns, inner, 1.0, a, lda, b, ldb, 0.0, c, ldc);
}
void gemm(CBLAS_TRANSPOSE form, int rows, int columns, int inner, const std::complex<double>* a, int lda,
          const std::complex<double>* b, int ldb, std::complex<double>* c, int ldc) {
  const std::complex<double> one = 1, zero = 0;
  cblas_zgemm(CblasColMajor, form, CblasNoTrans, rows, columns, inner, &one, a, lda, b, ldb, &zero, c, ldc);
}

void gemv(CBLAS_TRANSPOSE form, int rows, int columns, const double* a, int lda, const double* x, double* y) {
  cblas_dgemv(CblasColMajor, form, rows, columns, 1.0, a, lda, x, 1, 0.0, y, 1);
}
// OpenBLAS 0.3.21 reads the entry behind the last of x, where memory may end: a zero follows there.
void gemv(CBLAS_TRANSPOSE form, int rows, int columns, const std::complex<double>* a, int lda,
          const std::complex<double>* x, std::complex<double>* y) {
  const std::complex<double> one = 1, zero = 0;
  Eigen::VectorXcd longer;
  if (form == CblasNoTrans) {
    longer.setZero(columns + 1);
    std::copy(x, x + columns, longer.data());
    x = longer.data();
  }
  cblas_zgemv(CblasColMajor, form, rows, columns, &one, a, lda, x, 1, &zero, y, 1);
}

// For a few columns OpenBLAS takes as long to copy A into the order that its kernel wants as to multiply, unless the
// product is so small that it reads A where it stands: then a block of columns of A at a time.
constexpr Eigen::Index kNarrow = 16;
constexpr int kBlock = 64;

/// C = A^T B for few columns.
void narrow(int rows, int columns, int inner, const double* a, int lda, const double* b, int ldb, double* c) {
  for (int i = 0; i < rows; i += kBlock)
    gemm(CblasTrans, std::min(kBlock, rows - i), columns, inner, a + static_cast<std::ptrdiff_t>(i) * lda, lda, b, ldb,
         c + i, rows);
}

/// C = A B with A in this form.
template <class Matrix>
void multiply(CBLAS_TRANSPOSE form, const Eigen::Ref<const Matrix>& a, const Eigen::Ref<const Matrix>& b, Matrix& c) {
  const bool turned = form != CblasNoTrans;
  const Eigen::Index rows = turned ? a.cols() : a.rows(), inner = turned ? a.rows() : a.cols();
  assert(inner == b.rows());
  if (inner == 0) {
    c = Matrix::Zero(rows, b.cols());
    return;
  }
  c.resize(rows, b.cols());
  if (c.size() == 0) return;
  if (b.cols() == 1)
    return gemv(form, static_cast<int>(a.rows()), static_cast<int>(a.cols()), a.data(),
                static_cast<int>(a.outerStride()), b.data(), c.data());
  if constexpr (std::is_same_v<Matrix, Eigen::MatrixXd>)
    if (turned && b.cols() <= kNarrow)
      return narrow(static_cast<int>(rows), static_cast<int>(b.cols()), static_cast<int>(inner), a.data(),
                    static_cast<int>(a.outerStride()), b.data(), static_cast<int>(b.outerStride()), c.data());
  gemm(form, static_cast<int>(rows), static_cast<int>(b.cols()), static_cast<int>(inner), a.data(),
       static_cast<int>(a.outerStride()), b.data(), static_cast<int>(b.outerStride()), c.data(),
       static_cast<int>(rows));
}

template <class Matrix>
Matrix multiplied(CBLAS_TRANSPOSE form, const Eigen::Ref<const Matrix>& a, const Eigen::Ref<const Matrix>& b) {
  Matrix c;
  multiply<Matrix>(form, a, b, c);
  return c;
}

}  // namespace

void product(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b, Eigen::MatrixXd& c) {
  multiply<Eigen::MatrixXd>(CblasNoTrans, a, b, c);
}

void add_product(const Eigen::Ref<const Eigen::MatrixXd>& a, const Eigen::Ref<const Eigen::MatrixXd>& b,
                 Eigen::Ref<Eigen::MatrixXd> c) {
  assert(a.cols() == b.rows() && c.rows() == a.rows() && c.cols() == b.cols());
  if (c.size() == 0 || a.cols() == 0) return;
  if (b.cols() == 1) {
    cblas_dgemv(CblasColMajor, CblasNoTrans, static_cast<int>(a.rows()), static_cast<int>(a.cols()), 1.0, a.data(),
                static_cast<int>(a.outerStride()), b.data(), 1, 1.0, c.data(), 1);
    return;
  }
  cblas_dgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, static_cast<int>(a.rows()), static_cast<int>(b.cols()),
              static_cast<int>(a.cols()), 1.0, a.data(), static_cast<int>(a.outerStride()), b.data(),
              static_cast<int>(b.outerStride()), 1.0, c.data(), static_cast<int>(c.outerStride()));
}

void add_product_transposed(const Eigen::Ref<const Eigen::MatrixXd>& a, const Eigen::Ref<const Eigen::MatrixXd>& b,
                            Eigen::Ref<Eigen::MatrixXd> c) {
  assert(a.cols() == b.cols() && c.rows() == a.rows() && c.cols() == b.rows());
  if (c.size() == 0 || a.cols() == 0) return;
  cblas_dgemm(CblasColMajor, CblasNoTrans, CblasTrans, static_cast<int>(a.rows()), static_cast<int>(b.rows()),
              static_cast<int>(a.cols()), 1.0, a.data(), static_cast<int>(a.outerStride()), b.data(),
              static_cast<int>(b.outerStride()), 1.0, c.data(), static_cast<int>(c.outerStride()));
}

Eigen::MatrixXd product(const Eigen::Ref<const Eigen::MatrixXd>& a, const Eigen::Ref<const Eigen::MatrixXd>& b) {
  return multiplied<Eigen::MatrixXd>(CblasNoTrans, a, b);
}
Eigen::MatrixXd transposed_product(const Eigen::Ref<const Eigen::MatrixXd>& a,
                                   const Eigen::Ref<const Eigen::MatrixXd>& b) {
  return multiplied<Eigen::MatrixXd>(CblasTrans, a, b);
}
Eigen::MatrixXd adjoint_product(const Eigen::Ref<const Eigen::MatrixXd>& a,
                                const Eigen::Ref<const Eigen::MatrixXd>& b) {
  return multiplied<Eigen::MatrixXd>(CblasTrans, a, b);
}
Eigen::MatrixXcd product(const Eigen::Ref<const Eigen::MatrixXcd>& a, const Eigen::Ref<const Eigen::MatrixXcd>& b) {
  return multiplied<Eigen::MatrixXcd>(CblasNoTrans, a, b);
}
Eigen::MatrixXcd transposed_product(const Eigen::Ref<const Eigen::MatrixXcd>& a,
                                    const Eigen::Ref<const Eigen::MatrixXcd>& b) {
  return multiplied<Eigen::MatrixXcd>(CblasTrans, a, b);
}
Eigen::MatrixXcd adjoint_product(const Eigen::Ref<const Eigen::MatrixXcd>& a,
                                 const Eigen::Ref<const Eigen::MatrixXcd>& b) {
  return multiplied<Eigen::MatrixXcd>(CblasConjTrans, a, b);
}

Eigen::MatrixXd congruent(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return transposed_product(b, product(a, b));
}

}  // namespace dovetail::numerics
