#include "wear/history/coupled_point.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <memory>
#include <numeric>
#include <vector>

#include "paths/steady_state.hpp"
#include "tests/unit/steady/random_model.hpp"

namespace dovetail::wear {
namespace {

// Both equations of a stage as one dense matrix, put together from derivatives that a tangent has.
TEST(CoupledPoint, SolvesBothEquationsAtOnce) {
  const Eigen::Index nodes = 12;
  const auto model = std::make_shared<const dynamics::CondensedModel>(random_model(nodes, 1, Damping::within));
  const steady::State state = paths::steady_state(steady::Joint{model, {}, {.tolerance = 1e-11}}, 1.3);
  ASSERT_EQ(state.status, Status::converged);
  ASSERT_GT(state.wear_rate.maxCoeff(), 0);
  const steady::Tangent& tangent = *state.tangent;
  const Eigen::Index n = tangent.unknowns(), contact = state.displacement.rows();
  std::vector<Eigen::Index> all(nodes);
  std::iota(all.begin(), all.end(), Eigen::Index{0});
  const steady::WearRateSlopes slopes = tangent.wear_rate_slopes();

  std::srand(7);
  const Eigen::VectorXd f = Eigen::VectorXd::Random(n), g = Eigen::VectorXd::Random(nodes);
  for (const double depth : {0.0, 1e-2, 1.0, 1e3}) {
    Eigen::VectorXd cycles = Eigen::VectorXd::Constant(nodes, depth / state.wear_rate.maxCoeff());
    cycles(3) *= 0.5;
    Eigen::MatrixXd whole(n + nodes, n + nodes);
    whole << steady::jacobian(tangent.point()), tangent.residual_to_wear(all),
        -(cycles.asDiagonal() * slopes.by_displacement.transpose()),
        Eigen::MatrixXd::Identity(nodes, nodes) - Eigen::MatrixXd((cycles.cwiseProduct(slopes.by_wear)).asDiagonal());
    Eigen::VectorXd residual(n + nodes);
    residual << f, g;
    const Eigen::VectorXd expected = whole.partialPivLu().solve(-residual);

    const CoupledPoint at(tangent.point(), cycles);
    const steady::FactoredJacobian factors(at.eliminated());
    const Eigen::VectorXd moved = factors.solve(at.right_hand_side(f.reshaped(contact, n / contact), g));
    EXPECT_LT((moved - expected.head(n)).norm(), 1e-9 * expected.head(n).norm()) << depth;
    EXPECT_LT((at.deeper(moved, g) - expected.tail(nodes)).norm(), 1e-9 * expected.tail(nodes).norm()) << depth;
  }
}

}  // namespace
}  // namespace dovetail::wear
