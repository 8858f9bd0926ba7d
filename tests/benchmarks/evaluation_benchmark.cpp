// Evaluations of the quickstart scene on one core, with bars and as in a search: time, time by stage, peak memory.
//   build/tests/benchmarks/evaluation_benchmark
#include <benchmark/benchmark.h>
#include <sys/resource.h>

#include <map>
#include <string>

#include "optimizer/evaluator.hpp"
#include "optimizer/search/random_stream.hpp"
#include "studies/program/study_file/study.hpp"

namespace dovetail {
namespace {

double peak_memory_gib() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / (1024.0 * 1024.0);
}

/// Designs spread over the study's box, the same in every run; state.range(0) selects one. 0 is the start.
void evaluate_design(benchmark::State& state, const optimizer::Purpose& purpose) {
  static const studies::Study study = studies::load_study(QUICKSTART);
  static const optimizer::SceneEvaluator evaluator(study.scene);
  const optimizer::DesignSpace& space = study.problem.space;
  optimizer::Scene scene = study.scene;
  optimizer::RandomStream random(static_cast<std::uint64_t>(state.range(0)));
  if (state.range(0) > 0)
    for (const optimizer::DesignVariable& variable : space.variables())
      optimizer::set_parameter(scene, variable.key,
                               variable.lower + random.uniform() * (variable.upper - variable.lower));

  std::map<std::string, double> seconds;
  std::string status;
  for (auto _ : state) {
    const optimizer::Evaluation evaluation = evaluator.evaluate(scene, purpose).evaluation;
    for (const auto& [stage, time] : evaluation.timings_s) seconds[stage] += time;
    status = evaluation.status;
  }
  for (const auto& [stage, time] : seconds)
    state.counters[stage] = benchmark::Counter(time, benchmark::Counter::kAvgIterations);
  state.counters["peak_GiB"] = peak_memory_gib();
  state.SetLabel(status);
}

void with_bars(benchmark::State& state) {
  evaluate_design(state, {});
}
void in_a_search(benchmark::State& state) {
  evaluate_design(state, optimizer::kSearch);
}

BENCHMARK(with_bars)->DenseRange(0, 10)->Iterations(3)->Unit(benchmark::kMillisecond);
BENCHMARK(in_a_search)->DenseRange(0, 10)->Iterations(3)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace dovetail

BENCHMARK_MAIN();
