#include "tests/benchmarks/stages/chain.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "optimizer/scene/scene_kind.hpp"
#include "steady/point.hpp"

namespace dovetail::benchmarks {

namespace {

optimizer::Scene previous_of(const BenchmarkScene& of, optimizer::Scene scene) {
  of.make_previous(scene);
  return scene;
}

/// Unknowns of the Jacobian at the unworn resonance that are factorised: many nodes stick or are open.
Eigen::Index active_size(const Chain& chain) {
  return std::max<Eigen::Index>(chain.unworn->state.tangent->factors().size(), 2);
}

/// All nodes marched for a period with derivative, at the unworn resonance. The product with the dynamic stiffness is
/// part of it.
Kernel march_kernel(const Chain& chain) {
  const steady::State& state = chain.unworn->state;
  const std::shared_ptr<const steady::Problem> problem = state.tangent->point().problem;
  const auto march = [problem, displacement = state.displacement] {
    steady::Point point;
    steady::evaluate(problem, displacement, point);
    steady::differentiate(point);
  };
  const double before = problem->budget()->used();
  march();
  return {.work = {.name = kMarch, .run = march},
          .units = problem->budget()->used() - before,
          .words = fmt::format("marches of {} nodes with derivative", chain.fitted.cells.count())};
}

}  // namespace

Chain::Chain(const BenchmarkScene& of)
    : scene(of.design()), previous(previous_of(of, scene)), mesher(previous.kind->mesher(previous)) {}

double Chain::trace_size() const {
  return static_cast<double>(matrices->matrices()->system.contact_size());
}

double Chain::contact_size() const {
  return static_cast<double>(candidate.cells.count() * matrices->matrices()->system.full.dimensions);
}

std::vector<Kernel> kernels(const Chain& chain) {
  const double lift = KernelParams{}.lift * chain.scene.loading.speed * chain.scene.loading.speed;
  const optimizer::Matrices& matrices = *chain.candidate.matrices.shared;
  Eigen::SparseMatrix<double> free =
      fem::constrain(matrices.stiffness, matrices.system.constraints) + lift * matrices.system.mass;
  const reduction::FullModel full =
      chain.matrices->full_model(std::move(free), Eigen::SparseMatrix<double>(matrices.system.mass));
  std::vector<Kernel> result = sparse_kernels(full.stiffness, full.contact_size());
  result.push_back(dense_lu_kernel(active_size(chain)));
  result.push_back(dense_inverse_kernel(matrices.system.contact_size()));
  result.push_back(march_kernel(chain));
  result.push_back(traffic_kernel());
  return result;
}

void require(bool done, std::string_view stage, std::string_view status) {
  if (!done) throw std::runtime_error(std::string(stage) + ": " + std::string(status));
}

}  // namespace dovetail::benchmarks
