#include "optimizer/problem/load_case.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

namespace dovetail::optimizer {

namespace {

constexpr char kOf = '@';
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

Barred worst(std::span<const Barred> numbers) {
  Barred result{.value = -std::numeric_limits<double>::infinity(), .bar = 0};
  double least = result.value, most = result.value;
  for (const auto& [value, bar] : numbers) {
    if (std::isnan(value)) return {.value = kNaN, .bar = kNaN};
    result.value = std::max(result.value, value);
    least = std::max(least, value - bar);
    most = std::max(most, value + bar);
    if (std::isnan(bar)) result.bar = bar;
  }
  if (!std::isnan(result.bar)) result.bar = std::max(most - result.value, result.value - least);
  return result;
}

double largest_bar(std::span<const Barred> numbers) {
  double largest = 0;
  for (const auto& [value, bar] : numbers) largest = std::isnan(bar) ? kNaN : std::max(largest, bar);
  return largest;
}

/// Of the numbers with their weights, by linear interpolation between the middles of their shares. A bar of every
/// number moves it by no more than the largest.
Barred quantile(std::span<const LoadCase> cases, std::span<const Barred> numbers, double share) {
  if (std::ranges::any_of(numbers, [](const Barred& number) { return std::isnan(number.value); }))
    return {.value = kNaN, .bar = kNaN};
  std::vector<std::size_t> order(numbers.size());
  std::iota(order.begin(), order.end(), 0U);
  std::ranges::sort(order, {}, [&](std::size_t i) { return numbers[i].value; });
  double all = 0;
  for (const LoadCase& each : cases) all += each.weight;
  double before = 0, last_place = 0, last = numbers[order.front()].value, value = numbers[order.back()].value;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const double weight = cases[order[i]].weight / all, place = before + weight / 2, here = numbers[order[i]].value;
    if (share <= place) {
      value = i == 0 ? here : last + (here - last) * (share - last_place) / (place - last_place);
      break;
    }
    before += weight;
    last_place = place;
    last = here;
  }
  return {.value = value, .bar = largest_bar(numbers)};
}

}  // namespace

std::string of_case(std::string_view response, std::string_view load_case) {
  std::string name(response);
  if (!load_case.empty()) (name += kOf) += load_case;
  return name;
}

CaseResponse split_case(std::string_view name) {
  const std::size_t at = name.find(kOf);
  if (at == name.npos) return {.response = name, .load_case = {}};
  return {.response = name.substr(0, at), .load_case = name.substr(at + 1)};
}

namespace {

Barred by_rule(std::string_view over, std::span<const LoadCase> cases, std::span<const Barred> numbers, double share) {
  const std::optional<Over> rule = named<Over>(over);
  if (!rule) {
    std::vector<Barred> of_case;
    for (std::size_t i = 0; i < cases.size(); ++i)
      if (cases[i].name == over || cases[i].sample_of == over) of_case.push_back(numbers[i]);
    return of_case.empty() ? Barred{.value = kNaN, .bar = kNaN} : worst(of_case);
  }
  if (rule == Over::worst) return worst(numbers);
  if (rule == Over::quantile) return quantile(cases, numbers, share);
  Barred sum{.value = 0, .bar = 0};
  double weights = 0;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    weights += cases[i].weight;
    sum.value += cases[i].weight * numbers[i].value;
    sum.bar += cases[i].weight * numbers[i].bar;
  }
  if (rule == Over::sum) return sum;
  const Barred mean{.value = sum.value / weights, .bar = sum.bar / weights};
  if (rule == Over::mean) return mean;
  double squares = 0;
  for (std::size_t i = 0; i < cases.size(); ++i)
    squares += cases[i].weight / weights * std::pow(numbers[i].value - mean.value, 2);
  // No number moves it by more than its bar.
  return {.value = std::sqrt(squares), .bar = largest_bar(numbers)};
}

}  // namespace

Barred over_cases(std::string_view over, std::span<const LoadCase> cases, std::span<const Barred> numbers,
                  double share) {
  Barred all = by_rule(over, cases, numbers, share);
  std::vector<LoadCase> half;
  std::vector<Barred> of_half;
  double weights = 0, weights_of_half = 0;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    weights += cases[i].weight;
    if (!cases[i].first_half) continue;
    half.push_back(cases[i]);
    of_half.push_back(numbers[i]);
    weights_of_half += cases[i].weight;
  }
  if (half.empty()) return all;
  for (LoadCase& sample : half) sample.weight *= weights / weights_of_half;
  all.bar += std::abs(all.value - by_rule(over, half, of_half, share).value);
  return all;
}

}  // namespace dovetail::optimizer
