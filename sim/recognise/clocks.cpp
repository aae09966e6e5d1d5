// Clocks of tables that nobody described; see columns.hpp.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <sim/domain/number.hpp>
#include <sim/input/arranged.hpp>
#include <sim/input/dates.hpp>
#include <sim/input/number.hpp>
#include <sim/input/quantity.hpp>
#include <sim/input/row_order.hpp>
#include <sim/recognise/columns.hpp>
#include <sim/recognise/headings.hpp>

namespace mckibben::recognise {
namespace {

/// Positive numbers that are alike, and as often smaller as larger than the one before.
bool are_intervals(const Values& values) {
  Values sorted;
  std::size_t falls = 0;
  for (const double value : values) {
    if (std::isnan(value)) continue;
    if (!sorted.empty() && value <= sorted.back()) ++falls;
    sorted.push_back(value);
  }
  constexpr double no_interval = 1e8;  // stamps that have lost their digits
  const bool ascend = std::ranges::is_sorted(sorted) && sorted.front() != sorted.back(),
             descend = std::ranges::is_sorted(sorted, std::greater()) && sorted.front() != sorted.back();
  if (sorted.size() < 3 || ascend || descend || 5 * falls < sorted.size() || sorted.front() > no_interval)
    return false;
  std::ranges::sort(sorted);
  constexpr double alike = 5.0;
  const std::size_t n = sorted.size();
  return sorted[n / 20] > 0.0 && sorted[n - 1 - n / 20] < alike * sorted[n / 2] &&
         sorted[n / 20] > sorted[n / 2] / alike;
}

/// The unit in which a stamp of so many digits counts since 1970.
std::string unit_of_epoch(const std::string& first) {
  if (first.empty() || first.front() > '2') return "";  // beyond 2064: a counter
  switch (std::min(first.find_first_not_of("0123456789"), first.size())) {
    case 10:
      return "s";
    case 13:
      return "ms";
    case 16:
      return "us";
    case 19:
      return "ns";
    default:
      return "";
  }
}

/// Clocks that say the same, such as a stamp and the time at which its message came.
bool alike(const Values& a, const Values& b) {
  const double whole_a = a.back() - a.front(), whole_b = b.back() - b.front();
  if (!(whole_a > 0.0) || !(whole_b > 0.0) || !std::isfinite(whole_b / whole_a)) return false;
  const double in_another_unit = std::pow(1000.0, std::round(std::log10(whole_b / whole_a) / 3.0));
  return std::abs(whole_b / whole_a / in_another_unit - 1.0) < 1e-3;
}

/// Stamps that one clock took, of readings that come one after the other.
bool are_late(const Values& a, const Values& b) {
  const double whole = a.back() - a.front();
  return a != b && std::abs(b.front() - a.front()) < 0.1 * whole &&
         std::abs(b.back() - a.back()) < 0.1 * whole;
}

/// Between two rows, read in that unit [s]; 0 where stamps fall.
double step_of(const Values& stamps, const std::string& unit) {
  const Clock clock = clock_of(stamps);
  Values step{clock.ascends ? clock.step_s : 0.0};
  input::convert_units(step, unit, "s");
  return step.front();
}

/// What a recorder takes between two rows. A second is doubted: a millisecond looks like it in the wrong
/// unit.
bool is_a_tick(double row_s) {
  return row_s >= shortest_tick_s && row_s < longest_tick_s;
}

/// The unit in which rows would be a tick apart.
std::string or_which(const Values& stamps) {
  for (const char* unit : {"s", "ms", "us"})
    if (const double row_s = step_of(stamps, unit); is_a_tick(row_s))
      return fmt::format(", or {}, with rows {:.6g} ms apart", unit, 1e3 * row_s);
  return "";
}

Told unit_of(const UnknownColumn& column, const Heading& heading, const SaidStep& said) {
  if (column.is_date) return {std::string(input::date_unit), "it holds dates"};
  const std::string unit = unit_of_epoch(column.epoch);
  if (!heading.other_unit.empty()) return two_units(heading);
  if (heading.unit_fits && said.step_s > 0.0) {
    constexpr double alike = 1.02;
    const double row_s = step_of(column.values, heading.unit);
    if (const double ratio = row_s / said.step_s; row_s > 0.0 && (ratio > alike || alike * ratio < 1.0))
      return left_open(fmt::format("the table says {}, so that rows are {:.6g} ms apart; and {}",
                                   heading.unit, 1e3 * row_s, said.reason));
  }
  if (const double row_s = heading.unit_fits && unit.empty() ? step_of(column.values, heading.unit) : 0.0;
      row_s > 0.0 && !is_a_tick(row_s))
    return left_open(fmt::format("the table says {0}, so that rows are {1:.6g} ms apart: is it {0}{2}?",
                                 heading.unit, 1e3 * row_s, or_which(column.values)));
  if (heading.unit_fits && (unit.empty() || unit == heading.unit))
    return {heading.unit, fmt::format("the table says {}", heading.unit)};
  if (heading.unit_fits)
    return left_open(fmt::format("the table says {}; stamps such as {} are in {} since 1970", heading.unit,
                                 column.epoch, unit));
  if (!unit.empty()) return {unit, fmt::format("{} counts {} since 1970", column.epoch, unit)};
  const Clock clock = clock_of(column.values);
  if (said.step_s > 0.0 && std::abs(clock.step_s / said.step_s - 1.0) < 1e-3)
    return {"s", fmt::format("its rows are {:.6g} apart, and {}", clock.step_s, said.reason)};
  return left_open(fmt::format(
      "the table says {}; rows are {:.6g} of it apart: s, ms, us{}?",
      heading.unknown.empty() ? "no unit"
                              : fmt::format("({}), which is no unit that is known here", heading.unknown),
      clock.step_s, clock.step_s < 1e-3 && clock.begin_s > 1e4 ? ", or d, as Excel counts days" : ""));
}

ColumnGuess guess_of_time(const UnknownColumn& column, const Heading& heading, const SaidStep& said) {
  ColumnGuess guess{&domain::quantity_of("time"),
                    {column.name, heading.reason},
                    unit_of(column, heading, said),
                    {},
                    {},
                    {},
                    {}};
  if (!column.either.empty())
    guess.factor = decimals_or_thousands(column.either);
  else if (!heading.times.empty())
    guess.factor = left_open(fmt::format("its heading says {}: how many of its unit is one", heading.times));
  else if (!heading.other_unit.empty() || (heading.unit_fits && guess.unit.open()))
    guess.factor = unit_of_the_map();
  if (!column.is_date && are_intervals(column.values))
    guess.input = Told{"interval", "its numbers are alike and do not ascend: the time since the row before"};
  return guess;
}

}  // namespace

bool counts_rows(const Values& values) {
  if (values.size() < 3) return false;
  for (std::size_t k = 0; k < values.size(); ++k)
    if (values[k] != std::floor(values[k]) || (k > 0 && values[k] != values[k - 1] + 1.0)) return false;
  return true;
}

namespace {

/// The same, several times from the first number on.
bool counts_again(const Values& values) {
  std::size_t begin = 0, times = 1;
  for (std::size_t k = 1; k < values.size(); ++k) {
    if (values[k] == values[k - 1] + 1.0) continue;
    if (values[k] != values.front() || k - begin < 3) return false;
    begin = k;
    ++times;
  }
  return times > 1 && !values.empty() && values.front() == std::floor(values.front());
}

}  // namespace

TimeGuess time_of(const UnknownTable& table) {
  TimeGuess found;
  std::vector<std::pair<const UnknownColumn*, Heading>> candidates;
  for (const UnknownColumn& column : table.columns)
    if (Heading heading = heading_of(column); heading.quantity != nullptr && heading.quantity->key == "time")
      candidates.emplace_back(&column, std::move(heading));
  const auto numbers = std::ranges::find_if(table.columns, [&](const UnknownColumn& column) {
    return (counts_rows(column.values) || counts_again(column.values)) &&
           (!table.has_headings || names_rows(column.heading()));
  });
  if (candidates.empty() && numbers != table.columns.end()) {
    const SaidStep said = said_step(table);
    const bool of_several =
        counts_again(numbers->values) ||
        std::ranges::any_of(table.part, [](const std::string& part) { return part.starts_with("segment:"); });
    if (said.step_s <= 0.0 && !of_several) {
      found.row_numbers = &*numbers;
      return found;
    }
    const Told step = said.step_s > 0.0 ? Told{domain::write_number(said.step_s), said.reason}
                                        : left_open("time between two rows, in s");
    found.guess = ColumnGuess{&domain::quantity_of("time"),
                              {numbers->name, "it counts the rows"},
                              {"s", step.reason},
                              {},
                              step,
                              {},
                              {}};
    return found;
  }
  for (const UnknownColumn& column : table.texts)
    if (const Heading heading = heading_of(column);
        candidates.empty() && heading.quantity != nullptr && heading.quantity->key == "time") {
      found.guess = ColumnGuess{&domain::quantity_of("time"),
                                left_open(fmt::format("{} holds what is read as no number, such as {}",
                                                      column.name, column.texts.front())),
                                left_open("the unit of the column that you write"),
                                {},
                                {},
                                {},
                                {}};
      return found;
    }
  if (candidates.empty())
    for (const UnknownColumn& column : table.columns)
      if (const Clock clock = clock_of(column.values);
          clock.ascends && clock.step_s > 0.0 &&
          (!table.has_headings || heading_of(column).reason == no_word)) {
        candidates.push_back({&column, {nullptr, "", false, "it ascends from row to row (perhaps)"}});
        break;
      }
  if (candidates.empty()) return found;
  const UnknownColumn* first = candidates.front().first;
  const bool same = std::ranges::all_of(
      candidates, [&](const auto& one) { return alike(first->values, one.first->values); });
  found.guess = guess_of_time(*first, candidates.front().second, said_step(table));
  if (candidates.size() == 1) return found;
  // A clock that stands before each quantity, with another between.
  bool paired = candidates.front().first == &table.columns.front();
  for (std::size_t i = 1; i < candidates.size(); ++i)
    paired = paired && candidates[i].first - candidates[i - 1].first > 1;
  paired = paired && candidates.back().first != &table.columns.back();
  const bool late = paired && std::ranges::any_of(candidates, [&](const auto& one) {
                      const bool named = one.first->heading() == "time of " + one.first[1].heading();
                      return one.first != first && (named || are_late(first->values, one.first->values));
                    });
  if (same && !late) {
    found.guess->column.reason += "; the other columns of time say the same";
    return found;
  }
  if (paired) {
    for (const auto& [column, words] : candidates) found.clocks.push_back(column);
    found.guess->column.reason += "; each quantity stands behind a clock of its own";
    return found;
  }
  std::vector<std::string> names;
  for (const auto& [column, words] : candidates) names.push_back(column->name);
  found.guess->column = left_open(fmt::format("it may be any of: {}", fmt::join(names, "; ")));
  found.guess->unit = left_open("the unit of the column that you write");
  return found;
}

void put_in_order(UnknownTable& table) {
  const TimeGuess time = time_of(table);
  if (!time.guess || time.guess->input) return;
  for (UnknownColumn& column : table.columns)
    if (column.name == time.guess->column.value || std::ranges::count(time.clocks, &column) > 0)
      table.reordered = input::run_on(column.values) || table.reordered;
  const UnknownColumn* stamps = table.find(time.guess->column.value);
  if (stamps == nullptr || !time.clocks.empty()) return;
  const auto same = [&](std::size_t row) {
    const auto repeats = [&](const UnknownColumn& column) {
      return &column == stamps || input::same_number(column.values[row], column.values[row - 1]);
    };
    return std::ranges::all_of(table.columns, repeats) && std::ranges::all_of(table.texts, repeats);
  };
  const input::RowOrder order = input::order_of_rows(stamps->values, same);
  if (order.note.empty()) return;
  UnknownTable some = table.rows(order.rows);
  some.reordered = true;
  const std::string at = order.first > 0 ? fmt::format(" (the first: row {})", order.first + 1) : "";
  some.note += fmt::format("{}{}{}", some.note.empty() ? "" : "; ", order.note, at);
  table = std::move(some);
}

Values seconds_of(const UnknownTable& table, const ColumnGuess& time, std::string* done) {
  const Values* stamps = time.unit.open() ? nullptr : column_of(table, time.column.value);
  if (stamps == nullptr || stamps->empty() || (time.factor && time.factor->open())) return {};
  input::Table one;
  one.columns.push_back({"time_s", time.column.value, 0, *stamps});
  if (time.input) {
    double sum = 0.0;
    for (std::size_t k = 1; k < stamps->size(); ++k) one.columns[0].values[k] = sum += (*stamps)[k];
    one.columns[0].values.front() = 0.0;
  }
  const std::string spread = input::spread_stamps(one, {});
  if (done != nullptr) *done = spread;
  Values seconds = std::move(one.columns[0].values);
  if (time.factor)
    for (double& value : seconds) value *= input::parse_number(time.factor->value).value_or(1.0);
  if (time.unit.value != input::date_unit) input::convert_units(seconds, time.unit.value, "s");
  return seconds;
}

}  // namespace mckibben::recognise
