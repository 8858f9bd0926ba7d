#include "tests/hard_cases/oracle.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "tests/hard_cases/law.hpp"

namespace dovetail::hard_cases {
namespace {

using Complex = std::complex<double>;

// Of the rounding of direct terms: that of a factorisation or of modes is a fraction.
constexpr double kAmplified = 0.1;

// Reaction forces R = F - Z U of one harmonic from the uncondensed equations, and the energies of that harmonic.
struct Balance {
  std::vector<Eigen::VectorXcd> displacement, reaction, load;  // per harmonic; the first two of contact dofs
  std::vector<Eigen::VectorXcd> blocked;                       // contact forces of the load when nothing moves there
  double magnitude = 0;                                        // of the terms that cancel in R
  double energy = 0;                                           // of the terms that cancel in the energy balance
};

std::vector<Eigen::Index> contact_dofs(const reduction::ReducedModel& model) {
  std::vector<Eigen::Index> dofs;
  for (Eigen::Index i = 0; i < model.contact.count(); ++i) {
    dofs.push_back(model.contact.normal(i));
    for (Eigen::Index r = 0; r + 1 < model.contact.directions(); ++r) dofs.push_back(model.contact.tangential(i, r));
  }
  return dofs;
}

Eigen::VectorXcd excitation(const reduction::ReducedModel& model, int h) {
  Eigen::VectorXcd force = Eigen::VectorXcd::Zero(model.size());
  if (h == 0) force.real() = model.static_force;
  if (h > 0 && h <= model.cosine_force.rows()) force.real() = model.cosine_force.row(h - 1).transpose();
  if (h > 0 && h <= model.sine_force.rows()) force.imag() = -model.sine_force.row(h - 1).transpose();
  return force;
}

Balance balance(const Problem& problem, const Eigen::MatrixXd& displacement) {
  const reduction::ReducedModel& model = problem.model;
  const std::vector<Eigen::Index> c = contact_dofs(model);
  std::vector<char> taken(static_cast<std::size_t>(model.size()), 0);
  for (const Eigen::Index dof : c) taken[static_cast<std::size_t>(dof)] = 1;
  std::vector<Eigen::Index> internal;
  for (Eigen::Index dof = 0; dof < model.size(); ++dof)
    if (taken[static_cast<std::size_t>(dof)] == 0) internal.push_back(dof);
  Balance result;
  for (int h = 0; h <= problem.options.harmonics; ++h) {
    const double w = h * problem.omega;
    const Eigen::MatrixXcd dynamic =
        model.stiffness.cast<Complex>() + Complex(0, w) * model.damping - (w * w) * model.mass;
    const Eigen::VectorXcd force = excitation(model, h);
    Eigen::VectorXcd contact(displacement.rows()), all(model.size());
    if (h == 0)
      contact = displacement.col(0).cast<Complex>();
    else
      contact = displacement.col(2 * h - 1) - Complex(0, 1) * displacement.col(2 * h);
    all(c) = contact;
    Eigen::VectorXcd blocked = force(c);
    if (!internal.empty()) {
      const Eigen::MatrixXcd coupling = dynamic(internal, c), own = dynamic(internal, internal);
      const Eigen::PartialPivLU<Eigen::MatrixXcd> factor(own);
      const Eigen::VectorXcd inside = factor.solve(Eigen::VectorXcd(force(internal) - coupling * contact));
      all(internal) = inside;
      blocked -= coupling.transpose() * factor.solve(Eigen::VectorXcd(force(internal)));
      // Errors of rounding in the internal dofs, which a resonance of the glued structure amplifies.
      const double stiffness = model.stiffness(internal, internal).norm();
      result.magnitude += kAmplified * factor.solve(coupling).norm() * stiffness * inside.norm();
    }
    const Eigen::VectorXcd reaction = force - dynamic * all;
    result.magnitude += Eigen::VectorXd(dynamic.cwiseAbs() * all.cwiseAbs()).norm();
    result.displacement.push_back(contact);
    result.reaction.push_back(reaction(c));
    result.load.push_back(force);
    result.blocked.push_back(blocked);
    result.energy += std::numbers::pi * h *
                     (force.norm() + (dynamic.cwiseAbs() * all.cwiseAbs()).norm() + reaction(c).norm()) * all.norm();
  }
  return result;
}

// The claim as complex amplitudes per harmonic.
std::vector<Eigen::VectorXcd> series(const Eigen::MatrixXd& coefficients) {
  std::vector<Eigen::VectorXcd> result{coefficients.col(0).cast<Complex>()};
  for (Eigen::Index h = 1; 2 * h < coefficients.cols(); ++h)
    result.push_back(coefficients.col(2 * h - 1) - Complex(0, 1) * coefficients.col(2 * h));
  return result;
}

// e^(i tau) at all instants of the period.
std::vector<Complex> circle(int samples) {
  std::vector<Complex> result;
  for (int n = 0; n < samples; ++n) result.push_back(std::polar(1.0, 2 * std::numbers::pi * n / samples));
  return result;
}

// Values of one row of a series, times `factor`, added to component `r` of `into`.
void add(const std::vector<Eigen::VectorXcd>& series, Eigen::Index row, double factor,
         const std::vector<Complex>& circle, std::size_t r, std::vector<Vector>& into) {
  for (std::size_t h = 0; h < series.size(); ++h) {
    const Complex amplitude = factor * series[h](row);
    if (amplitude == Complex(0, 0)) continue;
    for (std::size_t n = 0; n < into.size(); ++n) into[n][r] += (amplitude * circle[h * n % into.size()]).real();
  }
}

// Amplitudes [terms] of one component by the discrete transform of every `stride`-th value.
std::vector<Complex> analyse(const std::vector<Vector>& values, std::size_t r, std::size_t terms,
                             const std::vector<Complex>& circle, std::size_t stride = 1) {
  const std::size_t count = values.size() / stride;
  std::vector<Complex> result(terms);
  for (std::size_t h = 0; h < terms; ++h) {
    for (std::size_t n = 0; n < count; ++n)
      result[h] += values[n * stride][r] * std::conj(circle[h * n % count * stride]);
    result[h] *= (h == 0 ? 1.0 : 2.0) / static_cast<double>(count);
  }
  return result;
}

// One node of the claim: its prediction and its two orbits.
class Node {
 public:
  Node(const Problem& problem, const Claim& claim, const std::vector<Eigen::VectorXcd>& displacement,
       const std::vector<Eigen::VectorXcd>& force, Eigen::Index i)
      : d_(static_cast<std::size_t>(problem.model.contact.directions())),
        terms_(force.size()),
        samples_(static_cast<std::size_t>(problem.options.samples)),
        mu_(problem.model.contact.friction(i)),
        coarse_circle_(circle(problem.options.samples)),
        fine_circle_(circle(kFiner * problem.options.samples)) {
    const reduction::ContactNodes& contact = problem.model.contact;
    const steady::Condition& condition = problem.condition;
    released_ = !condition.released.empty() && condition.released[static_cast<std::size_t>(i)] != 0;
    const double wear = condition.wear_depth.size() > 0 ? condition.wear_depth(i) : 0;
    fine_prediction_.assign(kFiner * samples_, Vector{});
    claimed_.assign(samples_, Vector{});
    Memory start;
    for (std::size_t r = 0; r < d_; ++r) {
      const Eigen::Index row = i * static_cast<Eigen::Index>(d_) + static_cast<Eigen::Index>(r);
      const double eps = r == 0 ? claim.normal(i) : claim.tangential(i);
      add(force, row, 1, fine_circle_, r, fine_prediction_);
      add(displacement, row, eps, fine_circle_, r, fine_prediction_);
      add(force, row, 1, coarse_circle_, r, claimed_);
      for (std::size_t h = 0; h < terms_; ++h) amplitudes_[r].push_back(force[h](row));
      if (r == 0) {
        for (Vector& p : fine_prediction_) p[0] -= eps * (contact.gap(i) + wear);
      } else {
        const auto column = static_cast<Eigen::Index>(r) - 1;
        start.slip[r] = eps * (condition.slip_origin.size() > 0 ? condition.slip_origin(i, column)
                                                                : contact.slip_origin(i, column));
      }
    }
    for (std::size_t n = 0; n < samples_; ++n) prediction_.push_back(fine_prediction_[n * kFiner]);
    const bool second_order = problem.options.slip_return == contact::SlipReturn::second_order;
    const Law law{.friction = mu_, .second_order = second_order, .touches_between = second_order};
    constexpr double kOrbit = 1e-13;  // far below a tolerance
    orbit_ = released_ ? free_orbit(prediction_) : periodic_orbit(prediction_, law, start, kOrbit);
    // The closest points, whichever rule the claim was solved with: from one sample to the next they bring states that
    // differ no farther apart (march_error). The rule of second order remembers a direction besides, which rings.
    const Law finest{.friction = mu_, .touches_between = true};
    constexpr double kResolution = 1e-8;  // far below what large steps cost
    fine_ = released_ ? free_orbit(fine_prediction_)
                      : periodic_orbit(fine_prediction_, finest, orbit_.memory.back(), kResolution);
    step_error_.assign(samples_, 0);
    if (!released_) step_error_ = march_error(fine_prediction_, finest, orbit_, fine_, d_ == 2);
    for (const Vector& f : claimed_) largest_ = std::max({largest_, std::abs(f[0]), std::hypot(f[1], f[2])});
  }

  [[nodiscard]] bool periodic() const { return orbit_.periodic; }
  [[nodiscard]] bool fine_periodic() const { return fine_.periodic; }
  [[nodiscard]] double uncertainty() const { return orbit_.uncertainty; }
  // |lambda - T L|.
  [[nodiscard]] double march_distance() const { return distance(orbit_.force, coarse_circle_, 1); }
  // The finer march where the claim has its samples: between them, only the series of the transform differ.
  [[nodiscard]] double finer_distance() const { return distance(fine_.force, fine_circle_, kFiner); }
  // What large steps may cost of that: an error e_n of the force at sample n is one of its amplitudes, of which
  // c_0^2 + sum |c_h|^2 <= 2 mean e_n^2 [Parseval].
  [[nodiscard]] double step_cost() const {
    double square = 0;
    for (const double e : step_error_) square += e * e;
    return std::sqrt(2 * square / static_cast<double>(samples_)) + std::sqrt(2) * fine_.uncertainty;
  }
  [[nodiscard]] std::vector<Contact> states() const {
    std::vector<Contact> result;
    for (std::size_t n = 0; n < samples_; ++n) {
      const Memory &now = orbit_.memory[n], &last = orbit_.memory[(n + samples_ - 1) % samples_];
      result.push_back(now.open    ? Contact::open
                       : last.open ? Contact::touching
                       : now.slid  ? Contact::slipping
                                   : Contact::sticking);
    }
    return result;
  }
  [[nodiscard]] double friction() const { return mu_; }
  [[nodiscard]] double largest_force() const { return largest_; }

  // The largest violations of the laws at the samples by the claim completed by its truncation error. `tolerance`, N,
  // is what a force may be off.
  struct Violations {
    double tension = 0, penetration = 0, complementarity = 0, cone = 0, stick = 0;
  };
  [[nodiscard]] Violations violations(double tolerance) const {
    Violations worst;
    if (released_) return worst;
    const std::vector<Vector> force = completed();
    for (std::size_t n = 0; n < samples_; ++n) {
      const std::size_t last = (n + samples_ - 1) % samples_;
      const Vector &f = force[n], &p = prediction_[n];
      worst.tension = std::max(worst.tension, -f[0]);
      worst.penetration = std::max(worst.penetration, p[0] - f[0]);
      worst.complementarity = std::max(worst.complementarity, std::min(f[0], f[0] - p[0]));
      const double traction = std::hypot(f[1], f[2]), inside = mu_ * std::max(0.0, f[0]) - traction;
      worst.cone = std::max(worst.cone, -inside);
      if (prediction_[n][0] <= 0 || prediction_[last][0] <= 0) continue;
      const double slip_y = p[1] - f[1] - prediction_[last][1] + force[last][1];
      const double slip_z = p[2] - f[2] - prediction_[last][2] + force[last][2];
      const double slip = std::hypot(slip_y, slip_z);
      if (inside > (1 + mu_) * tolerance)
        worst.stick = std::max(worst.stick, slip);
      else if (traction > tolerance)  // whose direction is known as well as that
        worst.stick = std::max(worst.stick, (-(slip_y * f[1] + slip_z * f[2]) - tolerance * slip) / traction);
    }
    return worst;
  }

 private:
  static constexpr int kFiner = 16;

  [[nodiscard]] double distance(const std::vector<Vector>& force, const std::vector<Complex>& circle,
                                std::size_t stride) const {
    double square = 0;
    for (std::size_t r = 0; r < d_; ++r) {
      const std::vector<Complex> found = analyse(force, r, terms_, circle, stride);
      for (std::size_t h = 0; h < terms_; ++h) square += std::norm(found[h] - amplitudes_[r][h]);
    }
    return std::sqrt(square);
  }

  // lambda + E at the samples.
  [[nodiscard]] std::vector<Vector> completed() const {
    std::vector<Vector> exact = orbit_.force;
    for (std::size_t n = 0; n < samples_; ++n) exact[n][0] = std::max(0.0, prediction_[n][0]);
    std::vector<Vector> result = claimed_;
    for (std::size_t r = 0; r < d_; ++r) {
      const std::vector<Complex> kept = analyse(exact, r, terms_, coarse_circle_);
      for (std::size_t n = 0; n < samples_; ++n) {
        double truncated = 0;
        for (std::size_t h = 0; h < terms_; ++h) truncated += (kept[h] * coarse_circle_[h * n % samples_]).real();
        result[n][r] += exact[n][r] - truncated;
      }
    }
    return result;
  }

  std::size_t d_, terms_, samples_;
  double mu_, largest_ = 0;
  bool released_ = false;
  std::vector<Complex> coarse_circle_, fine_circle_;
  std::vector<Vector> prediction_, fine_prediction_, claimed_;
  std::array<std::vector<Complex>, 3> amplitudes_;
  Orbit orbit_, fine_;
  std::vector<double> step_error_;
};

double norm(const std::vector<Eigen::VectorXcd>& a, std::size_t from = 0) {
  double square = 0;
  for (std::size_t h = from; h < a.size(); ++h) square += a[h].squaredNorm();
  return std::sqrt(square);
}

// Keeps the finding that exceeds what is allowed by the largest factor.
void note(Verdict& verdict, Check check, double found, double allowed) {
  Verdict::Finding& kept = verdict.findings[static_cast<std::size_t>(check)];
  if (!(found * kept.allowed <= kept.found * allowed) || kept.allowed == 0) kept = {found, allowed};
}

}  // namespace

const char* name(Check check) {
  constexpr std::array<const char*, kChecks> kNames{"equilibrium",     "march", "finer march", "tension", "penetration",
                                                    "complementarity", "cone",  "stick",       "energy"};
  return kNames[static_cast<std::size_t>(check)];
}

Eigen::MatrixXd reactions(const Problem& problem, const Eigen::MatrixXd& displacement) {
  const std::vector<Eigen::VectorXcd> found = balance(problem, displacement).reaction;
  Eigen::MatrixXd result(displacement.rows(), displacement.cols());
  result.col(0) = found[0].real();
  for (std::size_t h = 1; h < found.size(); ++h) {
    result.col(static_cast<Eigen::Index>(2 * h - 1)) = found[h].real();
    result.col(static_cast<Eigen::Index>(2 * h)) = -found[h].imag();
  }
  return result;
}

std::vector<std::vector<Contact>> contact_states(const Problem& problem, const Claim& claim) {
  const std::vector<Eigen::VectorXcd> displacement = series(claim.displacement), force = series(claim.force);
  std::vector<std::vector<Contact>> result;
  for (Eigen::Index i = 0; i < problem.model.contact.count(); ++i)
    result.push_back(Node(problem, claim, displacement, force, i).states());
  return result;
}

Verdict examine(const Problem& problem, const Claim& claim) {
  const Balance sum = balance(problem, claim.displacement);
  const std::vector<Eigen::VectorXcd> force = series(claim.force);
  const double tolerance = problem.options.tolerance;
  // As the engine measures: by the excitation as the contact sees it.
  double scale = norm(sum.blocked, 1);
  if (!(scale > 0)) scale = norm(sum.blocked);
  if (!(scale > 0)) scale = 1;
  std::vector<Node> nodes;
  Verdict verdict;
  double uncertainty = 1e-14 * (sum.magnitude + norm(sum.load));
  for (Eigen::Index i = 0; i < problem.model.contact.count(); ++i) {
    nodes.emplace_back(problem, claim, sum.displacement, force, i);
    uncertainty += nodes.back().uncertainty();
    verdict.periodic = verdict.periodic && nodes.back().periodic();
  }
  verdict.rounding = uncertainty / scale;
  // Slip that dies out slowly is extrapolated by the engine and marched to its end here: a few tolerances apart.
  const double allowed = 5 * tolerance * scale + uncertainty;
  double unbalanced = 0, marched = 0;
  for (std::size_t h = 0; h < force.size(); ++h) unbalanced += (sum.reaction[h] - force[h]).squaredNorm();
  note(verdict, Check::equilibrium, std::sqrt(unbalanced), allowed);
  // A value of a series is at most the sum of its H + 1 amplitudes: sqrt(H + 1) of their norm.
  const double value = std::sqrt(static_cast<double>(force.size())) * allowed;
  for (const Node& node : nodes) {
    marched += std::pow(node.march_distance(), 2);
    // Slip may drift on for ever at fine steps where it has come to rest at the claim's: that is no orbit to compare
    // with.
    if (node.fine_periodic())
      note(verdict, Check::finer_march, node.finer_distance(), allowed + node.step_cost());
    else
      ++verdict.drifting;
    if (node.largest_force() > 0)
      verdict.resolution = std::max(verdict.resolution, node.step_cost() / node.largest_force());
    const Node::Violations found = node.violations(value);
    note(verdict, Check::tension, found.tension, value);
    note(verdict, Check::penetration, found.penetration, value);
    note(verdict, Check::complementarity, found.complementarity, value);
    note(verdict, Check::cone, found.cone, (1 + node.friction()) * value);
    note(verdict, Check::stick, found.stick, 2 * value);  // two instants differ
  }
  note(verdict, Check::march, std::sqrt(marched), allowed);
  note(verdict, Check::energy, std::abs(claim.input_energy - claim.damping_energy - claim.contact_work),
       (2 * tolerance + 1e-12) * sum.energy);
  return verdict;
}

std::string objection(const Verdict& verdict) {
  if (!verdict.periodic) return "not periodic";
  if (!(verdict.rounding <= 1e-6)) return "rounding swamps the forces";
  for (std::size_t i = 0; i < kChecks; ++i)
    if (verdict.findings[i].rejects()) return name(static_cast<Check>(i));
  return {};
}

}  // namespace dovetail::hard_cases
