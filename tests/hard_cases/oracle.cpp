#include "tests/hard_cases/oracle.hpp"

#include <Eigen/LU>
#include <algorithm>
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

Balance balance(const Problem& problem, const Claim& claim) {
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
    Eigen::VectorXcd contact(claim.displacement.rows()), all(model.size());
    if (h == 0)
      contact = claim.displacement.col(0).cast<Complex>();
    else
      contact = claim.displacement.col(2 * h - 1) - Complex(0, 1) * claim.displacement.col(2 * h);
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

// Value at tau of a series given by complex amplitudes.
double at(const std::vector<Eigen::VectorXcd>& series, Eigen::Index row, double tau) {
  double sum = 0;
  for (std::size_t h = 0; h < series.size(); ++h)
    sum += (series[h](row) * std::polar(1.0, static_cast<double>(h) * tau)).real();
  return sum;
}

struct Marched {
  std::vector<Orbit> orbits;                // per node
  std::vector<Eigen::VectorXcd> harmonics;  // of the marched forces
};

Marched march_all(const Problem& problem, const Claim& claim, const Balance& balance, int samples,
                  const std::vector<Orbit>* start) {
  const reduction::ContactNodes& contact = problem.model.contact;
  const Eigen::Index d = contact.directions();
  const std::size_t terms = balance.reaction.size();
  Marched marched;
  marched.harmonics.assign(terms, Eigen::VectorXcd::Zero(contact.count() * d));
  for (Eigen::Index i = 0; i < contact.count(); ++i) {
    const bool released =
        !problem.condition.released.empty() && problem.condition.released[static_cast<std::size_t>(i)] != 0;
    const double wear = problem.condition.wear_depth.size() > 0 ? problem.condition.wear_depth(i) : 0;
    std::vector<Vector> prediction(static_cast<std::size_t>(samples));
    for (int n = 0; n < samples; ++n) {
      const double tau = 2 * std::numbers::pi * n / samples;
      Vector& p = prediction[static_cast<std::size_t>(n)];
      for (Eigen::Index r = 0; r < d; ++r) {
        const double eps = r == 0 ? claim.normal(i) : claim.tangential(i);
        const double offset = r == 0 ? contact.gap(i) + wear : 0;
        p[static_cast<std::size_t>(r)] =
            at(balance.reaction, i * d + r, tau) + eps * (at(balance.displacement, i * d + r, tau) - offset);
      }
    }
    Vector slip{};
    for (Eigen::Index r = 1; r < d; ++r)
      slip[static_cast<std::size_t>(r)] =
          claim.tangential(i) * (problem.condition.slip_origin.size() > 0 ? problem.condition.slip_origin(i, r - 1)
                                                                          : contact.slip_origin(i, r - 1));
    if (start != nullptr) slip = (*start)[static_cast<std::size_t>(i)].slip_force.back();
    Orbit orbit =
        released ? free_orbit(prediction)
                 : periodic_orbit(prediction, contact.friction(i), problem.options.slip_return == "second_order", slip);
    for (int n = 0; n < samples; ++n)
      for (std::size_t h = 0; h < terms; ++h) {
        const Complex weight =
            std::polar((h == 0 ? 1.0 : 2.0) / samples, -2 * std::numbers::pi * static_cast<double>(h) * n / samples);
        for (Eigen::Index r = 0; r < d; ++r)
          marched.harmonics[h](i * d + r) +=
              weight * orbit.force[static_cast<std::size_t>(n)][static_cast<std::size_t>(r)];
      }
    marched.orbits.push_back(std::move(orbit));
  }
  return marched;
}

double distance(const std::vector<Eigen::VectorXcd>& a, const std::vector<Eigen::VectorXcd>& b) {
  double square = 0;
  for (std::size_t h = 0; h < a.size(); ++h) square += (a[h] - b[h]).squaredNorm();
  return std::sqrt(square);
}

double norm(const std::vector<Eigen::VectorXcd>& a, std::size_t from = 0) {
  double square = 0;
  for (std::size_t h = from; h < a.size(); ++h) square += a[h].squaredNorm();
  return std::sqrt(square);
}

// Violations by the series themselves. What they may violate the law by is what the marched orbit has beyond harmonic
// H: everything more is an error of the solution. Relative to the largest force or displacement of the node.
void check_law(const Problem& problem, const Claim& claim, const Balance& balance, const Marched& marched,
               Verdict& verdict) {
  const reduction::ContactNodes& contact = problem.model.contact;
  const Eigen::Index d = contact.directions();
  double largest_force = 0, largest_gap = 0;
  struct Excess {
    double force = 0, tension = 0, cone = 0, penetration = 0;
  } excess;
  for (Eigen::Index i = 0; i < contact.count(); ++i) {
    const Orbit& orbit = marched.orbits[static_cast<std::size_t>(i)];
    const double mu = contact.friction(i), eps = claim.normal(i);
    const double wear = problem.condition.wear_depth.size() > 0 ? problem.condition.wear_depth(i) : 0;
    const auto samples = static_cast<int>(orbit.force.size());
    for (int n = 0; n < samples; ++n) {
      const double tau = 2 * std::numbers::pi * n / samples;
      const Vector& exact = orbit.force[static_cast<std::size_t>(n)];
      double traction = 0, remainder = 0;
      for (Eigen::Index r = 1; r < d; ++r) {
        const double force = at(balance.reaction, i * d + r, tau);
        traction += force * force;
        remainder += std::pow(force - exact[static_cast<std::size_t>(r)], 2);
      }
      const double normal = at(balance.reaction, i * d, tau);
      const double missed = std::abs(normal - exact[0]);
      const double gap = contact.gap(i) + wear - at(balance.displacement, i * d, tau);
      const double exact_gap = -orbit.slip_force[static_cast<std::size_t>(n)][0] / eps;
      excess.tension = std::max(excess.tension, -normal - missed);
      excess.cone =
          std::max(excess.cone, std::sqrt(traction) - mu * std::max(0.0, normal) - std::sqrt(remainder) - mu * missed);
      excess.penetration = std::max(excess.penetration, -gap - std::abs(gap - exact_gap));
      largest_force = std::max({largest_force, std::abs(normal), std::sqrt(traction)});
      largest_gap = std::max(largest_gap, std::abs(gap));
    }
  }
  verdict.tension = excess.tension / std::max(largest_force, 1e-300);
  verdict.cone = excess.cone / std::max(largest_force, 1e-300);
  verdict.penetration = excess.penetration / std::max(largest_gap, 1e-300);
}

}  // namespace

Verdict examine(const Problem& problem, const Claim& claim) {
  const Balance sum = balance(problem, claim);
  const int samples = problem.options.samples;
  const Marched same = march_all(problem, claim, sum, samples, nullptr);
  const Marched fine = march_all(problem, claim, sum, 16 * samples, &same.orbits);
  // As the engine measures: by the excitation as the contact sees it.
  double scale = norm(sum.blocked, 1);
  if (!(scale > 0)) scale = norm(sum.blocked);
  if (!(scale > 0)) scale = 1;
  Verdict verdict;
  verdict.residual = distance(same.harmonics, sum.reaction) / scale;
  double uncertainty = 1e-14 * (sum.magnitude + norm(sum.load));
  for (const Orbit& orbit : same.orbits) uncertainty += orbit.uncertainty;
  verdict.rounding = uncertainty / scale;
  verdict.fine_residual =
      distance(fine.harmonics, sum.reaction) / std::max(norm(sum.load) + norm(sum.reaction), 1e-300);
  for (const Marched* marched : {&same, &fine})
    for (const Orbit& orbit : marched->orbits) verdict.periodic = verdict.periodic && orbit.periodic;
  check_law(problem, claim, sum, fine, verdict);
  if (sum.energy > 0)
    verdict.energy = std::abs(claim.input_energy - claim.damping_energy - claim.contact_work) / sum.energy;
  return verdict;
}

std::string objection(const Problem& problem, const Verdict& verdict) {
  const double tolerance = problem.options.tolerance;
  if (!verdict.periodic) return "not periodic";
  if (!(verdict.rounding <= 1e-6)) return "rounding swamps the forces";
  // Slip that dies out slowly is extrapolated by the engine and marched to its end here: a few tolerances apart.
  if (!(verdict.residual <= 5 * tolerance + verdict.rounding)) return "residual";
  // The law on finer samples differs by O(1/N) of the forces at most: kinks inside an interval and slip that turns.
  if (!(verdict.fine_residual <= 5 * tolerance + verdict.rounding + 10.0 / problem.options.samples))
    return "residual on finer samples";
  if (!(verdict.tension <= 1e-6)) return "pulls";
  if (!(verdict.cone <= 1e-6)) return "leaves the cone of friction";
  if (!(verdict.penetration <= 1e-6)) return "penetrates";
  if (!(verdict.energy <= 2 * tolerance + 1e-12)) return "energy balance";
  return {};
}

}  // namespace dovetail::hard_cases
