#include "numerics/dense_product.hpp"

#include <cblas.h>

#include <cassert>
#include <complex>

namespace dovetail::numerics {
namespace {

Eigen::MatrixXcd complex_product(CBLAS_TRANSPOSE first, const Eigen::MatrixXcd& a, const Eigen::MatrixXcd& b) {
  const Eigen::Index rows = first == CblasNoTrans ? a.rows() : a.cols();
  const Eigen::Index inner = first == CblasNoTrans ? a.cols() : a.rows();
  assert(inner == b.rows());
  if (inner == 0) return Eigen::MatrixXcd::Zero(rows, b.cols());
  Eigen::MatrixXcd c(rows, b.cols());
  if (c.size() == 0) return c;
  const std::complex<double> one = 1, zero = 0;
  cblas_zgemm(CblasColMajor, first, CblasNoTrans, static_cast<int>(rows), static_cast<int>(b.cols()),
              static_cast<int>(inner), &one, a.data(), static_cast<int>(a.rows()), b.data(), static_cast<int>(b.rows()),
              &zero, c.data(), static_cast<int>(rows));
  return c;
}

}  // namespace

void product(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b, Eigen::MatrixXd& c) {
  assert(a.cols() == b.rows());
  c.resize(a.rows(), b.cols());
  if (c.size() == 0) return;
  if (a.cols() == 0) {
    c.setZero();
    return;
  }
  cblas_dgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, static_cast<int>(a.rows()), static_cast<int>(b.cols()),
              static_cast<int>(a.cols()), 1.0, a.data(), static_cast<int>(a.rows()), b.data(),
              static_cast<int>(b.rows()), 0.0, c.data(), static_cast<int>(c.rows()));
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

Eigen::MatrixXd transposed_product(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  assert(a.rows() == b.rows());
  Eigen::MatrixXd c = Eigen::MatrixXd::Zero(a.cols(), b.cols());
  if (c.size() == 0 || a.rows() == 0) return c;
  cblas_dgemm(CblasColMajor, CblasTrans, CblasNoTrans, static_cast<int>(a.cols()), static_cast<int>(b.cols()),
              static_cast<int>(a.rows()), 1.0, a.data(), static_cast<int>(a.outerStride()), b.data(),
              static_cast<int>(b.outerStride()), 0.0, c.data(), static_cast<int>(c.rows()));
  return c;
}

Eigen::MatrixXd product(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  Eigen::MatrixXd c;
  product(a, b, c);
  return c;
}

Eigen::MatrixXd adjoint_product(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return transposed_product(a, b);
}

Eigen::MatrixXd congruent(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return transposed_product(b, product(a, b));
}

Eigen::MatrixXcd product(const Eigen::MatrixXcd& a, const Eigen::MatrixXcd& b) {
  return complex_product(CblasNoTrans, a, b);
}

Eigen::MatrixXcd transposed_product(const Eigen::MatrixXcd& a, const Eigen::MatrixXcd& b) {
  return complex_product(CblasTrans, a, b);
}

Eigen::MatrixXcd adjoint_product(const Eigen::MatrixXcd& a, const Eigen::MatrixXcd& b) {
  return complex_product(CblasConjTrans, a, b);
}

}  // namespace dovetail::numerics
