#include "numerics/fourier.hpp"

#include <fftw3.h>
#include <pthread.h>

#include <cassert>
#include <cmath>
#include <complex>
#include <map>
#include <mutex>
#include <numbers>
#include <string>

#include "core/errors.hpp"

namespace dovetail::numerics {
namespace {

// FFTW's planner is the one part of it that is not thread-safe. A process that is made while another thread plans must
// not be born with the lock.
std::mutex& planner() {
  static std::mutex mutex;
  static const int kept = ::pthread_atfork([] { mutex.lock(); }, [] { mutex.unlock(); }, [] { mutex.unlock(); });
  static_cast<void>(kept);
  return mutex;
}

fftw_complex* as_fftw(Eigen::MatrixXcd& spectrum) {
  return reinterpret_cast<fftw_complex*>(spectrum.data());
}

}  // namespace

struct FourierBasis::Plans {
  struct Pair {
    fftw_plan forward = nullptr, backward = nullptr;
  };
  std::map<int, Pair> by_signals;

  Pair get(int samples, int signals) {
    const std::lock_guard lock(planner());
    Pair& pair = by_signals[signals];
    if (pair.forward != nullptr) return pair;
    const int half = samples / 2 + 1;
    Eigen::MatrixXd time(samples, signals);
    Eigen::MatrixXcd spectrum(half, signals);
    // Unaligned plans may be executed on any array.
    const unsigned flags = FFTW_ESTIMATE | FFTW_UNALIGNED;
    pair.forward = fftw_plan_many_dft_r2c(1, &samples, signals, time.data(), nullptr, 1, samples, as_fftw(spectrum),
                                          nullptr, 1, half, flags);
    pair.backward = fftw_plan_many_dft_c2r(1, &samples, signals, as_fftw(spectrum), nullptr, 1, half, time.data(),
                                           nullptr, 1, samples, flags);
    return pair;
  }

  Plans() = default;
  Plans(const Plans&) = delete;
  Plans& operator=(const Plans&) = delete;
  ~Plans() {
    const std::lock_guard lock(planner());
    for (auto& [signals, pair] : by_signals) {
      fftw_destroy_plan(pair.forward);
      fftw_destroy_plan(pair.backward);
    }
  }
};

FourierBasis::FourierBasis(int harmonics, int samples)
    : harmonics_(harmonics), samples_(samples), plans_(std::make_shared<Plans>()) {
  if (harmonics < 0)
    throw InputError({.file = {}, .key = "harmonics", .value = std::to_string(harmonics), .allowed = "must be >= 0"});
  if (samples <= 2 * harmonics)
    throw InputError({.file = {},
                      .key = "samples",
                      .value = std::to_string(samples),
                      .allowed = "must be > 2 * harmonics = " + std::to_string(2 * harmonics)});
  const int k = coefficients();
  synthesis_.resize(samples, k);
  // The angle is reduced exactly (n j mod N) so that opposite samples are opposite to the last bit or nearly so.
  for (int n = 0; n < samples; ++n) {
    synthesis_(n, 0) = 1;
    for (int j = 1; j <= harmonics; ++j) {
      const double tau = 2 * std::numbers::pi * static_cast<double>((static_cast<long>(n) * j) % samples) / samples;
      synthesis_(n, 2 * j - 1) = std::cos(tau);
      synthesis_(n, 2 * j) = std::sin(tau);
    }
  }
  analysis_ = synthesis_.transpose() * (2.0 / samples);
  analysis_.row(0) *= 0.5;
}

Eigen::MatrixXd FourierBasis::synthesise(const Eigen::Ref<const Eigen::MatrixXd>& coefficients) const {
  assert(coefficients.cols() == this->coefficients());
  const Eigen::Index signals = coefficients.rows();
  Eigen::MatrixXd time(samples_, signals);
  if (signals == 0) return time;
  Eigen::MatrixXcd spectrum = Eigen::MatrixXcd::Zero(samples_ / 2 + 1, signals);
  spectrum.row(0).real() = coefficients.col(0).transpose();
  for (int j = 1; j <= harmonics_; ++j) {
    spectrum.row(j).real() = 0.5 * coefficients.col(2 * j - 1).transpose();
    spectrum.row(j).imag() = -0.5 * coefficients.col(2 * j).transpose();
  }
  const Plans::Pair plan = plans_->get(samples_, static_cast<int>(signals));
  fftw_execute_dft_c2r(plan.backward, as_fftw(spectrum), time.data());
  return time;
}

Eigen::MatrixXd FourierBasis::analyse(const Eigen::Ref<const Eigen::MatrixXd>& samples) const {
  assert(samples.rows() == samples_);
  const Eigen::Index signals = samples.cols();
  Eigen::MatrixXd result(signals, coefficients());
  if (signals == 0) return result;
  Eigen::MatrixXd time = samples;
  Eigen::MatrixXcd spectrum(samples_ / 2 + 1, signals);
  const Plans::Pair plan = plans_->get(samples_, static_cast<int>(signals));
  fftw_execute_dft_r2c(plan.forward, time.data(), as_fftw(spectrum));
  const double scale = 1.0 / samples_;
  result.col(0) = scale * spectrum.row(0).real().transpose();
  for (int j = 1; j <= harmonics_; ++j) {
    result.col(2 * j - 1) = 2 * scale * spectrum.row(j).real().transpose();
    result.col(2 * j) = -2 * scale * spectrum.row(j).imag().transpose();
  }
  return result;
}

Eigen::VectorXd FourierBasis::at(double tau) const {
  Eigen::VectorXd row(coefficients());
  row(0) = 1;
  for (int j = 1; j <= harmonics_; ++j) {
    row(2 * j - 1) = std::cos(j * tau);
    row(2 * j) = std::sin(j * tau);
  }
  return row;
}

Eigen::VectorXd FourierBasis::derivative_at(double tau) const {
  Eigen::VectorXd row(coefficients());
  row(0) = 0;
  for (int j = 1; j <= harmonics_; ++j) {
    row(2 * j - 1) = -j * std::sin(j * tau);
    row(2 * j) = j * std::cos(j * tau);
  }
  return row;
}

}  // namespace dovetail::numerics
