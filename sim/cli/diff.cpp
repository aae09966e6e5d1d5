// The verb `diff`: two folders of `run` or of `replay` side by side.
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <sim/cli/results.hpp>
#include <sim/cli/run_folders.hpp>
#include <sim/cli/verbs.hpp>
#include <sim/output/grid.hpp>

namespace mckibben::cli {
namespace {

using input::Json;

constexpr std::size_t most_lines = 40;  // of one list in the text; the JSON document holds all

Json json_of(const std::vector<Difference>& list) {
  Json json = Json::array();
  for (const Difference& one : list) {
    Json entry{{"key", one.key}, {"left", one.left}, {"right", one.right}};
    if (one.left.is_number() && one.right.is_number())
      entry["difference"] = one.right.get<double>() - one.left.get<double>();
    json.push_back(std::move(entry));
  }
  return json;
}

Json json_of(const FolderDifference& found) {
  Json runs = Json::array();
  for (const RunDifference& run : found.runs) {
    Json columns = Json::object();
    for (const auto& column : run.columns)
      columns[column.name] = {{"largest", column.largest}, {"at_s", column.at_s}, {"rms", column.rms}};
    runs.push_back({{"run", run.name},
                    {"same", run.same()},
                    {"note", run.note.empty() ? Json(nullptr) : Json(run.note)},
                    {"columns", std::move(columns)},
                    {"metrics", json_of(run.metrics)}});
  }
  return {{"inputs", json_of(found.inputs)},
          {"tuned", json_of(found.tuned)},
          {"runs", std::move(runs)},
          {"only_left", found.only_left},
          {"only_right", found.only_right}};
}

std::string shown(const Json& value) {
  if (value.is_null()) return "-";
  if (value.is_string()) {
    const auto text = value.get<std::string>();
    return text.size() == 64 ? text.substr(0, 12) + "..." : text;  // a digest
  }
  if (value.is_structured()) return "there";
  return value.is_number_float() ? fmt::format("{:.6g}", value.get<double>()) : value.dump();
}

std::string text_of(const char* title, const std::vector<Difference>& list) {
  if (list.empty()) return "";
  output::Grid grid({title, "left", "right"}, 3);
  for (std::size_t i = 0; i < std::min(list.size(), most_lines); ++i)
    grid.add({list[i].key, shown(list[i].left), shown(list[i].right)});
  std::string text = grid.text();
  if (list.size() > most_lines)
    text += fmt::format("  ... and {} more; --json has all\n", list.size() - most_lines);
  return text + "\n";
}

std::string trajectories(const FolderDifference& found) {
  plant::CommandUnit commands{};
  const auto command = [](plant::CommandUnit unit) {
    return plant::Channel{&plant::command_of(unit)}.name();
  };
  for (const auto& [unit, name] : names(commands))
    if (std::ranges::any_of(found.runs, [&](const auto& run) { return run.find(command(unit)) != nullptr; }))
      commands = unit;
  output::Grid grid({"run", "contraction_ratio", "at s", "rms", "muscle bar", "rms",
                     in_unit(commands, "current mA"), "rms"},
                    1);
  std::string notes;
  for (const RunDifference& run : found.runs) {
    if (!run.note.empty()) notes += fmt::format("  {}: {}\n", run.name, run.note);
    if (run.same() || run.columns.empty()) continue;
    std::vector<std::string> row{run.name};
    for (const std::string& name :
         {std::string("contraction_ratio"), std::string("muscle_pressure_bar"), command(commands)}) {
      const ColumnDifference* column = run.find(name);
      const auto cell = [&](double value) { return column ? fmt::format("{:.3g}", value) : "-"; };
      row.push_back(cell(column ? column->largest : 0.0));
      if (row.size() == 2) row.push_back(cell(column ? column->at_s : 0.0));
      row.push_back(cell(column ? column->rms : 0.0));
    }
    grid.add(std::move(row));
  }
  return (grid.empty() ? "" : "largest difference at any tick, and rms over all\n" + grid.text() + "\n") +
         (notes.empty() ? "" : notes + "\n");
}

/// Of each run the numbers that its table shows; the rest is in the JSON document.
std::string metrics(const FolderDifference& found) {
  output::Grid grid({"run", "metric", "left", "right", "right - left"}, 2);
  std::size_t more = 0, lines = 0;
  for (const RunDifference& run : found.runs)
    for (const Difference& one : run.metrics) {
      const bool plain = one.key.find('.') == std::string::npos;
      if (!plain || ++lines > most_lines) {
        ++more;
        continue;
      }
      const bool numbers = one.left.is_number() && one.right.is_number();
      grid.add({run.name, one.key, shown(one.left), shown(one.right),
                numbers ? fmt::format("{:+.3g}", one.right.get<double>() - one.left.get<double>()) : ""});
    }
  return (grid.empty() ? "" : grid.text()) +
         (more > 0 ? fmt::format("  ... and {} more (ledger, solver, ...); --json has all\n", more) : "") +
         (grid.empty() && more == 0 ? "" : "\n");
}

std::string text_of(const FolderDifference& found) {
  std::string text = found.inputs.empty() ? "The inputs are the same.\n\n" : text_of("input", found.inputs);
  text += text_of("tuned", found.tuned) + trajectories(found) + metrics(found);
  for (const auto& name : found.only_left) text += "  only on the left: " + name + "\n";
  for (const auto& name : found.only_right) text += "  only on the right: " + name + "\n";
  if (found.same_runs())
    text += fmt::format("All {} runs are the same to the last digit.\n", found.runs.size());
  return text;
}

struct DiffOptions : Options {
  std::string left, right;
  std::optional<double> tolerance;  ///< largest difference of the contraction ratio that is allowed
};

int compare_folders(const DiffOptions& options) {
  const std::string &left = options.left, &right = options.right;
  const FolderDifference found = compare_run_folders(left, right);
  Json document{{"schema", "mckibben-diff/1"},
                {"left", left},
                {"right", right},
                {"same_inputs", found.inputs.empty()},
                {"same_runs", found.same_runs()}};
  std::string text = fmt::format("left {}, right {}\n\n", left, right) + text_of(found);
  const bool met = !options.tolerance || found.within(*options.tolerance);
  if (options.tolerance) {
    document["tolerance"] = *options.tolerance;
    document["within_tolerance"] = met;
    text += fmt::format("{} the tolerance: contraction ratios {} {:g} at every tick of every run.\n",
                        met ? "Within" : "Not within", met ? "differ by at most" : "do not all stay within",
                        *options.tolerance);
  }
  document.update(json_of(found));
  const std::string json = document.dump(2) + "\n";
  Job job(options, "diff " + left + " " + right, std::nullopt,
          {{(std::filesystem::path(left) / "run.json").string(), ""},
           {(std::filesystem::path(right) / "run.json").string(), ""}});
  job.write("diff.json", json);
  job.write("table.txt", text);
  return job.finish({json, text}, met ? done : criterion_not_met);
}

}  // namespace

void add_diff(CLI::App& app, Asked& asked) {
  CLI::App& verb = add_verb(app, "diff", to_find_out,
                            "Compare two folders that run or replay wrote: inputs, metrics, trajectories");
  DiffOptions& options = asked.when(verb, compare_folders);
  add_input(verb, options.left, "left", "Folder that run or replay wrote", "FOLDER");
  add_input(verb, options.right, "right", "Another one, written by the same verb", "FOLDER");
  add_out(verb, options, "nothing is written");
  add_json(verb, options);
  add_number(
      verb, "--tolerance", options.tolerance, 0, 1,
      "Difference of the contraction ratio that is allowed at any tick; more is exit status 1 (default: any)",
      "RATIO");
  verb.footer(
      "Examples:\n"
      "  mckibben diff out/five_loads out/mine            what differs?\n"
      "  mckibben diff before/ after/ --tolerance 1e-6    has anything changed? for a script\n");
}

}  // namespace mckibben::cli
