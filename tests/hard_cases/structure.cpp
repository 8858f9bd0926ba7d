#include "tests/hard_cases/structure.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "tests/verification/steady/rod.hpp"

namespace dovetail::hard_cases {

namespace {

Eigen::MatrixXd rotation(Eigen::Index d, Random& random) {
  Eigen::MatrixXd matrix(d, d);
  for (Eigen::Index i = 0; i < matrix.size(); ++i) matrix(i) = random.normal();
  return Eigen::HouseholderQR<Eigen::MatrixXd>(matrix).householderQ();
}

// Symmetric, with eigenvalues between a third and three times `size`.
Eigen::MatrixXd spring(Eigen::Index d, double size, Random& random) {
  const Eigen::MatrixXd axes = rotation(d, random);
  Eigen::VectorXd values(d);
  for (Eigen::Index i = 0; i < d; ++i) values(i) = size * random.decades(1.0 / 3, 3);
  return axes * values.asDiagonal() * axes.transpose();
}

class Builder {
 public:
  Builder(const Recipe& recipe, Random& random)
      : recipe_(recipe),
        random_(random),
        d_(recipe.directions),
        internal_(recipe.masses * d_),
        contact_(recipe.nodes * d_),
        model_(verification::empty_model(internal_ + contact_, recipe.nodes, d_ - 1)) {}

  Problem build() {
    number_contact();
    connect();
    Problem problem;
    problem.omega = recipe_.quasi_static ? random_.decades(0.1, 10) : frequency();
    damp(problem.omega);
    excite(problem.omega);
    problem.contact_mass = recipe_.contact_mass > 0;
    problem.model = model_;
    problem.options.harmonics = recipe_.harmonics;
    problem.options.samples = recipe_.samples;
    return problem;
  }

 private:
  // Normal first, as the loads below assume; tangential directions follow it.
  void number_contact() {
    for (int i = 0; i < recipe_.nodes; ++i) {
      const auto first = static_cast<int>(internal_ + i * d_);
      model_.contact.normal(i) = first;
      for (int r = 1; r < d_; ++r) model_.contact.tangential(i, r - 1) = first + r;
      model_.contact.friction(i) = random_.decades(recipe_.friction.low, recipe_.friction.high);
      model_.contact.gap(i) = random_.between(recipe_.gap.low, recipe_.gap.high);
      if (!random_.chance(recipe_.unloaded))
        model_.static_force(first) = random_.decades(recipe_.preload.low, recipe_.preload.high);
    }
  }

  // Adds the energy (a - R b)^T k (a - R b) / 2 of blocks of dofs that start at a and b.
  void link(Eigen::Index a, Eigen::Index b, const Eigen::MatrixXd& k, const Eigen::MatrixXd& turn) {
    model_.stiffness.block(a, a, d_, d_) += k;
    model_.stiffness.block(b, b, d_, d_) += turn.transpose() * k * turn;
    model_.stiffness.block(a, b, d_, d_) -= k * turn;
    model_.stiffness.block(b, a, d_, d_) -= turn.transpose() * k;
  }

  void connect() {
    const Eigen::MatrixXd straight = Eigen::MatrixXd::Identity(d_, d_);
    for (int m = 0; m < recipe_.masses; ++m) {
      const double mass = random_.decades(recipe_.mass.low, recipe_.mass.high);
      if (!recipe_.quasi_static) model_.mass.block(m * d_, m * d_, d_, d_).diagonal().setConstant(mass);
      if (m > 0) link(m * d_, (m - 1) * d_, spring(d_, 1, random_), straight);
      if (recipe_.ground > 0) model_.stiffness.block(m * d_, m * d_, d_, d_) += spring(d_, recipe_.ground, random_);
    }
    for (int i = 0; i < recipe_.nodes; ++i) {
      const double size = random_.decades(recipe_.contact_stiffness.low, recipe_.contact_stiffness.high);
      const int at = i < recipe_.masses ? i : random_.integer(0, recipe_.masses - 1);
      link(internal_ + i * d_, at * d_, spring(d_, size, random_), rotation(d_, random_));
      if (i > 0 && recipe_.coupling > 0)
        link(internal_ + i * d_, internal_ + (i - 1) * d_, spring(d_, size * recipe_.coupling, random_), straight);
      if (!recipe_.quasi_static)
        model_.mass.block(internal_ + i * d_, internal_ + i * d_, d_, d_).diagonal().setConstant(recipe_.contact_mass);
    }
  }

  // Undamped frequencies with the contact dofs listed free and the others fixed, ascending.
  Eigen::VectorXd modes(Modes which) const {
    std::vector<Eigen::Index> slaves;
    for (Eigen::Index i = 0; i < contact_; ++i)
      if (which == Modes::free || (which == Modes::sliding && i % d_ != 0)) slaves.push_back(internal_ + i);
    Eigen::MatrixXd stiffness = model_.stiffness.topLeftCorner(internal_, internal_);
    if (!slaves.empty()) {
      const Eigen::MatrixXd coupling = model_.stiffness(slaves, Eigen::seqN(0, internal_));
      const Eigen::MatrixXd own = model_.stiffness(slaves, slaves);
      stiffness -= coupling.transpose() * own.ldlt().solve(coupling);
    }
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(
        stiffness, model_.mass.topLeftCorner(internal_, internal_), Eigen::EigenvaluesOnly);
    return solver.eigenvalues().cwiseMax(0).cwiseSqrt();
  }

  double frequency() {
    const Eigen::VectorXd found = modes(recipe_.modes);
    Eigen::Index pick = random_.integer(0, std::min<int>(3, static_cast<int>(internal_) - 1));
    while (pick + 1 < found.size() && found(pick) < 1e-6 * found(found.size() - 1)) ++pick;
    return found(pick) * random_.between(recipe_.detuning.low, recipe_.detuning.high);
  }

  void damp(double omega) {
    if (recipe_.quasi_static || recipe_.damping_ratio.high <= 0) return;
    const double ratio = random_.decades(recipe_.damping_ratio.low, recipe_.damping_ratio.high);
    if (recipe_.proportional) {
      const double share = random_.unit();
      model_.damping = 2 * ratio * (share * omega * model_.mass + (1 - share) / omega * model_.stiffness);
      return;
    }
    for (int m = 0; m < recipe_.masses; ++m)
      model_.damping.block(m * d_, m * d_, d_, d_) +=
          spring(d_, 2 * ratio * omega * model_.mass(m * d_, m * d_), random_);
  }

  // Amplitudes of all dofs to the unit load of harmonic 1 with the contact dofs fixed or free.
  Eigen::VectorXcd linear_response(double omega, bool contact_free) const {
    const Eigen::Index n = contact_free ? internal_ + contact_ : internal_;
    const std::complex<double> i(0, 1);
    const Eigen::MatrixXcd dynamic =
        model_.stiffness.cast<std::complex<double>>() + i * omega * model_.damping - (omega * omega) * model_.mass;
    Eigen::VectorXcd load(internal_ + contact_), all = Eigen::VectorXcd::Zero(internal_ + contact_);
    load.real() = model_.cosine_force.row(0).transpose();
    load.imag() = -model_.sine_force.row(0).transpose();
    all.head(n) = dynamic.topLeftCorner(n, n).partialPivLu().solve(load.head(n));
    return contact_free ? all : Eigen::VectorXcd(dynamic.bottomRows(contact_) * all - load.tail(contact_));
  }

  void excite(double omega) {
    const int harmonics = recipe_.forcing_harmonics;
    model_.cosine_force = model_.sine_force = Eigen::MatrixXd::Zero(harmonics, internal_ + contact_);
    for (int h = 0; h < harmonics; ++h)
      for (Eigen::Index dof = 0; dof < internal_; ++dof) {
        if (recipe_.masses > 3 && random_.chance(0.5)) continue;
        model_.cosine_force(h, dof) = random_.normal() / (h + 1);
        model_.sine_force(h, dof) = random_.normal() / (h + 1);
      }
    if (recipe_.masses > 3) model_.cosine_force(0, 0) += 1;
    const double reach = random_.decades(recipe_.reach.low, recipe_.reach.high);
    const double scale = recipe_.measure == Measure::load ? reach : reach / largest_ratio(omega);
    model_.cosine_force *= scale;
    model_.sine_force *= scale;
  }

  // How far a unit load is from the first event that `measure` names.
  double largest_ratio(double omega) const {
    const Eigen::VectorXcd response = linear_response(omega, recipe_.measure == Measure::gap);
    double largest = 1e-300;
    for (Eigen::Index i = 0; i < recipe_.nodes; ++i) {
      const Eigen::Index first = i * d_;
      const double load = std::max(model_.static_force(internal_ + first), 1e-3 * recipe_.preload.low);
      double ratio = 0;
      if (recipe_.measure == Measure::gap)
        ratio = std::abs(response(internal_ + first)) / std::max(std::abs(model_.contact.gap(i)), 1e-12);
      else if (recipe_.measure == Measure::lift)
        ratio = std::abs(response(first)) / load;
      else
        ratio = response.segment(first + 1, d_ - 1).norm() / (model_.contact.friction(i) * load);
      largest = std::max(largest, ratio);
    }
    return largest;
  }

  const Recipe& recipe_;
  Random& random_;
  Eigen::Index d_, internal_, contact_;
  reduction::ReducedModel model_;
};

}  // namespace

Problem build(const Recipe& recipe, Random& random) {
  return Builder(recipe, random).build();
}

}  // namespace dovetail::hard_cases
