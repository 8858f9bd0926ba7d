// The contact engine on one core: one Newton step of 2100 unknowns beside a dense LU of that size, exact against
// finite-difference Jacobians, and the response of a rod. Medians and a table of ratios at the end.
//   build/tests/benchmarks/engine_benchmark
//   build/tests/benchmarks/engine_benchmark --benchmark_out=engine.json --benchmark_out_format=json
#include <benchmark/benchmark.h>

#include <cstdio>
#include <map>
#include <string>
#include <vector>

#include "numerics/process.hpp"
#include "paths/frequency_response.hpp"
#include "steady/tangent.hpp"
#include "studies/work_precision/newton_step.hpp"
#include "tests/verification/steady/rod.hpp"

namespace dovetail {
namespace {

constexpr int kHarmonics = 3, kSamples = 128;

// 100 nodes of 3 directions of which half stay stuck, or none.
const work_precision::PatchState& patch(bool half_stuck) {
  static const work_precision::PatchState half = work_precision::solve_patch({.held = 0.5}, kHarmonics, kSamples);
  static const work_precision::PatchState none = work_precision::solve_patch({.held = 0}, kHarmonics, kSamples);
  return half_stuck ? half : none;
}

void describe(benchmark::State& state, const work_precision::PatchState& at) {
  if (!at.converged()) {
    state.SkipWithError("the steady state did not converge");
    return;
  }
  state.SetLabel(std::to_string(at.problem()->unknowns()) + " unknowns; nodes stuck/slipping/lifting " +
                 std::to_string(at.stuck) + "/" + std::to_string(at.slipping) + "/" + std::to_string(at.separating));
}

void evaluate_with_derivative(const work_precision::PatchState& at, steady::Point& point) {
  steady::evaluate(at.problem(), at.state.displacement, point);
  steady::differentiate(point);
}

void residual(benchmark::State& state) {
  const work_precision::PatchState& at = patch(state.range(0) != 0);
  const bool derivative = state.range(1) != 0;
  steady::Point point;
  for (auto _ : state) {
    steady::evaluate(at.problem(), at.state.displacement, point);
    if (derivative) steady::differentiate(point);
  }
  describe(state, at);
}

// `fresh`: into memory asked of the system each time, which hands over 35 MB page by page.
void residual_and_dense_jacobian(benchmark::State& state) {
  const work_precision::PatchState& at = patch(state.range(0) != 0);
  const bool fresh = state.range(1) != 0;
  steady::Point point;
  Eigen::MatrixXd kept(at.problem()->unknowns(), at.problem()->unknowns());
  std::vector<double*> columns;
  std::vector<Eigen::Index> rows;
  for (Eigen::Index j = 0; j < kept.cols(); ++j) {
    rows.push_back(j);
    columns.push_back(kept.col(j).data());
  }
  for (auto _ : state) {
    evaluate_with_derivative(at, point);
    if (fresh) {
      const Eigen::MatrixXd jacobian = steady::jacobian(point);
      benchmark::DoNotOptimize(jacobian.data());
    } else {
      steady::assemble(steady::blocks(point), rows, columns, 0);
      benchmark::ClobberMemory();
    }
  }
  describe(state, at);
}

void full_lu(benchmark::State& state) {
  const work_precision::PatchState& at = patch(state.range(0) != 0);
  steady::Point point;
  evaluate_with_derivative(at, point);
  const Eigen::MatrixXd jacobian = steady::jacobian(point);
  for (auto _ : state) {
    state.PauseTiming();
    Eigen::MatrixXd copy = jacobian;
    state.ResumeTiming();
    const numerics::DenseLu lu(std::move(copy));
  }
  describe(state, at);
}

void newton_step(benchmark::State& state) {
  const work_precision::PatchState& at = patch(state.range(0) != 0);
  const auto point = std::make_shared<steady::Point>();
  Eigen::Index factorised = 0;
  for (auto _ : state) {
    evaluate_with_derivative(at, *point);
    const steady::Tangent linear(point);
    const Eigen::MatrixXd step = linear.solve(point->residual.reshaped());
    benchmark::DoNotOptimize(step.data());
    factorised = linear.factors().size();
  }
  describe(state, at);
  state.counters["factorised"] = static_cast<double>(factorised);
}

// One column of a finite-difference Jacobian: a residual at a point moved in one unknown. A whole one costs as many
// as there are unknowns, and one more.
void finite_difference_column(benchmark::State& state) {
  const work_precision::PatchState& at = patch(state.range(0) != 0);
  steady::Point point;
  steady::evaluate(at.problem(), at.state.displacement, point);
  const Eigen::MatrixXd base = point.residual;
  Eigen::MatrixXd moved = at.state.displacement, column;
  const double step = 1e-8 * moved.norm();
  Eigen::Index unknown = 0;
  for (auto _ : state) {
    double& x = moved.reshaped()(unknown);
    const double before = x;
    x += step;
    steady::evaluate(at.problem(), moved, point);
    column = (point.residual - base) / step;
    x = before;
    unknown = (unknown + 37) % moved.size();  // of all harmonics and nodes
  }
  describe(state, at);
}

// The 61 points w = 1 : 0.05 : 4, each from its neighbour, the model condensed anew.
void rod_response(benchmark::State& state) {
  const reduction::ReducedModel model = verification::rod(static_cast<int>(state.range(0)));
  std::vector<double> omega;
  for (int i = 0; i <= 60; ++i) omega.push_back(1 + 0.05 * i);
  std::vector<steady::State> curve;
  for (auto _ : state) curve = paths::frequency_response({verification::condensed(model), {}, {.harmonics = 3}}, omega);
  std::size_t converged = 0;
  int jacobians = 0;
  for (const steady::State& point : curve) {
    converged += point.status == Status::converged;
    jacobians += point.iterations;
  }
  if (converged != omega.size()) state.SkipWithError("points did not converge");
  state.counters["converged"] = static_cast<double>(converged);
  state.counters["jacobians"] = jacobians;
  state.counters["tip_w2.5"] = curve[30].outputs.row(0).segment(1, 2).norm();
  state.counters["tip3_w2.5"] = curve[30].outputs.row(0).segment(5, 2).norm();
}

BENCHMARK(residual)->ArgsProduct({{1, 0}, {0, 1}})->ArgNames({"half_stuck", "derivative"});
BENCHMARK(residual_and_dense_jacobian)->ArgsProduct({{1, 0}, {0, 1}})->ArgNames({"half_stuck", "fresh"});
BENCHMARK(full_lu)->Arg(1)->Arg(0)->ArgName("half_stuck");
BENCHMARK(newton_step)->Arg(1)->Arg(0)->ArgName("half_stuck");
BENCHMARK(finite_difference_column)->Arg(1)->Arg(0)->ArgName("half_stuck");
BENCHMARK(rod_response)->Arg(10)->Arg(50)->ArgName("nodes");

// Keeps the medians beside printing them.
class Medians : public benchmark::ConsoleReporter {
 public:
  void ReportRuns(const std::vector<Run>& runs) override {
    ConsoleReporter::ReportRuns(runs);
    for (const Run& run : runs)
      if (run.aggregate_name == "median" && !run.error_occurred)
        seconds_[run.run_name.function_name + "/" + run.run_name.args] =
            run.GetAdjustedCPUTime() / benchmark::GetTimeUnitMultiplier(run.time_unit);
  }
  // 0 when it was filtered out or failed.
  [[nodiscard]] double operator()(const std::string& name) const {
    const auto found = seconds_.find(name);
    return found == seconds_.end() ? 0 : found->second;
  }

 private:
  std::map<std::string, double> seconds_;
};

void row(const char* what, double value, const char* unit, const char* aim) {
  if (value > 0) std::printf("%-64s %10.4g %-7s %s\n", what, value, unit, aim);
}

void table(const Medians& median) {
  std::printf("\nMedian processor times and their ratios, 100 nodes x 3 directions, H = 3, N = 128:\n");
  for (const std::string half : {"half_stuck:1", "half_stuck:0"}) {
    std::printf("%s\n", half == "half_stuck:1" ? "half of the nodes stuck" : "no node stuck");
    const double lu = median("full_lu/" + half);
    if (!(lu > 0)) continue;
    const double exact = median("residual/" + half + "/derivative:1");
    const double dense = median("residual_and_dense_jacobian/" + half + "/fresh:0");
    const double fresh = median("residual_and_dense_jacobian/" + half + "/fresh:1");
    const double differences = 2101 * median("finite_difference_column/" + half);
    row("  residual", 1e3 * median("residual/" + half + "/derivative:0"), "ms", "");
    row("  residual and derivative in nodal blocks", 1e3 * exact, "ms", "(aim < 5)");
    row("  the same with the dense Jacobian assembled / full LU", 100 * dense / lu, "%", "(aim < 15)");
    row("  the same into fresh memory / full LU", 100 * fresh / lu, "%", "");
    row("  Newton step, condensed / full LU", 100 * median("newton_step/" + half) / lu, "%",
        half == "half_stuck:1" ? "(aim < 50)" : "");
    row("  full LU", 1e3 * lu, "ms", "");
    row("  finite-difference / exact Jacobian, nodal blocks", exact > 0 ? differences / exact : 0, "times",
        "(aim > 100)");
    row("  finite-difference / exact Jacobian, dense", dense > 0 ? differences / dense : 0, "times", "(aim > 100)");
  }
  std::printf("rod, 61 frequencies\n");
  const double ten = median("rod_response/nodes:10"), fifty = median("rod_response/nodes:50");
  row("  10 nodes", 1e3 * ten, "ms", "");
  row("  10 nodes, public codes need 3.8 s: faster by", ten > 0 ? 3.8 / ten : 0, "times", "(aim 100)");
  row("  50 nodes", 1e3 * fifty, "ms", "");
  row("  50 nodes, public code needs 21.9 s: faster by", fifty > 0 ? 21.9 / fifty : 0, "times", "(aim 100)");
}

}  // namespace
}  // namespace dovetail

int main(int argc, char** argv) {
  dovetail::numerics::prepare_process(argv);
  // Interleaving lets the figures that are compared meet the same state of the machine.
  std::vector<std::string> defaults{"--benchmark_repetitions=7", "--benchmark_report_aggregates_only=true",
                                    "--benchmark_enable_random_interleaving=true", "--benchmark_min_time=0.2"};
  std::vector<char*> arguments{argv[0]};
  for (std::string& argument : defaults) arguments.push_back(argument.data());
  for (int i = 1; i < argc; ++i) arguments.push_back(argv[i]);
  int count = static_cast<int>(arguments.size());
  benchmark::Initialize(&count, arguments.data());
  if (benchmark::ReportUnrecognizedArguments(count, arguments.data())) return 1;
  dovetail::Medians median;
  benchmark::RunSpecifiedBenchmarks(&median);
  dovetail::table(median);
  return 0;
}
