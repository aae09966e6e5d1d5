// LabVIEW Measurement files; see the header. What is not in the specification and yet in files: rows end
// before an empty remark, `Samples` tells nothing of the number of rows, and without X columns (X_Columns No)
// there is one nevertheless, with nothing in it.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <sim/domain/number.hpp>
#include <sim/input/cells.hpp>
#include <sim/input/limits.hpp>
#include <sim/input/number.hpp>
#include <sim/input/readers.hpp>
#include <sim/input/suggest.hpp>

namespace mckibben::input {
namespace {

constexpr std::string_view file_mark = "LabVIEW Measurement", segment_mark = "Channels", x_name = "X_Value",
                           comment_name = "Comment";

enum class XColumns { one, none, multi };

class LvmReader {
 public:
  LvmReader(const Source& source, std::span<const WantedColumn> wanted, std::size_t segment,
            TableProblems& problems)
      : source_(source), wanted_(wanted), segment_(segment), problems_(problems) {}

  Table read() {
    while (problems_.count() == 0 && skip_blank()) {
      if (begins_a_file())
        file_header();
      else
        read_segment();
    }
    if (problems_.count() > 0) return std::move(table_);
    if (segment_ > segments_)
      problems_.add({}, fmt::format("segment = {}: the file has {}", segment_, segments_));
    else if (table_.lines.empty())
      problems_.add({}, "there are no rows below the headers");
    return std::move(table_);
  }
  /// Of the segment that was read.
  const std::vector<Cell>& labels() const { return labels_; }

 private:
  /// What a header says: a key, and cells after it.
  struct Entry {
    std::size_t line;
    std::vector<Cell> cells;
  };
  using Header = std::map<std::string, Entry, std::less<>>;
  /// Of a channel: in a column, or evenly.
  struct Times {
    bool wanted = false;  ///< in the place of its values
    std::size_t channel = 0;
    std::optional<std::size_t> column{};
    double begin_s = 0.0, step_s = 0.0;
  };

  std::vector<Cell> cells() const { return split_cells(source_.line(line_), separator_); }
  bool at_end() const { return line_ > source_.lines(); }
  /// Whether nothing stands below this line.
  bool is_last() const {
    for (std::size_t line = line_ + 1; line <= source_.lines(); ++line)
      if (!trimmed(source_.line(line)).empty()) return false;
    return true;
  }
  bool begins_a_file() const { return trimmed(source_.line(line_)).starts_with(file_mark); }
  bool begins_a_header() const {
    return begins_a_file() || source_.line(line_).starts_with(std::string(segment_mark) + separator_);
  }

  /// Goes on to the next line that holds something, over special blocks too. False at the end of the file.
  bool skip_blank() {
    bool special = false;
    for (; !at_end(); ++line_) {
      const std::string_view line = trimmed(source_.line(line_));
      if (line.starts_with("***Start_Special***")) special = true;
      const bool blank = line.find_first_not_of("\t ,") == std::string_view::npos;
      if (!special && !blank) return true;
      if (line.starts_with("***End_Special***")) special = false;
    }
    return false;
  }

  /// Reads up to the end of a header, which must be there.
  Header header() {
    Header found;
    const std::size_t begin = line_;
    for (; skip_blank(); ++line_) {
      if (source_.line(line_).starts_with("***End_of_Header***")) {
        ++line_;
        return found;
      }
      std::vector<Cell> parts = cells();
      if (!parts.empty()) found[std::string(parts.front().text)] = {line_, parts};
    }
    problems_.add({begin, 1},
                  "this header does not end: there is no line ***End_of_Header***; is the file cut off?");
    return found;
  }

  /// Index of the value of `key` among `choices`; the first one if the key is not there.
  std::size_t choice(const Header& found, std::string_view key, std::span<const std::string_view> choices) {
    const auto entry = found.find(key);
    if (entry == found.end()) return 0;
    const std::vector<Cell>& parts = entry->second.cells;
    const Cell given = parts.size() > 1 ? parts[1] : Cell{};
    const auto at = std::find(choices.begin(), choices.end(), given.text);
    if (at != choices.end()) return static_cast<std::size_t>(at - choices.begin());
    problems_.add(source_.place(entry->second.line, given.offset),
                  fmt::format("{} = {} is not one of: {}", key, given.text, join(choices)));
    return 0;
  }

  void file_header() {
    // The separator is named in a line in which it already stands.
    for (std::size_t ahead = line_; ahead <= source_.lines() && !source_.line(ahead).starts_with("***End");
         ++ahead)
      if (source_.line(ahead).starts_with("Separator"))
        separator_ = source_.line(ahead).starts_with("Separator,") ? ',' : '\t';
    const Header found = header();
    constexpr std::string_view separators[] = {"Tab", "Comma"}, x_columns[] = {"One", "No", "Multi"};
    choice(found, "Separator", separators);
    x_columns_ = static_cast<XColumns>(choice(found, "X_Columns", x_columns));
    const auto sign = found.find("Decimal_Separator");
    const bool is_comma = sign != found.end() && trimmed(source_.line(sign->second.line)).ends_with(',');
    const bool is_said = sign != found.end() || separator_ == ',';
    numbers_ = NumberReader(is_comma ? ',' : is_said ? '.' : '\0');
    if (is_comma && separator_ == ',')
      problems_.add({sign->second.line, 1}, "a comma cannot be both the separator and the decimal sign");
    table_.separator = separator_;
  }

  void read_segment() {
    ++segments_;
    Header found;
    if (begins_a_header()) found = header();
    if (problems_.count() > 0 || !skip_blank()) return;
    const bool is_wanted = segment_ == 0 || segment_ == segments_;
    if (is_wanted) find_columns(found);
    if (problems_.count() > 0) return;
    const std::size_t first_row = table_.lines.size();
    for (++line_; !apart_ && skip_blank() && !begins_a_header(); ++line_)
      if (is_wanted) read_row(table_.lines.size() - first_row);
    if (is_wanted && first_row > 0 && table_.lines.size() > first_row) check_goes_on(first_row);
  }

  /// Index of a column by its label, or by its number.
  std::optional<std::size_t> find_label(const WantedColumn& wanted) {
    std::vector<std::string_view> names;
    for (const Cell& label : labels_) names.push_back(label.text);
    const auto found = std::find(names.begin(), names.end(), wanted.in_file);
    if (found != names.end()) {
      const auto index = static_cast<std::size_t>(found - names.begin());
      if (std::find(found + 1, names.end(), wanted.in_file) != names.end())
        problems_.add(source_.place(line_, labels_[index].offset),
                      fmt::format("repeated channel {}: name it by its column's number", wanted.in_file));
      return index;
    }
    std::size_t number = 0;
    const char* const last = wanted.in_file.data() + wanted.in_file.size();
    const auto [end, error] = std::from_chars(wanted.in_file.data(), last, number);
    if (error == std::errc{} && end == last && number >= 1 && number <= names.size()) return number - 1;
    if (wanted.needed)
      problems_.add({line_, 1}, fmt::format("the channel {} is missing{} (found: {})", wanted.in_file,
                                            did_you_mean(wanted.in_file, names), join_few(names)));
    return std::nullopt;
  }

  /// Index of the channel whose times are wanted: of the first, or of that which is named; none: a channel
  /// itself is wanted.
  std::optional<std::size_t> channel_of_times(const WantedColumn& wanted) {
    const auto is = [&](std::string_view name) {
      return [name](const Cell& label) { return label.text == name; };
    };
    if (!wanted.in_file.empty() && std::ranges::any_of(labels_, is(wanted.in_file))) return std::nullopt;
    const auto index = [&](auto found) { return static_cast<std::size_t>(found - labels_.begin()); };
    if (wanted.in_file.empty() || wanted.in_file == lvm_time)
      return index(std::ranges::find_if(
          labels_, [](const Cell& label) { return !label.text.empty() && label.text != x_name; }));
    if (!wanted.in_file.starts_with(lvm_time_of)) return std::nullopt;
    const auto found = std::ranges::find_if(labels_, is(wanted.in_file.substr(lvm_time_of.size())));
    return found == labels_.end() ? std::nullopt : std::optional(index(found));
  }

  void find_columns(const Header& found) {
    labels_ = cells();
    if (!check_columns(labels_.size(), {line_, 1}, problems_)) return;
    std::vector<Table::Column> columns;
    times_.clear();
    for (const WantedColumn& wanted : wanted_) {
      const auto of_times = channel_of_times(wanted);
      const auto index = of_times ? of_times : find_label(wanted);
      if (!index || *index == labels_.size()) continue;
      columns.push_back({wanted.name, wanted.in_file, *index, {}, wanted.may_miss});
      columns.back().own_clock = wanted.own_clock;
      times_.push_back({of_times.has_value(), *index});
    }
    if (std::ranges::any_of(times_, &Times::wanted))
      for (std::size_t i = 0; i < columns.size() && problems_.count() == 0; ++i) {
        find_times(found, columns[i].index, times_[i]);
        if (!times_[i].wanted) continue;
        columns[i].index = times_[i].column.value_or(columns[i].index);
        columns[i].in_file = times_[i].column ? labels_[columns[i].index].text : "X0 + k Delta_X";
      }
    if (problems_.count() > 0) return;
    const auto same = [](const Table::Column& a, const Table::Column& b) {
      return a.name == b.name && a.index == b.index;
    };
    if (table_.columns.empty())
      table_.columns = std::move(columns);
    else if (!std::equal(columns.begin(), columns.end(), table_.columns.begin(), table_.columns.end(), same))
      problems_.add({line_, 1},
                    fmt::format("segment {} has other channels than those before; name the one that "
                                "is wanted: segment: {}",
                                segments_, segments_));
  }

  /// Where the times of a channel stand, or from what they are counted.
  void find_times(const Header& found, std::size_t index, Times& times) {
    const bool has_x = labels_.front().text == x_name;
    const std::size_t channel =
        x_columns_ == XColumns::multi ? index / 2 : index - (has_x && index > 0 ? 1 : 0);
    check_is_time(found, channel);
    if (x_columns_ == XColumns::none) {
      times.begin_s = entry_number(found, "X0", channel);
      times.step_s = entry_number(found, "Delta_X", channel);
    } else {
      times.column = x_columns_ == XColumns::one || index == 0 ? 0 : index - 1;
    }
  }

  void check_is_time(const Header& found, std::size_t channel) {
    const auto entry = found.find("X_Dimension");
    if (entry == found.end() || channel + 1 >= entry->second.cells.size()) return;
    const Cell& dimension = entry->second.cells[channel + 1];
    if (!dimension.text.empty() && dimension.text != "Time")
      problems_.add(source_.place(entry->second.line, dimension.offset),
                    fmt::format("X_Dimension = {}: X must be time", dimension.text));
  }

  /// The number of a channel in a header.
  double entry_number(const Header& found, std::string_view key, std::size_t channel) {
    const auto entry = found.find(key);
    if (entry == found.end()) {
      problems_.add({line_, 1},
                    fmt::format("there are no X columns (X_Columns No), and {} is not in the header", key));
      return std::nan("");
    }
    return number(key, entry->second.line, entry->second.cells, channel + 1);
  }

  double number(std::string_view name, std::size_t line, const std::vector<Cell>& row, std::size_t index) {
    const Cell cell = index < row.size() ? row[index] : Cell{};
    std::string problem;
    const auto value = numbers_.read(name, cell, problem);
    if (!value) problems_.add(source_.place(line, cell.offset), problem);
    return value.value_or(std::nan(""));
  }

  void read_row(std::size_t row_of_segment) {
    const std::vector<Cell> row = cells();
    const auto lacks = [&](const Table::Column& column) { return column.index >= row.size(); };
    if (!table_.lines.empty() && std::ranges::any_of(table_.columns, lacks) && is_last()) {
      problems_.note({line_, 1}, "this last row is cut off: not read");
      return;
    }
    if (row.empty() || row.size() > labels_.size())
      problems_.add({line_, 1}, row.empty() ? std::string("a quote is opened but not closed in this row")
                                            : fmt::format("this row has {} cells; there are {} columns",
                                                          row.size(), labels_.size()));
    table_.lines.push_back(line_);
    for (std::size_t i = 0; i < table_.columns.size(); ++i) {
      Table::Column& column = table_.columns[i];
      if (times_[i].wanted)
        column.values.push_back(time(times_[i], row, row_of_segment));
      else if (column.may_miss && column.index < row.size() && is_missing(row[column.index]))
        column.values.push_back(std::nan(""));
      else
        column.values.push_back(number(column.in_file, line_, row, column.index));
    }
    check_clocks(row, row_of_segment);
  }

  /// Of a channel in a row, since the first that is read; NaN where the row has none.
  double time(const Times& times, const std::vector<Cell>& row, std::size_t row_of_segment) {
    double at_s = times.begin_s + static_cast<double>(row_of_segment) * times.step_s;
    if (times.column) {
      const Cell cell = *times.column < row.size() ? row[*times.column] : Cell{};
      at_s = is_missing(cell) ? std::nan("") : number(x_name, line_, row, *times.column);
    }
    if (!begin_s_ && !std::isnan(at_s)) {
      begin_s_ = at_s;
      if (at_s != 0.0)
        problems_.note({line_, 1}, fmt::format("X begins at {} s; times are those since this row",
                                               domain::write_number(at_s)));
    }
    return at_s - begin_s_.value_or(0.0);
  }

  /// Channels that are read at one time were measured then.
  void check_clocks(const std::vector<Cell>& row, std::size_t row_of_segment) {
    const Table::Column* common = table_.find("time_s");
    if (common == nullptr) return;
    const Times& of_all = times_[static_cast<std::size_t>(common - table_.columns.data())];
    for (std::size_t i = 0; i < times_.size() && of_all.wanted && !apart_; ++i) {
      const Table::Column& column = table_.columns[i];
      if (times_[i].wanted || column.own_clock) continue;
      const double own_s = time(times_[i], row, row_of_segment), common_s = common->values.back();
      if (std::isnan(column.values.back()) || std::abs(own_s - common_s) <= lvm_same_s) continue;
      apart_ = true;
      problems_.add(
          {line_, 1},
          fmt::format("{0} has another clock than {1}: {2} s in this row, where that has {3} s; write "
                      "columns: {{time: {{column: {4}, unit: s}}}}, and time: \"{5}{0}\" in the place "
                      "of {0}",
                      column.in_file, labels_[of_all.channel].text, domain::write_number(own_s),
                      domain::write_number(common_s), lvm_time, lvm_time_of));
    }
  }

  void check_goes_on(std::size_t first_row) {
    const Table::Column* time = table_.find("time_s");
    if (time != nullptr && time->values[first_row] <= time->values[first_row - 1])
      problems_.add(
          table_, *time, first_row,
          fmt::format("time begins again here, in segment {}; name the one that is wanted: segment: {}",
                      segments_, segments_));
  }

  const Source& source_;
  std::span<const WantedColumn> wanted_;
  std::size_t segment_;
  TableProblems& problems_;

  std::size_t line_ = 1, segments_ = 0;
  char separator_ = '\t';
  XColumns x_columns_ = XColumns::one;
  NumberReader numbers_;
  std::vector<Cell> labels_;
  std::vector<Times> times_;  ///< of each column
  std::optional<double> begin_s_;
  bool apart_ = false;  ///< two columns have not one clock
  Table table_;
};

}  // namespace

Table read_lvm(const Source& source, std::span<const WantedColumn> wanted, std::size_t segment,
               TableProblems& problems) {
  if (!check_text(source, problems)) return {};
  return LvmReader(source, wanted, segment, problems).read();
}

std::vector<std::string> lvm_channels(const Source& source) {
  Problems problems;
  TableProblems found(source, problems);
  LvmReader reader(source, {}, 1, found);
  reader.read();
  std::vector<std::string> names;
  for (const Cell& label : reader.labels())
    if (!label.text.empty() && label.text != x_name && label.text != comment_name)
      names.emplace_back(label.text);
  return names;
}

}  // namespace mckibben::input
