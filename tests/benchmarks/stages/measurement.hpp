#pragma once

#include <functional>
#include <string>
#include <vector>

/// Runs `work`. Tools that count instructions look for this name:
///   valgrind --tool=callgrind --toggle-collect=dovetail_counted --dump-after=dovetail_counted
extern "C" void dovetail_counted(const std::function<void()>& work);

namespace dovetail::benchmarks {

/// What is measured: a stage of an evaluation, or a kernel that its limit is made of.
struct Work {
  std::string name;
  std::function<void()> run;
  std::function<void()> prepare = {};  ///< before each run, not measured; may be empty
};

/// Runs works through dovetail_counted and takes their processor times.
class Measurement {
 public:
  explicit Measurement(int repetitions) : repetitions_(repetitions) {}

  /// Seconds of each repetition.
  std::vector<double> seconds(const Work& work);
  /// Names of what went through dovetail_counted, in order.
  [[nodiscard]] const std::vector<std::string>& counted() const { return counted_; }

 private:
  int repetitions_;
  std::vector<std::string> counted_;
};

/// Runs a work without measuring it.
void run_aside(const Work& work);

}  // namespace dovetail::benchmarks
