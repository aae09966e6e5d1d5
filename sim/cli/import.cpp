// The verb `import`: tables that nobody has described yet, as a data set and a rig to correct.
#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <sim/cli/results.hpp>
#include <sim/cli/verbs.hpp>
#include <sim/input/file_names.hpp>
#include <sim/input/number.hpp>
#include <sim/input/rigs.hpp>
#include <sim/input/source.hpp>
#include <sim/output/folder.hpp>
#include <sim/output/recognised.hpp>

namespace mckibben::cli {
namespace {

namespace fs = std::filesystem;

struct ImportOptions : Options {
  std::vector<std::string> files;
  std::string rig;
};

/// The tables of a folder, by their names; other files are none.
std::vector<fs::path> tables_of(const std::vector<std::string>& files) {
  constexpr std::array endings{".csv", ".tsv", ".txt",  ".dat", ".asc",  ".log",
                               ".lvm", ".mat", ".xlsx", ".xls", ".tdms", ""};
  std::vector<fs::path> tables;
  for (const fs::path file : files) {
    std::error_code ignored;
    if (!fs::is_directory(file, ignored)) {
      tables.push_back(file);
      continue;
    }
    std::vector<fs::path> inside;
    std::set<std::string> folders, others;  // what is inside instead
    for (const auto& entry : fs::directory_iterator(file)) {
      const std::string ending = input::lower(entry.path().extension().string());
      const std::string name = entry.path().stem().string();  // ~$: a lock of a spreadsheet that is open
      const bool no_ending = ending.size() > 1 && std::isdigit(static_cast<unsigned char>(ending[1])) != 0;
      if (entry.is_directory()) folders.insert(entry.path().filename().string());
      if (!entry.is_regular_file() || name.starts_with('.') || name.starts_with("~$") ||
          name.starts_with("README") || name.starts_with("LICENSE"))
        continue;
      if (no_ending || std::ranges::find(endings, ending) != endings.end())
        inside.push_back(entry.path());
      else
        others.insert(ending);
    }
    if (inside.empty())
      throw input::MissingInput(fmt::format(
          "{}: no table is in this folder{}{}", file.string(),
          others.empty() ? "" : fmt::format("; {} is read as none: save it as CSV", fmt::join(others, ", ")),
          folders.empty() ? "" : fmt::format("; name the folders in it: {}", fmt::join(folders, ", "))));
    std::ranges::sort(inside);
    tables.insert(tables.end(), inside.begin(), inside.end());
  }
  return tables;
}

/// The name of what the files are: their folder's, or that of a single file.
std::string name_of(const std::vector<std::string>& files) {
  const fs::path first = fs::absolute(files.front());
  const fs::path named = files.size() == 1 ? first.stem() : first.parent_path().filename();
  return input::made_file_safe(named.string()) + "-import";
}

/// A rig as a file in `folder` names it: by its own name, or by where it is from there.
std::string rig_from(const fs::path& folder, const std::string& rig) {
  if (input::is_shipped(rig)) return rig;
  const std::string path = fs::weakly_canonical(rig).lexically_relative(folder).generic_string();
  return path.find('/') == std::string::npos ? "./" + path : path;
}

int import_tables(const ImportOptions& options) {
  std::vector<domain::InputFile> read;
  recognise::KnownRig known;
  if (!options.rig.empty()) {
    const plant::Rig rig = input::read_rig(options.rig, read);
    known = {rig.tick_s, rig.muscle.rest_length_m, rig.holds_a_length(), rig.valve};
  }
  const auto found = recognise::recognise(tables_of(options.files), !options.rig.empty(), known);
  for (const auto& table : found.tables) read.push_back(table.input);
  std::string words = "import";
  for (const auto& file : options.files) words += " " + file;
  Job job(options, words, name_of(options.files), read);
  const fs::path folder = output::result_path(job.where());
  const std::string document = output::json_of(found), table = output::table_of(found, job.where().string());
  const std::string base = options.rig.empty() ? "thesis" : rig_from(folder, options.rig);
  job.write("dataset.yaml", output::dataset_yaml(found, folder, found.rig.empty() ? base : "rig.yaml"));
  if (!found.rig.empty()) job.write("rig.yaml", output::rig_yaml(found, base));
  job.write("understood.svg", output::picture_of(found));
  job.write("import.json", document);
  job.write("table.txt", table);
  return job.finish({document, table}, done);
}

}  // namespace

void add_import(CLI::App& app, Asked& asked) {
  CLI::App& verb =
      add_verb(app, "import", to_compare,
               "Look at measured tables and write a data set and a rig of them, to be corrected");
  ImportOptions& options = asked.when(verb, import_tables);
  verb.add_option("files", options.files, "Tables, or folders of them: text, .xlsx, .xls, .lvm, .tdms, .mat")
      ->required()
      ->type_name("FILE");
  add_rig(verb, options.rig, "they were measured on (default: one is written, to be filled in)");
  add_out(verb, options, "out/<folder>-import");
  add_json(verb, options);
  verb.footer(
      "Examples:\n"
      "  mckibben import bench/*.csv --out my_bench\n"
      "  mckibben import load_5kg_run2.csv --rig my_rig.yaml\n"
      "Every guess has its reason; unknown values are FILL_IN, which `check` refuses.\n");
}

}  // namespace mckibben::cli
