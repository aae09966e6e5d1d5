// The verb `fmu`: a rig as a Functional Mock-up Unit, for Simulink, OpenModelica and others.
#include <filesystem>

#include <fmt/format.h>

#include <sim/cli/results.hpp>
#include <sim/cli/verbs.hpp>
#include <sim/fmu/archive.hpp>
#include <sim/fmu/model/variables.hpp>
#include <sim/input/fields_json.hpp>
#include <sim/input/file_names.hpp>
#include <sim/input/rigs.hpp>
#include <sim/output/file.hpp>

namespace mckibben::cli {
namespace {

namespace fs = std::filesystem;

struct FmuOptions : Options {
  std::string rig, file, version = "2.0";
  bool true_states = false;
};

int write_fmu(const FmuOptions& options) {
  std::vector<domain::InputFile> inputs;
  const plant::Rig rig = input::read_rig(options.rig, inputs);
  const std::string name = input::made_file_safe(fs::path(options.rig).stem().string());
  const fs::path file = options.file.empty() ? fs::path(name + ".fmu") : fs::path(options.file);
  const auto version = options.version == "3.0" ? fmu::Version::three : fmu::Version::two;
  output::write_whole(fs::absolute(file), fmu::fmu_of(name, rig, version, options.true_states));
  input::Json document{{"schema", "mckibben-fmu/1"}, {"file", file.string()}, {"fmi", options.version}};
  auto& variables = document["variables"] = input::Json::array();
  std::string inputs_and_outputs;
  for (const fmu::Variable& each : fmu::variables_of(rig, options.true_states)) {
    variables.push_back({{"name", each.name}, {"reference", each.reference}, {"unit", each.unit}});
    if (each.role == fmu::Role::input || each.role == fmu::Role::output)
      inputs_and_outputs +=
          fmt::format("  {:6} {:24} {:4} {}\n", each.role == fmu::Role::input ? "input" : "output", each.name,
                      each.unit, each.meaning);
  }
  print(options,
        {document.dump(2) + "\n",
         fmt::format("{}: FMI {} for co-simulation, a step of {:g} s\n{}  and {} parameters, to be set "
                     "before the start\n",
                     file.string(), options.version, rig.tick_s, inputs_and_outputs,
                     fmu::parameter_paths(rig).size())});
  return done;
}

}  // namespace

void add_fmu(CLI::App& app, Asked& asked) {
  CLI::App& verb =
      add_verb(app, "fmu", to_simulate, "Write a rig as an FMU, for Simulink, OpenModelica and others");
  FmuOptions& options = asked.when(verb, write_fmu);
  add_input(verb, options.rig, "rig", "Rig file, or the name of a shipped rig", "RIG");
  verb.add_option("--out", options.file, "File that is written (default: <name>.fmu)")->type_name("FILE");
  verb.add_option("--fmi", options.version, "Version of the standard (default: 2.0)")
      ->check(one_of("version", {"2.0", "3.0"}))
      ->type_name("");
  verb.add_flag("--true-states", options.true_states, "Also outputs that no instrument shows");
  add_json(verb, options);
  verb.footer(
      "Examples:\n"
      "  mckibben fmu thesis --out thesis.fmu\n"
      "  mckibben fmu my_rig.yaml --fmi 3.0 --true-states\n"
      "The file needs nothing of this program, on Linux with x86-64; its sources are in it.\n");
}

}  // namespace mckibben::cli
