#pragma once

#include <cmath>

#include "contact/sample_step.hpp"

namespace dovetail::contact {

/// Derivatives of what a march carries from sample to sample. They are rows over the coefficients of lambda_u,
/// direction by direction: index r K + k.
template <int Directions>
struct SampleTangent {
  Eigen::MatrixXd slip_force;   // S = d lambda_x,T, column r, [m, d-1]
  Eigen::MatrixXd previous;     // S of the sample before
  Eigen::VectorXd angle;        // d angle [m]
  Eigen::VectorXd load = {};    // d of the sum of lambda_N |d lambda_x,T| [m]
  Eigen::VectorXd energy = {};  // the same with the limit force [m]
  Eigen::VectorXd path = {};    // of |d lambda_x,T| over one step [m]
};

/// The basis functions at a sample.
using BasisRow = Eigen::Ref<const Eigen::VectorXd>;

/// d lambda_x,T after a slip: d lambda_u,T - limit n d(angle) - limit' t d lambda_u,N.
template <int Directions>
void slip_tangent(const Step& step, const Memory& before, const Memory& after, const BasisRow& row,
                  SampleTangent<Directions>& tangent) {
  const Eigen::Index k = row.size();
  const double limit = step.limit.force, friction = step.limit.by_normal;
  if constexpr (Directions == 1) {
    const double sign = std::copysign(1.0, step.trial[0]);
    for (Eigen::Index j = 0; j < k; ++j) {
      tangent.slip_force(j, 0) = -sign * friction * row[j];
      tangent.slip_force(k + j, 0) = row[j];
    }
  } else {
    double* s0 = tangent.slip_force.col(0).data();
    double* s1 = tangent.slip_force.col(1).data();
    double* angle = tangent.angle.data();
    const Eigen::Index m = tangent.slip_force.rows();
    // d(angle) = weight_0 d pre_0 + weight_1 d pre_1 + weight_N d lambda_N + keep d(angle before)
    double w0 = 0, w1 = 0, wn = 0, keep = 0;
    if (step.rotated) {
      const double c = before.direction[0], s = before.direction[1];
      const double along = c * step.trial[0] + s * step.trial[1], across = c * step.trial[1] - s * step.trial[0];
      const double sum = limit + along, scale = 2 / (sum * sum + across * across);
      w0 = scale * (-sum * s - across * c);
      w1 = scale * (sum * c - across * s);
      wn = -scale * across * friction;
      keep = 1 + scale * (-sum * along - across * across);
    } else {
      const double square = step.trial[0] * step.trial[0] + step.trial[1] * step.trial[1];
      if (square > 0) {
        w0 = -step.trial[1] / square;
        w1 = step.trial[0] / square;
      }
    }
    for (Eigen::Index j = 0; j < m; ++j) angle[j] = keep * angle[j] - w0 * s0[j] - w1 * s1[j];
    for (Eigen::Index j = 0; j < k; ++j) {
      angle[j] += wn * row[j];
      angle[k + j] += w0 * row[j];
      angle[2 * k + j] += w1 * row[j];
    }
    const double t0 = after.direction[0], t1 = after.direction[1];
    const double a0 = limit * t1, a1 = -limit * t0;
    for (Eigen::Index j = 0; j < m; ++j) {
      s0[j] = a0 * angle[j];
      s1[j] = a1 * angle[j];
    }
    for (Eigen::Index j = 0; j < k; ++j) {
      s0[j] -= friction * t0 * row[j];
      s1[j] -= friction * t1 * row[j];
      s0[k + j] += row[j];
      s1[2 * k + j] += row[j];
    }
  }
}

template <int Directions>
void separation_tangent(const BasisRow& row, SampleTangent<Directions>& tangent) {
  const Eigen::Index k = row.size();
  tangent.slip_force.setZero();
  for (int r = 0; r < Directions; ++r)
    for (Eigen::Index j = 0; j < k; ++j) tangent.slip_force((1 + r) * k + j, r) = row[j];
}

/// d lambda_x,T where contact begins or ends: lambda_u,T there, with the place itself moving.
template <int Directions>
void crossing_tangent(const double* previous, const double* prediction, const Step& step, const BasisRow& row_before,
                      const BasisRow& row, Eigen::MatrixXd& slope) {
  const Eigen::Index k = row.size();
  slope.setZero();
  const double jump = prediction[0] - previous[0];
  for (int r = 0; r < Directions; ++r) {
    const double rise = (prediction[1 + r] - previous[1 + r]) / (jump * jump);
    for (Eigen::Index j = 0; j < k; ++j) {
      slope((1 + r) * k + j, r) = (1 - step.crossing) * row_before[j] + step.crossing * row[j];
      slope(j, r) = rise * (previous[0] * row[j] - prediction[0] * row_before[j]);
    }
  }
}

}  // namespace dovetail::contact
