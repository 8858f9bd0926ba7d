#include "tests/benchmarks/stages/measurement.hpp"

#include "studies/ready_study/processor_time.hpp"

// The empty statement keeps the call from becoming a jump: counting ends where this function returns.
[[gnu::noinline]] void dovetail_counted(const std::function<void()>& work) {
  work();
  asm volatile("" ::: "memory");
}

namespace dovetail::benchmarks {

std::vector<double> Measurement::seconds(const Work& work) {
  std::vector<double> times;
  for (int repetition = 0; repetition < repetitions_; ++repetition) {
    if (work.prepare) work.prepare();
    const double before = ready_study::processor_seconds();
    dovetail_counted(work.run);
    times.push_back(ready_study::processor_seconds() - before);
    counted_.push_back(work.name);
  }
  return times;
}

void run_aside(const Work& work) {
  if (work.prepare) work.prepare();
  work.run();
}

}  // namespace dovetail::benchmarks
