#pragma once

#include <Eigen/Core>

namespace dovetail::numerics {

/// C = A B on OpenBLAS, which picks the widest vector instructions of the machine at run time where Eigen, built
/// portably, cannot. C is resized. Worth it from about 10^4 multiplications.
void product(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b, Eigen::MatrixXd& c);
/// C += A B, C of the right size; all may be blocks of larger matrices.
void add_product(const Eigen::Ref<const Eigen::MatrixXd>& a, const Eigen::Ref<const Eigen::MatrixXd>& b,
                 Eigen::Ref<Eigen::MatrixXd> c);
/// C += A B^T, the same.
void add_product_transposed(const Eigen::Ref<const Eigen::MatrixXd>& a, const Eigen::Ref<const Eigen::MatrixXd>& b,
                            Eigen::Ref<Eigen::MatrixXd> c);
[[nodiscard]] Eigen::MatrixXd product(const Eigen::Ref<const Eigen::MatrixXd>& a,
                                      const Eigen::Ref<const Eigen::MatrixXd>& b);
[[nodiscard]] Eigen::MatrixXcd product(const Eigen::Ref<const Eigen::MatrixXcd>& a,
                                       const Eigen::Ref<const Eigen::MatrixXcd>& b);
/// A^T B (without conjugation).
[[nodiscard]] Eigen::MatrixXd transposed_product(const Eigen::Ref<const Eigen::MatrixXd>& a,
                                                 const Eigen::Ref<const Eigen::MatrixXd>& b);
[[nodiscard]] Eigen::MatrixXcd transposed_product(const Eigen::Ref<const Eigen::MatrixXcd>& a,
                                                  const Eigen::Ref<const Eigen::MatrixXcd>& b);
/// A^H B
[[nodiscard]] Eigen::MatrixXd adjoint_product(const Eigen::Ref<const Eigen::MatrixXd>& a,
                                              const Eigen::Ref<const Eigen::MatrixXd>& b);
[[nodiscard]] Eigen::MatrixXcd adjoint_product(const Eigen::Ref<const Eigen::MatrixXcd>& a,
                                               const Eigen::Ref<const Eigen::MatrixXcd>& b);
/// B^T A B
[[nodiscard]] Eigen::MatrixXd congruent(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);

}  // namespace dovetail::numerics
