#pragma once

#include <string>
#include <string_view>

namespace dovetail::report {

/// A unit engineers read, for values kept in SI.
struct Unit {
  std::string symbol;  ///< "µm", "mm³", "MPa"; empty: a plain number
  double si = 1;       ///< one of it in SI
};

/// The unit for values up to `largest` (SI magnitude) of a quantity whose SI unit is `si_unit` ("m", "m^3", "Pa", ...;
/// another one is kept). m: m, mm, µm, nm; m^3: mm³; Pa: Pa, MPa; kg: kg, g; J: J, mJ, µJ.
[[nodiscard]] Unit readable_unit(std::string_view si_unit, double largest);

/// SI unit of a response or data set by the ending of its name ("_m3", "_pa", ...); empty when it has none.
[[nodiscard]] std::string si_unit_of(std::string_view name);

/// Unit symbol of a study-file key by its ending ("_um", "_deg", "_rpm", ...); empty when it has none.
[[nodiscard]] std::string key_unit(std::string_view key);

/// A key in words, without section and unit: "flank mismatch", "flank angle, left".
[[nodiscard]] std::string key_words(std::string_view key);

/// A response's name in words without its unit: "asymptotic wear volume", "largest contact pressure".
[[nodiscard]] std::string words(std::string_view name);

/// `digits` significant digits, no exponent between 1e-4 and 1e6, true minus sign; "–" for NaN.
[[nodiscard]] std::string significant(double value, int digits = 4);

/// A number someone gave (a bound, a limit): up to `digits` significant digits without trailing zeros.
[[nodiscard]] std::string plain(double value, int digits = 6);

/// That in a unit: "9 mm".
[[nodiscard]] std::string plain(double value, const Unit& unit);

/// Value with its error bar in a unit, rounded to the bar's first two digits: "0.7812 ± 0.0013". One that no
/// reader would see, below 1e-5 of the value, is left out.
[[nodiscard]] std::string with_error(double value, double error, const Unit& unit);

/// How far a value lies from a reference: "+0.50 %", with `from_ten` digits from 10 % on; "–" where that says nothing.
[[nodiscard]] std::string per_cent(double value, double reference, int digits = 2, int from_ten = 2);

/// From one value to another: in per cent of the first, or where one of them is not above zero in the unit;
/// "none" where only rounding of design variables tells them apart.
[[nodiscard]] std::string difference(double from, double to, const Unit& unit);

}  // namespace dovetail::report
