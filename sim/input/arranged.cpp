// See the header.
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include <sim/domain/number.hpp>
#include <sim/input/arranged.hpp>
#include <sim/input/cells.hpp>
#include <sim/input/column_units.hpp>
#include <sim/input/number.hpp>
#include <sim/input/row_order.hpp>
#include <sim/input/suggest.hpp>

namespace mckibben::input {
namespace {

using domain::ColumnMap, domain::ColumnPlace, domain::Run;

constexpr std::string_view stamps_name = "time_s", cut_name = "cut", of_run = "of the run";
constexpr double falls_back = 0.5;  // of what has passed: less is one stamp that is wrong

std::string filter_name(std::string_view of, const std::string& column) {
  return fmt::format("where {} {}", of, column);
}
std::string clock_name(std::string_view of) {
  return fmt::format("time of {}", of);
}

/// Keeps the rows that are named, in that order.
void take_rows(Table& table, const std::vector<std::size_t>& rows) {
  const auto pick = [&](auto& values) {
    if (values.empty()) return;
    auto picked = values;
    picked.clear();
    for (const std::size_t row : rows) picked.push_back(values[row]);
    values = std::move(picked);
  };
  for (Table::Column& column : table.columns) pick(column.values);
  pick(table.lines);
  table.parts.clear();
}

/// 5 in "5 kg".
std::optional<double> number_in(std::string_view label) {
  Cell cell{label, 0};
  std::string unit;
  take_unit(cell, unit);
  return parse_number(cell.text);
}

/// Whether a row holds these texts. Numbers are compared as such: 1 is 1.0.
class Filter {
 public:
  Filter(const Table& table, std::string_view of, const domain::RowFilter& where) {
    for (const auto& [column, text] : where.cells)
      if (const Table::Column* found = table.find(filter_name(of, column))) {
        std::vector<double> labels;
        for (const auto& [label, number] : found->labels)
          if (label == text || (parse_number(text) && number_in(label) == parse_number(text)))
            labels.push_back(number);
        tests_.push_back({found, std::move(labels)});
      }
  }
  bool operator()(std::size_t row) const {
    return std::ranges::all_of(tests_, [&](const auto& test) {
      return std::ranges::count(test.second, test.first->values[row]) > 0;
    });
  }

 private:
  std::vector<std::pair<const Table::Column*, std::vector<double>>> tests_;
};

void add_filter(std::vector<WantedColumn>& wanted, std::string_view of, const domain::RowFilter& where) {
  for (const auto& [column, text] : where.cells)
    wanted.push_back({filter_name(of, column), column, true, true, CellKind::label});
}

/// Parts begin where a label changes; a single row with another one is the mark of a part that begins with
/// it.
void add_cuts(const std::vector<double>& labels, std::vector<std::size_t>& parts) {
  std::size_t begin = 0;  // of the stretch with one label
  bool marked = labels.size() > 1 && labels[1] != labels[0];
  for (std::size_t row = 1; row < labels.size(); ++row) {
    if (labels[row] == labels[row - 1]) continue;
    const bool was_mark = marked && row - begin == 1;
    if (!was_mark) parts.push_back(row);
    marked = !was_mark;
    begin = row;
  }
}

/// Whether stamps fall back here by most of what has passed, and go on from there.
bool begins_anew(const std::vector<double>& time, std::size_t begin, std::size_t row) {
  constexpr std::size_t least_rows = 3;
  if (row < begin + least_rows || row + 1 >= time.size() || time[row + 1] < time[row]) return false;
  if (time[row + 1] > time[row - 1]) return false;  // a single stamp is wrong
  const double passed = time[row - 1] - time[begin];
  return passed > 0.0 && time[row - 1] - time[row] > falls_back * passed;
}

/// The rows of each quantity that a long table holds one below the other; none if it is no long one.
std::vector<std::vector<std::size_t>> rows_of_quantities(const Table& table, const ColumnMap& map) {
  std::vector<std::vector<std::size_t>> all;
  for (const domain::Quantity& quantity : domain::quantities()) {
    const ColumnPlace& place = map[quantity];
    if (place.absent() || place.where.absent()) continue;
    const Filter counts(table, quantity.key, place.where);
    auto& rows = all.emplace_back();
    for (std::size_t row = 0; row < table.rows(); ++row)
      if (counts(row)) rows.push_back(row);
  }
  return all;
}

/// Whether each quantity of a long table has a clock that goes on.
bool goes_on(const Table& table, const ColumnMap& map) {
  const Table::Column* time = table.find(stamps_name);
  const auto all = rows_of_quantities(table, map);
  return time != nullptr && !all.empty() && std::ranges::all_of(all, [&](const auto& rows) {
           Table own;
           own.columns.push_back(*time);
           take_rows(own, rows);
           return parts_of(own).size() == 1;
         });
}

std::string list_of(const Table& table, const std::vector<std::size_t>& parts,
                    const TableProblems& problems) {
  std::string text;
  for (std::size_t i = 1; i < std::min<std::size_t>(parts.size(), 5); ++i)
    text += fmt::format("{}{}", i > 1 ? ", " : "",
                        table.lines.empty() ? parts[i] + 1 : problems.line_in_file(table.lines[parts[i]]));
  return text + (parts.size() > 5 ? ", ..." : "");
}

}  // namespace

bool has_own_clocks(const ColumnMap& map) {
  return std::ranges::any_of(domain::quantities(), [&](const domain::Quantity& quantity) {
    const ColumnPlace& place = map[quantity];
    return !place.absent() && place.has_own_clock();
  });
}

std::vector<WantedColumn> wanted_besides(const ColumnMap& map, const Run& run) {
  std::vector<WantedColumn> wanted;
  add_filter(wanted, of_run, run.where);
  if (!run.cut.empty()) wanted.push_back({std::string(cut_name), run.cut, true, true, CellKind::label});
  for (const domain::Quantity& quantity : domain::quantities()) {
    const ColumnPlace& place = map[quantity];
    if (place.absent()) continue;
    add_filter(wanted, quantity.key, place.where);
    if (!place.time.empty())
      wanted.push_back({clock_name(quantity.key), place.time, true, true, CellKind::stamp});
  }
  return wanted;
}

std::vector<std::size_t> parts_of(const Table& table) {
  std::vector<std::size_t> parts{0}, marks;
  const Table::Column* time = table.find(stamps_name);
  if (const Table::Column* cut = table.find(cut_name)) {
    add_cuts(cut->values, marks);
  } else if (time != nullptr) {
    // What stands between rows begins a part only where the clock does.
    for (std::size_t row = 1; row < time->values.size(); ++row)
      if (begins_anew(time->values, parts.back(), row)) parts.push_back(row);
    return parts;
  } else {
    marks = table.parts;
  }
  parts.insert(parts.end(), marks.begin(), marks.end());
  return parts;
}

void keep_where(Table& table, const Run& run, TableProblems& problems) {
  if (table.rows() == 0 || run.where.absent()) return;
  std::vector<std::size_t> rows;
  const Filter counts(table, of_run, run.where);
  for (std::size_t row = 0; row < table.rows(); ++row)
    if (counts(row)) rows.push_back(row);
  if (!rows.empty()) return take_rows(table, rows);
  const auto& [column, text] = *run.where.cells.begin();
  std::vector<std::string_view> labels;
  for (const auto& [label, number] : table.find(filter_name(of_run, column))->labels) labels.push_back(label);
  problems.add({}, fmt::format("where: no row has {} in {} (found: {})", text, column, join_few(labels)));
}

void drop_missing(Table& table, const ColumnMap& map, plant::CommandUnit commands, TableProblems& problems) {
  for (Table::Column& column : table.columns) {
    const domain::Quantity* quantity = named_quantity(column.name, map, commands);
    const std::string mark = quantity == nullptr ? "" : map[*quantity].missing;
    if (mark.empty()) continue;
    if (const auto number = parse_number(mark))
      std::ranges::replace(column.values, *number, std::nan(""));
    else
      problems.add({}, fmt::format("missing = {} of {} is not a number", mark, column.in_file));
  }
}

void order_rows(Table& table, const ColumnMap& map, TableProblems& problems) {
  const Table::Column* time = table.find(stamps_name);
  if (time == nullptr || map["time"].as == domain::Role::interval) return;
  for (Table::Column& column : table.columns)
    if (column.kind == CellKind::stamp || column.kind == CellKind::date) run_on(column.values);
  if (has_own_clocks(map)) return;
  const RowOrder order = order_of_rows(time->values, [&](std::size_t row) {
    return std::ranges::all_of(table.columns, [&](const Table::Column& column) {
      return &column == time || same_number(column.values[row], column.values[row - 1]);
    });
  });
  if (!order.note.empty()) {
    problems.note(table.lines.empty() ? nowhere : Place{table.lines[order.first], 1}, order.note);
    take_rows(table, order.rows);
  }
  const auto lost = std::ranges::find_if(time->values, [](double stamp) { return std::isnan(stamp); });
  if (lost != time->values.end())
    problems.add(table, *time, static_cast<std::size_t>(lost - time->values.begin()),
                 fmt::format("{} is missing here", time->in_file));
}

void keep_segment(Table& table, const ColumnMap& map, const Run& run, TableProblems& problems) {
  if (table.rows() == 0) return;
  const bool intervals = map["time"].as == domain::Role::interval;
  const std::vector<std::size_t> parts =
      run.cut.empty() && (intervals || goes_on(table, map)) ? std::vector<std::size_t>{0} : parts_of(table);
  if (run.segment == 0 && parts.size() > 1) {
    const std::string mark = run.cut.empty() ? std::string("the clock begins again") : run.cut + " changes";
    return problems.add(
        table.lines.empty() ? nowhere : Place{table.lines[parts[1]], 1},
        fmt::format("{} here, so that the file holds {} runs (they begin at lines {}); name each in "
                    "a run of its own: segment: 1 to segment: {}",
                    mark, parts.size(), list_of(table, parts, problems), parts.size()));
  }
  const auto segment = static_cast<std::size_t>(run.segment);
  if (segment > parts.size())
    return problems.add({}, fmt::format("segment = {}: the file has {}", run.segment, parts.size()));
  if (segment > 0) {
    std::vector<std::size_t> rows;
    const std::size_t end = segment < parts.size() ? parts[segment] : table.rows();
    for (std::size_t row = parts[segment - 1]; row < end; ++row) rows.push_back(row);
    take_rows(table, rows);
  }
  Table::Column* time = table.find(stamps_name);
  if (time == nullptr) return;
  if (intervals) {
    double sum = 0.0;
    for (std::size_t row = 0; row < time->values.size(); ++row) {
      if (row > 0) sum += time->values[row];
      time->values[row] = sum;
    }
  }
}

std::string spread_stamps(Table& table, const ColumnMap& map) {
  Table::Column* time = table.find(stamps_name);
  if (time == nullptr) return "";
  Spread done;
  const auto all = rows_of_quantities(table, map);
  if (all.empty()) done = spread(time->values);
  for (const std::vector<std::size_t>& rows : all) {
    std::vector<double> stamps;
    for (const std::size_t row : rows) stamps.push_back(time->values[row]);
    const Spread own = spread(stamps);
    done = {done.repeats + own.repeats, done.rounded || own.rounded};
    for (std::size_t k = 0; k < rows.size(); ++k) time->values[rows[k]] = stamps[k];
  }
  if (done.repeats > 0)
    return fmt::format(
        "{} repeats {} of {} stamps: a coarse clock; rows of one stamp are taken to lie evenly "
        "up to the next",
        time->in_file, done.repeats, time->values.size());
  return done.rounded ? fmt::format("{} is rounded; rows are taken to lie evenly", time->in_file) : "";
}

void merge_clocks(Table& table, const ColumnMap& map, const plant::Rig& rig) {
  struct Series {
    Table::Column* column;
    std::vector<std::pair<double, std::size_t>> stamps;  ///< and their rows
    bool given;
  };
  if (!has_own_clocks(map)) return;
  if (map.rows_are_ticks && table.find(stamps_name) == nullptr) {
    Table::Column ticks{.name = std::string(stamps_name), .in_file = "", .values = {}};
    for (std::size_t row = 0; row < table.rows(); ++row)
      ticks.values.push_back(static_cast<double>(row) * rig.tick_s);
    table.columns.push_back(std::move(ticks));
  }
  const Table::Column* common = table.find(stamps_name);
  std::vector<Series> all;
  if (common == nullptr) return;
  std::vector<double> instants;
  for (Table::Column& column : table.columns) {
    if (column.name == stamps_name || column.kind == CellKind::label) continue;
    const auto& quantities = domain::quantities(rig.command_unit());
    const domain::Quantity* found = named_quantity(column.name, map, rig.command_unit());
    if (const auto ours = std::ranges::find(quantities, column.name, &domain::Quantity::column);
        found == nullptr && ours != quantities.end())
      found = &*ours;  // under its own name
    if (found == nullptr) continue;
    const ColumnPlace& place = map[*found];
    const Table::Column* clock = place.time.empty() ? common : table.find(clock_name(found->key));
    const Filter counts(table, found->key, place.where);
    Series series{&column, {}, map.gives(*found) || found->is_command()};
    for (std::size_t row = 0; row < column.values.size(); ++row)
      if (!std::isnan(clock->values[row]) && !std::isnan(column.values[row]) && counts(row)) {
        series.stamps.emplace_back(clock->values[row] - place.late_s, row);
        instants.push_back(series.stamps.back().first);
      }
    std::ranges::stable_sort(series.stamps, {}, &std::pair<double, std::size_t>::first);
    all.push_back(std::move(series));
  }
  // What drives the rig is known from its first stamp to its last.
  for (const Series& series : all)
    if (series.given && !series.stamps.empty())
      std::erase_if(instants, [&](double at) {
        return at < series.stamps.front().first || at > series.stamps.back().first;
      });
  std::ranges::sort(instants);
  constexpr double same_s = 1e-9;
  instants.erase(
      std::unique(instants.begin(), instants.end(), [](double a, double b) { return b - a < same_s; }),
      instants.end());
  std::vector<std::size_t> lines(table.lines.empty() ? 0 : instants.size());
  for (const Series& series : all) {
    std::vector<double> values(instants.size(), std::nan(""));
    auto at = series.stamps.begin();
    for (std::size_t k = 0; k < instants.size(); ++k) {
      while (at != series.stamps.end() && at->first < instants[k] - same_s) ++at;
      if (at == series.stamps.end() || at->first > instants[k] + same_s) continue;
      values[k] = series.column->values[at->second];
      if (!lines.empty() && lines[k] == 0) lines[k] = table.lines[at->second];
    }
    series.column->values = std::move(values);
  }
  for (Table::Column& column : table.columns)  // clocks and labels have served
    if (std::ranges::none_of(all, [&](const Series& one) { return one.column == &column; }))
      column.name.clear();
  for (std::size_t k = 0; k < lines.size(); ++k)
    if (lines[k] == 0) lines[k] = k > 0 ? lines[k - 1] : table.lines.front();
  Table::Column time = *common;
  time.name = stamps_name;
  time.values = std::move(instants);
  std::erase_if(table.columns, [](const Table::Column& column) { return column.name.empty(); });
  table.columns.insert(table.columns.begin(), std::move(time));
  table.lines = std::move(lines);
}

void keep_window(Table& table, const Run& run, TableProblems& problems) {
  const Table::Column* time = table.find(stamps_name);
  if (time == nullptr || (run.from_s == 0.0 && run.to_s == 0.0) || time->values.empty()) return;
  constexpr double slack_s = 1e-9;
  const double begin_s = time->values.front() + run.from_s - slack_s,
               end_s = run.to_s > 0.0 ? time->values.front() + run.to_s + slack_s : time->values.back();
  std::vector<std::size_t> rows;
  for (std::size_t row = 0; row < time->values.size(); ++row)
    if (time->values[row] >= begin_s && time->values[row] <= end_s) rows.push_back(row);
  if (rows.empty())
    return problems.add(
        {}, fmt::format("from {} s to {} s there is no row; the file goes from {:.6g} s to {:.6g} s",
                        domain::write_number(run.from_s), domain::write_number(run.to_s), 0.0,
                        time->values.back() - time->values.front()));
  take_rows(table, rows);
}

}  // namespace mckibben::input
