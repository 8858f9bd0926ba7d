#include <algorithm>
#include <cmath>
#include <unsupported/Eigen/MatrixFunctions>

#include "numerics/dense_lu.hpp"
#include "stability/params.hpp"
#include "stability/perturbation.hpp"

namespace dovetail::stability {
namespace {

// What a node does now. `touching`: it closes just now, d lambda_T = ratio d lambda_N.
enum class Now { open, stuck, slipping, touching };

struct NodeState {
  Now now = Now::open;
  Eigen::Vector2d ratio = {0, 0};
  double sign = 1;
};

// The static dofs that move freely, the rows they obey, and how the slip memory moves the others.
struct Columns {
  std::vector<Eigen::VectorXd> shape, test;
  Eigen::MatrixXd memory;  // [ns, nw]
};

// u = on_dynamic q + on_memory w.
struct StaticShape {
  Eigen::MatrixXd on_dynamic, on_memory;
};

class Propagator {
 public:
  Propagator(const PerturbedStructure& structure, int samples)
      : s_(structure),
        samples_(samples),
        dynamic_(structure.dynamic.rows()),
        statics_(structure.stiffness.rows()),
        size_(2 * dynamic_ + structure.memory) {
    // Velocities and memory are scaled so that the system matrix has entries of one size.
    rate_ = std::sqrt(std::max(s_.dynamic.cwiseAbs().maxCoeff(), 1.0));
    const double across = s_.coupling.size() > 0 ? s_.coupling.cwiseAbs().maxCoeff() : 0;
    if (across > 0) unit_ = rate_ * rate_ * s_.omega * s_.omega / across;
    for (const SwitchingNode& node : s_.nodes) {
      const SampleState mode = node.timeline->start_mode();
      states_.push_back({.now = after(mode), .sign = node.timeline->start_sign()});
    }
  }

  Monodromy run() {
    struct Entry {
      ContactEvent event;
      std::size_t node;
    };
    std::vector<Entry> entries;
    for (std::size_t i = 0; i < s_.nodes.size(); ++i)
      for (const ContactEvent& event : s_.nodes[i].timeline->events()) entries.push_back({event, i});
    std::stable_sort(entries.begin(), entries.end(),
                     [](const Entry& a, const Entry& b) { return a.event.tau < b.event.tau; });
    map_ = Eigen::MatrixXd::Identity(size_, size_);
    for (std::size_t i = 0; i < s_.nodes.size(); ++i) forget(i);
    double now = 0;
    for (const Entry& entry : entries) {
      advance(now, entry.event.tau);
      change(entry.node, entry.event);
      now = entry.event.tau;
      if (!failure_.empty()) break;
    }
    advance(now, kPeriod);
    return {.map = std::move(map_), .failure = failure_};
  }

 private:
  // Memory a node has no use for at tau = 0 must not survive as a multiplier.
  void forget(std::size_t i) {
    const SwitchingNode& node = s_.nodes[i];
    if (node.memory < 0 || states_[i].now == Now::stuck) return;
    const Eigen::Index kept = turning(i) ? 1 : 0, directions = static_cast<Eigen::Index>(node.tangential.size());
    map_.middleRows(2 * dynamic_ + node.memory + kept, directions - kept).setZero();
  }

  static Now after(SampleState mode) {
    return mode == SampleState::separated ? Now::open : mode == SampleState::stuck ? Now::stuck : Now::slipping;
  }
  [[nodiscard]] bool in_space(std::size_t i) const { return s_.nodes[i].tangential.size() == 2; }
  [[nodiscard]] bool turning(std::size_t i) const { return states_[i].now == Now::slipping && in_space(i); }

  void advance(double from, double to) {
    if (!failure_.empty() || !(to > from)) return;
    bool turns = false;
    for (std::size_t i = 0; i < states_.size(); ++i) turns = turns || turning(i);
    if (!turns) return step(from, to);
    const double width = kPeriod / samples_;
    while (to - from > StabilityParams{}.step * width && failure_.empty()) {
      const double next = std::min(to, width * (std::floor(from / width + StabilityParams{}.step) + 1));
      step(from, next);
      from = next;
    }
  }

  void step(double from, double to) {
    const double middle = (from + to) / 2;
    const StaticShape shape = condense(middle);
    if (!failure_.empty()) return;
    Eigen::MatrixXd system = Eigen::MatrixXd::Zero(size_, size_);
    const double back = 1 / (s_.omega * s_.omega * rate_);
    system.block(0, dynamic_, dynamic_, dynamic_).diagonal().setConstant(rate_);
    system.block(dynamic_, 0, dynamic_, dynamic_) =
        -s_.dynamic / rate_ - back * s_.coupling.transpose() * shape.on_dynamic;
    system.block(dynamic_, dynamic_, dynamic_, dynamic_) = -s_.damping;
    system.block(dynamic_, 2 * dynamic_, dynamic_, s_.memory) =
        -back * unit_ * s_.coupling.transpose() * shape.on_memory;
    for (std::size_t i = 0; i < states_.size(); ++i)
      if (turning(i)) turn(s_.nodes[i], middle, shape, system);
    const Eigen::MatrixXd growth = (system * (to - from)).exp();
    map_ = growth * map_;
  }

  // The slip normal to the direction: n.dX' = |X'| dtheta - theta' v.dX with dtheta = n.d lambda_T / limit.
  void turn(const SwitchingNode& node, double tau, const StaticShape& shape, Eigen::MatrixXd& system) const {
    const SlipFrame frame = node.timeline->frame(tau);
    const Eigen::Vector2d normal(-frame.along(1), frame.along(0));
    const double compliance = frame.speed / std::max(frame.limit, 1e-300);
    Eigen::RowVectorXd on_dynamic = Eigen::RowVectorXd::Zero(dynamic_), on_memory = Eigen::RowVectorXd::Zero(s_.memory);
    for (int r = 0; r < 2; ++r) {
      const Eigen::Index row = node.tangential[static_cast<std::size_t>(r)];
      on_dynamic -= compliance * normal(r) * (s_.stiffness.row(row) * shape.on_dynamic + s_.coupling.row(row));
      on_memory -= compliance * normal(r) * (s_.stiffness.row(row) * shape.on_memory);
      on_dynamic -= frame.turning * frame.along(r) * shape.on_dynamic.row(row);
      on_memory -= frame.turning * frame.along(r) * shape.on_memory.row(row);
    }
    system.row(2 * dynamic_ + node.memory).head(dynamic_) = on_dynamic / unit_;
    system.row(2 * dynamic_ + node.memory).tail(s_.memory) = on_memory;
  }

  [[nodiscard]] Columns columns(double tau) const {
    Columns found{.shape = {}, .test = {}, .memory = Eigen::MatrixXd::Zero(statics_, s_.memory)};
    const auto add = [&](Eigen::VectorXd shape, Eigen::VectorXd test) {
      found.shape.push_back(std::move(shape));
      found.test.push_back(std::move(test));
    };
    const auto unit = [&](Eigen::Index dof) -> Eigen::VectorXd { return Eigen::VectorXd::Unit(statics_, dof); };
    for (const Eigen::Index dof : s_.free_static) add(unit(dof), unit(dof));
    for (std::size_t i = 0; i < states_.size(); ++i) {
      const SwitchingNode& node = s_.nodes[i];
      const NodeState& state = states_[i];
      const double friction = node.timeline->limit_at(tau).by_normal;
      if (state.now == Now::open) add(unit(node.normal), unit(node.normal));
      for (std::size_t r = 0; r < node.tangential.size(); ++r) {
        const Eigen::Index dof = node.tangential[r];
        if (state.now == Now::open)
          add(unit(dof), unit(dof));
        else if (state.now == Now::touching)
          add(unit(dof), unit(dof) - state.ratio(static_cast<Eigen::Index>(r)) * unit(node.normal));
        else if (state.now == Now::stuck && node.memory >= 0)
          found.memory(dof, node.memory + static_cast<Eigen::Index>(r)) = 1;
        else if (state.now == Now::slipping && !in_space(i))
          add(unit(dof), unit(dof) - state.sign * friction * unit(node.normal));
      }
      if (!turning(i)) continue;
      const Eigen::Vector2d along = node.timeline->frame(tau).along;
      const Eigen::VectorXd slip = along(0) * unit(node.tangential[0]) + along(1) * unit(node.tangential[1]);
      add(slip, slip - friction * unit(node.normal));
      found.memory(node.tangential[0], node.memory) = -along(1);
      found.memory(node.tangential[1], node.memory) = along(0);
    }
    return found;
  }

  [[nodiscard]] StaticShape condense(double tau) {
    const Columns at = columns(tau);
    const auto count = static_cast<Eigen::Index>(at.shape.size());
    StaticShape result{.on_dynamic = Eigen::MatrixXd::Zero(statics_, dynamic_), .on_memory = at.memory};
    if (count == 0) return result;
    Eigen::MatrixXd shape(statics_, count), test(statics_, count);
    for (Eigen::Index j = 0; j < count; ++j) {
      shape.col(j) = at.shape[static_cast<std::size_t>(j)];
      test.col(j) = at.test[static_cast<std::size_t>(j)];
    }
    const Eigen::MatrixXd loaded = test.transpose() * s_.stiffness;
    const numerics::DenseLu lu(loaded * shape);
    if (!(lu.reciprocal_condition() > StabilityParams{}.regular)) {
      failure_ = "contact dofs without mass are held by nothing, or wedged by friction, in one of the phases";
      return result;
    }
    result.on_dynamic = -shape * lu.solve(test.transpose() * s_.coupling);
    result.on_memory -= shape * lu.solve(loaded * at.memory);
    return result;
  }

  // Tangential displacements of a node now, as rows of the map.
  Eigen::MatrixXd displacement(const SwitchingNode& node, double tau) {
    const StaticShape shape = condense(tau);
    Eigen::MatrixXd rows(static_cast<Eigen::Index>(node.tangential.size()), size_);
    for (std::size_t r = 0; r < node.tangential.size(); ++r)
      rows.row(static_cast<Eigen::Index>(r)) =
          shape.on_dynamic.row(node.tangential[r]) * map_.topRows(dynamic_) +
          unit_ * shape.on_memory.row(node.tangential[r]) * map_.bottomRows(s_.memory);
    return rows;
  }

  void change(std::size_t i, const ContactEvent& event) {
    if (!failure_.empty()) return;
    const SwitchingNode& node = s_.nodes[i];
    NodeState& state = states_[i];
    const auto directions = static_cast<Eigen::Index>(node.tangential.size());
    Eigen::MatrixXd memory = Eigen::MatrixXd::Zero(directions, size_);
    if (node.memory >= 0 && event.mode != SampleState::separated) {
      if (event.closing) {
        state.now = Now::touching;
        state.ratio = event.ratio;
      }
      if (event.closing || state.now == Now::slipping)
        memory = displacement(node, event.tau);
      else
        memory = unit_ * map_.middleRows(2 * dynamic_ + node.memory, directions);
    }
    state.now = after(event.mode);
    state.sign = event.sign;
    if (node.memory < 0) return;
    if (state.now == Now::slipping) {
      // Along the slip the displacement follows statically from now on.
      if (in_space(i)) {
        const Eigen::Vector2d along = event.closing && event.ratio.norm() > 0
                                          ? Eigen::Vector2d(event.ratio.normalized())
                                          : node.timeline->frame(event.tau).along;
        memory.row(0) = Eigen::RowVectorXd(along(0) * memory.row(1) - along(1) * memory.row(0));
        memory.row(1).setZero();
      } else {
        memory.setZero();
      }
    }
    map_.middleRows(2 * dynamic_ + node.memory, directions) = memory / unit_;
  }

  const PerturbedStructure& s_;
  int samples_;
  Eigen::Index dynamic_, statics_, size_;
  double rate_ = 1, unit_ = 1;  // of velocities and of memory
  std::vector<NodeState> states_;
  Eigen::MatrixXd map_;
  std::string failure_;
};

}  // namespace

Monodromy monodromy(const PerturbedStructure& structure, int samples) {
  return Propagator(structure, samples).run();
}

}  // namespace dovetail::stability
