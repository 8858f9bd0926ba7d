#pragma once

namespace dovetail::fem {

/// Isotropic linear elasticity. Defaults: Ti-6Al-4V, annealed.
struct Material {
  double youngs_modulus = 114e9;  ///< E, Pa, > 0
  double poisson_ratio = 0.33;    ///< nu, 0 <= nu < 0.5
  double density = 4430;          ///< rho, kg/m^3, > 0
};

}  // namespace dovetail::fem
