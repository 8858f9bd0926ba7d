#pragma once

#include <algorithm>
#include <ctime>
#include <utility>
#include <vector>

namespace dovetail::ready_study {

/// Processor time of this thread, s: other programs on the machine do not count.
inline double processor_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// The middle one of `values`, not empty; the larger of two.
inline double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Median processor time of `function`, repeated until `seconds` have passed and `least` times at least. s
template <class Function>
double median_seconds(Function&& function, double seconds, int least = 3) {
  std::vector<double> times;
  const double start = processor_seconds();
  while (static_cast<int>(times.size()) < least || processor_seconds() - start < seconds) {
    const double before = processor_seconds();
    function();
    times.push_back(processor_seconds() - before);
  }
  return median(std::move(times));
}

}  // namespace dovetail::ready_study
