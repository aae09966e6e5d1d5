// Quantities through UDUNITS-2; see the header. UDUNITS is neither thread-safe nor strict about where a
// number may stand ("5 3 kg" would be 15 kg), and reads its own numbers by the locale. So calls are
// serialised, under the locale C, and the unit's spelling is checked first. It counts radians as
// dimensionless; a unit's definition still names them, which tells angles from ratios.
#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cmath>
#include <limits>
#include <memory>
#include <mutex>
#include <numbers>
#include <system_error>

#include <fmt/format.h>
#include <locale.h>  // of POSIX
#include <udunits2.h>

#include <plant/constants.hpp>
#include <sim/input/number.hpp>
#include <sim/input/quantity.hpp>
#include <sim/input/utf8.hpp>

namespace mckibben::input {
namespace {

using Unit = std::unique_ptr<ut_unit, decltype([](ut_unit* unit) { ut_free(unit); })>;
using Converter = std::unique_ptr<cv_converter, decltype([](cv_converter* one) { cv_free(one); })>;

constexpr std::size_t longest_quantity = 200;
constexpr std::string_view unknown_spread = "unknown";

/// Whoever calls UDUNITS holds this: alone, and with a decimal point whatever the program's locale.
class InUdunits {
 public:
  InUdunits() : lock_(only_one), before_(uselocale(with_points())) {}
  InUdunits(const InUdunits&) = delete;
  InUdunits& operator=(const InUdunits&) = delete;
  ~InUdunits() { uselocale(before_); }

 private:
  static inline std::mutex only_one;
  static locale_t with_points() {
    static const locale_t c = newlocale(LC_ALL_MASK, "C", nullptr);
    return c;
  }

  std::lock_guard<std::mutex> lock_;
  locale_t before_;
};

/// The unit database, read once. Call in UDUNITS.
ut_system* unit_system() {
  struct FreeSystem {
    void operator()(ut_system* system) const { ut_free_system(system); }
  };
  static const std::unique_ptr<ut_system, FreeSystem> system = [] {
    ut_set_error_message_handler(ut_ignore);
    std::unique_ptr<ut_system, FreeSystem> read(ut_read_xml(nullptr));
    if (!read && errno == EMFILE) throw std::system_error(errno, std::generic_category(), "units");
    if (!read) throw std::runtime_error("the unit database of UDUNITS-2 (libudunits2-data) is not installed");
    const Unit degree(ut_parse(read.get(), "degree", UT_ASCII));
    ut_map_name_to_unit("deg", UT_ASCII, degree.get());
    ut_map_name_to_unit("Winkelgrad", UT_ASCII, degree.get());
    ut_map_symbol_to_unit("Grad", UT_ASCII, degree.get());  // G and rad otherwise; grad may be gon
    return read;
  }();
  return system.get();
}

/// Letters, digits that follow a letter or an exponent, and single operators: no second number, no offset.
/// The only number is a leading "1/".
bool spelt_like_a_unit(std::string_view text) {
  constexpr std::size_t longest_unit = 60;  // UDUNITS' parser is recursive
  if (text.size() > longest_unit) return false;
  if (text.starts_with("1/")) text.remove_prefix(2);
  char before = ' ';
  for (const char c : text) {
    const bool is_digit = std::isdigit(static_cast<unsigned char>(c)) != 0;
    const bool is_letter =
        std::isalpha(static_cast<unsigned char>(c)) != 0 || static_cast<unsigned char>(c) >= 0x80 || c == '%';
    const bool after_letter = std::isalnum(static_cast<unsigned char>(before)) != 0;
    const bool is_sign = c == '-' && (after_letter || before == '^');
    if (is_digit && !after_letter && before != '^' && before != '-') return false;
    if (!is_digit && !is_letter && !is_sign && std::string_view(" ./*^()").find(c) == std::string_view::npos)
      return false;
    before = c;
  }
  return !text.empty();
}

/// Without what says that a pressure is one above the atmosphere or absolute: kPa abs, psi(g), bar_rel.
std::string_view without_reference(std::string_view text) {
  constexpr std::array<std::string_view, 9> pressures{"psi", "pa",   "hpa", "kpa", "mpa",
                                                      "bar", "mbar", "atm", "inhg"};
  constexpr std::array<std::string_view, 11> references{"g",        "gauge",    "gage",    "rel",
                                                        "relative", "relativ",  "abs",     "absolute",
                                                        "absolut",  "\xC3\xBC", "\xC3\x9C"};
  const std::size_t end = text.find_first_of(" (_[");
  if (end == std::string_view::npos) return text;
  const auto letters = [](std::string_view part) {
    std::string small = lower(part);
    std::erase_if(small,
                  [](char c) { return std::string_view(" ()[]_.").find(c) != std::string_view::npos; });
    return small;
  };
  const std::string unit = letters(text.substr(0, end)), reference = letters(text.substr(end));
  const bool is_reference = reference == "a" || std::ranges::find(references, reference) != references.end();
  return is_reference && std::ranges::find(pressures, unit) != pressures.end() ? text.substr(0, end) : text;
}

/// Spellings that headings have and UDUNITS has not; gauge or absolute is not the unit's business.
std::string_view known_as(std::string_view text) {
  text = without_reference(text);
  constexpr std::array<std::pair<std::string_view, std::string_view>, 28> spellings{
      {{"ms", "ms"},
       {"us", "us"},
       {"s", "s"},
       {"sec", "sec"},
       {"ma", "mA"},
       {"cm", "cm"},
       {"mbar", "mbar"},
       {"hpa", "hPa"},
       {"psi", "psi"},
       {"kpag", "kPa"},
       {"kpaa", "kPa"},
       {"kg/cm2", "kgf/cm2"},
       {"kg/cm\xC2\xB2", "kgf/cm2"},
       {"kg/cm^2", "kgf/cm2"},
       {"lb/in2", "psi"},
       {"lb/in^2", "psi"},
       {"lbs/in2", "psi"},
       {"thou", "mil"},
       {"psig", "psi"},
       {"psia", "psi"},
       {"barg", "bar"},
       {"bara", "bar"},
       {"kpa", "kPa"},
       {"lbf", "lbf"},
       {"lbs", "lb"},
       {"deg", "deg"},
       {"mm", "mm"},
       {"kn", "kN"}}};
  const std::string in_small = lower(text);
  for (const auto& [small, unit] : spellings)
    if (in_small == small) return unit;
  return text;
}

Unit parse_unit(std::string_view text) {
  text = known_as(text);
  return Unit(ut_parse(unit_system(), std::string(text).c_str(), UT_UTF8));
}

bool is_angular(const ut_unit* unit) {
  char definition[256];
  const int length = ut_format(unit, definition, sizeof definition, UT_ASCII | UT_DEFINITION);
  return length > 0 && static_cast<std::size_t>(length) < sizeof definition &&
         std::string_view(definition).find("rad") != std::string_view::npos;
}

enum class Fit { fits, unknown, wrong };

/// Converts the values if the units fit.
Fit convert(std::span<double> values, std::string_view from, std::string_view to) {
  if (from == to) return Fit::fits;
  if (!spelt_like_a_unit(without_reference(from))) return Fit::unknown;
  const InUdunits here;
  const Unit given = parse_unit(from);
  if (!given) return Fit::unknown;
  const Unit wanted = parse_unit(to);
  if (!wanted) throw std::logic_error(fmt::format("{} is no unit of UDUNITS-2", to));
  if (is_angular(given.get()) != is_angular(wanted.get())) return Fit::wrong;
  // Asked of the quotient, because UDUNITS also converts reciprocals (Hz for s), hardly what was meant.
  const Unit quotient(ut_divide(given.get(), wanted.get()));
  const Converter converter(ut_get_converter(given.get(), wanted.get()));
  if (!quotient || ut_is_dimensionless(quotient.get()) == 0 || !converter) return Fit::wrong;
  cv_convert_doubles(converter.get(), values.data(), values.size(), values.data());
  return Fit::fits;
}

/// Text split where the number ends; the unit may be empty.
struct Split {
  std::string_view number, unit;
};

Split split(std::string_view text) {
  text = trimmed(text);
  const std::size_t length = number_length(text);
  return {text.substr(0, length), trimmed(text.substr(length))};
}

std::string_view usual_unit(std::string_view si_unit) {
  if (si_unit == "Pa") return "bar";
  if (si_unit == "rad") return "deg";
  return si_unit;
}

/// ": for example 5 bar": what the number may mean, or else what is usual; nothing if neither is known.
std::string example_for(std::string_view number, std::string_view si_unit, const Usual& usual) {
  const std::string meant = meant_quantity(number, si_unit, usual);
  if (meant.empty() && usual.value == 0.0) return "";
  return ": for example " + (meant.empty() ? usual_quantity(usual.value, si_unit) : meant);
}

/// Walks through a unit's definition down to base units.
struct Definition {
  law::UnitSize size;
  bool from_zero = true;

  static ut_status basic(const ut_unit* unit, void* self) {
    const ut_unit* const one[] = {unit};
    const int power[] = {1};
    return product(nullptr, 1, one, power, self);
  }
  static ut_status product(const ut_unit*, int count, const ut_unit* const* units, const int* powers,
                           void* self) {
    auto& [size, from_zero] = *static_cast<Definition*>(self);
    for (int i = 0; i < count; ++i) {
      const char* const symbol = ut_get_symbol(units[i], UT_ASCII);
      for (std::size_t k = 0; symbol != nullptr && k < size.dimension.exponents.size(); ++k)
        if (std::string_view(symbol) == law::Dimension::bases[k]) size.dimension.exponents[k] += powers[i];
    }
    return UT_SUCCESS;
  }
  static ut_status galilean(const ut_unit*, double scale, const ut_unit* unit, double offset, void* self);
  static ut_status timestamp(const ut_unit*, const ut_unit*, double, void*) { return UT_BAD_ARG; }
  static ut_status logarithmic(const ut_unit*, double, const ut_unit*, void*) { return UT_BAD_ARG; }
};
constexpr ut_visitor definition{Definition::basic, Definition::product, Definition::galilean,
                                Definition::timestamp, Definition::logarithmic};

ut_status Definition::galilean(const ut_unit*, double scale, const ut_unit* unit, double offset, void* self) {
  auto& own = *static_cast<Definition*>(self);
  own.size.size *= scale;
  own.from_zero = own.from_zero && offset == 0.0;
  return ut_accept_visitor(unit, &definition, self);
}

/// Of valves that are open or shut.
std::string_view if_a_duty(std::string_view unit, std::string_view si_unit) {
  if (unit != "%" || (si_unit != "mA" && si_unit != "V")) return "";
  return "; a duty is a command, too: 0 % is half-way from zero_command to span_command, 100 % span_command "
         "(ports: 3/2: 0 % is zero_command); zero_command: -100 V, span_command: 100 V make 1 V of 1 %";
}

/// To a number that must have none: of a length its share of the muscle's may be meant.
std::string without_unit(double value, std::string_view number, std::string_view unit) {
  if (convert({&value, 1}, unit, "m") != Fit::fits) return fmt::format(": for example {}", number);
  return fmt::format(
      "; as a contraction ratio it is the length divided by rest_length: {:.3g} if that is 250 mm",
      value / 0.25);
}

}  // namespace

std::optional<law::UnitSize> unit_size(std::string_view unit) {
  if (unit == "1") return law::UnitSize{};
  if (!spelt_like_a_unit(unit)) return std::nullopt;
  const InUdunits here;
  const Unit given = parse_unit(unit);
  Definition found;
  if (!given || ut_accept_visitor(given.get(), &definition, &found) != UT_SUCCESS || !found.from_zero)
    return std::nullopt;
  return found.size;
}

std::string meant_quantity(std::string_view text, std::string_view si_unit, const Usual& usual) {
  const std::string_view number = split(text).number;
  const auto written = parse_number(number);
  if (!written || si_unit == "1") return "";
  const bool rad = si_unit == "rad" && std::abs(*written) <= std::numbers::pi;  // up to half a turn
  // Where nothing is usual: steps and offsets are of mm, and what is not small of a small unit.
  const bool nothing_usual = usual.value == 0.0, unknown = nothing_usual && std::isfinite(usual.highest),
             large = std::abs(*written) >= 1.0;
  const std::string_view unit = rad                                          ? si_unit
                                : unknown && si_unit == "m"                  ? "mm"
                                : unknown && si_unit == "Pa" && large        ? "mbar"
                                : nothing_usual && si_unit == "m/s" && large ? "mm/s"
                                                                             : usual_unit(si_unit);
  for (const std::string_view one : {unit, si_unit, si_unit == "kg" ? std::string_view("g") : si_unit}) {
    double value = *written;
    convert({&value, 1}, one, si_unit);
    if (value >= usual.lowest && value <= usual.highest &&
        (usual.value == 0.0 || std::abs(std::log10(value / usual.value)) < 1.0))
      return fmt::format("{} {}", number, one) +
             (rad ? fmt::format(", which is {:.3g} deg", value / plant::degree_rad) : "");
  }
  return "";
}

double read_quantity(std::string_view text, std::string_view si_unit, const Usual& usual) {
  const std::string_view whole = trimmed(text);
  if (whole.size() > longest_quantity)
    throw BadQuantity(
        fmt::format("{} is no quantity: it has more than {} characters", shortened(whole), longest_quantity));
  const auto [number, unit] = split(whole);
  const std::string_view rest = whole.substr(number.size());
  if (number.empty() ||
      (!rest.empty() && std::string_view(".,_0123456789").find(rest.front()) != std::string_view::npos))
    throw BadQuantity(why_no_number(whole));
  const auto value = parse_number(number);
  if (!value) throw BadQuantity(why_no_number(number));
  if (si_unit == "1") {
    if (unit.empty()) return *value;
    if (unit == "%") return *value / 100.0;
    throw BadQuantity(
        fmt::format("{} must be a bare number, without a unit{}", whole, without_unit(*value, number, unit)));
  }
  if (unit.empty())
    throw BadQuantity(fmt::format("{} has no unit; it is measured in {}{}", whole, si_unit,
                                  example_for(number, si_unit, usual)));
  double converted = *value;
  const Fit fit = convert({&converted, 1}, unit, si_unit);
  if (fit == Fit::unknown)
    throw BadQuantity(fmt::format("{}: {} is not a unit; wanted is {}{}", whole, unit, si_unit,
                                  example_for(number, si_unit, usual)));
  if (fit == Fit::wrong)
    throw BadQuantity(fmt::format("{}: {} is the wrong kind of unit; wanted is {}{}{}", whole, unit, si_unit,
                                  example_for("", si_unit, usual), if_a_duty(unit, si_unit)));
  return converted;
}

WithSpread split_spread(std::string_view text) {
  for (const std::string_view sign : {std::string_view("±"), std::string_view("+-")})
    if (const auto at = text.find(sign); at != std::string_view::npos)
      return {trimmed(text.substr(0, at)), trimmed(text.substr(at + sign.size()))};
  return {text, std::nullopt};
}

double read_spread(std::string_view spread, double value, std::string_view si_unit) {
  if (spread.empty())
    throw BadQuantity(fmt::format("what follows ± is missing: a deviation{}, ± 10 % or ± unknown",
                                  si_unit == "1" ? "" : fmt::format(" in {}", usual_unit(si_unit))));
  if (spread == unknown_spread) return std::numeric_limits<double>::infinity();
  const bool relative = spread.ends_with('%');
  const double read = read_quantity(spread, relative ? "1" : si_unit) * (relative ? std::abs(value) : 1.0);
  if (!std::isfinite(read)) throw BadQuantity(fmt::format("± {} is too large", shortened(spread)));
  if (read < 0.0) throw BadQuantity(fmt::format("± {}: a deviation is not negative", shortened(spread)));
  if (relative && value == 0.0)
    throw BadQuantity(fmt::format("± {}: a share of nothing is nothing; give it in {}", shortened(spread),
                                  si_unit == "1" ? "absolute numbers" : si_unit));
  return read;
}

std::string write_with_spread(double value, double spread, std::string_view si_unit) {
  return write_quantity(value, si_unit) + " ± " +
         (std::isinf(spread) ? std::string(unknown_spread) : write_quantity(spread, si_unit));
}

std::string unit_problem(std::string_view unit, std::string_view wanted) {
  constexpr double longest_of_clocks_s = 7 * 86400.0;
  const std::string shown = shortened(unit);
  double one = 1.0;
  switch (convert({&one, 1}, unit, wanted)) {
    case Fit::unknown:
      return fmt::format("{} is not a unit; wanted is {}", shown, wanted);
    case Fit::wrong:
      return fmt::format("{} is the wrong kind of unit; wanted is {}", shown, wanted);
    case Fit::fits:
      break;
  }
  if (wanted == "s" && one > longest_of_clocks_s)
    return fmt::format("{} is too long a unit for the times of a run; wanted is {}", shown, wanted);
  return "";
}

void convert_units(std::span<double> values, std::string_view unit, std::string_view wanted) {
  if (convert(values, unit, wanted) != Fit::fits) throw std::logic_error("units that do not fit");
}

std::string write_quantity(double value, std::string_view si_unit) {
  if (si_unit == "rad") {  // people think in degrees: where they read back to the same bits, they are written
    const double degrees = std::round(value / plant::degree_rad * 1e9) / 1e9;
    std::string text = write_number(degrees) + " deg";
    if (read_quantity(text, si_unit) == value) return text;
  }
  return si_unit == "1" ? write_number(value) : fmt::format("{} {}", write_number(value), si_unit);
}

std::string show_limit(double limit, std::string_view si_unit, std::string_view text) {
  if (si_unit == "1") return fmt::format("{:.6g}", limit);
  const std::string_view given = split(text).unit;
  const std::string_view unit = !given.empty() ? given : si_unit == "rad" ? "deg" : si_unit;
  double shown = limit;
  return convert({&shown, 1}, si_unit, unit) == Fit::fits ? fmt::format("{:.6g} {}", shown, unit)
                                                          : fmt::format("{:.6g} {}", limit, si_unit);
}

std::string usual_quantity(double value, std::string_view si_unit) {
  const bool small = std::abs(value) < 1.0;
  const std::string_view unit = si_unit == "m" && small   ? "mm"
                                : si_unit == "s" && small ? "ms"
                                                          : usual_unit(si_unit);
  return show_limit(value, si_unit, fmt::format("1 {}", unit));
}

}  // namespace mckibben::input
