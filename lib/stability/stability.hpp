#pragma once

#include <Eigen/Core>
#include <span>
#include <string>
#include <string_view>

#include "core/enum_names.hpp"
#include "core/options.hpp"
#include "reduction/reduced_model.hpp"
#include "steady/state.hpp"

namespace dovetail::stability {

struct StabilityOptions {
  int samples = 512;         ///< per period, of the first of two passes (the second has twice as many), >= 16
  double tolerance = 1e-10;  ///< moduli closer to 1 than this are marginal whatever the error estimate says, >= 0
};

enum class StabilityVerdict {
  stable,          ///< every non-trivial multiplier lies inside the unit circle
  unstable,        ///< at least one lies outside
  marginal,        ///< the largest modulus is 1 within its error estimate
  not_meaningful,  ///< the model does not define what a perturbation does next
  undetermined,    ///< defined, but not computed: see the reason
};

constexpr EnumNames<StabilityVerdict, 5> enum_names(StabilityVerdict) {
  return {{{StabilityVerdict::stable, "stable"},
           {StabilityVerdict::unstable, "unstable"},
           {StabilityVerdict::marginal, "marginal"},
           {StabilityVerdict::not_meaningful, "not_meaningful"},
           {StabilityVerdict::undetermined, "undetermined"}}};
}
[[nodiscard]] constexpr std::string_view to_string(StabilityVerdict verdict) {
  return name_of(verdict);
}

/// Local (Floquet) stability of one periodic solution. Numbers are only filled with stable, unstable and marginal.
struct Stability {
  StabilityVerdict verdict = StabilityVerdict::undetermined;
  std::string reason;            ///< one sentence, never empty
  double largest_modulus = 0;    ///< of the non-trivial multipliers
  double error = 0;              ///< of it: its change between `samples` and twice as many, and rounding
  Eigen::VectorXcd multipliers;  ///< non-trivial ones, largest modulus first
  int neutral = 0;               ///< multipliers exactly +1: slip memory of nodes stuck all the period (the family)
  int events = 0;                ///< changes of contact state in the period, all nodes
};

/// How a small perturbation of a converged periodic solution grows in one period.
///
/// Contact dofs carry no mass, so the state is (q, q') of the masses and the slip X_T of the nodes in contact. Between
/// changes of contact state the perturbation obeys a linear equation with the contact dofs condensed statically:
/// separated: d lambda = 0; stuck: du_N = 0, du_T = dX_T frozen; slipping along v: du_N = 0, d lambda_T = mu d lambda_N
/// v
/// + mu lambda_N dv, where in space v turns with the slip direction. Its exponential is exact in a constant phase and
/// the midpoint rule follows turning slip (second order). Contact forces are continuous, so (q, q') needs no jump; the
/// slip memory a closing node starts with does: d lambda_T = (lambda_T'/lambda_N') d lambda_N there. Instants of change
/// are located between samples. The multipliers are the eigenvalues of the product [Leine, Nijmeijer 2004].
///
/// They are those of the contact states the truncated series has: refine the harmonics for those of the exact solution.
/// `state` must be a steady state of `model` that keeps its tangent. Not meaningful: no mass at all (a
/// quasi-static cycle), or contact dofs with mass that lift off (an impact law is needed). Undetermined: not converged,
/// contact dofs that slip with mass or change state with damping, wedged slip, a node that nothing holds while it is
/// open. Cost: O((n_dynamic + n_contact)^3) per change of state, and per sample where a node slips in two directions.
[[nodiscard]] Stability local_stability(const reduction::ReducedModel& model, const steady::State& state,
                                        const StabilityOptions& options = {});

}  // namespace dovetail::stability

namespace dovetail {
template <>
std::span<const Field<stability::StabilityOptions>> option_table<stability::StabilityOptions>();
}
