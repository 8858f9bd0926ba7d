#include "studies/report/words/units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "contact/wear_law.hpp"
#include "geometry/profile/parameters.hpp"

namespace dovetail::report {

namespace {

struct Choice {
  std::string_view si_unit;
  double from;  ///< used for values of at least this, SI
  std::string_view symbol;
  double si;
};

// Of each quantity the largest first; the last one takes what is smaller.
constexpr std::array kChoices{
    Choice{"m", 1, "m", 1},
    Choice{"m", 1e-3, "mm", 1e-3},
    Choice{"m", 1e-7, "\u00b5m", 1e-6},
    Choice{"m", 1e-10, "nm", 1e-9},
    Choice{"m", 0, "pm", 1e-12},
    Choice{"m^3", 1e-13, "mm\u00b3", 1e-9},
    Choice{"m^3", 0, "\u00b5m\u00b3", 1e-18},
    Choice{"Pa", 1e4, "MPa", 1e6},
    Choice{"Pa", 0, "Pa", 1},
    Choice{"kg", 1, "kg", 1},
    Choice{"kg", 0, "g", 1e-3},
    Choice{"J", 1, "J", 1},
    Choice{"J", 1e-3, "mJ", 1e-3},
    Choice{"J", 0, "\u00b5J", 1e-6},
};

constexpr std::array<std::pair<std::string_view, std::string_view>, 7> kSiEndings{
    {{"_m3_per_cycle", "m^3"}, {"_m3", "m^3"}, {"_m", "m"}, {"_hz", "Hz"}, {"_pa", "Pa"}, {"_kg", "kg"}, {"_j", "J"}}};

constexpr std::array<std::pair<std::string_view, std::string_view>, 19> kKeyEndings{{
    {"_m3_per_j", "m\u00b3/J"},
    {"_j_per_m2", "J/m\u00b2"},
    {"_n_per_m3", "N/m\u00b3"},
    {"_um", "\u00b5m"},
    {"_mm", "mm"},
    {"_deg", "\u00b0"},
    {"_rpm", "rpm"},
    {"_n", "N"},
    {"_hz", "Hz"},
    {"_gpa", "GPa"},
    {"_mpa", "MPa"},
    {"_pa", "Pa"},
    {"_kg_m3", "kg/m\u00b3"},
    {"_per_pa", "1/Pa"},
    {"_kg", "kg"},
    {"_m3", "m\u00b3"},
    {"_m", "m"},
    {"_j", "J"},
    {"_s", "s"},
}};

template <class Endings>
std::pair<std::string_view, std::string_view> split(std::string_view name, const Endings& endings) {
  std::pair<std::string_view, std::string_view> best{name, ""};
  std::size_t longest = 0;
  for (const auto& [ending, unit] : endings) {
    if (!name.ends_with(ending) || ending.size() <= longest) continue;
    longest = ending.size();
    best = {name.substr(0, name.size() - longest), unit};
  }
  return best;
}

std::string spaced(std::string_view name) {
  std::string text(name);
  std::replace(text.begin(), text.end(), '_', ' ');
  return text;
}

std::string true_minus(std::string text) {
  if (!text.empty() && text.front() == '-') text.replace(0, 1, "\u2212");
  return text;
}

/// A unit as people write it: m^3 with a superscript.
std::string typeset(std::string_view unit) {
  std::string text(unit);
  for (const auto& [power, written] : {std::pair{"^2", "\u00b2"}, std::pair{"^3", "\u00b3"}})
    for (std::size_t at = text.find(power); at != text.npos; at = text.find(power)) text.replace(at, 2, written);
  return text;
}

/// A key of the study file without the unit that it ends with, and that unit. What a wear law is given in is in its
/// table, and its key may end with a unit that is in no list.
std::pair<std::string_view, std::string> named(std::string_view key) {
  const auto [name, unit] = split(key, kKeyEndings);
  const contact::WearParameter* wear = contact::find_wear_parameter(key.substr(key.rfind('.') + 1));
  if (wear == nullptr) return {name, std::string(unit)};
  const std::string own = typeset(wear->unit);
  return {own == unit ? name : key, own};
}

std::string superscript(int exponent) {
  constexpr std::array<std::string_view, 10> kDigits{"\u2070", "\u00b9", "\u00b2", "\u00b3", "\u2074",
                                                     "\u2075", "\u2076", "\u2077", "\u2078", "\u2079"};
  std::string text = exponent < 0 ? "\u207b" : "";
  for (const char c : std::to_string(std::abs(exponent))) text += kDigits[static_cast<std::size_t>(c - '0')];
  return text;
}

/// Exponent of the first digit of |value| once rounded to `digits`.
int exponent_of(double value, int digits) {
  const std::string text = fmt::format("{:.{}e}", std::abs(value), digits - 1);
  return std::stoi(text.substr(text.find('e') + 1));
}

}  // namespace

Unit readable_unit(std::string_view si_unit, double largest) {
  Unit last{.symbol = std::string(si_unit), .si = 1};
  for (const Choice& choice : kChoices) {
    if (choice.si_unit != si_unit) continue;
    last = {.symbol = std::string(choice.symbol), .si = choice.si};
    if (std::abs(largest) >= choice.from) break;
  }
  // Without a size the middle of the road.
  if (si_unit == "m" && !(std::abs(largest) > 0)) return {.symbol = "\u00b5m", .si = 1e-6};
  if (si_unit == "m^3" && !(std::abs(largest) > 0)) return {.symbol = "mm\u00b3", .si = 1e-9};
  if (si_unit == "Pa" && !(std::abs(largest) > 0)) return {.symbol = "MPa", .si = 1e6};
  return last;
}

std::string si_unit_of(std::string_view name) {
  return std::string(split(name, kSiEndings).second);
}

std::string key_unit(std::string_view key) {
  return named(key).second;
}

std::string key_words(std::string_view key) {
  const std::string_view name = named(key).first;
  std::string side;
  for (const geometry::FlankPlace& place : geometry::kFlanks)
    if (name.starts_with("geometry." + std::string(place.name) + ".")) side = ", " + std::string(place.name);
  const std::size_t dot = name.rfind('.');
  return spaced(dot == std::string_view::npos ? name : name.substr(dot + 1)) + side;
}

std::string words(std::string_view name) {
  std::string text = spaced(split(name, kSiEndings).first);
  for (const auto& [ending, word] : {std::pair{" max", "largest "}, std::pair{" mean", "mean "}})
    if (text.ends_with(ending)) return word + text.substr(0, text.size() - std::string_view(ending).size());
  return text;
}

std::string significant(double value, int digits) {
  if (std::isnan(value)) return "\u2013";
  if (std::isinf(value)) return value > 0 ? "\u221e" : "\u2212\u221e";
  if (value == 0) return "0";
  const int exponent = exponent_of(value, digits);
  if (exponent >= -4 && exponent < 6) {
    // Digits before the point are rounded as well: 160354 to two digits is 160000.
    const double whole = std::pow(10.0, std::max(0, exponent - digits + 1));
    return true_minus(fmt::format("{:.{}f}", whole > 1 ? std::round(value / whole) * whole : value,
                                  std::max(0, digits - 1 - exponent)));
  }
  const std::string mantissa = fmt::format("{:.{}f}", value / std::pow(10.0, exponent), digits - 1);
  if (mantissa == "1" || mantissa == "-1") return true_minus(value < 0 ? "-10" : "10") + superscript(exponent);
  return true_minus(mantissa) + "\u00d710" + superscript(exponent);
}

std::string plain(double value, int digits) {
  std::string text = significant(value, digits);
  if (text.find('.') == std::string::npos || text.find("\u00d7") != std::string::npos) return text;
  text.erase(text.find_last_not_of('0') + 1);
  if (text.ends_with('.')) text.pop_back();
  return text;
}

std::string plain(double value, const Unit& unit) {
  return plain(value / unit.si) + (unit.symbol.empty() ? "" : "\u00a0" + unit.symbol);
}

std::string with_error(double value, double error, const Unit& unit) {
  const double shown = value / unit.si, bar = std::abs(error) / unit.si;
  const std::string symbol = unit.symbol.empty() ? "" : "\u00a0" + unit.symbol;
  if (!std::isfinite(shown) || !(bar > 0) || std::isinf(bar))
    return significant(shown) + (std::isinf(bar) ? " \u00b1 \u221e" : "") + symbol;
  constexpr double kUnseen = 1e-5;
  if (bar < kUnseen * std::abs(shown)) return significant(shown, 5) + symbol;
  // More than seven digits of a value say nothing to a reader.
  constexpr int kDigits = 7;
  const int bar_exponent = exponent_of(bar, 2);
  const int value_exponent = shown == 0 ? bar_exponent : exponent_of(shown, kDigits);
  const int digits = std::clamp(value_exponent - bar_exponent + 2, 2, kDigits);
  if (bar_exponent >= 0 || bar_exponent < -9 || value_exponent < -4)
    return significant(shown, digits) + " \u00b1 " + significant(bar, 2) + symbol;
  const int decimals = std::max(1 - bar_exponent, 0);
  return true_minus(fmt::format("{:.{}f}", shown, std::min(decimals, std::max(0, kDigits - 1 - value_exponent)))) +
         " \u00b1 " + significant(bar, 2) + symbol;
}

std::string per_cent(double value, double reference, int digits, int from_ten) {
  if (!(reference > 0) || !std::isfinite(value)) return value == reference ? "0\u00a0%" : "\u2013";
  const double change = 100 * (value / reference - 1);
  return (change > 0 ? "+" : "") + significant(change, std::abs(change) >= 10 ? from_ten : digits) + "\u00a0%";
}

std::string difference(double from, double to, const Unit& unit) {
  if (!std::isfinite(from) || !std::isfinite(to)) return "\u2013";
  if (std::abs(to - from) <= 1e-8 * std::max(std::abs(from), std::abs(to))) return "none";
  // Of what is in per cent itself it would be read as a part of it.
  if (from > 0 && to > 0 && unit.symbol != "%") return per_cent(to, from, 2, 3);
  const std::string symbol = unit.symbol == "%"    ? " percentage points"
                             : unit.symbol.empty() ? ""
                                                   : "\u00a0" + unit.symbol;
  return (to > from ? "+" : "") + significant((to - from) / unit.si, 3) + symbol;
}

}  // namespace dovetail::report
