#include "steady/problem.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <random>
#include <utility>

#include "dynamics/extremes.hpp"
#include "paths/steady_state.hpp"
#include "steady/tangent.hpp"
#include "tests/unit/steady/random_model.hpp"

namespace dovetail {
namespace {

bool same_branch(const steady::Point& a, const steady::Point& b) {
  for (std::size_t i = 0; i < a.nodes.size(); ++i)
    if (a.nodes[i].state != b.nodes[i].state || a.nodes[i].periods != b.nodes[i].periods) return false;
  return true;
}

struct Kind {
  const char* name;
  Eigen::Index tangential;
  contact::SlipReturn slip_return;
};

class Jacobian : public testing::TestWithParam<Kind> {};

TEST_P(Jacobian, MatchesFiniteDifferencesAndItsOwnSolver) {
  const auto model =
      std::make_shared<const dynamics::CondensedModel>(random_model(5, GetParam().tangential, Damping::proportional));
  steady::Condition condition;
  condition.released = {0, 0, 1, 0, 0};
  const std::shared_ptr<const steady::Problem> of = problem(model, 1.3, condition, GetParam().slip_return);
  std::mt19937 generator(5);
  std::normal_distribution<double> normal;
  const Eigen::Index nc = model->contact_size();
  int compared = 0, mixed = 0;
  for (int trial = 0; trial < 12; ++trial) {
    const Eigen::MatrixXd at =
        of->closed_start() + Eigen::MatrixXd::NullaryExpr(nc, 7, [&] { return 0.02 * normal(generator); });
    const Eigen::MatrixXd direction = Eigen::MatrixXd::NullaryExpr(nc, 7, [&] { return normal(generator); });
    const std::shared_ptr<const steady::Point> here = point(of, at);
    const steady::Point& base = *here;
    steady::Point plus, minus;
    const double h = 1e-7;
    steady::evaluate(of, at + h * direction, plus);
    steady::evaluate(of, at - h * direction, minus);
    if (!same_branch(base, plus) || !same_branch(base, minus)) continue;
    ++compared;
    for (const contact::MarchResult& node : base.nodes) mixed += !node.always_stuck && !node.always_separated;
    const Eigen::MatrixXd jacobian = steady::jacobian(base);
    const Eigen::VectorXd exact = jacobian * direction.reshaped();
    const Eigen::VectorXd difference = (plus.residual - minus.residual).reshaped() / (2 * h);
    // Rounding 1e-16 |lambda_u| / h = 1e-8.
    EXPECT_LT((exact - difference).norm(), 1e-7 * exact.norm());
    const steady::Tangent linear(here);
    EXPECT_LT((linear.solve(exact) - direction.reshaped()).norm(), 1e-9 * direction.norm());
    const Eigen::VectorXd back = jacobian.transpose() * direction.reshaped();
    EXPECT_LT((linear.solve_transposed(back) - direction.reshaped()).norm(), 1e-9 * direction.norm());
  }
  EXPECT_GE(compared, 4);
  EXPECT_GE(mixed, 4);
}

INSTANTIATE_TEST_SUITE_P(Kinds, Jacobian,
                         testing::Values(Kind{"Plane", 1, contact::SlipReturn::first_order},
                                         Kind{"Space", 2, contact::SlipReturn::first_order},
                                         Kind{"SpaceSecondOrder", 2, contact::SlipReturn::second_order}),
                         [](const testing::TestParamInfo<Kind>& kind) { return std::string(kind.param.name); });

TEST(CondensedModel, IsTheSchurComplementWithItsSlope) {
  for (const Damping damping : {Damping::proportional, Damping::general, Damping::within}) {
    const reduction::ReducedModel reduced = random_model(3, 2, damping);
    const dynamics::CondensedModel model(reduced);
    EXPECT_EQ(model.modal(), damping != Damping::general);
    const double omega = 1.7, step = 2e-6;  // truncation 4e-12 times the third derivative, rounding 1e-10
    for (const int h : {0, 1, 3}) {
      const Eigen::MatrixXcd s = reduced.stiffness.cast<std::complex<double>>() +
                                 std::complex<double>(0, h * omega) * reduced.damping -
                                 h * h * omega * omega * reduced.mass;
      const Eigen::MatrixXcd ii = s.topLeftCorner(6, 6), ci = s.bottomLeftCorner(9, 6);
      const Eigen::MatrixXcd exact = s.bottomRightCorner(9, 9) - ci * ii.inverse() * ci.transpose();
      const dynamics::CondensedHarmonic at = model.harmonic(h, omega);
      EXPECT_LT((model.stiffness(h, omega, at) - exact).norm(), 1e-12 * exact.norm());
      const dynamics::HarmonicMatrices all = dynamics::harmonic_system(model, 3, omega).stiffness;
      EXPECT_EQ(all.base() != nullptr, damping == Damping::within);
      EXPECT_LT((all.matrix(h) - exact).norm(), 1e-12 * exact.norm());
      const dynamics::CondensedHarmonic up = model.harmonic(h, omega + step), down = model.harmonic(h, omega - step);
      const Eigen::VectorXcd u = Eigen::VectorXcd::Random(9);
      const Eigen::VectorXcd slope =
          ((model.stiffness(h, omega + step, up) - model.stiffness(h, omega - step, down)) * u -
           (up.force - down.force)) /
          (2 * step);
      EXPECT_LT((model.slope(h, omega, at, u) - slope).norm(), 1e-8 * (1 + slope.norm()));
      // Internal rows of S q = F hold for the recovered displacements.
      Eigen::VectorXcd force = Eigen::VectorXcd::Zero(15);
      if (h == 0) force = reduced.static_force;
      if (h == 1)
        force = reduced.cosine_force.row(0).transpose() -
                std::complex<double>(0, 1) * reduced.sine_force.row(0).transpose();
      const Eigen::VectorXcd left = s * model.recover(at, u);
      EXPECT_LT((left - force).head(6).norm(), 1e-12 * (1 + force.norm()));
      const Eigen::VectorXcd moved = (model.outputs(up, u) - model.outputs(down, u)) / (2 * step);
      EXPECT_LT((model.output_slope(h, omega, at, u) - moved).norm(), 1e-8);
      EXPECT_LT((model.outputs(at, u) - model.recover(at, u).head(2)).norm(), 1e-12);
    }
  }
}

// What harmonics share is applied at once, and what they do not share one by one: with the same result.
TEST(HarmonicMatrices, ApplyAlikeSharedAndDense) {
  const dynamics::CondensedModel model(random_model(3, 2, Damping::within));
  const dynamics::HarmonicMatrices shared = dynamics::harmonic_system(model, 3, 1.7).stiffness;
  dynamics::HarmonicMatrices dense = shared;
  dense.add_to_diagonal(2, Eigen::VectorXcd::Zero(9));
  ASSERT_TRUE(shared.base() && !dense.base());
  Eigen::MatrixXd x = Eigen::MatrixXd::Random(9 * 7, 4);
  x.topRows(9 * 2).setZero();  // some coefficients are
  x.col(1).setZero();
  std::vector<Eigen::MatrixXd> local(3);
  for (Eigen::MatrixXd& at : local) at = Eigen::MatrixXd::Random(3, 7);
  Eigen::MatrixXd blocks = Eigen::MatrixXd::Zero(9 * 7, 3);
  for (Eigen::Index i = 0; i < 3; ++i)
    for (Eigen::Index k = 0; k < 7; ++k)
      blocks.col(i).segment(k * 9 + 3 * i, 3) = local[static_cast<std::size_t>(i)].col(k);
  for (const bool conjugated : {false, true}) {
    EXPECT_LT((shared.apply(x, conjugated) - dense.apply(x, conjugated)).norm(), 1e-14 * x.norm() * 50);
    for (const dynamics::HarmonicMatrices* each : {&shared, &std::as_const(dense)})
      EXPECT_LT((each->apply_to_blocks(local, conjugated) - shared.apply(blocks, conjugated)).norm(), 1e-12);
  }
  EXPECT_GT((shared.apply(x, true) - shared.apply(x)).norm(), 1e-3);  // damped
  // Of few dofs, and in some rows only.
  Eigen::MatrixXd few = Eigen::MatrixXd::Zero(9 * 7, 4);
  const std::vector<Eigen::Index> dofs{3, 4, 7};
  for (Eigen::Index k = 0; k < 7; ++k) {
    few.row(k * 9 + 2) = x.row(k * 9 + 2);
    few.row(k * 9 + 6) = x.row(k * 9 + 6);
  }
  for (const dynamics::HarmonicMatrices* each : {&shared, &std::as_const(dense)}) {
    for (const bool conjugated : {false, true})
      EXPECT_LT((each->apply(few, conjugated) + each->apply(x - few, conjugated) - each->apply(x, conjugated)).norm(),
                1e-12);
    const Eigen::MatrixXd all = each->apply(x), some = each->apply_at(dofs, x);
    for (Eigen::Index k = 0; k < 7; ++k)
      for (Eigen::Index i = 0; i < 3; ++i)
        EXPECT_LT((some.row(k * 3 + i) - all.row(k * 9 + dofs[static_cast<std::size_t>(i)])).norm(), 1e-12);
  }
  for (int h = 0; h <= 3; ++h) EXPECT_LT((shared.matrix(h) - dense.matrix(h)).norm(), 1e-14);
  EXPECT_LT((shared.rows(1, 3, 2) - dense.matrix(1).middleRows(3, 2)).norm(), 1e-12);
}

TEST(CondensedModel, ReportsEverythingWrong) {
  reduction::ReducedModel model = random_model(3, 1, Damping::proportional);
  model.contact.area(1) = 0;
  model.contact.normal(2) = 99;
  model.static_force.resize(2);
  try {
    dynamics::CondensedModel condensed(model);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.violations().size(), 3u) << error.what();
  }
  model = random_model(3, 1, Damping::proportional);
  model.stiffness(0, 1) += 1;  // the engine would see half of it
  EXPECT_THROW(dynamics::CondensedModel{model}, InputError);
}

TEST(Extremes, FindsTheLargestOfSeveral) {
  // 3 cos + 2 sin(3.): dense sampling with 2e5 points is within (pi / 2e5)^2 of the extremes.
  Eigen::VectorXd a = Eigen::VectorXd::Zero(7);
  a << 0.3, 3, 0, 0, 0, 0.5, 2;
  double low = 1e9, high = -1e9;
  for (int i = 0; i < 200000; ++i) {
    const double value = dynamics::fourier_row(i * 2 * 3.14159265358979 / 200000, 7).dot(a);
    low = std::min(low, value);
    high = std::max(high, value);
  }
  const dynamics::Extremes found = dynamics::extremes(a);
  EXPECT_NEAR(found.maximum, high, 1e-8);
  EXPECT_NEAR(found.minimum, low, 1e-8);
  EXPECT_NEAR(dynamics::fourier_row(found.tau_maximum, 7).dot(a), found.maximum, 1e-14);
  EXPECT_EQ(dynamics::extremes(Eigen::VectorXd::Constant(1, 2.0)).amplitude(), 0);
}

TEST(State, RefusesBadOptions) {
  const auto model = std::make_shared<const dynamics::CondensedModel>(random_model(2, 1, Damping::proportional));
  EXPECT_THROW((void)paths::steady_state({model, {}, {.harmonics = 3, .samples = 6}}, 1), InputError);
  EXPECT_THROW((void)paths::steady_state({model, {}, {}}, -1), InputError);
  EXPECT_THROW((void)paths::steady_state({model, {}, {}}, 1, Eigen::MatrixXd::Zero(2, 7)), InputError);
  EXPECT_THROW((void)paths::steady_state({model, {.wear_depth = Eigen::VectorXd::Zero(5)}, {}}, 1), InputError);
}

TEST(State, SolversAgree) {
  const auto model = std::make_shared<const dynamics::CondensedModel>(random_model(2, 1, Damping::proportional));
  const steady::State newton = paths::steady_state({model, {}, {.solver = steady::Solver::newton}}, 1.3);
  ASSERT_EQ(newton.status, Status::converged);
  for (const steady::Solver solver : {steady::Solver::powell, steady::Solver::powell_fd}) {
    const steady::State other = paths::steady_state({model, {}, {.solver = solver}}, 1.3);
    ASSERT_EQ(other.status, Status::converged) << to_string(solver);
    EXPECT_LT((other.displacement - newton.displacement).norm(), 1e-7 * newton.displacement.norm())
        << to_string(solver);
  }
}

// A free body on `nodes` contact nodes, pressed on them: nothing else holds it, and rounding leaves its stiffness
// against being moved as a whole at about 1e-16 of the others instead of zero.
reduction::ReducedModel free_body(Eigen::Index nodes) {
  reduction::ReducedModel model = random_model(nodes, 1, Damping::proportional);
  const Eigen::Index n = model.stiffness.rows();
  Eigen::MatrixXd rigid = Eigen::MatrixXd::Zero(n, 2);
  for (Eigen::Index i = 0; i < n; ++i) rigid(i, i % 2) = 1;  // contact dofs begin at an even index: N, T, N, T, ...
  const Eigen::MatrixXd keep =
      Eigen::MatrixXd::Identity(n, n) - rigid * (rigid.transpose() * rigid).inverse() * rigid.transpose();
  model.stiffness = keep * model.stiffness * keep;
  model.damping = 0.03 * model.stiffness;
  model.static_force *= 20;
  model.contact.friction.setConstant(0.8);
  return model;
}

// The larger bodies have Jacobians that are solved with the factors of the held one; all steps that a solve may take
// would be half a minute of dense factorisations.
TEST(State, OfABodyThatNothingHoldsIsSingular) {
  for (const auto& [nodes, steps] : {std::pair<Eigen::Index, int>{3, steady::Options{}.max_iterations}, {60, 10}}) {
    const auto model = std::make_shared<const dynamics::CondensedModel>(free_body(nodes));
    const steady::State held = paths::steady_state({model, {}, {}}, 1.3);
    ASSERT_EQ(held.status, Status::converged);
    ASSERT_TRUE(held.tangent);
    const std::vector<char> all(static_cast<std::size_t>(nodes), 1);
    for (const bool linearise : {true, false}) {
      const steady::State floating = paths::steady_state(
          {model, {.released = all}, {.max_iterations = steps, .max_rescue_iterations = 0, .linearise = linearise}},
          1.3, held.displacement, held.tangent);
      EXPECT_NE(floating.status, Status::converged) << linearise << " " << floating.residual;
      EXPECT_FALSE(floating.tangent);
    }
  }
}

TEST(State, OfABodyThatIsFreeToGoNowhereInParticularIsSingular) {
  // Without a static load the free body is in equilibrium wherever it is: the residual vanishes, the place is not
  // known.
  for (const Eigen::Index nodes : {3, 60}) {
    reduction::ReducedModel body = free_body(nodes);
    const auto loaded = std::make_shared<const dynamics::CondensedModel>(body);
    const steady::State held = paths::steady_state({loaded, {}, {}}, 1.3);
    ASSERT_EQ(held.status, Status::converged);
    body.static_force.setZero();
    const auto model = std::make_shared<const dynamics::CondensedModel>(body);
    const std::vector<char> all(static_cast<std::size_t>(nodes), 1);
    for (const bool linearise : {true, false}) {
      const steady::State floating = paths::steady_state({model, {.released = all}, {.linearise = linearise}}, 1.3,
                                                         held.displacement, held.tangent);
      EXPECT_EQ(floating.status, Status::singular) << linearise << " " << floating.residual;
      EXPECT_FALSE(floating.tangent);
    }
  }
}

TEST(Tangent, PredictsWearAndFrequency) {
  const auto model = std::make_shared<const dynamics::CondensedModel>(random_model(4, 2, Damping::proportional));
  const steady::Options options{.tolerance = 1e-13, .periodic_tolerance = 1e-13};
  const double omega = 1.3, h = 1e-6;
  const steady::State at = paths::steady_state({model, {}, options}, omega);
  ASSERT_EQ(at.status, Status::converged);
  ASSERT_TRUE(at.tangent);
  const steady::State up = paths::steady_state({model, {}, options}, omega + h, at.displacement);
  const steady::State down = paths::steady_state({model, {}, options}, omega - h, at.displacement);
  const Eigen::MatrixXd slope = (up.displacement - down.displacement) / (2 * h);
  EXPECT_LT((at.tangent->response_to_frequency() - slope).norm(), 1e-5 * slope.norm());
  const Eigen::VectorXd change = Eigen::Vector4d(1, 0, -0.5, 0.2);
  const steady::State more = paths::steady_state({model, {.wear_depth = h * change}, options}, omega, at.displacement);
  const steady::State less = paths::steady_state({model, {.wear_depth = -h * change}, options}, omega, at.displacement);
  const Eigen::MatrixXd moved = (more.displacement - less.displacement) / (2 * h);
  EXPECT_LT((at.tangent->response_to_wear(change) - moved).norm(), 1e-5 * moved.norm());
  const Eigen::VectorXd rate = (more.wear_rate - less.wear_rate) / (2 * h);
  EXPECT_LT((at.tangent->wear_rate_to_wear({0, 1, 2, 3}) * change - rate).norm(), 1e-5 * rate.norm());
  EXPECT_GT(rate.norm(), 0);
}

}  // namespace
}  // namespace dovetail
