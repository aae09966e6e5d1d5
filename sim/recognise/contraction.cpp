// Sign and zero of a contraction; see columns.hpp.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <sim/data/scatter.hpp>
#include <sim/input/number.hpp>
#include <sim/input/quantity.hpp>
#include <sim/recognise/columns.hpp>

namespace mckibben::recognise {
namespace {

constexpr double least_correlation = 0.5, least_zero_share = 0.01, digits_of_range = 1e-4;
constexpr double settled_share = 0.05, near_rest_share = 0.3;  ///< of the range of its readings
constexpr double zeros_apart = 2e-3;  ///< the same: two medians that differ by more are not one

/// The number that a muscle's length, or its ratio to that at rest, has at rest; none if nobody knows.
std::optional<double> length_at_rest(const std::string& unit, bool is_length, const KnownRig& rig) {
  if (unit == "1") return 1.0;
  if (unit == "%") return 100.0;
  if (!is_length || rig.rest_length_m == 0.0 || !input::unit_problem(unit, "m").empty()) return std::nullopt;
  Values length{rig.rest_length_m};
  input::convert_units(length, "m", unit);
  return length.front();
}

/// By how much it moves in a single table where the drive is lowest: loads of other tables stretch it
/// otherwise.
double scatter_alone(const Readings& drives, const Readings& readings) {
  double widest = 0.0;
  for (std::size_t i = 0; i < drives.values.size(); ++i)
    widest = std::max(widest, together({drives.values[i]}, {readings.values[i]}).scatter);
  return widest;
}

/// Zero of a contraction that moves along with what drives the muscle; none: 0.
std::optional<Told> zero_told(const ColumnGuess& contraction, const ColumnGuess& drive, const Together& found,
                              double alone, const Range& range, double lowest_drive, bool is_length,
                              bool empties, const KnownRig& rig) {
  const std::string& unit = contraction.unit.value;
  const double span = range.high - range.low;
  const bool falls = found.correlation < 0.0, ratio = unit == "1" || unit == "%";
  const double at_rest = falls ? range.high : range.low;  // of its readings, the nearest to it
  const std::optional<double> rest = length_at_rest(unit, is_length, rig);
  const bool near_rest = rest && std::abs(at_rest - *rest) <= near_rest_share * span;
  if (falls && near_rest)
    return Told{fmt::format("{:.12g}", *rest), "what a length, or its ratio to that at rest, reads at rest"};
  if (is_length)
    return left_open(
        fmt::format("what it reads at the muscle's rest length; its readings go from {:.6g} to {:.6g}",
                    range.low, range.high));
  const bool from_rest = ratio || unit == "count";
  if (from_rest && (!falls || std::abs(at_rest) <= near_rest_share * span || range.high <= 0.0))
    return std::nullopt;
  if (std::abs(found.at_least_drive) < least_zero_share * span) return std::nullopt;
  const double step = std::pow(10.0, std::floor(std::log10(digits_of_range * span)));
  const std::string lowest =
      fmt::format("{:.4g}{}", lowest_drive, drive.unit.open() ? "" : " " + drive.unit.value);
  const auto rounded = [&](double value) { return fmt::format("{:.12g}", std::round(value / step) * step); };
  if (found.scatter > settled_share * span)
    return left_open(
        fmt::format("what it reads at the muscle's rest length; where {} is lowest, {}, it {} by {:.4g} {}; "
                    "perhaps {}, the end of its readings",
                    drive.column.value, lowest,
                    alone > settled_share * span ? "still moves" : "differs between the tables, as loads do,",
                    found.scatter, unit, rounded(at_rest)));
  const std::string reason = fmt::format("its median where {} is lowest, {}", drive.column.value, lowest);
  if (empties)
    return Told{.value = rounded(found.at_least_drive),
                .reason = reason + ": no pressure is left in the muscle there",
                .was_read = !rig.holds_a_length};
  return left_open(
      fmt::format("what it reads at the muscle's rest length; {} is {}: it is that if no pressure is left "
                  "in the muscle there and no load stretches it",
                  rounded(found.at_least_drive), reason));
}

/// Whether the gauge comes down to 0 in the air, as far as it shows.
bool reads_nothing(const ColumnGuess& gauge, const std::vector<const UnknownTable*>& tables) {
  constexpr double nothing = 0.02;  // of its range
  if (gauge.column.open() || gauge.unit.open() || (gauge.zero && gauge.zero->open())) return false;
  const auto readings = readings_of(tables, gauge.column.value);
  if (!readings) return false;
  const Range& range = readings->range;
  const double zero = gauge.zero ? input::parse_number(gauge.zero->value).value_or(0.0) : 0.0;
  return std::abs(range.low - zero) < nothing * (range.high - range.low);
}

}  // namespace

void sign_and_zero(ColumnGuess& contraction, const ColumnGuess& drive, const ColumnGuess* gauge,
                   const std::vector<const UnknownTable*>& tables, const Heading& heading,
                   const KnownRig& rig) {
  const auto drives = readings_of(tables, drive.column.value),
             readings = readings_of(tables, contraction.column.value);
  if (!drives || !readings) return;
  const Range& range = readings->range;
  const Together found = together(drives->values, readings->values);
  const std::string along = fmt::format("correlation with {} {:.2f}", drive.column.value, found.correlation);
  const bool scale_is_open = contraction.unit.open() || (contraction.factor && contraction.factor->open());
  if (std::abs(found.correlation) < least_correlation) {
    if (gauge != nullptr && gauge != &drive && !gauge->column.open())  // valves that set a flow
      return sign_and_zero(contraction, *gauge, gauge, tables, heading, rig);
    const std::string weak = ": too weak to decide its sign; 1 if it grows as the muscle contracts, else -1";
    contraction.factor =
        left_open((contraction.factor ? contraction.factor->reason + "; " : "") + along + weak);
    contraction.zero = left_open("what it reads with the muscle at its rest length");
    return;
  }
  const bool falls = found.correlation < 0.0;
  if (falls && contraction.factor && contraction.factor->open())
    contraction.factor->reason += "; and negative, as it falls while the muscle contracts, " + along;
  else if (falls && heading.is_contraction && range.high > near_rest_share * (range.high - range.low))
    contraction.factor =
        left_open(fmt::format("-1 if it falls as the muscle contracts, and yet its name says the "
                              "opposite; {}: does that drive the muscle?",
                              along));
  else if (falls)
    contraction.factor = Told{"-1", "it falls as the muscle contracts, " + along};
  const double at_rest = falls ? range.high : range.low;
  if (!scale_is_open)
    contraction.zero =
        zero_told(contraction, drive, found, scatter_alone(*drives, *readings), range, drives->range.low,
                  heading.is_length, gauge != nullptr && reads_nothing(*gauge, tables), rig);
  else if (std::abs(at_rest) > near_rest_share * (range.high - range.low))
    contraction.zero = left_open(fmt::format(
        "what it reads with the muscle at its rest length, before factor is multiplied; its readings "
        "go from {:.4g} to {:.4g}, and {:.4g} is nearest to it",
        range.low, range.high, at_rest));
}

void compare_zeros(Recognised& all) {
  constexpr std::size_t most_named = 6;
  struct Zero {
    double value;
    std::string says;
  };
  std::vector<Zero> zeros;
  std::vector<Told*> told;
  double least_apart = 0.0;
  for (std::size_t i = 0; i < all.runs.size(); ++i) {
    MapGuess& map = all.maps[all.runs[i].map];
    const auto contraction = std::ranges::find_if(
        map.columns, [](const ColumnGuess& one) { return one.zero && one.zero->was_read; });
    const ColumnGuess* drive = drive_of(map);
    if (contraction == map.columns.end() || drive == nullptr) continue;
    const Values *drives = column_of(all.tables[i], drive->column.value),
                 *readings = column_of(all.tables[i], contraction->column.value);
    if (drives == nullptr || readings == nullptr) continue;
    const double zero = together({drives}, {readings}).at_least_drive;
    zeros.push_back({zero, fmt::format("{:.6g} {} ({})", zero, contraction->unit.value, all.runs[i].id)});
    told.push_back(&*contraction->zero);
    const Range range = range_of(*readings);
    least_apart = std::max({least_apart, data::step_of(*readings), zeros_apart * (range.high - range.low)});
  }
  if (zeros.empty()) return;
  const auto [low, high] = std::ranges::minmax_element(zeros, {}, &Zero::value);
  std::string says = "; if a load hangs there, it is the zero under it";
  const bool differ = high->value - low->value > least_apart;
  if (differ) {
    std::string list;
    for (const Zero& one : zeros) list += (list.empty() ? "" : ", ") + one.says;
    says = fmt::format(
        "; it differs between the tables, {}, as loads stretch the muscle: joint: {{reading_offset: 0 mm ± "
        "1 mm}} of the rig lets diagnose move it",
        zeros.size() > most_named ? fmt::format("from {} to {}", low->says, high->says) : list);
  }
  std::ranges::sort(told);
  told.erase(std::ranges::unique(told).begin(), told.end());
  for (Told* one : told) {
    one->reason += says;
    one->doubtful = differ;
  }
}

double step_of(const ColumnGuess& guess, std::string_view unit, const std::vector<UnknownTable>& tables) {
  const std::string factor = guess.factor ? guess.factor->value : "1";
  if (guess.input || guess.unit.open() || !input::unit_problem(guess.unit.value, std::string(unit)).empty() ||
      (factor != "1" && factor != "-1"))
    return 0.0;
  double step = 0.0;
  for (const UnknownTable& table : tables) {
    const Values* readings = column_of(table, guess.column.value);
    const double own = readings == nullptr ? 0.0 : data::step_of(*readings);
    if (own > 0.0 && (step == 0.0 || own < step)) step = own;
  }
  return step;
}

}  // namespace mckibben::recognise
