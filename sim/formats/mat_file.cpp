// Looking up vectors among the arrays of a MAT-file; see the header.
#include <algorithm>
#include <charconv>
#include <utility>

#include <fmt/format.h>

#include <sim/formats/mat_arrays.hpp>
#include <sim/formats/mat_file.hpp>
#include <sim/formats/mat_hdf5.hpp>

namespace mckibben::formats {
namespace {

constexpr std::size_t most_names = 10000;

std::string_view kind_of(const MatArray& array) {
  if (array.is_complex) return "complex";
  switch (array.kind) {
    case MatClass::cell:
      return "a cell array";
    case MatClass::structure:
      return "a struct";
    case MatClass::text:
      return "text";
    case MatClass::sparse:
      return "sparse";
    case MatClass::object:
    case MatClass::opaque:
      return "an object (a table, a timeseries)";
    default:
      return "not numeric";
  }
}

/// The numeric arrays in a variable: its own, or those of its fields, of each of several structs.
void list(const MatArray& array, const std::string& name, const std::string& label, MatContents& contents) {
  constexpr std::size_t most_structs = 1000;
  if (contents.names.size() >= most_names) return;
  if (array.is_numeric()) {
    const bool flat = array.sizes.size() == 2;
    contents.add(name, label, flat ? array.sizes[0] : 0, flat ? array.sizes[1] : 0);
  }
  if (const std::string kind = array.object_class(); !kind.empty() && !name.empty())
    contents.objects.push_back(about_object(name, kind));
  if (!array.is_struct()) return;
  const std::size_t count = std::min(array.count(), most_structs);
  for (std::size_t i = 0; i < count; ++i) {
    const auto fields = array.fields(i);
    std::string own = label;  // as Simulink calls a signal
    for (const auto& [field, inside] : fields)
      if ((field == "label" || field == "signalName") && inside.kind == MatClass::text) own = inside.text();
    for (const auto& [field, inside] : fields)
      list(inside, fmt::format("{}{}.{}", name, count > 1 ? fmt::format("({})", i + 1) : "", field),
           field == "time" ? "" : own, contents);
  }
}

MatArray variable(const MatVariables& variables, std::string_view name) {
  for (std::size_t i = 0; i < variables.size(); ++i)
    if (MatArray array = variables[i]; array.name == name) return array;
  throw BadFile(fmt::format("there is no variable {}", name));
}

/// `signals(2)` as `signals` and 2; 0 where no element is named.
std::pair<std::string_view, std::size_t> split_element(std::string_view name) {
  const auto open_at = name.find('(');
  if (open_at == std::string_view::npos || !name.ends_with(')')) return {name, 0};
  std::size_t element = 0;
  std::from_chars(name.data() + open_at + 1, name.data() + name.size() - 1, element);
  return {name.substr(0, open_at), element};
}

MatArray array_at(const MatVariables& variables, std::string_view path) {
  auto [first, element] = split_element(path.substr(0, path.find('.')));
  MatArray array = variable(variables, first);
  for (std::size_t dot = path.find('.'); dot != std::string_view::npos;) {
    const std::size_t next = std::min(path.find('.', dot + 1), path.size());
    const auto part = split_element(path.substr(dot + 1, next - dot - 1));
    const std::string_view of = path.substr(0, dot);
    if (const std::string kind = array.object_class(); !kind.empty()) throw BadFile(about_object(of, kind));
    if (!array.is_struct()) throw BadFile(fmt::format("{} is not a struct", of));
    const std::size_t count = array.count();
    if (element > count || count == 0 || (element == 0 && count != 1))
      throw BadFile(fmt::format("{} is an array of {} structs; name one: {}(1)", of, count,
                                of.substr(0, of.find_last_of('('))));
    auto fields = array.fields(element == 0 ? 0 : element - 1);
    element = part.second;
    const auto found =
        std::find_if(fields.begin(), fields.end(), [&](const auto& one) { return one.first == part.first; });
    if (found == fields.end()) throw BadFile(fmt::format("{} has no field {}", of, part.first));
    array = std::move(found->second);
    dot = next == path.size() ? std::string_view::npos : next;
  }
  return array;
}

std::vector<double> values(const MatVariables& variables, std::string_view where) {
  const auto [path, column] = split_column(where);
  const MatArray array = array_at(variables, path);
  if (const std::string kind = array.object_class(); !kind.empty()) throw BadFile(about_object(path, kind));
  if (!array.is_numeric())
    throw BadFile(fmt::format("{} is {}; wanted is a vector of real numbers", path, kind_of(array)));
  if (array.count() > most_numbers)
    throw BadFile(
        fmt::format("{} says it has more than {} numbers, which is more than is read", path, most_numbers));
  if (array.sizes.size() != 2)
    throw BadFile(fmt::format("{} has {} dimensions; wanted is a vector", path, array.sizes.size()));
  if (array.count() == 0) throw BadFile(fmt::format("{} is empty", path));
  const std::size_t rows = array.sizes[0], columns = array.sizes[1];
  if (column > columns) throw BadFile(fmt::format("{} has {} columns", path, columns));
  if (column > 0) return array.numbers((column - 1) * rows, rows);
  if (rows != 1 && columns != 1)
    throw BadFile(fmt::format("{} has {} rows and {} columns; name one: {}(:,1)", path, rows, columns, path));
  return array.numbers(0, array.count());
}

}  // namespace

std::pair<std::string_view, std::size_t> split_column(std::string_view where) {
  const auto open_at = where.find("(:,");
  if (open_at == std::string_view::npos || !where.ends_with(')')) return {where, 0};
  const std::string_view digits = where.substr(open_at + 3, where.size() - open_at - 4);
  std::size_t column = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), column);
  if (error != std::errc{} || end != digits.data() + digits.size() || column == 0)
    throw BadFile(
        fmt::format("{} is no column: write {}(:,2) for the second", where, where.substr(0, open_at)));
  return {where.substr(0, open_at), column};
}

std::string about_object(std::string_view name, std::string_view kind) {
  std::string there;
  if (kind == "timeseries")
    there = fmt::format("t = {0}.Time; x = squeeze({0}.Data); save('run.mat', 't', 'x', '-v7')", name);
  else if (kind == "table" || kind == "timetable")
    there = fmt::format("write{}({}, 'run.csv')", kind, name);
  else if (kind.starts_with("Simulink."))
    there = fmt::format(
        "take each signal's timeseries, such as ts = {}.get(1).Values, then t = ts.Time; x = "
        "squeeze(ts.Data); "
        "save('run.mat', 't', 'x', '-v7')",
        name);
  else
    there = "save its numbers as vectors with -v7";
  return fmt::format("{} is an object of class {}, which only MATLAB opens; there: {}", name, kind, there);
}

void MatContents::add(const std::string& name, const std::string& label, std::size_t rows,
                      std::size_t columns) {
  constexpr std::size_t most_columns = 100;
  names.push_back(name);
  const bool matrix = rows > 1 && columns > 1;
  for (std::size_t k = 1; matrix && k <= std::min(columns, most_columns); ++k)
    vectors.push_back(
        {fmt::format("{}(:,{})", name, k), label.empty() ? "" : fmt::format("{} {}", label, k)});
  if (!matrix) vectors.push_back({name, label});
}

MatContents read_mat(const std::string& bytes, const std::vector<std::string>& wanted) {
  if (is_mat_hdf5(bytes)) return read_mat_hdf5(bytes, wanted);
  const MatVariables variables(bytes);
  MatContents contents;
  for (const std::string& where : wanted) {
    Found& found = contents.found.emplace_back();
    try {
      found.values = values(variables, where);
    } catch (const BadFile& bad) {
      found.problem = bad.what();
    }
  }
  for (std::size_t i = 0; i < variables.size() && contents.names.size() < most_names; ++i)
    list(variables[i], variables[i].name, "", contents);
  return contents;
}

}  // namespace mckibben::formats
