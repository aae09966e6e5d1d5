// By the readers that data sets are read with; see the header.
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include <fmt/format.h>

#include <sim/domain/columns.hpp>
#include <sim/domain/number.hpp>
#include <sim/formats/mat_file.hpp>
#include <sim/input/column_hints.hpp>
#include <sim/input/dates.hpp>
#include <sim/input/diagnostics.hpp>
#include <sim/input/limits.hpp>
#include <sim/input/number.hpp>
#include <sim/input/readable.hpp>
#include <sim/input/readers.hpp>
#include <sim/input/spelling.hpp>
#include <sim/input/text_layout.hpp>
#include <sim/recognise/columns.hpp>
#include <sim/recognise/headings.hpp>
#include <sim/recognise/settings.hpp>
#include <sim/recognise/unknown_table.hpp>

namespace mckibben::recognise {
namespace {

using input::Cell, input::Source;

/// A column as it grows, row by row.
struct Growing {
  UnknownColumn column;
  input::ClockReader clock;
  input::EpochReader epoch;
  std::size_t numbers = 0, dates = 0, words = 0, empty = 0, first_empty = 0;
  std::vector<double> times, texts;                  ///< of `known`, by their places
  std::map<std::string, double, std::less<>> known;  ///< none: there are too many
  bool few_words = true;
  std::string cell_unit, first_word;
  std::size_t first_line = 0;

  void add(const Cell& cell, input::NumberReader& reader, std::size_t line) {
    std::string problem;
    Cell bare = cell;
    const bool same_unit = input::take_unit(bare, cell_unit);
    const auto number = same_unit ? epoch.read("", bare, reader, problem) : std::nullopt;
    const auto time = number ? std::nullopt : clock.read("", cell, problem);
    numbers += number ? 1 : 0;
    dates += time ? 1 : 0;
    if (input::is_missing(cell) && empty++ == 0) first_empty = line;
    if (!number && !time && !input::is_missing(cell) && words++ == 0) {
      first_word = cell.text.substr(0, 40);
      first_line = line;
    }
    column.values.push_back(number.value_or(std::nan("")));
    if (dates > 0) times.resize(column.values.size(), std::nan(""));
    if (time) times.back() = *time;
    word(cell.text);
  }
  /// Words that come again may be labels.
  void word(std::string_view text) {
    constexpr std::size_t most_words = 200, longest = 60;
    if (!few_words) return;
    auto found = known.find(text);
    if (found == known.end() && !text.empty()) {
      few_words = known.size() < most_words && text.size() <= longest;
      if (!few_words) {
        known.clear();
        texts = {};
        return;
      }
      found = known.emplace(text, static_cast<double>(known.size())).first;
      column.texts.emplace_back(text);
    }
    texts.push_back(text.empty() ? std::nan("") : found->second);
  }
  /// Numbers, or dates, for the most part.
  bool is_of_use() {
    column.epoch = epoch.taken_off().value_or("");
    if (dates > numbers && dates > words) {
      column.is_date = true;
      times.resize(column.values.size(), std::nan(""));
      column.values = std::move(times);
      column.texts.clear();
      return true;
    }
    if (numbers == 0 || numbers < words) return false;
    if (empty > 0)
      column.odd = fmt::format("{} of its {} cells are empty, the first in line {}", empty,
                               column.values.size(), first_empty);
    if (words > 0)
      column.odd = fmt::format("{} of its {} cells hold no number, such as {} in line {}", words,
                               column.values.size(), first_word, first_line);
    if (column.unit.empty()) column.unit = cell_unit;
    column.texts.clear();
    leave_out_marks();
    return true;
  }
  /// -9999 and the like: numbers that come again, far beyond all others.
  void leave_out_marks() {
    constexpr double far = 10.0;
    for (const bool low : {true, false}) {
      const Range all = range_of(column.values);
      const double mark = low ? all.low : all.high;
      Values others = column.values;
      std::ranges::replace(others, mark, std::nan(""));
      const Range rest = range_of(others);
      const double gap = low ? rest.low - mark : mark - rest.high;
      if (std::ranges::count(column.values, mark) < 2 || rest.high == rest.low ||
          gap < far * (rest.high - rest.low) ||
          std::abs(mark) < far * std::max(std::abs(rest.low), std::abs(rest.high)))
        continue;
      column.missing = domain::write_number(mark);
      column.values = std::move(others);
      return;
    }
  }
};

void keep(std::vector<Growing>& all, UnknownTable& table) {
  for (Growing& each : all) {
    if (each.is_of_use()) {
      table.columns.push_back(std::move(each.column));
    } else if (each.few_words && !each.known.empty()) {
      each.column.values = std::move(each.texts);
      table.texts.push_back(std::move(each.column));
    } else if (input::names_time(each.column.heading()) && each.words > 0) {  // stamps of another kind
      each.column.texts = {each.first_word};
      each.column.values.assign(each.column.values.size(), std::nan(""));
      table.texts.push_back(std::move(each.column));
    } else if (!each.column.name.empty())
      table.words.push_back(each.column.name);
    each = {};
  }
}

[[noreturn]] void refuse(const Source& source, input::Place place, std::string why) {
  throw input::BadInput({{input::Severity::error, source.name(), place, std::move(why), ""}});
}

/// Headings beyond the rows with a number in the line below, as an oscilloscope has `Start` and `Increment`.
void add_settings_beside(const Source& source, const input::TextLayout& layout, UnknownTable& table) {
  if (layout.heading == 0) return;
  const auto names = input::split_cells(source.line(layout.heading), layout.separator),
             values = input::split_cells(source.line(layout.heading + 1), layout.separator);
  for (std::size_t i = layout.headings.size(); i < std::min(names.size(), values.size()); ++i)
    if (!names[i].text.empty() && input::is_number_like(values[i].text))
      table.settings.push_back({std::string(names[i].text), std::string(values[i].text)});
}

/// A quantity in each row, its name before its numbers.
void refuse_rows_of_quantities(const Source& source, const input::TextLayout& layout,
                               const std::vector<Growing>& all) {
  constexpr std::size_t most_quantities = 12, least_instants = 20;
  if (all.size() < least_instants || all.front().column.texts.empty() || all.front().numbers > 0 ||
      all.front().column.values.size() > most_quantities)
    return;
  const auto& names = all.front().column.texts;
  if (std::ranges::any_of(names, [](const std::string& name) {
        const Heading heading = heading_of({name, "", false});
        return heading.quantity != nullptr && heading.quantity->key == "time";
      }))
    refuse(
        source, {layout.first_row, 1},
        "each quantity stands in a row; they are wanted in columns: transpose the table and save it again");
}

/// Control characters, as of a code page that nobody knows: no YAML takes them.
bool is_unprintable(std::string_view heading) {
  for (std::size_t at = 0; at < heading.size(); ++at) {
    const auto byte = static_cast<unsigned char>(heading[at]);
    const bool c1 =
        byte == 0xC2 && at + 1 < heading.size() && static_cast<unsigned char>(heading[at + 1]) < 0xA0;
    if (byte < 0x20 || byte == 0x7F || c1) return true;
  }
  return false;
}

void read_text(const Source& source, UnknownTable& table) {
  const input::TextLayout layout = input::layout_of(source, {});
  if (!layout.problem.empty()) refuse(source, {layout.problem_line, 1}, layout.problem);
  table.has_headings = layout.heading > 0;
  table.note = input::note_of_thinned(source);
  for (std::size_t line = 1; line < layout.head; ++line) {
    if (input::trimmed(source.line(line)).empty()) continue;
    table.remarks.emplace_back(source.line(line));
    if (const auto said = setting_in(source.line(line))) table.settings.push_back(*said);
  }
  if (layout.between > 0) table.words.push_back(fmt::format("line {}", source.line_in_file(layout.between)));
  if (layout.unread > 0) table.words.push_back(fmt::format("line {}", layout.unread));
  if (layout.footer > 0)
    table.words.push_back(fmt::format("line {} and those below", source.line_in_file(layout.footer)));
  add_settings_beside(source, layout, table);
  std::vector<Growing> all(layout.headings.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    const std::string& heading = layout.headings[i];
    const bool again = std::count(layout.headings.begin(), layout.headings.end(), heading) > 1;
    all[i].column.name =
        heading.empty() || again || is_unprintable(heading) ? std::to_string(i + 1) : heading;
    if (again || is_unprintable(heading)) all[i].column.label = heading;
    all[i].column.unit = layout.units[i];
  }
  const input::Look look = input::look_at(source, layout);
  if (look.another_heading > 0) refuse(source, {look.another_heading, 1}, std::string(input::another_table));
  if (look.blank_cells > 0) refuse(source, {look.blank_cells, 1}, std::string(input::lost_between_blanks));
  const auto note = [&](const std::string& lost) { table.note += (table.note.empty() ? "" : "; ") + lost; };
  if (look.short_rows > 0) note(look.note_of_short_rows(source.line_in_file(look.first_short)));
  if (look.summaries > 0) note(look.note_of_summaries(source.line_in_file(look.first_summary)));
  table.decimal = look.decimal;
  std::vector<input::NumberReader> readers;
  for (std::size_t i = 0; i < all.size(); ++i) {
    readers.emplace_back(look.columns[i].decimal);
    all[i].column.either = look.columns[i].either;
  }
  for (std::size_t line = layout.first_row; line <= layout.last_row; ++line) {
    const input::Line kind = input::kind_of(source, layout, line);
    if (kind == input::Line::remark && !all.empty() && !all.front().column.values.empty())
      table.between.push_back(
          {all.front().column.values.size(), source.line_in_file(line), std::string(source.line(line))});
    if (kind != input::Line::row) continue;
    const std::vector<Cell> cells = input::row_cells(source, layout, line);
    if (look.lacks_cells(layout, cells)) continue;
    if (cells.size() > all.size())
      refuse(source, {line, 1},
             fmt::format(
                 "this row has {} cells; those above have {}: if another table begins here, put each into "
                 "a file of its own",
                 cells.size(), all.size()));
    for (std::size_t i = 0; i < all.size(); ++i)
      all[i].add(i < cells.size() ? cells[i] : Cell{}, readers[i], source.line_in_file(line));
  }
  refuse_rows_of_quantities(source, layout, all);
  keep(all, table);
}

std::vector<input::WantedColumn> wanted_of_labview(const Source& source) {
  std::vector<input::WantedColumn> wanted;
  for (auto& name : input::lvm_channels(source))
    wanted.push_back({name, name, false, true, input::CellKind::number, true});
  return wanted;
}

/// How many runs its segments are: one, if its time goes on over all.
std::size_t runs_of_labview(const Source& source) {
  std::vector<input::WantedColumn> wanted = wanted_of_labview(source);
  wanted.push_back({"time_s", "", true});
  for (std::size_t segment = 0;; ++segment) {
    input::Problems problems;
    input::TableProblems said(source, problems);
    input::read_lvm(source, wanted, segment, said);
    if (said.count() == 0 && segment == 0) return 1;
    if (said.count() > 0 && segment > 0) return std::max<std::size_t>(segment - 1, 1);
  }
}

/// Clocks of the channels, where they have not one: each stands before its channel.
void read_labview(const Source& source, std::size_t segment, UnknownTable& table) {
  const std::vector<input::WantedColumn> channels = wanted_of_labview(source);
  std::vector<input::WantedColumn> wanted;
  for (const input::WantedColumn& channel : channels) {
    const std::string clock =
        wanted.empty() ? std::string(input::lvm_time) : std::string(input::lvm_time_of) + channel.name;
    wanted.push_back({clock, clock, false, true});
    wanted.push_back(channel);
  }
  input::Problems problems;
  input::Table found;
  {
    input::TableProblems said(source, problems);
    found = input::read_lvm(source, wanted, segment, said);
  }
  problems.raise();
  const std::vector<double>* last = nullptr;
  const auto same = [&](const std::vector<double>& clock) {
    return last != nullptr && std::ranges::equal(clock, *last, [](double a, double b) {
             return !(std::abs(a - b) > input::lvm_same_s);  // or one has none here
           });
  };
  for (std::size_t i = 0; i < found.columns.size(); ++i) {
    const bool clock = i % 2 == 0;
    if (clock && same(found.columns[i].values)) continue;
    if (clock) last = &found.columns[i].values;
    table.columns.push_back({found.columns[i].name, clock ? "s" : "", false, "", found.columns[i].values});
  }
  table.time_is_inside = found.columns.empty() || table.columns.size() == 1 + found.columns.size() / 2;
  if (table.time_is_inside && !table.columns.empty()) table.columns.erase(table.columns.begin());
}

/// Vectors of the greatest length; shorter ones are settings.
void read_matlab(const Source& source, UnknownTable& table) {
  std::vector<std::string> names;
  std::vector<formats::MatContents::Vector> vectors;
  std::vector<formats::Found> found;
  try {
    const formats::MatContents contents = formats::read_mat(source.text(), {});
    vectors = contents.vectors;
    if (vectors.empty() && !contents.objects.empty())
      refuse(source, input::nowhere, contents.objects.front());
    for (const std::string& object : contents.objects) table.words.push_back(object);
    for (const auto& each : vectors) names.push_back(each.name);
    found = formats::read_mat(source.text(), names).found;
  } catch (const formats::BadFile& bad) {
    refuse(source, input::nowhere, bad.what());
  }
  std::size_t rows = 0;
  for (const formats::Found& each : found) rows = std::max(rows, each.values.size());
  for (std::size_t i = 0; i < found.size() && rows > 1; ++i) {
    if (found[i].values.size() == rows)
      table.columns.push_back({names[i], "", false, "", std::move(found[i].values), vectors[i].label});
    else
      table.words.push_back(names[i]);
  }
}

std::string no_numbers_in(const Source& source) {
  const std::string_view begin = input::trimmed(std::string_view(source.text()).substr(0, 1000));
  const bool json = begin.starts_with('{') || begin.starts_with('[');
  return std::string("no column of numbers is found in it") +
         (json ? "; this looks like JSON, of which records are read, [{\"t\": 0, \"p\": 1.2}, ...]: write it "
                 "as "
                 "such, or as CSV"
               : "");
}

/// `segment`: of an .lvm; 0: all.
UnknownTable read_one(const std::filesystem::path& path, const Source& source, std::size_t segment) {
  UnknownTable table;
  table.path = path;
  table.input = {source.name(), source.sha256()};
  const auto format = input::format_of(path.string(), source.text());
  if (format != input::Format::mat) {
    input::Problems problems;
    {
      input::TableProblems said(source, problems);
      input::check_text(source, said);
    }
    problems.raise();
  }
  if (format != input::Format::text && source.thinned().step > 1)
    refuse(source, input::nowhere, "too large to be read; save each run in a file of its own");
  if (format == input::Format::text) read_text(source, table);
  if (format == input::Format::lvm) read_labview(source, segment, table);
  if (format == input::Format::mat) read_matlab(source, table);
  if (table.columns.empty()) refuse(source, input::nowhere, no_numbers_in(source));
  return table;
}

}  // namespace

const UnknownColumn* UnknownTable::find(const std::string& name) const {
  const auto found = std::ranges::find(columns, name, &UnknownColumn::name);
  return found == columns.end() ? nullptr : &*found;
}

UnknownTable UnknownTable::rows(const std::vector<std::size_t>& which, const std::string& says) const {
  UnknownTable some = *this;
  if (!says.empty()) some.part.push_back(says);
  some.between.clear();
  for (const Between& each : std::ranges::is_sorted(which) ? between : std::vector<Between>{})
    if (const auto row = std::ranges::lower_bound(which, each.row); row != which.end())
      some.between.push_back({static_cast<std::size_t>(row - which.begin()), each.line, each.text});
  for (auto* list : {&some.columns, &some.texts})
    for (UnknownColumn& column : *list) {
      std::vector<double> values;
      for (const std::size_t row : which) values.push_back(column.values[row]);
      column.values = std::move(values);
    }
  return some;
}

std::vector<UnknownTable> read_unknown(const std::filesystem::path& path, std::uintmax_t together) {
  std::vector<UnknownTable> tables;
  const std::vector<input::LoadedSheet> sheets = input::load_tables(path, together);
  for (const auto& [name, source] : sheets) {
    const bool labview = input::format_of(path.string(), source.text()) == input::Format::lvm;
    const std::size_t segments = labview ? runs_of_labview(source) : 1;
    for (std::size_t i = 1; i <= segments; ++i) {
      tables.push_back(read_one(path, source, segments > 1 ? i : 0));
      tables.back().sheet = name;
      if (sheets.size() > 1) tables.back().part.push_back("sheet: " + domain::yaml_scalar(name));
      if (segments > 1) tables.back().part.push_back(fmt::format("segment: {}", i));
    }
  }
  return tables;
}

}  // namespace mckibben::recognise
