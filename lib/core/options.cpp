#include "core/options.hpp"

#include <algorithm>
#include <charconv>
#include <numeric>

namespace dovetail {

Range Range::interval() const {
  Range alone = *this;
  alone.zero = {};
  return alone;
}

bool Range::contains(double value) const {
  if (!std::isfinite(value)) return false;
  if (is_zero_apart(value)) return true;
  if (lower_open ? value <= lower : value < lower) return false;
  return !(upper_open ? value >= upper : value > upper);
}

bool Range::contains_rounded(double value) const {
  if (contains(value)) return true;
  if (!std::isfinite(value)) return false;
  // A product and a quotient, each rounded to half a unit in the last place; twice that for safety.
  constexpr double kRounding = 2 * std::numeric_limits<double>::epsilon();
  const auto at = [&](double end, bool open) {
    return !open && std::isfinite(end) && std::abs(value - end) <= kRounding * std::abs(end);
  };
  return at(lower, lower_open) || at(upper, upper_open);
}

std::string Range::phrase() const {
  const bool below = std::isfinite(lower);
  const bool above = std::isfinite(upper);
  if (!below && !above) return "must be a finite number";
  std::string text = "must be ";
  if (!zero.empty()) text += "0 (" + std::string(zero) + ") or ";
  if (below) text += (lower_open ? "> " : ">= ") + shortest(lower);
  if (below && above) text += " and ";
  if (above) text += (upper_open ? "< " : "<= ") + shortest(upper);
  return text;
}

std::string shortest(double value) {
  if (std::isnan(value)) return "nan";  // of either sign
  char buffer[32];
  const auto [end, error] = std::to_chars(std::begin(buffer), std::end(buffer), value);
  return error == std::errc{} ? std::string(std::begin(buffer), end) : std::to_string(value);
}

namespace {
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t above = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, diagonal + (a[i - 1] == b[j - 1] ? 0U : 1U)});
      diagonal = above;
    }
  }
  return row[b.size()];
}
}  // namespace

std::string nearest(std::string_view word, std::span<const std::string> candidates) {
  std::string best;
  std::size_t smallest = std::max<std::size_t>(2, word.size() / 2);
  for (const std::string& candidate : candidates)
    if (!word.empty() && candidate.starts_with(std::string(word) + "_")) return candidate;  // its unit is missing
  for (const std::string& candidate : candidates) {
    const std::size_t distance = edit_distance(word, candidate);
    if (distance <= smallest && (best.empty() || distance < smallest)) {
      smallest = distance;
      best = candidate;
    }
  }
  return best;
}

namespace {

std::string full_key(const std::string& prefix, std::string_view key) {
  return prefix.empty() ? std::string(key) : prefix + "." + std::string(key);
}

}  // namespace

std::string one_of(std::span<const std::string_view> names) {
  std::string allowed = names.size() == 1 ? "must be" : "must be one of";
  for (std::size_t i = 0; i < names.size(); ++i) allowed += (i == 0 ? " " : ", ") + std::string(names[i]);
  return allowed;
}

void check_choice(const std::string& prefix, std::string_view key, const std::string& value,
                  std::span<const std::string_view> choices, std::vector<Violation>& found) {
  if (choices.empty() || std::ranges::find(choices, value) != choices.end()) return;
  found.push_back({.file = {}, .key = full_key(prefix, key), .value = value, .allowed = one_of(choices)});
}

void check_range(const std::string& prefix, std::string_view key, double value, const Range& range,
                 std::vector<Violation>& found) {
  if (!range.contains_rounded(value))
    found.push_back({.file = {}, .key = full_key(prefix, key), .value = shortest(value), .allowed = range.phrase()});
}

}  // namespace dovetail
