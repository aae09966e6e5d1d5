// What is left open in what was recognised, as often as the files say it; see recognise.hpp.
#include <algorithm>

#include <sim/recognise/recognise.hpp>

namespace mckibben::recognise {
namespace {

bool is_open(const std::string& part) {
  return part.find(domain::fill_in) != std::string::npos;
}

/// In one line of columns; of a long table that says the file's column, and which rows.
std::size_t open_in(const ColumnGuess& guess) {
  std::size_t count = guess.in_file.empty() && guess.column.open() ? 1 : 0;
  count += (guess.unit.open() ? 1 : 0) + (is_open(guess.where) ? 1 : 0);
  for (const auto* told : {&guess.zero, &guess.factor, &guess.time})
    count += *told && (*told)->open() ? 1 : 0;
  return count;
}

}  // namespace

const ColumnGuess* MapGuess::find(std::string_view key) const {
  const auto found = std::find_if(columns.begin(), columns.end(),
                                  [&](const ColumnGuess& each) { return each.quantity->key == key; });
  return found == columns.end() ? nullptr : &*found;
}

bool Recognised::each_has(std::string_view key) const {
  return std::ranges::all_of(maps, [&](const MapGuess& map) { return map.find(key) != nullptr; });
}

bool Recognised::each_has_rows() const {
  return std::ranges::all_of(
      maps, [](const MapGuess& map) { return map.rows.has_value() || map.find("time") != nullptr; });
}

std::size_t Recognised::open() const {
  std::size_t count = 0;
  for (std::size_t m = 0; m < maps.size(); ++m) {
    const auto runs_of = static_cast<std::size_t>(std::ranges::count(runs, m, &RunGuess::map));
    const auto lines = [&](bool each) { return m == 0 && each ? 1 : runs_of; };
    for (const ColumnGuess& guess : maps[m].columns)
      count += open_in(guess) * lines(each_has(guess.quantity->key));
    if (maps[m].rows && maps[m].rows->told.open()) count += lines(each_has_rows());
  }
  for (const UnknownTable& table : tables)
    count += static_cast<std::size_t>(std::ranges::count_if(table.part, is_open));
  for (const RunGuess& run : runs) count += run.load && run.load->open() ? 1 : 0;
  for (const auto* settings : {&dataset, &rig})
    count += static_cast<std::size_t>(
        std::ranges::count_if(*settings, [](const Setting& each) { return each.told.open(); }));
  return count;
}

}  // namespace mckibben::recognise
