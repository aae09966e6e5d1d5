// Quantities at the edge of the program: a number with its unit in a file, a plain double in SI inside.
// Units are those of UDUNITS-2 (Unidata); it also checks that a unit measures the right thing.
#pragma once

#include <limits>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

#include <sim/law/dimension.hpp>

namespace mckibben::input {

/// A text that is not the wanted quantity; `what()` names the text, what is wrong and an example.
class BadQuantity : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// What a value usually is, for examples in messages: 0 where nothing is known.
struct Usual {
  double value = 0.0;
  double lowest = -std::numeric_limits<double>::infinity(), highest = std::numeric_limits<double>::infinity();
};

/// The value of `text`, such as "30 mm", in `si_unit`, such as "m". For the unit "1" a bare number is wanted
/// (or per cent, "5 %"). Angles are not taken for ratios, nor ratios for angles. Safe to call from several
/// threads. Throws BadQuantity; std::runtime_error if the unit database is not installed.
double read_quantity(std::string_view text, std::string_view si_unit, const Usual& usual = {});

/// "8 bar" of "8" or "8 Pa": the number in the unit in which it is near to what is usual; empty if in none.
std::string meant_quantity(std::string_view text, std::string_view si_unit, const Usual& usual);

/// "6 mm ± 0.1 mm", taken apart at the sign, which may also be "+-". `spread` is empty where there is none.
struct WithSpread {
  std::string_view value;
  std::optional<std::string_view> spread;
};
WithSpread split_spread(std::string_view text);

/// The standard deviation that such a spread says of `value`: "0.1 mm"; "10 %", of the value; "unknown",
/// infinite. Throws BadQuantity.
double read_spread(std::string_view spread, double value, std::string_view si_unit);

/// A quantity and how well it is known: "0.006 m ± 0.0001 m".
std::string write_with_spread(double value, double spread, std::string_view si_unit);

/// What is wrong with `unit` for what is measured in `wanted`:
/// "V is the wrong kind of unit"; empty if nothing.
std::string unit_problem(std::string_view unit, std::string_view wanted);

/// Converts numbers from `unit` to `wanted`, which unit_problem must have found well.
void convert_units(std::span<double> values, std::string_view unit, std::string_view wanted);

/// What a unit measures and how much of SI's unit it is; nothing if it is none, or does not count from zero.
std::optional<law::UnitSize> unit_size(std::string_view unit);

/// Shortest digits that read back exactly, and the unit: "0.03 m". For the unit "1" the number alone.
std::string write_quantity(double value, std::string_view si_unit);

/// A limit as a person would like to read it beside `text`: in the unit that `text` uses, in degrees for
/// angles, with six digits.
std::string show_limit(double limit, std::string_view si_unit, std::string_view text = {});

/// A value as people write it: "5 bar" for 5e5 Pa, "8 mm" for 0.008 m.
std::string usual_quantity(double value, std::string_view si_unit);

}  // namespace mckibben::input
