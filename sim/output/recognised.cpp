// Files and words; see the header.
#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include <sim/domain/columns.hpp>
#include <sim/input/dataset_file.hpp>
#include <sim/input/json.hpp>
#include <sim/output/grid.hpp>
#include <sim/output/json_parts.hpp>
#include <sim/output/recognised.hpp>

namespace mckibben::output {
namespace {

using recognise::ColumnGuess, recognise::MapGuess, recognise::Recognised, recognise::RunGuess,
    recognise::Setting, recognise::Told;

constexpr const char* how_to_go_on =
    "# Each comment gives the source of the value below it. Correct what is wrong. FILL_IN marks unknown "
    "values:\n"
    "# `mckibben check` shows each place, and nothing is simulated before all are filled in.\n";

/// A comment in a line of YAML: headings may hold anything.
std::string as_comment(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return c < 0x20 || c == 0x7F; }, ' ');
  return "# " + text;
}

std::string reasons_of(const ColumnGuess& guess) {
  std::string text = guess.column.reason + "; " + guess.unit.reason;
  for (const auto* told : {&guess.zero, &guess.factor, &guess.missing, &guess.input, &guess.time})
    if (*told)
      text += "; " +
              std::string(told == &guess.zero      ? "zero: "
                          : told == &guess.factor  ? "factor: "
                          : told == &guess.time    ? "time: "
                          : told == &guess.missing ? "missing: "
                                                   : "") +
              (*told)->reason;
  return text;
}

std::string place_of(const ColumnGuess& guess) {
  std::string text =
      fmt::format("{}: {{column: {}, unit: {}", guess.quantity->key,
                  domain::yaml_scalar(guess.in_file.empty() ? guess.column.value : guess.in_file),
                  domain::yaml_scalar(guess.unit.value));
  if (!guess.where.empty()) text += ", where: " + guess.where;
  if (guess.zero) text += ", zero: " + guess.zero->value;
  if (guess.factor) text += ", factor: " + guess.factor->value;
  if (guess.missing) text += ", missing: " + guess.missing->value;
  if (guess.input) text += ", as: " + guess.input->value;
  if (guess.time) text += ", time: " + domain::yaml_scalar(guess.time->value);
  return text + "}";
}

/// Which of a map's columns are written.
enum class Which { all, of_each, others };

std::string columns_yaml(const Recognised& found, const MapGuess& map, Which which,
                         const std::string& indent) {
  const auto wanted = [&](bool of_each) {
    return which == Which::all || of_each == (which == Which::of_each);
  };
  std::string text;
  for (const ColumnGuess& guess : map.columns)
    if (wanted(found.each_has(guess.quantity->key)))
      text += fmt::format("{0}{1}\n{0}{2}\n", indent, as_comment(reasons_of(guess)), place_of(guess));
  if (map.rows && wanted(found.each_has_rows()))
    text += fmt::format("{0}{1}\n{0}{2}: {3}\n", indent, as_comment(map.rows->told.reason), map.rows->key,
                        map.rows->told.value);
  if (which == Which::others) return text;
  for (const std::string& remark : map.remarks) text += fmt::format("{}{}\n", indent, as_comment(remark));
  for (const Told& each : map.ignored)
    text +=
        fmt::format("{}{}\n", indent, as_comment(fmt::format("not used: {}: {}", each.value, each.reason)));
  return text;
}

std::string run_yaml(const Recognised& found, std::size_t i, const std::filesystem::path& folder) {
  const RunGuess& run = found.runs[i];
  const std::string file =
      std::filesystem::weakly_canonical(found.tables[i].path).lexically_relative(folder).generic_string();
  std::string text;
  if (run.load) text += fmt::format("  {}\n", as_comment(run.load->reason));
  text += fmt::format("  - id: {}\n    file: {}\n", domain::yaml_scalar(run.id), domain::yaml_scalar(file));
  for (const std::string& part : found.tables[i].part) text += "    " + part + "\n";
  if (run.load) text += fmt::format("    load: {}\n", run.load->value);
  const std::string own =
      columns_yaml(found, found.maps[run.map], run.map > 0 ? Which::all : Which::others, "      ");
  if (!own.empty())
    text += fmt::format("    # {}\n    columns:\n{}",
                        run.map > 0 ? "its columns have other names" : "not all runs have these", own);
  return text;
}

std::string value_of(const Told& told) {
  return told.open() ? told.value + " (to be filled in)" : told.value;
}

}  // namespace

std::string dataset_yaml(const Recognised& found, const std::filesystem::path& folder,
                         const std::string& rig) {
  std::string text = fmt::format(
      "# What {} table{} seem{} to hold, written by `mckibben import`.\n{}schema: {}\nrig: {}\n",
      found.tables.size(), found.tables.size() == 1 ? "" : "s", found.tables.size() == 1 ? "s" : "",
      how_to_go_on, input::dataset_schema, domain::yaml_scalar(rig));
  for (const Setting& each : found.dataset)
    text += fmt::format("\n{}\n{}: {}\n", as_comment(each.told.reason), each.key, each.told.value);
  text += "\ncolumns:\n" + columns_yaml(found, found.maps.front(), Which::of_each, "  ") + "\nruns:\n";
  for (std::size_t i = 0; i < found.runs.size(); ++i) text += run_yaml(found, i, folder);
  return text;
}

std::string rig_yaml(const Recognised& found, const std::string& base) {
  std::string text = fmt::format(
      "# The rig as far as its tables say, written by `mckibben import`.\n{}"
      "# What is not said here is the base's: mckibben schema rig --format yaml shows every value.\n"
      "schema: {}\nbase: {}\n",
      how_to_go_on, input::rig_schema, domain::yaml_scalar(base));
  std::string section, sensor;
  for (const Setting& each : found.rig) {
    const std::size_t dot = each.key.find('.');
    const std::string part = dot == std::string::npos ? "" : each.key.substr(0, dot);
    if (part != section && !part.empty()) text += part + ":\n";
    section = part;
    std::string indent = part.empty() ? "" : "  ", key = part.empty() ? each.key : each.key.substr(dot + 1);
    if (part == "sensors") {
      const std::string signal = key.substr(0, key.find('.'));
      if (signal != std::exchange(sensor, signal)) text += "  - signal: " + signal + "\n";
      indent = "    ";
      key = key.substr(signal.size() + 1);
    }
    text += fmt::format("{0}{1}\n{0}{2}: {3}\n", indent, as_comment(each.told.reason), key, each.told.value);
  }
  return text;
}

std::string table_of(const Recognised& found, const std::string& where) {
  std::string text =
      fmt::format("{} table{} read\n", found.tables.size(), found.tables.size() == 1 ? "" : "s");
  for (std::size_t m = 0; m < found.maps.size(); ++m) {
    if (m > 0) {
      const auto one = std::find_if(found.runs.begin(), found.runs.end(),
                                    [&](const RunGuess& run) { return run.map == m; });
      text += fmt::format("\nother columns, as in {}\n", one->id);
    }
    text += "\n";
    for (const ColumnGuess& guess : found.maps[m].columns)
      text += fmt::format("  {}\n      {}\n", place_of(guess), reasons_of(guess));
    for (const std::string& remark : found.maps[m].remarks) text += fmt::format("  {}\n", remark);
    for (const Told& each : found.maps[m].ignored)
      text += fmt::format("  not used: {}: {}\n", each.value, each.reason);
    if (const auto& rows = found.maps[m].rows)
      text += fmt::format("  {}: {}\n      {}\n", rows->key, rows->told.value, rows->told.reason);
  }
  Grid runs({"run", "load", "why"}, 3);
  for (const RunGuess& run : found.runs)
    runs.add({run.id, run.load ? value_of(*run.load) : "-", run.load ? run.load->reason : ""});
  text += "\n" + runs.text() + "\n";
  for (const auto* settings : {&found.dataset, &found.rig})
    for (const Setting& each : *settings)
      text += fmt::format("  {}: {}\n      {}\n", each.key, each.told.value, each.told.reason);
  const std::size_t open = found.open();
  std::string zeros;
  for (const MapGuess& map : found.maps)
    for (const ColumnGuess& guess : map.columns)
      if (guess.zero && guess.zero->doubtful) zeros += (zeros.empty() ? " " : ", ") + guess.column.value;
  text += open > 0
              ? fmt::format("\n{} value{} to be filled in (FILL_IN) in {}; then: mckibben check {}\n", open,
                            open == 1 ? " is" : "s are", where, where)
              : fmt::format("\n{}; next: mckibben check {}\n",
                            zeros.empty() ? "All values are known"
                                          : "No value is missing, but a load may hang at the zero of" + zeros,
                            where);
  return text;
}

namespace {

input::Json told_json(const Told& told) {
  return {{"value", told.value}, {"reason", told.reason}, {"open", told.open()}};
}

input::Json map_json(const MapGuess& map) {
  input::Json json{{"columns", input::Json::object()}, {"not_used", input::Json::object()}};
  for (const ColumnGuess& guess : map.columns) {
    input::Json& column = json["columns"][std::string(guess.quantity->key)];
    column = {{"column", told_json(guess.column)}, {"unit", told_json(guess.unit)}};
    if (guess.zero) column["zero"] = told_json(*guess.zero);
    if (guess.factor) column["factor"] = told_json(*guess.factor);
    if (guess.missing) column["missing"] = told_json(*guess.missing);
    if (guess.input) column["as"] = told_json(*guess.input);
    if (guess.time) column["time"] = told_json(*guess.time);
    if (!guess.where.empty()) column["where"] = guess.where;
  }
  for (const Told& each : map.ignored) json["not_used"][each.value] = each.reason;
  if (map.rows) json[map.rows->key] = told_json(map.rows->told);
  return json;
}

}  // namespace

std::string json_of(const Recognised& found) {
  std::vector<domain::InputFile> inputs;
  for (const auto& table : found.tables) inputs.push_back(table.input);
  input::Json json = heading_json("mckibben-import/1", inputs);
  json["open"] = found.open();
  for (const MapGuess& map : found.maps) json["maps"].push_back(map_json(map));
  for (const RunGuess& run : found.runs) {
    input::Json each{{"id", run.id}, {"map", run.map}};
    for (const std::string& part : found.tables[json["runs"].size()].part) each["part"].push_back(part);
    if (run.load) each["load"] = told_json(*run.load);
    json["runs"].push_back(std::move(each));
  }
  for (const char* which : {"dataset", "rig"}) {
    json[which] = input::Json::object();
    for (const Setting& each : which[0] == 'd' ? found.dataset : found.rig)
      json[which][each.key] = told_json(each.told);
  }
  return text_of(json);
}

}  // namespace mckibben::output
