#include "steady/tangent.hpp"

#include <gtest/gtest.h>

#include <random>

#include "paths/steady_state.hpp"
#include "steady/near_jacobian.hpp"
#include "steady/solve.hpp"
#include "tests/unit/steady/random_model.hpp"

namespace dovetail {
namespace {

Eigen::MatrixXd random_matrix(Eigen::Index rows, Eigen::Index columns, unsigned seed) {
  std::mt19937 generator(seed);
  std::normal_distribution<double> normal;
  return Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return normal(generator); });
}

// Which nodes carry nothing, by gap; the others slip, lift off or stick.
class Condensation : public testing::TestWithParam<std::vector<char>> {};

TEST_P(Condensation, OfNodesWithoutForceIsExact) {
  for (const auto& [tangential, damping] :
       {std::pair{1, Damping::proportional}, {2, Damping::proportional}, {1, Damping::within}, {2, Damping::within}}) {
    const auto model = std::make_shared<const dynamics::CondensedModel>(random_model(5, tangential, damping));
    const std::shared_ptr<const steady::Problem> of = problem(model, 1.3, {.released = GetParam()});
    const Eigen::Index nc = model->contact_size();
    EXPECT_EQ(of->system().stiffness.base() != nullptr, damping == Damping::within);
    const std::shared_ptr<const steady::Point> at = point(of, of->closed_start() + 0.02 * random_matrix(nc, 7, 11));
    const steady::Tangent linear(at);
    ASSERT_EQ(linear.factors().status(), Status::converged);
    const auto open = std::count(GetParam().begin(), GetParam().end(), 1);
    EXPECT_LE(linear.factors().size(), 7 * (nc - open * (1 + tangential)));
    const Eigen::MatrixXd jacobian = steady::jacobian(*at), x = random_matrix(7 * nc, 3, 12);
    // Both sides agree to rounding times the condition of J, which is below 1e3 here.
    EXPECT_LT((linear.solve(jacobian * x) - x).norm(), 1e-11 * x.norm());
    EXPECT_LT((linear.solve_transposed(jacobian.transpose() * x) - x).norm(), 1e-11 * x.norm());
    const steady::JacobianBlocks blocks = steady::blocks(*at);
    EXPECT_LT((steady::apply_jacobian(blocks, x) - jacobian * x).norm(), 1e-13 * (jacobian * x).norm());
    EXPECT_LT((steady::apply_jacobian_transposed(blocks, x) - jacobian.transpose() * x).norm(),
              1e-13 * (jacobian.transpose() * x).norm());
  }
}

INSTANTIATE_TEST_SUITE_P(Nodes, Condensation,
                         testing::Values(std::vector<char>{0, 0, 0, 0, 0}, std::vector<char>{1, 0, 0, 1, 0},
                                         std::vector<char>{1, 1, 1, 1, 1}));

TEST(Tangent, FactorisesTheMeanOnlyOfANodeThatSlidInEarlierPeriods) {
  for (const Eigen::Index tangential : {1, 2}) {
    reduction::ReducedModel quiet = random_model(5, tangential, Damping::proportional);
    quiet.cosine_force.setZero();
    quiet.sine_force.setZero();
    const auto model = std::make_shared<const dynamics::CondensedModel>(quiet);
    const Eigen::Index nc = model->contact_size(), d = model->directions();
    // Nodes 1 and 3 stand far from where they last stuck: they slide to the limit of friction once and stick there.
    steady::Condition condition{.slip_origin = Eigen::MatrixXd::Zero(5, tangential)};
    const Eigen::MatrixXd where = problem(model, 1.3, condition)->closed_start();
    condition.slip_origin.row(1).setConstant(5);
    condition.slip_origin.row(3).setConstant(-5);
    const std::shared_ptr<const steady::Point> at =
        point(problem(model, 1.3, condition), where + 1e-3 * random_matrix(nc, 7, 11));
    for (const Eigen::Index i : {1, 3}) {
      const contact::MarchResult& node = at->nodes[static_cast<std::size_t>(i)];
      ASSERT_FALSE(node.always_stuck);
      ASSERT_EQ(node.slip_distance, 0);
      // Their harmonics drive nothing but themselves, up to what the Fourier sums leave of a constant.
      const Eigen::Index harmonic = d * 6;
      EXPECT_LT(
          (node.force_derivative.bottomRows(harmonic) - Eigen::MatrixXd::Identity(d * 7, d * 7).bottomRows(harmonic))
              .cwiseAbs()
              .maxCoeff(),
          1e-14);
    }
    const steady::Tangent linear(at);
    ASSERT_EQ(linear.factors().status(), Status::converged);
    EXPECT_EQ(linear.factors().size(), 2 * tangential);
    const Eigen::MatrixXd x = random_matrix(7 * nc, 3, 12);
    EXPECT_LT((linear.solve(steady::jacobian(*at) * x) - x).norm(), 1e-11 * x.norm());
  }
}

TEST(Tangent, SharesTheFactorsOfAnEqualJacobianOnly) {
  const auto model = std::make_shared<const dynamics::CondensedModel>(random_model(4, 1, Damping::proportional));
  const std::shared_ptr<const steady::Problem> of = problem(model, 1.3, {});
  const Eigen::MatrixXd at = of->closed_start() + 0.02 * random_matrix(8, 7, 5);
  const steady::Tangent first(point(of, at));
  EXPECT_FALSE(first.shares_factors());
  // In a plane D changes only where the state of a sample does.
  EXPECT_TRUE(steady::Tangent(point(of, at + 1e-12 * random_matrix(8, 7, 6)), &first).shares_factors());
  EXPECT_FALSE(steady::Tangent(point(of, at + 0.05 * random_matrix(8, 7, 7)), &first).shares_factors());
  EXPECT_FALSE(steady::Tangent(point(problem(model, 1.3001, {}), at), &first).shares_factors());
}

TEST(Tangent, SolvesWithTheFactorsOfAPointNearBy) {
  const auto model = std::make_shared<const dynamics::CondensedModel>(random_model(60, 1, Damping::proportional));
  const std::shared_ptr<const steady::Problem> of = problem(model, 1.3, {});
  const Eigen::MatrixXd at = of->closed_start() + 0.02 * random_matrix(120, 7, 5);
  const steady::Tangent first(point(of, at));
  const std::shared_ptr<const steady::Point> near = point(of, at + 2e-4 * random_matrix(120, 7, 7));
  const steady::Tangent exact(near), kept(near, &first, steady::Factorise::when_needed);
  ASSERT_FALSE(exact.shares_factors());
  ASSERT_FALSE(kept.shares_factors());
  EXPECT_TRUE(kept.is_regular());
  EXPECT_LT((kept.response_to_frequency() - exact.response_to_frequency()).norm(),
            1e-8 * exact.response_to_frequency().norm());
  const Eigen::MatrixXd rhs = random_matrix(840, 2, 8);
  for (const double tolerance : {1e-2, 1e-10}) {
    const Eigen::VectorXd x = kept.solve(rhs.col(0), tolerance);
    EXPECT_LE((steady::jacobian(*near) * x - rhs.col(0)).norm(), 1.001 * tolerance * rhs.col(0).norm());
    EXPECT_GT((x - exact.solve(rhs.col(0))).norm(), 0) << "solved with factors of its own";
  }
  EXPECT_EQ(&kept.nearest_factors(), &first.factors());
  // Many right-hand sides are worth factors of its own.
  EXPECT_LT((kept.solve(rhs) - exact.solve(rhs)).norm(), 1e-12 * rhs.norm());
  EXPECT_NE(&kept.nearest_factors(), &first.factors());
}

// An equal stiffness that is not known to be the same one is treated as another: the same answer on the longer way.
TEST(NearJacobian, SolvesAlikeWhereTheStiffnessIsTheSameAndWhereItMayDiffer) {
  for (const Damping damping : {Damping::proportional, Damping::within})
    for (const auto& [tangential, released] : {std::pair{1, 0}, {2, 3}}) {
      const auto model = std::make_shared<const dynamics::CondensedModel>(random_model(20, tangential, damping));
      const steady::Condition condition{.released = [&, open = released] {
        std::vector<char> nodes(20, 0);
        std::fill_n(nodes.begin() + 5, open, 1);
        return nodes;
      }()};
      const std::shared_ptr<const steady::Problem> of = problem(model, 1.3, condition);
      const std::shared_ptr<const steady::Problem> again = problem(model, 1.3, condition);
      const Eigen::Index nc = model->contact_size();
      const Eigen::MatrixXd at = of->closed_start() + 0.02 * random_matrix(nc, 7, 5);
      const steady::FactoredJacobian factors(point(of, at));
      const std::shared_ptr<const steady::Point> near = point(of, at + 2e-2 * random_matrix(nc, 7, 7));
      const std::shared_ptr<const steady::Point> same = point(again, near->displacement);
      const Eigen::VectorXd rhs = random_matrix(7 * nc, 1, 8);
      for (const double tolerance : {1e-2, 1e-10}) {
        const numerics::GmresOptions options{.tolerance = tolerance, .most = 60};
        const numerics::GmresResult quick = steady::solve_near(*near, factors, rhs, options);
        const numerics::GmresResult whole = steady::solve_near(*same, factors, rhs, options);
        ASSERT_EQ(quick.status, Status::converged);
        ASSERT_EQ(whole.status, Status::converged);
        EXPECT_GT(quick.products, tolerance < 1e-9 ? 3 : 0) << "little differs";
        EXPECT_LE(quick.products, whole.products + 1);
        const double left = (steady::jacobian(*near) * quick.x - rhs).norm() / rhs.norm();
        EXPECT_LE(left, 1.001 * tolerance);
        EXPECT_NEAR(left, quick.residual, 1e-3 * tolerance);
        EXPECT_LT((quick.x - whole.x).norm(), 100 * tolerance * whole.x.norm());
      }
      EXPECT_EQ(steady::solve_near(*near, factors, rhs, {.most = 0}).status, Status::iteration_limit);
      EXPECT_EQ(steady::solve_near(*near, factors, Eigen::VectorXd(0 * rhs), {}).x.norm(), 0);
      // What is condensed is lent where the system is known to be the same.
      const steady::FactoredJacobian lent(near, &factors), made(near), other(same, &factors);
      EXPECT_EQ(lent.solve(rhs), made.solve(rhs));
      EXPECT_EQ(other.operations(), made.operations());
      EXPECT_EQ(lent.operations() < made.operations(), released > 0);
      const numerics::GmresResult own = steady::solve_near(factors.point(), factors, rhs, {});
      EXPECT_EQ(own.products, 1);
      EXPECT_LT((factors.solve(rhs) - own.x).norm(), 1e-14 * own.x.norm());
    }
}

// Where nothing near by helps, or nothing is left to save, the Jacobian is factorised.
TEST(Tangent, HasFactorsOfItsOwnFarFromTheOthers) {
  const auto model = std::make_shared<const dynamics::CondensedModel>(random_model(60, 1, Damping::proportional));
  const std::shared_ptr<const steady::Problem> of = problem(model, 1.3, {});
  const Eigen::MatrixXd at = of->closed_start() + 0.02 * random_matrix(120, 7, 5);
  const steady::Tangent first(point(of, at));
  const std::shared_ptr<const steady::Point> far = point(of, of->closed_start() + 2 * random_matrix(120, 7, 7));
  const steady::Tangent other(far, &first, steady::Factorise::when_needed);
  const Eigen::VectorXd x = random_matrix(840, 1, 9);
  EXPECT_LT((other.solve(steady::jacobian(*far) * x) - x).norm(), 1e-10 * x.norm());
  EXPECT_NE(&other.nearest_factors(), &first.factors());
  // Another pseudo-penalty is another problem.
  const auto soft = std::make_shared<const steady::Problem>(of->with_penalty(0.1));
  const steady::Tangent elsewhere(point(soft, at), &first, steady::Factorise::when_needed);
  EXPECT_NE(&elsewhere.nearest_factors(), &first.factors());
}

TEST(State, IsTheSameWithKeptFactorsAndTakesFewerJacobians) {
  const auto model = std::make_shared<const dynamics::CondensedModel>(random_model(60, 1, Damping::proportional));
  const steady::Options options{.tolerance = 1e-12};
  const steady::State from = paths::steady_state({model, {}, options}, 1.30);
  ASSERT_EQ(from.status, Status::converged);
  const steady::State fresh = paths::steady_state({model, {}, options}, 1.301, from.displacement);
  const steady::State kept = paths::steady_state({model, {}, options}, 1.301, from.displacement, from.tangent);
  ASSERT_EQ(fresh.status, Status::converged);
  ASSERT_EQ(kept.status, Status::converged);
  EXPECT_LT((fresh.displacement - kept.displacement).norm(), 1e-10 * fresh.displacement.norm());
  EXPECT_LT(kept.iterations, fresh.iterations);
}

}  // namespace
}  // namespace dovetail
