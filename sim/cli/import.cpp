// The verb `import`: tables that nobody has described yet, as a data set and a rig to correct.
#include <filesystem>
#include <string>
#include <vector>

#include <sim/cli/results.hpp>
#include <sim/cli/verbs.hpp>
#include <sim/input/file_names.hpp>
#include <sim/input/rigs.hpp>
#include <sim/output/folder.hpp>
#include <sim/output/recognised.hpp>

namespace mckibben::cli {
namespace {

namespace fs = std::filesystem;

struct ImportOptions : Options {
  std::vector<std::string> files;
  std::string rig;
};

/// The name of what the files are: their folder's, or that of a single file.
std::string name_of(const std::vector<std::string>& files) {
  const fs::path first = fs::absolute(files.front());
  const fs::path named = files.size() == 1 ? first.stem() : first.parent_path().filename();
  return input::made_file_safe(named.string()) + "-import";
}

/// A rig as a file in `folder` names it: by its own name, or by where it is from there.
std::string rig_from(const fs::path& folder, const std::string& rig) {
  for (const auto shipped : input::shipped_rigs())
    if (rig == shipped) return rig;
  const std::string path = fs::weakly_canonical(rig).lexically_relative(folder).generic_string();
  return path.find('/') == std::string::npos ? "./" + path : path;
}

int import_tables(const ImportOptions& options) {
  std::vector<domain::InputFile> read;
  if (!options.rig.empty()) input::read_rig(options.rig, read);
  const auto found = recognise::recognise({options.files.begin(), options.files.end()}, !options.rig.empty());
  for (const auto& table : found.tables) read.push_back(table.input);
  std::string words = "import";
  for (const auto& file : options.files) words += " " + file;
  Job job(options, words, name_of(options.files), read);
  const fs::path folder = output::result_path(job.where());
  const std::string document = output::json_of(found), table = output::table_of(found, job.where().string());
  job.write(
      "dataset.yaml",
      output::dataset_yaml(found, folder, options.rig.empty() ? "rig.yaml" : rig_from(folder, options.rig)));
  if (options.rig.empty()) job.write("rig.yaml", output::rig_yaml(found));
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
  verb.add_option("files", options.files,
                  "Tables: .csv, .tsv, .lvm, .mat, .txt, .dat, .asc; one for each run")
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
