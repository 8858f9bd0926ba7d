#pragma once

#include <Eigen/Core>

#include "numerics/gmres.hpp"
#include "steady/factored_jacobian.hpp"

namespace dovetail::steady {

/// J x = b of a point with its derivative, by GMRES with the factors P of a point near by. Where both have one
/// stiffness, J = P + (D - D_P) (eps I - Z) differs from P in the rows of those nodes alone whose D differs. After
/// P^-1 b the residual lies in these rows, and so does everything that follows: a product takes one solve with P and
/// these rows of Z. The factors must serve the point's problem. `most` counts products, of which P^-1 b is the first.
[[nodiscard]] numerics::GmresResult solve_near(const Point& point, const FactoredJacobian& near,
                                               const Eigen::VectorXd& rhs, const numerics::GmresOptions& options);

}  // namespace dovetail::steady
