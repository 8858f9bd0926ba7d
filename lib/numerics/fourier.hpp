#pragma once

#include <Eigen/Core>
#include <memory>

namespace dovetail::numerics {

/// Real Fourier series x(tau) = a0 + sum_j ( c_j cos(j tau) + s_j sin(j tau) ), j = 1..H, sampled at
/// tau_n = 2 pi n / N, n = 0..N-1. Coefficients of one signal: [a0, c1, s1, ..., cH, sH], K = 2H+1 of them.
///
/// Transforms go through FFTW many-signal plans made with FFTW_ESTIMATE, so equal input gives equal bits in
/// every run. Plans are cached per object and number of signals; copies share them. All const members may be
/// called from several threads.
class FourierBasis {
 public:
  /// Throws InputError unless harmonics >= 0 and samples > 2 * harmonics (fewer samples would alias).
  FourierBasis(int harmonics, int samples);

  [[nodiscard]] int harmonics() const { return harmonics_; }
  [[nodiscard]] int samples() const { return samples_; }
  [[nodiscard]] int coefficients() const { return 2 * harmonics_ + 1; }

  /// Coefficients [signals, K] to samples [N, signals]. O(signals N log N).
  [[nodiscard]] Eigen::MatrixXd synthesise(const Eigen::Ref<const Eigen::MatrixXd>& coefficients) const;
  /// Samples [N, signals] to the first K coefficients [signals, K]. O(signals N log N).
  [[nodiscard]] Eigen::MatrixXd analyse(const Eigen::Ref<const Eigen::MatrixXd>& samples) const;

  /// Row n holds the K basis functions at tau_n [N, K]: samples of one signal = table * coefficients.
  [[nodiscard]] const Eigen::MatrixXd& synthesis_table() const { return synthesis_; }
  /// Coefficients of one signal = analysis_table * samples, [K, N]. analysis * synthesis = identity.
  [[nodiscard]] const Eigen::MatrixXd& analysis_table() const { return analysis_; }

  /// The K basis functions at any tau (radians), and their derivatives with respect to tau.
  [[nodiscard]] Eigen::VectorXd at(double tau) const;
  [[nodiscard]] Eigen::VectorXd derivative_at(double tau) const;

 private:
  struct Plans;
  int harmonics_, samples_;
  Eigen::MatrixXd synthesis_, analysis_;
  std::shared_ptr<Plans> plans_;  // shared by copies: a plan depends on N and the number of signals only
};

}  // namespace dovetail::numerics
