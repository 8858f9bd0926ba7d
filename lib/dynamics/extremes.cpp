#include "dynamics/extremes.hpp"

#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

#include "dynamics/params.hpp"

namespace dovetail::dynamics {
namespace {

constexpr ExtremesParams kExtremes = {};

struct Value {
  double value = 0, first = 0, second = 0;
};

// Cosines and sines of the multiples of tau follow from one another: each of their own takes most of the time.
Value evaluate(const Eigen::Ref<const Eigen::VectorXd>& a, double tau) {
  Value v{.value = a(0)};
  const std::complex<double> first = std::polar(1.0, tau);
  std::complex<double> turn = 1;
  for (Eigen::Index j = 1; 2 * j < a.size(); ++j) {
    turn = {turn.real() * first.real() - turn.imag() * first.imag(),
            turn.real() * first.imag() + turn.imag() * first.real()};
    const double h = static_cast<double>(j), c = turn.real(), s = turn.imag();
    v.value += a(2 * j - 1) * c + a(2 * j) * s;
    v.first += h * (a(2 * j) * c - a(2 * j - 1) * s);
    v.second -= h * h * (a(2 * j - 1) * c + a(2 * j) * s);
  }
  return v;
}

// The zero of the derivative between lower and upper, where it changes sign: Newton, bisecting when it leaves.
double stationary(const Eigen::Ref<const Eigen::VectorXd>& a, double lower, double upper) {
  const bool rising = evaluate(a, lower).first > 0;
  double tau = (lower + upper) / 2;
  for (int i = 0; i < kExtremes.iterations && upper - lower > kExtremes.angle; ++i) {
    const Value v = evaluate(a, tau);
    ((v.first > 0) == rising ? lower : upper) = tau;
    double next = v.second != 0 ? tau - v.first / v.second : lower;
    if (!(next > lower && next < upper)) next = (lower + upper) / 2;
    if (std::abs(next - tau) < kExtremes.angle) return next;
    tau = next;
  }
  return tau;
}

}  // namespace

Extremes extremes(const Eigen::Ref<const Eigen::VectorXd>& coefficients) {
  const Eigen::Index harmonics = coefficients.size() / 2;
  Extremes result{.minimum = coefficients(0), .maximum = coefficients(0)};
  if (harmonics == 0 || coefficients.tail(2 * harmonics).isZero(0)) return result;
  const Eigen::Index grid = kExtremes.places * harmonics;
  const double width = 2 * std::numbers::pi / static_cast<double>(grid);
  const double huge = std::numeric_limits<double>::infinity();
  result.minimum = huge;
  result.maximum = -huge;
  Value before = evaluate(coefficients, 0);
  for (Eigen::Index i = 0; i < grid; ++i) {
    const double lower = width * static_cast<double>(i), upper = width * static_cast<double>(i + 1);
    const Value after = evaluate(coefficients, upper);
    // All sign changes are refined: a polynomial of degree H has at most 2H of them.
    double tau = lower, value = before.value;
    if (before.first * after.first < 0) {
      tau = stationary(coefficients, lower, upper);
      value = evaluate(coefficients, tau).value;
    }
    if (value > result.maximum) {
      result.maximum = value;
      result.tau_maximum = tau;
    }
    if (value < result.minimum) {
      result.minimum = value;
      result.tau_minimum = tau;
    }
    before = after;
  }
  return result;
}

Eigen::VectorXd fourier_row(double tau, Eigen::Index coefficients) {
  Eigen::VectorXd row(coefficients);
  row(0) = 1;
  for (Eigen::Index j = 1; 2 * j < coefficients; ++j) {
    row(2 * j - 1) = std::cos(static_cast<double>(j) * tau);
    row(2 * j) = std::sin(static_cast<double>(j) * tau);
  }
  return row;
}

}  // namespace dovetail::dynamics
