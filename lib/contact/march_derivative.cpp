#include <Eigen/LU>
#include <algorithm>
#include <cassert>
#include <cmath>

#include "contact/sample_tangent.hpp"

namespace dovetail::contact {
namespace {

// Derivative of the state at the start of a periodic orbit: the march over one period maps it to M s + B with
// s = (lambda_x,T, angle), so s = (I - M)^-1 B. M comes from three more columns beside the coefficients. False when the
// orbit does not determine its state (a node that only sticks).
bool orbit_tangent(const double* prediction, const NodeLaw& law, const Eigen::MatrixXd& rows, SlipReturn rule,
                   const Memory& orbit, SampleTangent<2>& tangent) {
  const Eigen::Index k = rows.rows(), m = 3 * k;
  SampleTangent<2> wide{
      .slip_force = Eigen::MatrixXd::Zero(m + 3, 2), .previous = {}, .angle = Eigen::VectorXd::Zero(m + 3)};
  wide.slip_force(m, 0) = wide.slip_force(m + 1, 1) = wide.angle(m + 2) = 1;
  Memory memory = orbit;
  for (Eigen::Index n = 0; n < rows.cols(); ++n) {
    const Memory before = memory;
    const Eigen::Index earlier = (n + rows.cols() - 1) % rows.cols();
    const Step step = sample_step<2>(prediction + 3 * earlier, prediction + 3 * n, law, rule, memory);
    if (step.touched)
      crossing_tangent<2>(prediction + 3 * earlier, prediction + 3 * n, step, rows.col(earlier), rows.col(n),
                          wide.slip_force);
    if (step.state == SampleState::separated)
      separation_tangent<2>(rows.col(n), wide);
    else if (step.state == SampleState::slipping)
      slip_tangent<2>(step, before, memory, rows.col(n), wide);
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
                       const MarchResult& result, SampleTangent<Directions>& tangent) {
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
    step.limit = law.limit(here[0]);
    // lambda_T = lambda_u,T - lambda_x,T points along the slip.
    step.trial[0] = here[1] - beginning.memory.slip_force[0];
    slip_tangent<Directions>(step, beginning.memory, beginning.memory, rows.col(n), tangent);
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

/// What a march is differentiated along.
struct Marched {
  const double* prediction;
  const NodeLaw& law;
  const Eigen::MatrixXd& rows;  ///< BasisRow n of the table in column n
  const MarchResult& result;
};

/// Adds to `tangent.load` and `tangent.energy` what the step to sample n does.
template <int Directions>
void add_slip_slopes(const Marched& marched, const Step& step, Eigen::Index n, SampleTangent<Directions>& tangent) {
  const auto& [prediction, law, rows, result] = marched;
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
  tangent.path.setZero();
  for (int r = 0; r < Directions; ++r)
    tangent.path += (delta[r] / length) * ((step.opened ? end : tangent.slip_force).col(r) - tangent.previous.col(r));
  tangent.load += load * tangent.path;
  for (const Eigen::Index at : {n, earlier}) {
    const FrictionLimit limit = law.limit(result.force(at, 0));
    tangent.energy += (limit.force / 2) * tangent.path;
    if (!(prediction[d * at] > 0)) continue;
    tangent.load.head(k) += (length / 2) * rows.col(at);
    tangent.energy.head(k) += (length / 2 * limit.by_normal) * rows.col(at);
  }
}

template <int Directions>
void differentiate_node(const double* prediction, const NodeLaw& law, const numerics::FourierBasis& basis,
                        SlipReturn rule, MarchResult& result) {
  constexpr Eigen::Index d = 1 + Directions;
  const Eigen::Index k = basis.coefficients(), m = d * k;
  const int samples = basis.samples();
  result.slip_load_derivative.setZero(m);
  result.dissipation_derivative.setZero(m);
  if (result.always_stuck) {
    result.force_derivative.setIdentity(m, m);
    return;
  }
  // BasisRow n of the table, contiguous: columns of the transposed one.
  const Eigen::MatrixXd rows = basis.synthesis_table().transpose();
  const Eigen::MatrixXd& analysis = basis.analysis_table();
  SampleTangent<Directions> tangent{.slip_force = Eigen::MatrixXd::Zero(m, Directions),
                                    .previous = Eigen::MatrixXd::Zero(m, Directions),
                                    .angle = Eigen::VectorXd::Zero(m),
                                    .load = Eigen::VectorXd::Zero(m),
                                    .energy = Eigen::VectorXd::Zero(m),
                                    .path = Eigen::VectorXd::Zero(m)};
  auto [memory, first] = beginning_of<Directions>(prediction, law, rows, rule, result, tangent);
  const long last = static_cast<long>(result.periods) * samples;
  Runs<Directions> runs(k, m, samples);
  Eigen::MatrixXd derivative = Eigen::MatrixXd::Identity(m, m);
  for (long i = first; i < last; ++i) {
    const auto n = static_cast<int>(i % samples);
    const bool counts = i >= last - samples;
    const Memory before = memory;
    const int earlier = (n + samples - 1) % samples;
    const Step step = sample_step<Directions>(prediction + d * earlier, prediction + d * n, law, rule, memory);
    if (step.state != SampleState::stuck || step.touched) {
      if (counts) runs.close(tangent.slip_force);
      if (step.touched)
        crossing_tangent<Directions>(prediction + d * earlier, prediction + d * n, step, rows.col(earlier), rows.col(n),
                                     tangent.slip_force);
      tangent.previous = tangent.slip_force;
      if (step.state == SampleState::separated)
        separation_tangent<Directions>(rows.col(n), tangent);
      else if (step.state == SampleState::slipping)
        slip_tangent<Directions>(step, before, memory, rows.col(n), tangent);
    }
    if (!counts) continue;
    runs.add(analysis.col(n));
    if (step.state == SampleState::separated)
      derivative.topLeftCorner(k, k).noalias() -= analysis.col(n) * rows.col(n).transpose();
    if (step.state != SampleState::stuck)
      add_slip_slopes<Directions>({prediction, law, rows, result}, step, n, tangent);
  }
  runs.close(tangent.slip_force);

  const Eigen::MatrixXd product = runs.product();
  for (int r = 0; r < Directions; ++r) derivative.middleRows((1 + r) * k, k) -= product.middleCols(r * m, m);
  // Analysis times synthesis is the identity only to rounding: where nothing separates, say so exactly.
  if (result.always_separated) derivative.setZero();
  reorder(derivative, k, d, result.force_derivative);
  for (Eigen::Index r = 0; r < d; ++r)
    for (Eigen::Index j = 0; j < k; ++j) {
      result.slip_load_derivative(j * d + r) = tangent.load(r * k + j) / law.tangential_penalty;
      result.dissipation_derivative(j * d + r) = tangent.energy(r * k + j) / law.tangential_penalty;
    }
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
