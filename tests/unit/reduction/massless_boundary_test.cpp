#include "reduction/massless_boundary.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "numerics/dense_lu.hpp"
#include "numerics/dense_symmetric.hpp"
#include "reduction/validation.hpp"
#include "tests/unit/reduction/stiffness_error.hpp"
#include "tests/unit/reduction/truss_model.hpp"

namespace dovetail::reduction {
namespace {

// Below the first glued mode of the trusses (about 60 rad/s with 4 columns and rows), so Z is bounded.
constexpr double kAngular = 17.0;

Eigen::VectorXd glued_frequencies(const FullModel& full) {
  const Eigen::Index internal = full.internal_size();
  const Eigen::SparseMatrix<double> stiffness = full.stiffness.topLeftCorner(internal, internal);
  const Eigen::SparseMatrix<double> mass = full.mass.topLeftCorner(internal, internal);
  return numerics::all_values<double>(stiffness, mass).values.cwiseSqrt();
}

// Deterministic loads without structure.
Eigen::VectorXd some(Eigen::Index size, double phase) {
  Eigen::VectorXd values(size);
  for (Eigen::Index k = 0; k < size; ++k) values(k) = std::sin(phase + 2.4 * static_cast<double>(k));
  return values;
}

class AtSpeed : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(StandstillAndSpinSoftened, AtSpeed, testing::Values(0.0, 1e-4, 5.0, 20.0));

// A blade that floats at standstill has no static response to forces out of equilibrium.
class Spinning : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(SpinSoftened, Spinning, testing::Values(5.0, 20.0));

TEST_P(AtSpeed, AllModesAreExactWhenContactHasNoMass) {
  const FullModel full = truss_model({.speed = GetParam(), .contact_mass = false});
  const Reduction reduction = reduce(full, {.modes = 1000});
  ASSERT_EQ(reduction.status, Status::converged) << reduction.message;
  EXPECT_EQ(reduction.model.size(), full.size());
  // Rounding: condition numbers near 1e4 times a few hundred operations.
  for (double angular : {0.5 * kAngular, kAngular, 333.0, 1234.0}) {
    const StiffnessError error = compare(full, reduction, std::vector{angular}).front();
    EXPECT_LT(error.stiffness, 1e-8) << angular;
    EXPECT_LT(error.flexibility, 1e-8) << angular;
  }
  const Eigen::VectorXd exact = glued_frequencies(full);
  ASSERT_EQ(exact.size(), reduction.glued_frequencies.size());
  EXPECT_LT((reduction.glued_frequencies.array() / exact.array() - 1).abs().maxCoeff(), 1e-9);
}

TEST_P(AtSpeed, StaticResponseHoldsWithFewModes) {
  const FullModel full = truss_model({.speed = GetParam()});
  const Reduction reduction = reduce(full, {.modes = 5});
  ASSERT_EQ(reduction.status, Status::converged) << reduction.message;
  // Contact springs k_c hold the floating blade: (K + B^T k_c B) u = f.
  const Eigen::Index contact = full.contact_size();
  const double spring = 3e5;
  Eigen::MatrixXd held(full.stiffness);
  held.diagonal().tail(contact).array() += spring;
  const ReducedModel& model = reduction.model;
  Eigen::MatrixXd held_reduced = model.stiffness;
  held_reduced.diagonal().head(contact).array() += spring;

  Eigen::MatrixXd loads(full.size(), 2), reduced_loads(model.size(), 2);
  loads << full.static_force, full.cosine_force;
  reduced_loads << model.static_force, model.cosine_force.transpose();
  const Eigen::MatrixXd exact = numerics::DenseLu(held).solve(loads);
  const Eigen::MatrixXd q = numerics::DenseLu(held_reduced).solve(reduced_loads);
  const Eigen::MatrixXd u = reduction.recovery.apply(q, spring * q.topRows(contact));
  for (int column = 0; column < 2; ++column)
    EXPECT_LT((u.col(column) - exact.col(column)).norm(), 1e-9 * exact.col(column).norm());
  EXPECT_LT((q.topRows(contact) - exact.bottomRows(contact)).norm(), 1e-9 * exact.bottomRows(contact).norm());
  EXPECT_LT((model.output_vectors * q - full.outputs.transpose() * exact).norm(), 1e-9 * exact.norm());
}

TEST_P(Spinning, RecoveredFieldSolvesTheStaticEquationsForAnyContactForces) {
  const FullModel full = truss_model({.speed = GetParam()});
  const Reduction reduction = reduce(full, {.modes = 6});
  ASSERT_EQ(reduction.status, Status::converged) << reduction.message;
  const Eigen::Index contact = full.contact_size();
  const Eigen::VectorXd lambda = some(contact, 0.3);
  const ReducedModel& model = reduction.model;
  Eigen::VectorXd load = model.static_force;
  load.head(contact) -= lambda;
  const Eigen::VectorXd q = numerics::DenseLu(model.stiffness).solve(load);
  const Eigen::VectorXd u = reduction.recovery.apply(q, lambda);
  Eigen::VectorXd residual = full.stiffness * u - full.static_force;
  residual.tail(contact) += lambda;
  // |K| |u| eps is 1e-10 of the load; the reduced system loses some three digits more.
  EXPECT_LT(residual.norm(), 1e-7 * full.static_force.norm());
}

TEST(MasslessBoundary, CountsRigidAndNegativeModes) {
  // At standstill the blade floats; spin softening of -Omega^2 M turns its three rigid motions negative.
  const Reduction standstill = reduce(truss_model({.speed = 0}), {.modes = 8});
  EXPECT_EQ(standstill.rigid_modes, 3);
  EXPECT_EQ(standstill.negative_modes, 0);
  const Reduction spinning = reduce(truss_model({.speed = 20}), {.modes = 8});
  EXPECT_EQ(spinning.rigid_modes, 0);
  EXPECT_EQ(spinning.negative_modes, 3);
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(spinning.free_eigenvalues(k), -400, 1e-6);
  EXPECT_GT(spinning.free_eigenvalues(3), 0);
}

TEST(MasslessBoundary, KeepsNegativeModesEvenWhenFewerAreAskedFor) {
  const Reduction reduction = reduce(truss_model({.speed = 20}), {.modes = 0});
  ASSERT_EQ(reduction.status, Status::converged) << reduction.message;
  EXPECT_EQ((reduction.free_eigenvalues.array() < 0).count(), 3);
}

TEST(MasslessBoundary, ContactComesFirstAndCarriesNoMassOrDamping) {
  const FullModel full = truss_model({.speed = 5});
  const Reduction reduction = reduce(full, {.modes = 8, .damping_ratio = 0.02});
  const ReducedModel& model = reduction.model;
  const Eigen::Index contact = full.contact_size();
  const Eigen::Index m = model.size() - contact;
  EXPECT_TRUE(violations(model).empty());
  EXPECT_EQ(model.contact.normal, Eigen::VectorXi::LinSpaced(4, 0, 6));
  EXPECT_EQ(Eigen::VectorXi(model.contact.tangential.col(0)), Eigen::VectorXi::LinSpaced(4, 1, 7));
  EXPECT_EQ(model.mass.topRows(contact).norm(), 0);
  EXPECT_EQ(model.damping.topRows(contact).norm(), 0);
  EXPECT_EQ(model.mass.bottomRightCorner(m, m), Eigen::MatrixXd::Identity(m, m));
  // Modal damping of the glued modes: c = 2 zeta omega, omega^2 the stiffness.
  for (Eigen::Index k = contact; k < model.size(); ++k)
    EXPECT_NEAR(model.damping(k, k) / (2 * std::sqrt(model.stiffness(k, k))), 0.02, 1e-14);
  EXPECT_EQ(Eigen::MatrixXd(model.damping - Eigen::MatrixXd(model.damping.diagonal().asDiagonal())).norm(), 0);
}

TEST(MasslessBoundary, LoadsAlreadyInTheBasisAddNoVectors) {
  // Cosine force and first output are the same vector; the sine force is zero: three independent loads.
  const Reduction reduction = reduce(truss_model({.speed = 5}), {.modes = 8});
  EXPECT_EQ(reduction.free_eigenvalues.size(), 8 + 3);
}

TEST(MasslessBoundary, GluedModesConvergeFromAbove) {
  const FullModel full = truss_model({.columns = 5, .blade_rows = 6, .speed = 5});
  const Eigen::VectorXd exact = glued_frequencies(full);
  double previous = 1;
  for (int modes : {10, 20, 40}) {
    const Reduction reduction = reduce(full, {.modes = modes});
    const double error = reduction.glued_frequencies(0) / exact(0) - 1;
    EXPECT_GT(error, 0);  // less inertia: frequencies from above
    EXPECT_LT(error, 0.5 * previous);
    previous = error;
  }
}

TEST(MasslessBoundary, ReportsAGluedStructureThatIsNotPositiveDefinite) {
  const Reduction reduction = reduce(truss_model({.speed = 1e4}));
  EXPECT_EQ(reduction.status, Status::singular);
  EXPECT_THAT(reduction.message, testing::HasSubstr("positive definite"));
}

TEST(MasslessBoundary, RefusesWrongSizesAndOptionsTogether) {
  FullModel full = truss_model();
  full.static_force.conservativeResize(5);
  try {
    (void)reduce(full, {.modes = -1});
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::AllOf(testing::HasSubstr("static_force"),
                                             testing::HasSubstr("reduction.modes = -1: must be >= 0")));
  }
}

TEST(MasslessBoundary, RefusesContactDofsThatAreNotLast) {
  FullModel full = truss_model();
  std::swap(full.contact.normal(0), full.contact.tangential(0, 0));
  EXPECT_THROW((void)reduce(full), InputError);
}

// Two contact nodes on a trace of four, each the mean of two: the static flexibility they see is A K^-1 A^T.
TEST_P(Spinning, OtherNodesOnTheTraceSeeItsFlexibility) {
  const FullModel full = truss_model({.speed = GetParam()});
  const TraceModel trace = trace_model(full, {.modes = 6});
  ASSERT_EQ(trace.status, Status::converged) << trace.message;
  Eigen::SparseMatrix<double> average(2, 4);
  average.insert(0, 0) = average.insert(0, 1) = 0.5;
  average.insert(1, 2) = 0.25;
  average.insert(1, 3) = 0.75;
  ContactNodes nodes = full.contact;
  for (Eigen::VectorXd* values : {&nodes.area, &nodes.gap, &nodes.friction, &nodes.wear_coefficient})
    values->conservativeResize(2);
  nodes.normal.conservativeResize(2);
  nodes.tangential.conservativeResize(2, 1);
  nodes.position.resize(0, 3);
  nodes.group.resize(0);
  nodes.slip_origin.resize(0, 0);
  const Reduction reduced = reduce(trace, average, nodes, 1e-3);
  ASSERT_EQ(reduced.status, Status::converged) << reduced.message;

  const Eigen::Index contact = full.contact_size();
  const Eigen::MatrixXd inverse = Eigen::MatrixXd(full.stiffness).inverse().bottomRightCorner(contact, contact);
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(4, 8);
  for (Eigen::Index row = 0; row < 2; ++row)
    for (Eigen::Index column = 0; column < 4; ++column)
      a.block<2, 2>(2 * row, 2 * column) = average.coeff(row, column) * Eigen::Matrix2d::Identity();
  const Eigen::MatrixXd expected = a * inverse * a.transpose();
  const Eigen::MatrixXd found = Eigen::MatrixXd(reduced.model.stiffness.inverse()).topLeftCorner(4, 4);
  // Condition numbers near 1e4 times a few hundred operations.
  EXPECT_LT((found - expected).norm(), 1e-9 * expected.norm());
}

// A change of the stiffness after the reduction: what the reduced model, its frequencies and its fields miss falls with
// the square of it.
TEST_P(AtSpeed, AChangeOfTheStiffnessIsTakenToFirstOrder) {
  const FullModel full = truss_model({.speed = GetParam(), .contact_mass = false});
  const TraceModel trace = trace_model(full, {.modes = 1000});
  ASSERT_EQ(trace.status, Status::converged) << trace.message;
  Eigen::SparseMatrix<double> same(trace.contact.count(), trace.contact.count());
  same.setIdentity();
  // The same pattern, other values: some springs stiffer, some softer.
  Eigen::SparseMatrix<double> change = full.stiffness;
  for (Eigen::Index column = 0; column < change.outerSize(); ++column)
    for (Eigen::SparseMatrix<double>::InnerIterator entry(change, column); entry; ++entry)
      entry.valueRef() *= std::sin(0.7 * static_cast<double>(entry.row() + entry.col()));

  const Eigen::MatrixXd forces = some(full.contact_size(), 0.3);
  double last_model = 0, last_field = 0, last_glued = 0;
  for (const double size : {1e-3, 1e-4}) {
    TraceModel changed = trace;
    const Eigen::Index m = trace.structure->basis().vectors.cols(), nt = full.contact_size();
    const Eigen::MatrixXd forced =
        trace.structure->field(Eigen::MatrixXd::Zero(m, nt), Eigen::MatrixXd::Identity(nt, nt)).transpose();
    changed.change = std::make_shared<StiffnessChange>(stiffness_change(*trace.structure, size * change, forced));
    const Reduction found = reduce(changed, same, trace.contact, 1e-3);
    FullModel exact = full;
    exact.stiffness = full.stiffness + size * change;
    // Compliance of the contact at a frequency, and the field of contact forces.
    const double model = compare(exact, found, std::vector{kAngular}).front().flexibility;
    const Eigen::VectorXd q = some(found.model.size() - full.contact_size(), 1.1);
    Eigen::VectorXd coordinates(found.model.size());
    coordinates << Eigen::VectorXd::Zero(full.contact_size()), q;
    const Eigen::MatrixXd field = found.recovery.apply(coordinates, forces);
    // Its contact part are the displacements at which the reduced model has these forces.
    const Eigen::Index nc = full.contact_size();
    const Eigen::VectorXd u = found.model.stiffness.topLeftCorner(nc, nc).ldlt().solve(
        -forces - found.model.stiffness.topRightCorner(nc, q.size()) * q);
    const double fields = (field.bottomRows(nc) - u).norm() / u.norm();
    const Eigen::VectorXd traced = glued_frequencies(changed), whole = glued_frequencies(exact);
    const double glued = std::abs(traced(0) / whole(0) - 1) + std::abs(found.glued_frequencies(0) / whole(0) - 1);
    if (last_model > 0) {
      EXPECT_LT(model, 0.02 * last_model + 1e-9);
      EXPECT_LT(fields, 0.02 * last_field + 1e-9);
      EXPECT_LT(glued, 0.02 * last_glued + 1e-9);
    }
    last_model = model, last_field = fields, last_glued = glued;
  }
  EXPECT_GT(last_model, 0);
}

// What is negligible in a change is left out so that a body that only moves along still feels nothing of it, whether or
// not its diagonal is there to be told.
TEST(StiffnessChange, LeavesOutWhatIsNegligibleAndStillDoesNothingToBodiesThatMoveAlong) {
  const FullModel full = truss_model({.contact_mass = false});
  const TraceModel trace = trace_model(full, {.modes = 1000});
  ASSERT_EQ(trace.status, Status::converged) << trace.message;
  const Eigen::Index n = full.size();
  // Springs from each unknown to the next, the last one weak; the first two pull as much as they push.
  std::vector<Eigen::Triplet<double>> entries;
  const auto spring = [&](Eigen::Index i, Eigen::Index j, double k) {
    for (const auto& [r, c, sign] : {std::tuple{i, i, 1}, {j, j, 1}, {i, j, -1}, {j, i, -1}})
      entries.emplace_back(static_cast<int>(r), static_cast<int>(c), sign * k);
  };
  spring(0, 1, 1.0);
  spring(0, 2, -1.0);  // the diagonal of the first is an exact zero
  spring(0, n - 1, 1e-5);
  spring(0, n - 2, -1e-5);
  spring(1, n - 1, 1e-5);
  Eigen::SparseMatrix<double> change(n, n);
  change.setFromTriplets(entries.begin(), entries.end());
  ASSERT_EQ(change.coeff(0, 0), 0);
  Eigen::MatrixXd forced(2, n);
  forced.row(0).setOnes();
  forced.row(1) = some(n, 1).transpose();
  const StiffnessChange found = stiffness_change(*trace.structure, change, forced);
  EXPECT_NEAR(found.on_trace(0, 0), 0, 1e-15);
  EXPECT_NEAR(found.on_trace(0, 1), 0, 1e-15);
  const double exact = forced.row(1) * (change * forced.row(1).transpose());
  EXPECT_NEAR(found.on_trace(1, 1), exact, 1e-3 * std::abs(exact));
  EXPECT_NE(found.on_trace(1, 1), exact);
}

}  // namespace
}  // namespace dovetail::reduction
