#pragma once

#include <Eigen/Core>
#include <vector>

#include "contact/contact_law.hpp"
#include "contact/slip_return.hpp"
#include "core/status.hpp"
#include "numerics/fourier.hpp"

namespace dovetail::contact {

enum class SampleState : unsigned char { separated, stuck, slipping };

struct MarchOptions {
  SlipReturn slip_return = SlipReturn::first_order;
  bool periodic = true;    ///< false: march the samples once and stop (a quasi-static path)
  int max_periods = 2000;  ///< periods marched before giving up, >= 1
  /// Distance of lambda_x,T from its periodic orbit, relative to the largest limit force and absolute, > 0: both hold,
  /// as far as rounding permits.
  double tolerance = 1e-10;
  double resolution = 1e300;  ///< N
};

/// State of a node between two samples: lambda_x,T and the direction of the last slip.
struct Memory {
  double slip_force[2] = {0, 0};  ///< lambda_x,T, N
  double direction[2] = {1, 0};   ///< of lambda_T at the last slip (two tangential directions)
  bool slipped = false;           ///< at the last sample
  bool separated = false;         ///< at the last sample
};

/// Where the derivative of a march may start: after the last sample before the last period that forgot all history, or
/// at the very beginning.
struct DerivativeStart {
  long sample = -1;    ///< absolute index of that sample; -1: the beginning
  Memory memory = {};  ///< after it
  Memory orbit = {};   ///< at the start of the last period
};

/// One node marched over the period. d = 1 + tangential directions, m = d (2H+1).
/// Flattened coefficients of a node are ordered coefficient by coefficient: index k d + r is Fourier coefficient k
/// of direction r (0 normal, 1.. tangential).
struct MarchResult {
  Status status = Status::converged;  ///< converged or not_periodic
  int periods = 0;                    ///< periods marched
  Eigen::MatrixXd force;              ///< lambda [N, d], N
  Eigen::MatrixXd slip_force;         ///< lambda_x = eps X [N, d], N
  Eigen::MatrixXd slip_step;          ///< increments of lambda_x,T under load [N, d-1] over the last period, N
  std::vector<SampleState> state;     ///< [N] of the last period
  bool extrapolated = false;          ///< slip that dies out slowly was extrapolated to its periodic state
  bool always_stuck = false;          ///< neither slipped nor separated in any marched period
  bool always_closed = false;         ///< lambda_N = lambda_u,N > 0 at all samples
  bool always_separated = false;      ///< no force at any sample
  double slip_distance = 0;           ///< path length of X_T under load over the last period, m
  double slip_load = 0;               ///< sum of mean lambda_N |dX_T| over the last period, N m
  double dissipation = 0;             ///< the same of the limit force: energy of the period, J
  Eigen::Vector2d slip_end = {0, 0};  ///< X_T after the last sample, m
  DerivativeStart start = {};

  // Filled by differentiate().
  Eigen::MatrixXd force_derivative;           ///< D = d lambda_h / d lambda_u,h [m, m]
  Eigen::RowVectorXd slip_load_derivative;    ///< d slip_load / d lambda_u,h [m], m
  Eigen::RowVectorXd dissipation_derivative;  ///< d dissipation / d lambda_u,h [m], m
};

/// Marches the contact law of one node over the samples until lambda_x repeats [Salles 2009, eq. 15-19]:
///   pre_N = lambda_u,N^n, pre_T = lambda_u,T^n - lambda_x,T^(n-1)
///   separation pre_N <= 0: lambda = 0, lambda_x = lambda_u
///   stick |pre_T| <= limit(pre_N): lambda = pre, lambda_x,T unchanged
///   slip: lambda_N = pre_N, lambda_T = kappa pre_T, kappa = limit / |pre_T|, lambda_x,T += (1 - kappa) pre_T.
/// In space a slip state that still changes after 16 periods is extrapolated every 8 as a geometric sequence.
/// `prediction` is lambda_u [N, d], d = 2 or 3. Cost: O(N d) per period.
void march(const Eigen::Ref<const Eigen::MatrixXd>& prediction, const NodeLaw& law, const MarchOptions& options,
           MarchResult& result);

/// Adds the derivatives of the march of `prediction` to its `result`. They are those of the march itself, through all
/// marched periods, exact away from its kinks [Salles 2009, eq. 23-32]; after an extrapolation those of the periodic
/// orbit reached. Cost: O(N d m) plus O(m) per slipping sample.
void differentiate(const Eigen::Ref<const Eigen::MatrixXd>& prediction, const NodeLaw& law,
                   const numerics::FourierBasis& basis, SlipReturn rule, MarchResult& result);

/// The march of a node that is kept free of contact: lambda = 0, lambda_x = lambda_u, D = 0 [m, m],
/// m = d `coefficients`.
void carry_nothing(const Eigen::Ref<const Eigen::MatrixXd>& prediction, double tangential_penalty,
                   Eigen::Index coefficients, MarchResult& result);

}  // namespace dovetail::contact
