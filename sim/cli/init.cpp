// The verb `init`: a scenario to start from. What is said of a key comes from the field lists, so that it
// stays true; a test checks and runs the file, also with all that is optional in it.
#include <algorithm>
#include <filesystem>
#include <string>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <sim/cli/results.hpp>
#include <sim/cli/verbs.hpp>
#include <sim/input/field_list.hpp>
#include <sim/input/scenario_file.hpp>
#include <sim/output/folder.hpp>

namespace mckibben::cli {
namespace {

using input::FieldInfo;

/// A key and what to write for it. A line that begins with # and a letter is there to be switched on.
struct Part {
  std::string_view key, yaml;
};

constexpr Part scenario_parts[] = {
    {"rig",
     "rig:\n"
     "  # Or a muscle by catalogue: festo_dmsp_5, festo_dmsp_10, festo_dmsp_20, festo_dmsp_40, home_made.\n"
     "  base: thesis\n"
     "  #muscle: {rest_radius: 8 mm ± 1 %}                    "
     "# mckibben schema rig lists all that can change\n"
     "  #effects: {muscle_leak: {conductance: 1e-10 m3/(s.Pa)}}   "
     "# mckibben effects lists what can be added\n"},
    {"loads", "loads: [11.138 kg, 16.138 kg]\n"},
    {"duration", "duration: 6 s\n"},
    {"skip", "#skip: 0.5 s\n"},
    {"target",
     "target:                     # heights: contraction ratios (0.10), or lengths (30 mm)\n"
     "  kind: minimum_jerk\n"
     "  start: 0.05\n"
     "  moves:\n"
     "    - {at: 0.5 s, lasting: 1.5 s, to: 0.15}\n"
     "    - {at: 3 s, lasting: 2 s, to: 0.08}\n"},
    {"controllers",
     "controllers:\n"
     "  - {kind: pid}             # gains that are left out are tuned\n"
     "  - {kind: pid, name: pid_late, feedback_delay_ticks: 5}\n"
     "  - {kind: static_inverse, assumed_load: 14 kg}\n"},
    {"joint_force", "#joint_force: [{at: 0.2 s, force: 10 N}]\n"},
    {"joint_torque", ""},
    {"noise", "#noise: {encoder_jitter: 1e-4, ripple: 5 mbar}\n"},
    {"seed", "#seed: 7\n"},
    {"criteria", "#criteria: [{controller: pid, rmse_below: 0.05}]    # if not met, the exit status is 1\n"},
    {"robustness", "#robustness: {rigs: 10}     # within the ± of the rig\n"},
    {"name", "#name: mine\n"},
};

std::string comment_of(const FieldInfo& info) {
  std::string text = fmt::format("# {}: {}", info.key, info.meaning);
  if (info.type == FieldInfo::Type::quantity)
    text += fmt::format("; from {} to {}", input::show_limit(info.lowest.get<double>(), info.unit),
                        input::show_limit(info.highest.get<double>(), info.unit));
  if (info.type == FieldInfo::Type::variant) {
    std::string kinds;
    for (const auto& group : info.groups) kinds += (kinds.empty() ? "" : ", ") + group.kind;
    text += "\n# kinds: " + kinds;
  }
  return text + (info.required ? "\n" : " (may be left out)\n");
}

std::string scenario_to_start_from(const std::string& file) {
  std::string text = fmt::format(
      "# A scenario: which rig lifts which loads along which target, under which controllers.\n"
      "#\n"
      "#   mckibben check {0}    is it right? nothing is run\n"
      "#   mckibben run {0}      simulates each load under each controller; results in out/{1}\n"
      "#\n"
      "# Change what you like; a value has its unit. Lines such as #seed: 7 are off; take the # away to\n"
      "# switch them on. Every key: mckibben schema scenario --format markdown\n"
      "schema: {2}\n",
      file, std::filesystem::path(file).stem().string(), input::scenario_schema);
  const auto fields = input::list_fields<domain::Scenario>();
  for (const Part& part : scenario_parts) {
    const auto info =
        std::find_if(fields.begin(), fields.end(), [&](const FieldInfo& one) { return one.key == part.key; });
    text += "\n" + comment_of(*info) + std::string(part.yaml);
  }
  return text;
}

struct InitOptions : Options {
  std::string file = "scenario.yaml";  ///< where to
};

int write_scenario(const InitOptions& options) {
  const std::string& path = options.file;
  const std::filesystem::path file = path;
  if (path.empty()) throw output::CannotWrite("cannot write a file without a name");
  std::error_code error;
  const auto there = std::filesystem::symlink_status(file, error);
  if (!std::filesystem::status_known(there))
    throw output::CannotWrite(fmt::format("cannot write {}: {}", path, error.message()));
  if (std::filesystem::exists(there))
    throw output::CannotWrite(fmt::format("cannot write {}: it is there already; give another name", path));
  const std::string text = scenario_to_start_from(path);
  output::write_whole(std::filesystem::absolute(file), text, output::Earlier::is_refused);
  print(options, {input::Json{{"schema", "mckibben-init/1"}, {"file", path}}.dump(2) + "\n",
                  fmt::format("{0} is written; read and change it, then: mckibben run {0}\n", path)});
  return done;
}

}  // namespace

void add_init(CLI::App& app, Asked& asked) {
  CLI::App& verb = add_verb(app, "init", to_simulate, "Write a scenario with comments, to start from");
  InitOptions& options = asked.when(verb, write_scenario);
  verb.add_option("file", options.file,
                  "Where to (default: scenario.yaml); a file that is there is left alone")
      ->type_name("FILE");
  add_json(verb, options);
  verb.footer(
      "Examples:\n"
      "  mckibben init my.yaml\n"
      "  mckibben init scenarios/mine.yaml --json\n"
      "The file says how to go on. It is a scenario as it stands: mckibben run my.yaml\n");
}

}  // namespace mckibben::cli
