#include <Eigen/LU>
#include <algorithm>
#include <cassert>
#include <cmath>

#include "contact/sample_step.hpp"

namespace dovetail::contact {
namespace {

// Derivatives are rows over the coefficients of lambda_u, direction by direction while marching: index r K + k.
template <int Directions>
struct Tangent {
  Eigen::MatrixXd slip_force;  // S = d lambda_x,T, column r, [m, d-1]
  Eigen::MatrixXd previous;    // S of the sample before
  Eigen::VectorXd angle;       // d angle [m]
  Eigen::VectorXd load = {};   // d of the sum of lambda_N |d lambda_x,T| [m]
};

/// The basis functions at a sample.
using Row = Eigen::Ref<const Eigen::VectorXd>;

// d lambda_x,T after a slip: d lambda_u,T - limit n d(angle) - mu t d lambda_u,N.
template <int Directions>
void slip_tangent(const Step& step, const Memory& before, const Memory& after, double friction, const Row& row,
                  Tangent<Directions>& tangent) {
  const Eigen::Index k = row.size();
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
      const double sum = step.limit + along, scale = 2 / (sum * sum + across * across);
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
    const double a0 = step.limit * t1, a1 = -step.limit * t0;
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
void separation_tangent(const Row& row, Tangent<Directions>& tangent) {
  const Eigen::Index k = row.size();
  tangent.slip_force.setZero();
  for (int r = 0; r < Directions; ++r)
    for (Eigen::Index j = 0; j < k; ++j) tangent.slip_force((1 + r) * k + j, r) = row[j];
}

// d lambda_x,T where contact begins or ends: lambda_u,T there, with the place itself moving.
template <int Directions>
void crossing_tangent(const double* previous, const double* prediction, const Step& step, const Row& row_before,
                      const Row& row, Eigen::MatrixXd& slope) {
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

// Derivative of the state at the start of a periodic orbit: the march over one period maps it to M s + B with
// s = (lambda_x,T, angle), so s = (I - M)^-1 B. M comes from three more columns beside the coefficients. False when the
// orbit does not determine its state (a node that only sticks).
bool orbit_tangent(const double* prediction, const NodeLaw& law, const Eigen::MatrixXd& rows, SlipReturn rule,
                   const Memory& orbit, Tangent<2>& tangent) {
  const Eigen::Index k = rows.rows(), m = 3 * k;
  Tangent<2> wide{.slip_force = Eigen::MatrixXd::Zero(m + 3, 2), .previous = {}, .angle = Eigen::VectorXd::Zero(m + 3)};
  wide.slip_force(m, 0) = wide.slip_force(m + 1, 1) = wide.angle(m + 2) = 1;
  Memory memory = orbit;
  for (Eigen::Index n = 0; n < rows.cols(); ++n) {
    const Memory before = memory;
    const Eigen::Index earlier = (n + rows.cols() - 1) % rows.cols();
    const Step step = sample_step<2>(prediction + 3 * earlier, prediction + 3 * n, law.friction, rule, memory);
    if (step.touched)
      crossing_tangent<2>(prediction + 3 * earlier, prediction + 3 * n, step, rows.col(earlier), rows.col(n),
                          wide.slip_force);
    if (step.state == SampleState::separated)
      separation_tangent<2>(rows.col(n), wide);
    else if (step.state == SampleState::slipping)
      slip_tangent<2>(step, before, memory, law.friction, rows.col(n), wide);
  }
  // The angle only matters when the first sample goes on rotating from the last.
  if (!memory.slipped) wide.angle.setZero();
  Eigen::Matrix3d map;
  map << wide.slip_force.col(0).tail(3).transpose(), wide.slip_force.col(1).tail(3).transpose(),
      wide.angle.tail(3).transpose();
  const Eigen::FullPivLU<Eigen::Matrix3d> lu(Eigen::Matrix3d::Identity() - map);
  if (!(lu.rcond() > 1e-9)) return false;
  Eigen::MatrixXd drive(3, m);
  drive << wide.slip_force.col(0).head(m).transpose(), wide.slip_force.col(1).head(m).transpose(),
      wide.angle.head(m).transpose();
  const Eigen::MatrixXd state = lu.solve(drive);
  tangent.slip_force = state.topRows(2).transpose();
  tangent.angle = state.row(2).transpose();
  return true;
}

// D from direction-by-direction to coefficient-by-coefficient order of rows and columns.
void reorder(const Eigen::MatrixXd& by_direction, Eigen::Index k, Eigen::Index d, Eigen::MatrixXd& result) {
  result.resize(d * k, d * k);
  for (Eigen::Index s = 0; s < d; ++s)
    for (Eigen::Index l = 0; l < k; ++l)
      for (Eigen::Index r = 0; r < d; ++r)
        for (Eigen::Index j = 0; j < k; ++j) result(j * d + r, l * d + s) = by_direction(r * k + j, s * k + l);
}

/// Where the derivative of a march begins.
struct Beginning {
  Memory memory = {};
  long sample = 0;  ///< the first to march, counted from the beginning of the march
};

/// Begins where the march forgot its history last; after an extrapolation on the periodic orbit reached. `tangent` is
/// that of the state there.
template <int Directions>
Beginning beginning_of(const double* prediction, const NodeLaw& law, const Eigen::MatrixXd& rows, SlipReturn rule,
                       const MarchResult& result, Tangent<Directions>& tangent) {
  const DerivativeStart& start = result.start;
  const long samples = rows.cols();
  if constexpr (Directions == 2)
    if (result.extrapolated && result.status == Status::converged &&
        orbit_tangent(prediction, law, rows, rule, start.orbit, tangent))
      return {.memory = start.orbit, .sample = (result.periods - 1) * samples};
  Beginning beginning{.memory = start.memory, .sample = start.sample + 1};
  if (start.sample < 0) {
    beginning.memory = {};
    for (int r = 0; r < Directions; ++r) beginning.memory.slip_force[r] = law.tangential_penalty * law.slip_origin(r);
    return beginning;
  }
  const long n = start.sample % samples;
  const double* here = prediction + (1 + Directions) * n;
  if (!(here[0] > 0)) {
    separation_tangent<Directions>(rows.col(n), tangent);
  } else if constexpr (Directions == 1) {
    Step step;
    step.state = SampleState::slipping;
    // lambda_T = lambda_u,T - lambda_x,T points along the slip.
    step.trial[0] = here[1] - beginning.memory.slip_force[0];
    slip_tangent<Directions>(step, beginning.memory, beginning.memory, law.friction, rows.col(n), tangent);
  }
  return beginning;
}

/// lambda_T = lambda_u,T - lambda_x,T: D_T = I - sum_n a_n S_n, with S constant while the node sticks, so one product
/// over the runs of constant S is enough.
template <int Directions>
class Runs {
 public:
  Runs(Eigen::Index k, Eigen::Index m, Eigen::Index samples)
      : weights_(k, samples + 1), slopes_(m * Directions, samples + 1), weight_(Eigen::VectorXd::Zero(k)) {}

  template <class Column>
  void add(const Column& analysis) {
    weight_ += analysis;
  }
  void close(const Eigen::MatrixXd& slope) {
    weights_.col(count_) = weight_;
    Eigen::Map<Eigen::MatrixXd>(slopes_.col(count_).data(), slope.rows(), Directions) = slope;
    ++count_;
    weight_.setZero();
  }
  [[nodiscard]] Eigen::MatrixXd product() const {
    return weights_.leftCols(count_) * slopes_.leftCols(count_).transpose();
  }

 private:
  Eigen::MatrixXd weights_, slopes_;
  Eigen::VectorXd weight_;
  Eigen::Index count_ = 0;
};

/// Adds to `tangent.load` what the step to sample n does.
template <int Directions>
void add_load_slope(const double* prediction, const Step& step, Eigen::Index n, const Eigen::MatrixXd& rows,
                    const MarchResult& result, Tangent<Directions>& tangent) {
  constexpr Eigen::Index d = 1 + Directions;
  const Eigen::Index earlier = (n + rows.cols() - 1) % rows.cols(), k = rows.rows();
  const double load = (result.force(n, 0) + result.force(earlier, 0)) / 2;
  double delta[2] = {0, 0}, square = 0;
  for (int r = 0; r < Directions; ++r) {
    delta[r] = step.end[r] - step.origin[r];
    square += delta[r] * delta[r];
  }
  if (load <= 0 || square <= 0) return;
  const double length = std::sqrt(square);
  Eigen::MatrixXd end;  // d lambda_x,T where contact ends
  if (step.opened) {
    end.resize(tangent.load.size(), Directions);
    crossing_tangent<Directions>(prediction + d * earlier, prediction + d * n, step, rows.col(earlier), rows.col(n),
                                 end);
  }
  for (int r = 0; r < Directions; ++r)
    tangent.load +=
        (load * delta[r] / length) * ((step.opened ? end : tangent.slip_force).col(r) - tangent.previous.col(r));
  if (prediction[d * n] > 0) tangent.load.head(k) += (length / 2) * rows.col(n);
  if (prediction[d * earlier] > 0) tangent.load.head(k) += (length / 2) * rows.col(earlier);
}

template <int Directions>
void differentiate_node(const double* prediction, const NodeLaw& law, const numerics::FourierBasis& basis,
                        SlipReturn rule, MarchResult& result) {
  constexpr Eigen::Index d = 1 + Directions;
  const Eigen::Index k = basis.coefficients(), m = d * k;
  const int samples = basis.samples();
  result.slip_load_derivative.setZero(m);
  if (result.always_stuck) {
    result.force_derivative.setIdentity(m, m);
    return;
  }
  // Row n of the table, contiguous: columns of the transposed one.
  const Eigen::MatrixXd rows = basis.synthesis_table().transpose();
  const Eigen::MatrixXd& analysis = basis.analysis_table();
  Tangent<Directions> tangent{.slip_force = Eigen::MatrixXd::Zero(m, Directions),
                              .previous = Eigen::MatrixXd::Zero(m, Directions),
                              .angle = Eigen::VectorXd::Zero(m),
                              .load = Eigen::VectorXd::Zero(m)};
  auto [memory, first] = beginning_of<Directions>(prediction, law, rows, rule, result, tangent);
  const long last = static_cast<long>(result.periods) * samples;
  Runs<Directions> runs(k, m, samples);
  Eigen::MatrixXd derivative = Eigen::MatrixXd::Identity(m, m);
  for (long i = first; i < last; ++i) {
    const auto n = static_cast<int>(i % samples);
    const bool counts = i >= last - samples;
    const Memory before = memory;
    const int earlier = (n + samples - 1) % samples;
    const Step step = sample_step<Directions>(prediction + d * earlier, prediction + d * n, law.friction, rule, memory);
    if (step.state != SampleState::stuck || step.touched) {
      if (counts) runs.close(tangent.slip_force);
      if (step.touched)
        crossing_tangent<Directions>(prediction + d * earlier, prediction + d * n, step, rows.col(earlier), rows.col(n),
                                     tangent.slip_force);
      tangent.previous = tangent.slip_force;
      if (step.state == SampleState::separated)
        separation_tangent<Directions>(rows.col(n), tangent);
      else if (step.state == SampleState::slipping)
        slip_tangent<Directions>(step, before, memory, law.friction, rows.col(n), tangent);
    }
    if (!counts) continue;
    runs.add(analysis.col(n));
    if (step.state == SampleState::separated)
      derivative.topLeftCorner(k, k).noalias() -= analysis.col(n) * rows.col(n).transpose();
    if (step.state != SampleState::stuck) add_load_slope<Directions>(prediction, step, n, rows, result, tangent);
  }
  runs.close(tangent.slip_force);

  const Eigen::MatrixXd product = runs.product();
  for (int r = 0; r < Directions; ++r) derivative.middleRows((1 + r) * k, k) -= product.middleCols(r * m, m);
  // Analysis times synthesis is the identity only to rounding: where nothing separates, say so exactly.
  if (result.always_separated) derivative.setZero();
  reorder(derivative, k, d, result.force_derivative);
  for (Eigen::Index r = 0; r < d; ++r)
    for (Eigen::Index j = 0; j < k; ++j)
      result.slip_load_derivative(j * d + r) = tangent.load(r * k + j) / law.tangential_penalty;
}

template <int Directions>
void run(const Eigen::Ref<const Eigen::MatrixXd>& prediction, const NodeLaw& law, const numerics::FourierBasis& basis,
         SlipReturn rule, MarchResult& result) {
  const Eigen::Matrix<double, Eigen::Dynamic, 1 + Directions, Eigen::RowMajor> rows = prediction;
  differentiate_node<Directions>(rows.data(), law, basis, rule, result);
}

}  // namespace

void differentiate(const Eigen::Ref<const Eigen::MatrixXd>& prediction, const NodeLaw& law,
                   const numerics::FourierBasis& basis, SlipReturn rule, MarchResult& result) {
  assert(prediction.rows() == basis.samples());
  if (prediction.cols() == 2)
    run<1>(prediction, law, basis, rule, result);
  else
    run<2>(prediction, law, basis, rule, result);
}

}  // namespace dovetail::contact
