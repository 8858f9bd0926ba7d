#include "wear/asymptote/spread.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "core/errors.hpp"
#include "dynamics/condensed_model.hpp"
#include "tractions/traction_family.hpp"

namespace dovetail {

template <>
std::span<const Field<wear::SpreadOptions>> option_table<wear::SpreadOptions>() {
  using O = wear::SpreadOptions;
  constexpr Range kShare{.lower = 0, .upper = 1, .upper_open = true};
  static const std::vector<Field<O>> fields{
      {.key = "friction", .member = &O::friction, .range = kShare},
      {.key = "load", .member = &O::load, .range = kShare},
      {.key = "wear_coefficient", .member = &O::wear_coefficient, .range = kShare},
      {.key = "tractions", .member = &O::tractions},
      {.key = "combined", .member = &O::combined},
  };
  return fields;
}

}  // namespace dovetail

namespace dovetail::wear {

namespace {

using dynamics::CondensedModel;

/// A changed problem.
struct Change {
  std::string name;
  double friction = 1, load = 1, wear_coefficient = 1;
  Eigen::MatrixXd slip_origin = {};  ///< empty: as it was
};

std::string factor(double value) {
  return "x " + shortest(std::round(value * 1e12) / 1e12);
}

/// Two sets of nodes: the flanks by turns, or the halves of a single one along its longer extent.
std::vector<bool> second_side(const reduction::ContactNodes& contact) {
  const Eigen::Index count = contact.count();
  std::vector<bool> second(static_cast<std::size_t>(count), false);
  const bool several = contact.group.size() == count && (contact.group.array() != contact.group(0)).any();
  Eigen::VectorXd along = Eigen::VectorXd::LinSpaced(count, 0, 1);
  if (several) {
    along = contact.group.cast<double>();
    const Eigen::VectorXd turns = along.unaryExpr([](double group) { return std::fmod(std::abs(group), 2.0); });
    if (turns.minCoeff() < turns.maxCoeff()) along = turns;
  } else if (contact.position.rows() == count) {
    const Eigen::RowVector3d extent = contact.position.colwise().maxCoeff() - contact.position.colwise().minCoeff();
    Eigen::Index axis = 0;
    if (extent.maxCoeff(&axis) > 0) along = contact.position.col(axis);
  }
  const double middle = (along.minCoeff() + along.maxCoeff()) / 2;
  for (Eigen::Index i = 0; i < count; ++i) second[static_cast<std::size_t>(i)] = along(i) > middle;
  return second;
}

/// Corners of |m| <= 1 of the stuck nodes.
std::vector<Change> corners(const CondensedModel& model, const steady::State& unworn) {
  std::vector<Change> result;
  const tractions::TractionFamily family(unworn);
  const Eigen::Index directions = model.directions() - 1;
  if (family.nodes().empty() || directions < 1) return result;
  const std::vector<bool> second = second_side(model.contact());
  constexpr std::array kSigns{std::pair{1.0, 1.0}, std::pair{-1.0, -1.0}, std::pair{1.0, -1.0}, std::pair{-1.0, 1.0}};
  const auto sign = [](double value) { return value > 0 ? "+" : "-"; };
  for (Eigen::Index direction = 0; direction < directions; ++direction)
    for (const auto& [first_sign, second_sign] : kSigns) {
      Eigen::MatrixXd traction = family.nominal();
      for (std::size_t k = 0; k < family.nodes().size(); ++k) {
        const auto row = static_cast<Eigen::Index>(k);
        traction.row(row).setZero();
        traction(row, direction) = second[static_cast<std::size_t>(family.nodes()[k])] ? second_sign : first_sign;
      }
      std::string name = std::string("first side ") + sign(first_sign) + ", second side " + sign(second_sign);
      if (directions > 1) name += ", direction " + std::to_string(direction + 1);
      result.push_back({.name = std::move(name),
                        .slip_origin = family.slip_origin(tractions::TractionFamily::admissible(traction))});
    }
  return result;
}

class Members {
 public:
  Members(const steady::Joint& joint, const WornComputation& compute, Spread& spread)
      : joint_(joint), compute_(compute), spread_(spread) {}

  void add(const std::string& source, const Change& change) {
    const auto changed = std::make_shared<CondensedModel>(*joint_.model);
    if (change.friction != 1) changed->set_friction(change.friction * joint_.model->contact().friction);
    if (change.load != 1) changed->scale_excitation(change.load);
    if (change.wear_coefficient != 1)
      changed->set_wear_coefficient(change.wear_coefficient * joint_.model->contact().wear_coefficient);
    steady::Joint joint = joint_;
    joint.model = changed;
    if (change.slip_origin.size() > 0) joint.condition.slip_origin = change.slip_origin;
    SpreadMember member{.source = source, .change = change.name, .end = compute_(joint)};
    spread_.solves += member.end.solves;
    spread_.members.push_back(std::move(member));
  }

  /// The changes of one source; returns those with the least and the most wear, the unchanged problem among them.
  std::pair<Change, Change> add_all(const std::string& source, const std::vector<Change>& changes) {
    Change least, most;
    double lowest = spread_.nominal.volume, highest = lowest;
    for (const Change& change : changes) {
      add(source, change);
      const WornEnd& end = spread_.members.back().end;
      if (end.verdict != Verdict::asymptote) continue;
      if (end.volume < lowest) lowest = end.volume, least = change;
      if (end.volume > highest) highest = end.volume, most = change;
    }
    return {least, most};
  }

 private:
  const steady::Joint& joint_;
  const WornComputation& compute_;
  Spread& spread_;
};

/// Over the members of one source, or of all.
SpreadRange range_of(const Spread& spread, const std::string& source, bool all) {
  const WornEnd& nominal = spread.nominal;
  SpreadRange range{.source = source, .verdict = nominal.verdict};
  range.lowest_volume = range.highest_volume = nominal.volume;
  range.lowest_depth = range.highest_depth = nominal.largest_depth();
  bool wearing = nominal.verdict == Verdict::no_asymptote;
  for (const SpreadMember& member : spread.members) {
    if (!all && member.source != source) continue;
    ++range.members;
    const WornEnd& end = member.end;
    if (end.verdict == Verdict::not_converged) ++range.failed;
    if (end.verdict == Verdict::no_asymptote) wearing = true;
    if (end.verdict != Verdict::asymptote) continue;
    range.lowest_volume = std::min(range.lowest_volume, end.volume);
    range.highest_volume = std::max(range.highest_volume, end.volume);
    range.lowest_depth = std::min(range.lowest_depth, end.largest_depth());
    range.highest_depth = std::max(range.highest_depth, end.largest_depth());
    if (nominal.largest_depth() > 0)
      range.profile_change =
          std::max(range.profile_change, (end.depth - nominal.depth).cwiseAbs().maxCoeff() / nominal.largest_depth());
  }
  if (range.failed > 0 || nominal.verdict == Verdict::not_converged)
    range.verdict = Verdict::not_converged;
  else if (wearing)
    range.verdict = Verdict::no_asymptote;
  return range;
}

}  // namespace

Spread spread(const steady::Joint& joint, const WornEnd& nominal, const WornComputation& compute,
              const steady::State* unworn, const SpreadOptions& options) {
  if (std::vector<Violation> found = violations(options, "spread"); !found.empty()) throw InputError(std::move(found));
  Spread result;
  result.nominal = nominal;
  Members members(joint, compute, result);
  std::vector<std::string> sources;
  std::vector<std::pair<Change, Change>> extremes;
  const auto vary = [&](const std::string& source, const std::vector<Change>& changes) {
    if (changes.empty()) return;
    sources.push_back(source);
    extremes.push_back(members.add_all(source, changes));
  };
  const auto both = [&](const std::string& source, double share, double Change::*member) {
    if (share == 0) return;
    std::vector<Change> changes(2);
    changes[0].*member = 1 - share;
    changes[1].*member = 1 + share;
    for (Change& change : changes) change.name = factor(change.*member);
    vary(source, changes);
  };
  constexpr const char* kWearCoefficient = "wear_coefficient";
  both(kWearCoefficient, options.wear_coefficient, &Change::wear_coefficient);
  both("friction", options.friction, &Change::friction);
  both("load", options.load, &Change::load);
  if (options.tractions && unworn && unworn->tangent) vary("residual_tractions", corners(*joint.model, *unworn));

  constexpr const char* kCombined = "combined";
  if (options.combined && sources.size() > 1)
    for (const bool more : {false, true}) {
      Change all;
      for (std::size_t i = 0; i < sources.size(); ++i) {
        const Change& one = more ? extremes[i].second : extremes[i].first;
        if (one.name.empty() || sources[i] == kWearCoefficient) continue;  // where wear ends does not depend on k_w
        all.friction *= one.friction;
        all.load *= one.load;
        if (one.slip_origin.size() > 0) all.slip_origin = one.slip_origin;
        all.name += (all.name.empty() ? "" : "; ") + sources[i] + " " + one.name;
      }
      if (!all.name.empty()) members.add(kCombined, all);
    }
  for (const std::string& source : sources) result.ranges.push_back(range_of(result, source, false));
  if (options.combined) result.ranges.push_back(range_of(result, kCombined, true));
  return result;
}

}  // namespace dovetail::wear
