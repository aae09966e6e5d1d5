// Runs in a table: cut by columns that say which, and by clocks that begin again; long tables, with one
// reading a row, are turned to a column for each quantity. See columns.hpp.
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <plant/instruments.hpp>
#include <sim/domain/columns.hpp>
#include <sim/domain/number.hpp>
#include <sim/input/arranged.hpp>
#include <sim/input/cells.hpp>
#include <sim/input/dates.hpp>
#include <sim/input/quantity.hpp>
#include <sim/recognise/columns.hpp>
#include <sim/recognise/headings.hpp>

namespace mckibben::recognise {
namespace {

constexpr std::size_t most_runs = 200, most_levels = 20, least_rows = 3, least_block = 5;

/// A column as labels of its rows.
struct Labels {
  explicit Labels(const UnknownColumn& of) : column(&of) {
    std::map<double, std::size_t> rows;
    double before = std::nan("");
    for (const double value : of.values) {
      if (rows.size() > most_runs) break;
      if (std::isnan(value)) continue;
      ++rows[value];
      stretches += value == before ? 0 : 1;
      before = value;
    }
    count = rows.size();
    for (const auto& [value, number] : rows) fewest = std::min(fewest, number);
  }
  bool are_few() const { return count > 1 && count <= most_runs && fewest >= least_rows; }
  bool are_blocks() const { return are_few() && stretches == count && fewest >= least_block; }
  /// As loads are put on one after the other.
  bool are_levels() const { return count > 0 && count <= most_levels && stretches <= 3 * count; }

  const UnknownColumn* column;
  std::size_t count = 0, stretches = 0, fewest = static_cast<std::size_t>(-1);
};

std::string text_of(const UnknownColumn& column, double value) {
  return column.texts.empty() ? domain::write_number(value) : column.texts[static_cast<std::size_t>(value)];
}

std::string filter_of(const UnknownColumn& column, double value) {
  return fmt::format("{}: {}", domain::yaml_scalar(column.name), domain::yaml_scalar(text_of(column, value)));
}

/// The load that a column of masses, or a label, says.
std::optional<LoadGuess> load_of(const UnknownColumn& column, double value) {
  const std::string text = text_of(column, value);
  if (const auto load = load_in(text)) return LoadGuess{*load, fmt::format("its {} says so", column.name)};
  if (!names_a_load(column.name) || !column.texts.empty()) return std::nullopt;
  const std::string unit = heading_of(column).unit;
  if (!column.either.empty())
    return LoadGuess{std::string(domain::fill_in), decimals_or_thousands(column.either).reason};
  if (!unit.empty() && value > 0.0 && input::unit_problem(unit, "kg").empty())
    return LoadGuess{fmt::format("{} {}", text, unit), fmt::format("the column {} says so", column.name)};
  std::vector<double> mass_kg{value};
  if (!unit.empty() && value > 0.0 && input::unit_problem(unit, "N").empty()) {
    input::convert_units(mass_kg, unit, "N");
    return LoadGuess{std::string(domain::fill_in),
                     fmt::format("the column {} says {} {}, a force: {:.5g} kg weighs so much", column.name,
                                 text, unit, mass_kg.front() / plant::gravity_m_per_s2)};
  }
  return LoadGuess{std::string(domain::fill_in),
                   fmt::format("the column {} says {}{}", column.name, text,
                               unit.empty() ? ", without a unit: kg, g, lb, N?" : " " + unit)};
}

void drop(UnknownTable& table, const std::vector<Labels>& which) {
  for (const Labels& each : which)
    for (auto* columns : {&table.columns, &table.texts})
      std::erase_if(*columns, [name = each.column->name](const auto& one) { return one.name == name; });
}

/// The rows of each label, or of each set of them, in the order in which they come; none of unlabelled rows.
std::vector<std::vector<std::size_t>> groups_of(const std::vector<Labels>& labels, std::size_t& stretches) {
  std::map<std::vector<double>, std::size_t> known;
  std::vector<std::vector<std::size_t>> groups;
  std::size_t before = most_runs + 1;
  for (std::size_t row = 0; row < labels.front().column->values.size(); ++row) {
    std::vector<double> here;
    for (const Labels& each : labels) here.push_back(each.column->values[row]);
    if (std::ranges::any_of(here, [](double one) { return std::isnan(one); })) continue;
    const auto [found, is_new] = known.try_emplace(here, groups.size());
    if (is_new) groups.emplace_back();
    groups[found->second].push_back(row);
    stretches += found->second == before ? 0 : 1;
    before = found->second;
  }
  return groups;
}

/// Parts of a table as `segment` numbers them, by a column `cut` or by its clock.
std::vector<UnknownTable> segments_of(const UnknownTable& table, const char* by, const UnknownColumn& column,
                                      const std::vector<std::string>& besides) {
  input::Table whole;
  whole.columns.push_back({by, column.name, 0, column.values});
  const std::vector<std::size_t> parts = input::parts_of(whole);
  std::vector<UnknownTable> runs;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const std::size_t end = i + 1 < parts.size() ? parts[i + 1] : column.values.size();
    std::vector<std::size_t> rows(end - parts[i]);
    std::iota(rows.begin(), rows.end(), parts[i]);
    runs.push_back(table.rows(rows, fmt::format("segment: {}", i + 1)));
    runs.back().part.insert(runs.back().part.end() - 1, besides.begin(), besides.end());
  }
  return runs;
}

void say_restarts(std::vector<UnknownTable>& parts, const std::string& clock) {
  constexpr std::size_t most_said = 5;
  std::vector<std::size_t> rows;
  std::size_t row = 1;
  for (std::size_t i = 0; i + 1 < parts.size(); ++i) {
    row += parts[i].rows();
    if (rows.size() < most_said) rows.push_back(row);
  }
  std::string& note = parts.front().note;
  note += fmt::format("{}{} begins again at row {}{}: {} runs", note.empty() ? "" : "; ", clock,
                      fmt::join(rows, ", "), rows.size() + 1 < parts.size() ? ", ..." : "", parts.size());
}

/// A mark in the first row of each run.
bool is_mark(const Labels& labels) {
  if (labels.count != 2 || !labels.column->texts.empty()) return false;
  const Values& values = labels.column->values;
  std::map<double, bool> single{{values.front(), true}};
  for (std::size_t row = 1; row < values.size(); ++row) {
    single.try_emplace(values[row], true);
    if (values[row] == values[row - 1]) single[values[row]] = false;
  }
  return single.size() == 2 && single.begin()->second != single.rbegin()->second;
}

/// A table with one reading a row, and a column that says of what.
struct Long {
  const UnknownColumn *key = nullptr, *value = nullptr, *unit = nullptr;
};
std::optional<Long> long_table(const UnknownTable& table) {
  const TimeGuess time = time_of(table);
  if (!time.guess || time.guess->column.open() || time.guess->input) return std::nullopt;
  std::vector<const UnknownColumn*> readings, keys;
  Long found;
  const auto names_quantities = [](const UnknownColumn& column) {
    std::set<std::string_view> named;
    for (const std::string& text : column.texts)
      if (const Heading heading = heading_of({text, "", false}); heading.quantity != nullptr)
        named.insert(heading.quantity->key);
    return named.size() > 1;
  };
  for (const UnknownColumn& column : table.columns) {
    const Labels labels(column);
    const Heading heading = heading_of(column);
    const bool is_time = heading.quantity != nullptr && heading.quantity->key == "time";
    if (is_time || labels.count < 2 || names_a_run(column.name) || counts_rows(column.values) ||
        ((names_a_load(column.name) || heading.quantity == nullptr) && labels.are_levels() &&
         !names_a_key(column.name)))
      continue;
    const bool key = names_a_key(column.name) && labels.are_few() && labels.count <= most_levels;
    (key ? keys : readings).push_back(&column);
  }
  for (const UnknownColumn& column : table.texts) {
    const bool units = std::ranges::all_of(
        column.texts, [](const std::string& text) { return !input::unit_word(text).empty(); });
    const Labels labels(column);
    if (units) found.unit = &column;
    if (!units && labels.are_few() && labels.count <= most_levels &&
        (names_a_key(column.name) || names_quantities(column)))
      keys.push_back(&column);
  }
  if (readings.size() != 1 || keys.size() != 1) return std::nullopt;
  found.key = keys.front();
  found.value = readings.front();
  if (heading_of(*found.value).quantity != nullptr && !names_a_key(found.key->name)) return std::nullopt;
  return found;
}

/// A column for each label; rows of one stamp are one.
UnknownTable turned(const UnknownTable& table, const Long& by) {
  const TimeGuess time = time_of(table);
  const UnknownColumn& stamps = *table.find(time.guess->column.value);
  Values instants;
  for (const double stamp : stamps.values)
    if (!std::isnan(stamp)) instants.push_back(stamp);
  std::ranges::sort(instants);
  instants.erase(std::unique(instants.begin(), instants.end()), instants.end());
  const bool value_is_named = heading_of(*by.value).quantity != nullptr;
  std::map<double, UnknownColumn> columns;
  for (std::size_t row = 0; row < stamps.values.size(); ++row) {
    const double label = by.key->values[row];
    if (std::isnan(label) || std::isnan(stamps.values[row])) continue;
    UnknownColumn& column = columns[label];
    if (column.values.empty()) {
      const std::string text = text_of(*by.key, label);
      const bool named = heading_of({text, "", false}).quantity != nullptr || !value_is_named;
      column.name = named ? text : fmt::format("{} {}", by.value->name, text);
      column.unit = by.value->unit;
      if (by.unit != nullptr && !std::isnan(by.unit->values[row]))
        column.unit = input::unit_word(text_of(*by.unit, by.unit->values[row]));
      column.in_file = by.value->name;
      column.where = fmt::format("{{{}}}", filter_of(*by.key, label));
      column.values.assign(instants.size(), std::nan(""));
    }
    const auto at = std::ranges::lower_bound(instants, stamps.values[row]);
    column.values[static_cast<std::size_t>(at - instants.begin())] = by.value->values[row];
  }
  UnknownTable wide = table;
  wide.texts.clear();
  wide.columns = {stamps};
  wide.columns.front().values = std::move(instants);
  for (auto& [label, column] : columns) wide.columns.push_back(std::move(column));
  return wide;
}

/// Days beside a clock that goes on over midnight.
bool goes_on_over(const UnknownColumn& days, const UnknownTable& table) {
  const TimeGuess time = time_of(table);
  const Values time_s = time.guess ? seconds_of(table, *time.guess) : Values{};
  if (time_s.empty() || !std::ranges::all_of(days.texts, input::is_day)) return false;
  double within = 0.0, over = 0.0;  // the longest steps
  for (std::size_t row = 1; row < time_s.size(); ++row) {
    double& longest = days.values[row] == days.values[row - 1] ? within : over;
    longest = std::max(longest, std::abs(time_s[row] - time_s[row - 1]));
  }
  return over <= within;
}

/// By columns that say to which run, or under which load, a row belongs.
std::vector<UnknownTable> cut_by_labels(const UnknownTable& table, const std::optional<Long>& is_long) {
  std::vector<Labels> marks, constant;
  for (const auto* columns : {&table.columns, &table.texts})
    for (const UnknownColumn& column : *columns) {
      const Labels labels(column);
      const bool sensor = !is_long && names_a_sensor(column.name) && labels.count <= most_levels;
      const bool run = (sensor || names_a_run(column.name)) && heading_of(column).quantity == nullptr,
                 load = names_a_load(column.name) && labels.are_levels();
      if ((run || names_a_start(column.name)) && is_mark(labels)) {
        std::vector<UnknownTable> runs =
            segments_of(table, "cut", column, {"cut: " + domain::yaml_scalar(column.name)});
        for (UnknownTable& each : runs) drop(each, {labels});
        return runs;
      }
      const bool key = is_long && (&column == is_long->key || &column == is_long->unit);
      const bool block = !column.texts.empty() && labels.are_blocks() && !names_a_phase(column.name) &&
                         !key && !goes_on_over(column, table);
      if (load && labels.count == 1) constant.push_back(labels);
      if (labels.are_few() && (run || load || block)) marks.push_back(labels);
    }
  std::vector<UnknownTable> runs;
  if (marks.empty()) {
    runs.push_back(table);
  } else {
    std::size_t stretches = 0;
    const auto groups = groups_of(marks, stretches);
    const auto finest = std::ranges::max_element(marks, {}, &Labels::stretches);
    const bool come_again = stretches > groups.size() && stretches * least_rows <= table.rows();
    if (come_again && finest->stretches == stretches && stretches <= most_runs)
      runs =
          segments_of(table, "cut", *finest->column, {"cut: " + domain::yaml_scalar(finest->column->name)});
    else if (come_again || groups.size() > most_runs)
      runs.push_back(table);
    else
      for (const auto& rows : groups) {
        std::vector<std::string> filters;
        for (const Labels& each : marks)
          filters.push_back(filter_of(*each.column, each.column->values[rows.front()]));
        runs.push_back(table.rows(rows, fmt::format("where: {{{}}}", fmt::join(filters, ", "))));
      }
  }
  marks.insert(marks.end(), constant.begin(), constant.end());
  for (UnknownTable& run : runs) {
    for (const Labels& each : marks) {
      const auto column = std::ranges::find(each.column->texts.empty() ? run.columns : run.texts,
                                            each.column->name, &UnknownColumn::name);
      const Labels own(*column);
      const auto first = std::ranges::find_if_not(column->values, [](double one) { return std::isnan(one); });
      if (own.count != 1) continue;
      const std::optional<LoadGuess> load = load_of(*column, *first);
      if (!run.load)
        run.load = load;
      else if (load && load->quantity != run.load->quantity)
        run.load = LoadGuess{std::string(domain::fill_in), run.load->reason + "; and " + load->reason};
    }
    if (runs.size() > 1 || marks.size() == constant.size()) drop(run, marks);
  }
  return runs;
}

/// A line between rows that names a load is about the rows below it: they are a part of their own, by the
/// time at which they begin and end.
std::vector<UnknownTable> cut_by_lines(UnknownTable table) {
  std::vector<Between> lines;
  for (const Between& each : table.between)
    if (masses_in(each.text, false).loads.size() == 1 && each.row < table.rows()) lines.push_back(each);
  const auto load_in_line = [](const std::string& text) { return masses_in(text, false).loads.front(); };
  for (; !lines.empty() && lines.front().row == 0; lines.erase(lines.begin()))
    table.remarks = {lines.front().text};
  const std::optional<LoadGuess> first = load_of(table);
  std::erase_if(lines, [&, load = first ? first->quantity : ""](const Between& each) mutable {
    const bool same = load_in_line(each.text) == load;
    load = load_in_line(each.text);
    return same;
  });
  if (lines.empty()) return {std::move(table)};
  const TimeGuess time = time_of(table);
  const Values time_s = time.guess ? seconds_of(table, *time.guess) : Values{};
  if (time_s.size() != table.rows()) {
    table.load = LoadGuess{std::string(domain::fill_in),
                           fmt::format("line {} says {} of the rows below it; cut there, with from: and to:",
                                       lines.front().line, load_in_line(lines.front().text))};
    return {std::move(table)};
  }
  std::vector<UnknownTable> parts;
  for (std::size_t i = 0; i <= lines.size(); ++i) {
    const std::size_t begin = i == 0 ? 0 : lines[i - 1].row,
                      end = i < lines.size() ? lines[i].row : table.rows();
    std::vector<std::size_t> rows(end - begin);
    std::iota(rows.begin(), rows.end(), begin);
    const auto since = [&](const char* key, std::size_t row) {
      return fmt::format("{}: {:.9g} s", key, time_s[row] - time_s.front());
    };
    parts.push_back(table.rows(rows, i == 0 ? since("to", end - 1) : since("from", begin)));
    UnknownTable& part = parts.back();
    part.between.clear();
    if (i > 0)
      part.load =
          LoadGuess{load_in_line(lines[i - 1].text), fmt::format("line {} says so", lines[i - 1].line)};
    if (i > 0 && i < lines.size()) part.part.push_back(since("to", end - 1));
  }
  return parts;
}

/// Where a line above the first part names its load, one above this that names none may say another.
void say_titles(UnknownTable& part) {
  const auto names_a_mass = [](const std::string& text) { return !masses_in(text, false).loads.empty(); };
  const auto title = std::ranges::find_if(part.between, [](const Between& each) { return each.row == 0; });
  if (part.load || title == part.between.end() || names_a_mass(title->text) ||
      std::ranges::none_of(part.remarks, names_a_mass))
    return;
  part.load =
      LoadGuess{std::string(domain::fill_in),
                fmt::format("line {}, above these rows, names no load: {}", title->line, title->text)};
}

}  // namespace

std::vector<UnknownTable> runs_in(const UnknownTable& table) {
  std::vector<UnknownTable> runs;
  for (UnknownTable& labelled : cut_by_labels(table, long_table(table))) {
    const std::optional<Long> is_long = long_table(labelled);
    if (!is_long) put_in_order(labelled);
    const TimeGuess time = time_of(labelled);
    const UnknownColumn* stamps =
        time.guess && !time.guess->input ? labelled.find(time.guess->column.value) : nullptr;
    bool again = stamps != nullptr && std::ranges::none_of(labelled.part, [](const std::string& said) {
                   return said.starts_with("cut:");
                 });
    if (is_long && again) {  // each reading by itself: they may stand one below the other
      std::map<double, Values> of;
      for (std::size_t row = 0; row < stamps->values.size(); ++row)
        of[is_long->key->values[row]].push_back(stamps->values[row]);
      again = std::ranges::any_of(of, [](const auto& one) {
        input::Table part;
        part.columns.push_back({"time_s", "", 0, one.second});
        return input::parts_of(part).size() > 1;
      });
    }
    std::vector<UnknownTable> parts;
    if (again) parts = segments_of(labelled, "time_s", *stamps, {});
    if (parts.size() < 2) {
      parts.clear();
      parts.push_back(std::move(labelled));
    } else {
      say_restarts(parts, stamps->name);
    }
    for (std::size_t i = 1; i < parts.size(); ++i) say_titles(parts[i]);
    for (UnknownTable& part : parts) {
      const std::optional<Long> own = long_table(part);
      if (own)
        runs.push_back(turned(part, *own));
      else
        for (UnknownTable& cut : cut_by_lines(std::move(part))) runs.push_back(std::move(cut));
    }
  }
  return runs;
}

}  // namespace mckibben::recognise
