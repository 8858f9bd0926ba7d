#include "studies/work_precision/growth.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

namespace dovetail::work_precision {
namespace {

constexpr int kHarmonics = 3, kSamples = 128;

}  // namespace

std::vector<Growth> measure_growth(bool quick, const std::function<void(const std::string&)>& progress) {
  using Sizes = std::vector<int>;
  const double seconds = quick ? 0 : 0.15;
  const Eigen::Index nodes = quick ? 16 : 100, few = quick ? 9 : 25;
  std::vector<Growth> result;
  const auto begin = [&](const std::string& key, const std::string& title, const std::string& fixed) {
    result.push_back({.key = key, .title = title, .fixed = fixed, .size = {}, .times = {}});
    if (progress) progress("Newton step: " + title);
  };
  const auto add = [&](int size, const StepTimes& times) {
    result.back().size.push_back(size);
    result.back().times.push_back(times);
  };
  begin("nodes", "contact nodes", fmt::format("{} harmonics, {} samples", kHarmonics, kSamples));
  for (const int n : quick ? Sizes{9, 16, 25} : Sizes{25, 50, 100, 200})
    add(n, measure_step({.nodes = n}, kHarmonics, kSamples, seconds));
  // All unknowns of 31 harmonics at 100 nodes would be a matrix of 2.9 GB.
  begin("harmonics", "harmonics", fmt::format("{} nodes, {} samples", few, kSamples));
  for (const int h : quick ? Sizes{1, 3, 5} : Sizes{1, 3, 5, 7, 11, 15, 21, 31})
    add(h, measure_step({.nodes = few}, h, kSamples, seconds));
  begin("samples", "samples per period", fmt::format("{} nodes, {} harmonics", nodes, kHarmonics));
  for (const int n : quick ? Sizes{64, 128, 256} : Sizes{64, 128, 256, 512, 1024, 2048, 4096})
    add(n, measure_step({.nodes = nodes}, kHarmonics, n, seconds));
  return result;
}

double exponent(const Growth& growth, double StepTimes::*part) {
  const std::size_t n = growth.size.size();
  if (n < 2 || growth.times[n - 1].status != Status::converged || growth.times[n - 2].status != Status::converged)
    return std::numeric_limits<double>::quiet_NaN();
  return std::log(growth.times[n - 1].*part / (growth.times[n - 2].*part)) /
         std::log(growth.size[n - 1] / growth.size[n - 2]);
}

}  // namespace dovetail::work_precision
