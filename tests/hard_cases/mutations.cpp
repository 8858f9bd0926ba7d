#include "tests/hard_cases/mutations.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dovetail::hard_cases {
namespace {

constexpr double kShare = 0.01, kCost = 0.2;

// A claim sample by sample, and changes of it.
class Canvas {
 public:
  Canvas(const Problem& problem, const Claim& claim, double floor)
      : problem_(problem),
        claim_(claim),
        floor_(floor),
        d_(problem.model.contact.directions()),
        terms_(claim.displacement.cols()),
        samples_(problem.options.samples) {
    basis_.resize(terms_, samples_);
    for (Eigen::Index n = 0; n < samples_; ++n)
      for (Eigen::Index k = 0; k < terms_; ++k) {
        const double angle = 2 * std::numbers::pi * static_cast<double>((k + 1) / 2 * n) / samples_;
        basis_(k, n) = k == 0 ? 1 : k % 2 == 1 ? std::cos(angle) : std::sin(angle);
      }
    force_ = claim.force * basis_;
    penalty_.resize(claim.force.rows());
    for (Eigen::Index row = 0; row < penalty_.size(); ++row)
      penalty_(row) = row % d_ == 0 ? claim.normal(row / d_) : claim.tangential(row / d_);
    opening_ = penalty_.asDiagonal() * claim.displacement * basis_;  // eps (U - g - W)
    for (Eigen::Index i = 0; i < nodes(); ++i) {
      const double wear = problem.condition.wear_depth.size() > 0 ? problem.condition.wear_depth(i) : 0;
      opening_.row(i * d_).array() -= penalty_(i * d_) * (problem.model.contact.gap(i) + wear);
    }
  }

  [[nodiscard]] Eigen::Index nodes() const { return claim_.force.rows() / d_; }
  [[nodiscard]] Eigen::Index directions() const { return d_; }
  [[nodiscard]] Eigen::Index terms() const { return terms_; }
  [[nodiscard]] int samples() const { return samples_; }
  [[nodiscard]] double penalty(Eigen::Index row) const { return penalty_(row); }
  [[nodiscard]] double prediction(Eigen::Index row, Eigen::Index n) const { return force_(row, n) + opening_(row, n); }
  [[nodiscard]] Eigen::VectorXd traction(Eigen::Index i, Eigen::Index n) const {
    return force_.col(n).segment(i * d_ + 1, d_ - 1);
  }
  // A hundredth of the largest force; of a node without any, of its largest gap, as a force. 0: it is too small.
  [[nodiscard]] double unit(Eigen::Index i) const {
    double largest = 0;
    for (Eigen::Index n = 0; n < samples_; ++n)
      largest = std::max({largest, std::abs(force_(i * d_, n)), traction(i, n).norm()});
    const double unit = largest > 0 ? kShare * largest : gap_unit(i);
    return unit > floor_ ? unit : 0;
  }
  [[nodiscard]] double gap_unit(Eigen::Index i) const {
    double largest = 0;
    for (Eigen::Index n = 0; n < samples_; ++n) largest = std::max(largest, std::max(0.0, -opening_(i * d_, n)));
    return kShare * largest;
  }
  // The series that is 1 at sample n and as small as H harmonics can be elsewhere.
  [[nodiscard]] Eigen::RowVectorXd spike(Eigen::Index n) const {
    return basis_.col(n).transpose() / basis_.col(n).squaredNorm();
  }
  [[nodiscard]] Eigen::RowVectorXd harmonic(Eigen::Index k) const { return Eigen::RowVectorXd::Unit(terms_, k); }
  // Displacements changed alone, and with the forces that then keep the balance.
  [[nodiscard]] Claim displaced(const Eigen::MatrixXd& displacement) const {
    Claim changed = claim_;
    changed.displacement = displacement;
    return changed;
  }
  [[nodiscard]] Claim balanced(const Eigen::MatrixXd& displacement) const {
    Claim changed = displaced(displacement);
    changed.force = reactions(problem_, displacement);
    return changed;
  }
  // `size` N times `shape` added to a row of the displacements (over its eps) or of the forces.
  [[nodiscard]] Eigen::MatrixXd moved(Eigen::Index row, double size, const Eigen::RowVectorXd& shape) const {
    Eigen::MatrixXd displacement = claim_.displacement;
    displacement.row(row) += size / penalty_(row) * shape;
    return displacement;
  }
  // The same, further where needed so that the node's reactions change by as much, too; not where they hardly change.
  [[nodiscard]] std::optional<Eigen::MatrixXd> felt(Eigen::Index row, double size,
                                                    const Eigen::RowVectorXd& shape) const {
    constexpr double kIdle = 1e-6;
    const Eigen::MatrixXd displacement = moved(row, size, shape);
    const Eigen::MatrixXd change = reactions(problem_, displacement) - reactions(problem_, claim_.displacement);
    const double share = change.middleRows(row / d_ * d_, d_).norm() / (std::abs(size) * shape.norm());
    if (!(share > kIdle)) return std::nullopt;
    return share < 1 ? moved(row, size / share, shape) : displacement;
  }
  [[nodiscard]] Claim pushed(Eigen::Index row, double size, const Eigen::RowVectorXd& shape) const {
    Claim changed = claim_;
    changed.force.row(row) += size * shape;
    return changed;
  }

 private:
  const Problem& problem_;
  const Claim& claim_;
  double floor_;
  Eigen::Index d_, terms_;
  int samples_;
  Eigen::MatrixXd basis_, force_, opening_;
  Eigen::VectorXd penalty_;
};

// A place where `admits(node, sample)` holds and the node has a size; false when there is none.
struct Place {
  Eigen::Index node = 0, sample = 0;
};
template <typename Admits>
std::optional<Place> place(const Canvas& canvas, Random& random, const Admits& admits) {
  std::vector<Place> places;
  for (Eigen::Index i = 0; i < canvas.nodes(); ++i) {
    if (!(canvas.unit(i) > 0)) continue;
    for (Eigen::Index n = 0; n < canvas.samples(); ++n)
      if (admits(i, n)) places.push_back({i, n});
  }
  if (places.empty()) return std::nullopt;
  return places[static_cast<std::size_t>(random.integer(0, static_cast<int>(places.size()) - 1))];
}

bool anywhere(Eigen::Index /*node*/, Eigen::Index /*sample*/) {
  return true;
}

double sign(Random& random) {
  return random.chance(0.5) ? 1 : -1;
}

Eigen::Index any_row(const Canvas& canvas, Eigen::Index node, Random& random) {
  return node * canvas.directions() + random.integer(0, static_cast<int>(canvas.directions()) - 1);
}

Eigen::RowVectorXd any_harmonic(const Canvas& canvas, Random& random, int from = 0) {
  return canvas.harmonic(random.integer(from, static_cast<int>(canvas.terms()) - 1));
}

std::optional<Claim> force_harmonic(const Problem& problem, const Claim& claim, double floor, Random& random) {
  const Canvas canvas(problem, claim, floor);
  const auto at = place(canvas, random, anywhere);
  if (!at) return std::nullopt;
  return canvas.pushed(any_row(canvas, at->node, random), sign(random) * canvas.unit(at->node),
                       any_harmonic(canvas, random));
}

// A displacement of one node in one direction, anywhere or where it opens at times, alone or with all reactions to it.
std::optional<Claim> displace(const Problem& problem, const Claim& claim, double floor, Random& random, bool alone,
                              bool one_sample, bool gap) {
  const Canvas canvas(problem, claim, floor);
  const Eigen::Index d = canvas.directions();
  const auto at = place(canvas, random, [&](Eigen::Index i, Eigen::Index n) {
    return !gap || (canvas.prediction(i * d, n) < 0 && canvas.gap_unit(i) > floor);
  });
  if (!at) return std::nullopt;
  const Eigen::Index row = gap ? at->node * d : any_row(canvas, at->node, random);
  const double unit = canvas.unit(at->node);
  const double size = sign(random) * (gap ? std::max(canvas.gap_unit(at->node), unit) : unit);
  const auto displacement =
      canvas.felt(row, size, one_sample ? canvas.spike(at->sample) : any_harmonic(canvas, random));
  if (!displacement) return std::nullopt;
  return alone ? canvas.displaced(*displacement) : canvas.balanced(*displacement);
}

std::optional<Claim> displacement_harmonic(const Problem& problem, const Claim& claim, double floor, Random& random) {
  return displace(problem, claim, floor, random, true, false, false);
}
std::optional<Claim> state_harmonic(const Problem& problem, const Claim& claim, double floor, Random& random) {
  return displace(problem, claim, floor, random, false, false, false);
}
std::optional<Claim> state_sample(const Problem& problem, const Claim& claim, double floor, Random& random) {
  return displace(problem, claim, floor, random, false, true, false);
}
std::optional<Claim> state_gap(const Problem& problem, const Claim& claim, double floor, Random& random) {
  return displace(problem, claim, floor, random, false, false, true);
}

// One harmonic with the other sign, if it is of a hundredth at least.
std::optional<Claim> state_sign(const Problem& problem, const Claim& claim, double floor, Random& random) {
  const Canvas canvas(problem, claim, floor);
  std::vector<std::pair<Eigen::Index, Eigen::Index>> places;
  for (Eigen::Index row = 0; row < claim.displacement.rows(); ++row)
    for (Eigen::Index k = 0; k < canvas.terms(); ++k) {
      const double unit = canvas.unit(row / canvas.directions());
      if (unit > 0 && 2 * std::abs(claim.displacement(row, k)) * canvas.penalty(row) >= unit)
        places.emplace_back(row, k);
    }
  if (places.empty()) return std::nullopt;
  const auto [row, k] = places[static_cast<std::size_t>(random.integer(0, static_cast<int>(places.size()) - 1))];
  Eigen::MatrixXd displacement = claim.displacement;
  displacement(row, k) *= -1;
  return canvas.balanced(displacement);
}

// Two nodes with each other's displacements, if these are a hundredth apart at least.
std::optional<Claim> state_swap(const Problem& problem, const Claim& claim, double floor, Random& random) {
  const Canvas canvas(problem, claim, floor);
  const Eigen::Index d = canvas.directions();
  if (canvas.nodes() < 2) return std::nullopt;
  const Eigen::Index a = random.integer(0, static_cast<int>(canvas.nodes()) - 2), b = a + 1;
  Eigen::MatrixXd displacement = claim.displacement;
  displacement.middleRows(a * d, d).swap(displacement.middleRows(b * d, d));
  const Eigen::MatrixXd change = displacement - claim.displacement;
  bool apart = false;
  for (Eigen::Index r = 0; r < d; ++r)
    apart = apart || (canvas.unit(a) > 0 &&
                      change.row(a * d + r).cwiseAbs().maxCoeff() * canvas.penalty(a * d + r) >= canvas.unit(a));
  if (!apart) return std::nullopt;
  return canvas.balanced(displacement);
}

// Forces and displacements at one sample. A change by a hundredth must not turn the contact there into another state.
std::optional<Claim> normal_sample(const Problem& problem, const Claim& claim, double floor, Random& random, bool open,
                                   bool force, double direction) {
  const Canvas canvas(problem, claim, floor);
  const auto at = place(canvas, random, [&](Eigen::Index i, Eigen::Index n) {
    const double prediction = canvas.prediction(i * canvas.directions(), n);
    return open ? prediction < -2 * canvas.unit(i) : prediction > 2 * canvas.unit(i);
  });
  if (!at) return std::nullopt;
  const Eigen::Index row = at->node * canvas.directions();
  const Eigen::RowVectorXd spike = canvas.spike(at->sample);
  const double size = direction * canvas.unit(at->node);
  return force ? canvas.pushed(row, size, spike) : canvas.displaced(canvas.moved(row, size, spike));
}

std::optional<Claim> pull(const Problem& problem, const Claim& claim, double floor, Random& random) {
  return normal_sample(problem, claim, floor, random, true, true, -1);
}
std::optional<Claim> press(const Problem& problem, const Claim& claim, double floor, Random& random) {
  return normal_sample(problem, claim, floor, random, true, true, 1);
}
std::optional<Claim> sink(const Problem& problem, const Claim& claim, double floor, Random& random) {
  return normal_sample(problem, claim, floor, random, false, false, 1);
}
std::optional<Claim> lift(const Problem& problem, const Claim& claim, double floor, Random& random) {
  return normal_sample(problem, claim, floor, random, false, false, -1);
}

// Slips as the oracle's own march says.
std::optional<Claim> drag(const Problem& problem, const Claim& claim, double floor, Random& random) {
  const Canvas canvas(problem, claim, floor);
  const std::vector<std::vector<Contact>> states = contact_states(problem, claim);
  const auto at = place(canvas, random, [&](Eigen::Index i, Eigen::Index n) {
    return states[static_cast<std::size_t>(i)][static_cast<std::size_t>(n)] == Contact::slipping &&
           problem.model.contact.friction(i) > 0 && canvas.traction(i, n).norm() > 0;
  });
  if (!at) return std::nullopt;
  const Eigen::VectorXd along = canvas.traction(at->node, at->sample).normalized();
  Claim changed = claim;
  changed.force.middleRows(at->node * canvas.directions() + 1, canvas.directions() - 1) +=
      canvas.unit(at->node) * along * canvas.spike(at->sample);
  return changed;
}

std::optional<Claim> drag_open(const Problem& problem, const Claim& claim, double floor, Random& random) {
  const Canvas canvas(problem, claim, floor);
  const auto at = place(canvas, random, [&](Eigen::Index i, Eigen::Index n) {
    return canvas.prediction(i * canvas.directions(), n) < 0;
  });
  if (!at) return std::nullopt;
  return canvas.pushed(at->node * canvas.directions() + 1, sign(random) * canvas.unit(at->node),
                       canvas.spike(at->sample));
}

// Where it sticks for half of the period at least: a displacement elsewhere is no slip, but a slide's.
std::optional<Claim> creep(const Problem& problem, const Claim& claim, double floor, Random& random) {
  const Canvas canvas(problem, claim, floor);
  const std::vector<std::vector<Contact>> states = contact_states(problem, claim);
  const auto at = place(canvas, random, [&](Eigen::Index i, Eigen::Index /*n*/) {
    const std::vector<Contact>& node = states[static_cast<std::size_t>(i)];
    return 2 * std::count(node.begin(), node.end(), Contact::sticking) >= canvas.samples();
  });
  if (!at) return std::nullopt;
  const Eigen::Index row = at->node * canvas.directions() + 1;
  const auto displacement = canvas.felt(row, sign(random) * canvas.unit(at->node), any_harmonic(canvas, random, 1));
  if (!displacement) return std::nullopt;
  return canvas.displaced(*displacement);
}

// Of a state that dissipates something: else its energies are rounding.
std::optional<Claim> miscount(const Problem& problem, const Claim& claim, double /*floor*/, Random& random) {
  bool dissipates = !problem.model.damping.isZero(0);
  for (const std::vector<Contact>& node : contact_states(problem, claim))
    dissipates = dissipates || std::find(node.begin(), node.end(), Contact::slipping) != node.end();
  if (!dissipates) return std::nullopt;
  const double largest =
      std::max({std::abs(claim.input_energy), std::abs(claim.damping_energy), std::abs(claim.contact_work)});
  Claim changed = claim;
  std::array<double*, 3> terms{&changed.input_energy, &changed.damping_energy, &changed.contact_work};
  *terms[static_cast<std::size_t>(random.integer(0, 2))] += sign(random) * kShare * largest;
  return changed;
}

}  // namespace

const std::vector<Mutation>& mutations() {
  using enum Check;
  static const std::vector<Mutation> all{
      {"forces of one harmonic", {equilibrium}, force_harmonic},
      {"displacements of one harmonic", {equilibrium}, displacement_harmonic},
      {"a state, one harmonic", {march, finer_march}, state_harmonic},
      {"a state, one sample", {march, finer_march}, state_sample},
      {"a state, by its gap", {march, finer_march}, state_gap},
      {"a state, sign of a harmonic", {march, finer_march}, state_sign},
      {"a state, nodes swapped", {march, finer_march}, state_swap},
      {"pulls where open", {equilibrium, march, finer_march, tension}, pull},
      {"presses where open", {equilibrium, march, finer_march, complementarity}, press},
      {"sinks in where pressed", {equilibrium, march, finer_march, penetration}, sink},
      {"gapes where pressed", {equilibrium, march, finer_march, complementarity}, lift},
      {"traction where it slips", {equilibrium, march, finer_march, cone}, drag},
      {"traction where open", {equilibrium, march, finer_march, cone}, drag_open},
      {"creeps where it sticks", {equilibrium, march, finer_march, stick}, creep},
      {"an energy", {energy}, miscount},
  };
  return all;
}

void spoil(const Problem& problem, const Claim& claim, const Verdict& verdict, Random& random,
           std::vector<Score>& scores) {
  const double floor = 1e3 * verdict[Check::march].allowed;
  scores.resize(mutations().size());
  for (std::size_t m = 0; m < scores.size(); ++m) {
    const std::optional<Claim> spoiled = mutations()[m].apply(problem, claim, floor, random);
    if (!spoiled) continue;
    const Verdict found = examine(problem, *spoiled);
    for (const Check check : mutations()[m].seen_by) {
      if (check == Check::finer_march && verdict.resolution > kCost * kShare) continue;
      ++scores[m].shown[static_cast<std::size_t>(check)];
      if (found.rejects(check)) ++scores[m].rejected[static_cast<std::size_t>(check)];
    }
  }
}

std::string table(const std::vector<Score>& scores) {
  std::string text = fmt::format("{:<32}", "spoiled by 1 %: rejected / shown");
  for (std::size_t c = 0; c < kChecks; ++c) text += fmt::format("{:>16}", name(static_cast<Check>(c)));
  text += "\n";
  for (std::size_t m = 0; m < scores.size(); ++m) {
    text += fmt::format("{:<32}", mutations()[m].name);
    for (std::size_t c = 0; c < kChecks; ++c) {
      const std::vector<Check>& seen = mutations()[m].seen_by;
      const bool due = std::find(seen.begin(), seen.end(), static_cast<Check>(c)) != seen.end();
      text += fmt::format("{:>16}", due ? fmt::format("{} / {}", scores[m].rejected[c], scores[m].shown[c]) : ".");
    }
    text += "\n";
  }
  return text;
}

}  // namespace dovetail::hard_cases
