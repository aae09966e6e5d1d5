// The verb `control`: the controller of a scenario drives a bench in real time, and what happens is recorded
// as a data set.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <regex>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <sim/bench/comedi.hpp>
#include <sim/bench/loop.hpp>
#include <sim/bench/serial.hpp>
#include <sim/bench/simulated.hpp>
#include <sim/cli/results.hpp>
#include <sim/cli/verbs.hpp>
#include <sim/domain/number.hpp>
#include <sim/input/common_checks.hpp>
#include <sim/input/fields_json.hpp>
#include <sim/input/rigs.hpp>
#include <sim/input/scenario_file.hpp>
#include <sim/input/yaml_file.hpp>
#include <sim/input/yaml_writer.hpp>
#include <sim/output/unfinished.hpp>
#include <sim/run/briefing.hpp>
#include <sim/run/recording.hpp>
#include <sim/run/track.hpp>

namespace mckibben::cli {
namespace {

using domain::Scenario;
using input::Json;

/// Beyond those that may be missed: a device may take ten to answer.
constexpr int silent_ticks = 12;

struct ControlOptions : Options {
  std::string scenario, device = "simulated", port;
  bench::Wiring wiring;
  int most_missed_ticks = bench::LoopPlan{}.most_missed_ticks;
  bool dry_run = false, verbose = false;
};

/// Why a scenario is none that one controller can drive under one load, and the key to blame.
struct Unfit {
  std::string_view key;
  std::string why;  ///< empty if it is one
};

Unfit unfit(const Scenario& scenario) {
  if (std::string why = input::no_load(scenario.rig); !why.empty()) return {"rig", std::move(why)};
  if (scenario.loads_kg.size() != 1) return {"loads", "one load hangs on a bench; name it alone"};
  if (scenario.controllers.size() != 1)
    return {"controllers", "one controller drives a bench; name it alone"};
  controllers::Settings only = scenario.controllers.front();
  if (const auto* terms = controllers::part_of<controllers::PidForm>(only);
      terms != nullptr && terms->needs_tuning())
    return {"controllers",
            fmt::format("{} has no gains; `run` of this file tunes and prints them: write them here",
                        name_of(only))};
  if (const auto* plans = controllers::part_of<controllers::ModelTerms>(only);
      plans != nullptr && !plans->assumed_load_kg)
    return {"controllers",
            "to find its load from the weighing takes longer than a tick; write it down as assumed_load"};
  return {};
}

/// Says at its key why it is unfit; of a list with one entry at that. Throws BadInput.
void refuse(const std::string& path, const Unfit& unfit) {
  const input::YamlFile file = input::load_yaml(path);
  const input::Node* node = file.root.find(unfit.key);
  if (node != nullptr && node->children.size() == 1 && node->kind == input::Node::Kind::list)
    node = &node->children.front();
  input::Problems problems;
  problems.error(file.source, node != nullptr ? node->place : file.root.place,
                 fmt::format("{}: {}", unfit.key, unfit.why));
  problems.raise();
}

/// The rig to be believed of a simulated bench: the base, where the scenario's rig only adds effects to it.
/// They are the bench's own, and diagnosed with them it lacks nothing. Empty where there is none.
std::string believed_rig(const std::string& scenario) {
  const input::YamlFile file = input::load_yaml(scenario);
  const input::Node* rig = file.root.find("rig");
  if (rig == nullptr || rig->kind != input::Node::Kind::map || rig->find("effects") == nullptr) return "";
  const bool only_effects = std::ranges::all_of(
      rig->children, [](const auto& child) { return child.key == "base" || child.key == "effects"; });
  if (!only_effects) return "";
  const input::Node* base = rig->find("base");
  const std::string name = base != nullptr ? base->text : "thesis";
  return input::is_shipped(name) ? name : (file.source.folder() / name).lexically_normal().string();
}

/// Why the options do not go together; empty if they do.
std::string misplaced(const ControlOptions& options) {
  if (options.device != "simulated" && options.port.empty())
    return fmt::format("--device {} needs its --port", options.device);
  if (options.device == "simulated" && !options.port.empty())
    return "--port is of a device: say which, --device serial or --device comedi";
  if (options.verbose && !options.dry_run) return "--verbose is of --dry-run: say both";
  if (options.device != "comedi" && options.wiring != bench::Wiring{})
    return "--output, --full-scale, --counter and --encoder are of --device comedi";
  return "";
}

bench::LoopPlan loop_of(const Scenario& scenario, const run::Briefing& briefing,
                        const ControlOptions& options) {
  bench::LoopPlan plan;
  plan.rig = scenario.rig;
  plan.ticks = static_cast<std::int64_t>(run::plan_of(scenario, 0.0, 0).ticks);
  plan.load_kg = scenario.loads_kg.front();
  plan.most_missed_ticks = options.most_missed_ticks;
  const auto& settings = briefing.settings.front();
  if (const auto* external = controllers::part_of<controllers::ExternalSettings>(settings))
    plan.start_limit_s = external->start_limit_s + 1.0;  // says it first, and better
  else if (controllers::part_of<controllers::GuestTerms>(settings) == nullptr)
    plan.start_limit_s = std::numeric_limits<double>::infinity();  // ours may plan for long, but not for ever
  plan.limits = controllers::limits_of(settings, briefing.knowledge.front())
                    .value_or(controllers::CurrentRange{scenario.rig.dac.lowest_command,
                                                        scenario.rig.dac.largest_command});
  return plan;
}

std::unique_ptr<bench::Device> device_of(const Scenario& scenario, const ControlOptions& options) {
  if (options.device == "serial" && !options.dry_run)
    return std::make_unique<bench::Serial>(options.port, scenario.rig);
  if (options.device == "comedi" && !options.dry_run)
    return bench::open_comedi(options.port, options.wiring, scenario.rig);
  return std::make_unique<bench::Simulated>(scenario.rig, scenario.loads_kg.front(), scenario.rig.integrator,
                                            scenario.rig.dac.lowest_command, scenario.noise, scenario.seed);
}

/// Reads `1:0`; a single number is read as the first of the two.
std::pair<unsigned, std::optional<unsigned>> numbers_of(const std::string& text) {
  static const std::regex form("([0-9]{1,4})(:([0-9]{1,4}))?");
  std::smatch parts;
  if (!std::regex_match(text, parts, form))
    throw CLI::ValidationError(text + " is neither a number nor two with a colon, such as 1:0");
  const auto number = [&](std::size_t i) { return static_cast<unsigned>(std::stoul(parts[i].str())); };
  return {number(1), parts[3].matched ? std::optional(number(3)) : std::nullopt};
}

void add_wiring(CLI::App& verb, bench::Wiring& wiring) {
  verb.add_option_function<std::string>(
          "--output",
          [&wiring](const std::string& text) {
            const auto [output, channel] = numbers_of(text);
            wiring.output = output;
            wiring.channel = channel.value_or(0);
          },
          "Of comedi: subdevice and channel of the output (default: the board's first)")
      ->type_name("N[:N]");
  add_quantity(
      verb, "--full-scale", wiring.full_scale_V, "V", 1e3,
      "Of comedi: voltage that makes the DAC's largest command, where the output gives volts and the "
      "valve takes none (default: 10 V)",
      "VOLTAGE");
  verb.add_option("--counter", wiring.counter,
                  "Of comedi: subdevice of the counter (default: the board's first)")
      ->type_name("N");
  verb.add_option_function<std::string>(
          "--encoder",
          [&wiring](const std::string& text) {
            const auto [a, b] = numbers_of(text);
            if (!b) throw CLI::ValidationError(text + ": an encoder has two signals, such as 8:10");
            wiring.encoder = {a, *b};
          },
          "Of comedi: lines (PFI) of the encoder's signals A and B (default: the board's own)")
      ->type_name("A:B");
}

double late_ms(const bench::Row& row, double tick_s) {
  return 1e3 * (row.read_s - static_cast<double>(row.tick) * tick_s);
}

/// How late ticks began, in ms: of as many in a hundred, at most that.
double late_ms(const bench::Recorded& recorded, double tick_s, double share) {
  std::vector<double> list_ms;
  for (const auto& row : recorded.rows) list_ms.push_back(late_ms(row, tick_s));
  if (list_ms.empty()) return 0.0;
  std::sort(list_ms.begin(), list_ms.end());
  return list_ms[static_cast<std::size_t>(share * static_cast<double>(list_ms.size() - 1))];
}

constexpr std::string_view gauge_column = "muscle_pressure_bar";

/// Of the commands.
std::string column_of(const Scenario& scenario) {
  return plant::Channel{&plant::command_of(scenario.rig.command_unit())}.name();
}

std::string head_of(const Scenario& scenario, bool gauge) {
  return fmt::format("time_s,{},contraction_ratio,counts,{}target,late_ms,read_s,sent_s\n",
                     column_of(scenario), gauge ? fmt::format("{},", gauge_column) : "");
}

std::string line_of(const bench::Row& row, const controllers::Knowledge& known, bool gauge) {
  return fmt::format("{},{},{},{},{}{},{:.3f},{:.6f},{:.6f}\n",
                     run::tidy_s(static_cast<double>(row.tick) * known.tick_s), row.current_mA,
                     static_cast<double>(row.counts) * known.contraction_per_count, row.counts,
                     gauge ? fmt::format("{},", row.gauge_Pa / plant::Pa_per_bar) : "",
                     known.target_at(row.tick), late_ms(row, known.tick_s), row.read_s, row.sent_s);
}

/// What goes with the rows: they are a data set of a rig with all that the scenario's has. Ticks begin late:
/// what counts is when each reading was taken and each command went out.
template <class Folder>
void describe(Folder& folder, const Scenario& scenario, bool gauge, double longest_silence_s) {
  Json dataset{{"schema", "mckibben-dataset/1"}, {"rig", "rig.yaml"}};
  dataset["columns"]["command"] = {
      {"column", column_of(scenario)}, {"unit", name_of(scenario.rig.command_unit())}, {"time", "sent_s"}};
  dataset["columns"]["contraction"] = {{"column", "counts"}, {"unit", "count"}, {"time", "read_s"}};
  if (gauge)
    dataset["columns"]["muscle_pressure"] = {{"column", gauge_column}, {"unit", "bar"}, {"time", "read_s"}};
  if (longest_silence_s > domain::Recorded{}.bridge_s)  // the device holds its output meanwhile
    dataset["bridge"] = fmt::format("{} s", run::tidy_s(longest_silence_s));
  dataset["runs"] = Json::array({Json{{"id", "bench"},
                                      {"file", "bench.csv"},
                                      {"load", domain::write_number(scenario.loads_kg.front()) + " kg"}}});
  folder.write("rig.yaml", input::to_yaml(input::rig_json(scenario.rig)));
  folder.write("dataset.yaml", input::to_yaml(dataset));
}

std::string text_of(const Scenario& scenario, const bench::Recorded& recorded) {
  const auto late = [&](double share) { return late_ms(recorded, scenario.rig.tick_s, share); };
  std::string text = fmt::format("{}: {} of {} ticks of {:g} ms; ", scenario.name, recorded.rows.size(),
                                 run::plan_of(scenario, 0.0, 0).ticks, 1e3 * scenario.rig.tick_s);
  text += recorded.rows.empty()
              ? "it ended before tick 0, and nothing was recorded\n"
              : fmt::format("each began late by {:.3f} ms (median), {:.3f} ms (99 %), {:.3f} ms (at most)\n",
                            late(0.5), late(0.99), late(1.0));
  text += fmt::format("missed ticks: {}; outputs that were limited: {}\n", recorded.missed_ticks,
                      recorded.limited_ticks);
  for (const auto& finding : recorded.findings)
    text +=
        fmt::format("found out by the controller: {} {:g} {}\n", finding.name, finding.value, finding.unit);
  if (!recorded.stopped.empty()) text += fmt::format("stopped, and vented: {}\n", recorded.stopped);
  return text;
}

std::string document_of(const Scenario& scenario, const ControlOptions& options,
                        const bench::Recorded& recorded) {
  const auto late = [&](double share) { return late_ms(recorded, scenario.rig.tick_s, share); };
  Json document{{"schema", "mckibben-control/1"},
                {"device", options.device},
                {"ticks", recorded.rows.size()},
                {"late_ms", {{"median", late(0.5)}, {"of_99_in_100", late(0.99)}, {"largest", late(1.0)}}},
                {"missed_ticks", recorded.missed_ticks},
                {"limited_ticks", recorded.limited_ticks}};
  if (!recorded.stopped.empty()) document["stopped"] = recorded.stopped;
  for (const auto& finding : recorded.findings) document["findings"][finding.name] = finding.value;
  document["scenario"] = input::scenario_json(scenario);
  return document.dump(2) + "\n";
}

/// "500 commands of 4 to 12.31 mA, one every 12 ms, the largest change 0.24 mA".
std::string sent(const Scenario& scenario, const bench::Recorded& recorded) {
  if (recorded.rows.empty()) return "";
  double lowest = recorded.rows.front().current_mA, highest = lowest, fastest = 0.0;
  for (std::size_t k = 1; k < recorded.rows.size(); ++k) {
    const double command = recorded.rows[k].current_mA;
    lowest = std::min(lowest, command);
    highest = std::max(highest, command);
    fastest = std::max(fastest, std::abs(command - recorded.rows[k - 1].current_mA));
  }
  const auto unit = name_of(scenario.rig.command_unit());
  return fmt::format("{} commands of {:.4g} to {:.4g} {}, one every {:g} ms, the largest change {:.4g} {}\n",
                     recorded.rows.size(), lowest, highest, unit, 1e3 * scenario.rig.tick_s, fastest, unit);
}

int show(const ControlOptions& options, const Scenario& scenario, const bench::Recorded& recorded) {
  constexpr std::size_t ends = 5;
  std::string text = fmt::format("  tick    counts {:>11}   (the bench is simulated; nothing is sent)\n",
                                 column_of(scenario));
  const std::size_t rows = recorded.rows.size();
  const bool all = options.verbose || rows <= 2 * ends + 1;
  for (std::size_t k = 0; k < rows; ++k) {
    if (!all && k == ends) {
      text += fmt::format("   ...   {} more: --verbose\n", rows - 2 * ends);
      k = rows - ends;
    }
    const bench::Row& row = recorded.rows[k];
    text += fmt::format("{:6} {:9} {:11.4f}\n", row.tick, row.counts, row.current_mA);
  }
  text += sent(scenario, recorded);
  print(options, {document_of(scenario, options, recorded), text + text_of(scenario, recorded)});
  return recorded.stopped.empty() ? done : failure;
}

/// Drives the device, and records: rows as they come, all as a data set at the end.
int on_bench(const ControlOptions& options, const Scenario& scenario, const run::Briefing& briefing,
             std::unique_ptr<controllers::Controller> controller, bench::LoopPlan plan) {
  // No recording replaces another: a folder of results is replaced by one of the same words only.
  const auto now = std::chrono::floor<std::chrono::milliseconds>(std::chrono::system_clock::now());
  Job job(options, fmt::format("control {}, {}", options.scenario, now.time_since_epoch().count()),
          scenario.name + "-control", scenario.inputs);
  const controllers::Knowledge& known = briefing.knowledge.front();
  std::unique_ptr<bench::Device> device;
  try {
    device = device_of(scenario, options);
  } catch (const bench::DeviceFailure& unreachable) {
    say(unreachable.what());
    return run::interrupted() ? static_cast<int>(interrupted) : static_cast<int>(failure);
  }
  const bool gauge = device->has_gauge();
  output::Unfinished rows(job.where(), "bench.csv", head_of(scenario, gauge), say);
  plan.longest_silence_s = (options.most_missed_ticks + silent_ticks) * scenario.rig.tick_s;
  describe(rows, scenario, gauge, plan.longest_silence_s);
  plan.record = [&](const bench::Row& row) { rows.append(line_of(row, known, gauge)); };
  bench::RealClock clock;
  const bench::Recorded recorded = bench::drive(*device, std::move(controller), plan, clock);
  device.reset();
  try {
    if (!recorded.rows.empty()) {
      std::string csv = head_of(scenario, gauge);
      for (const bench::Row& row : recorded.rows) csv += line_of(row, known, gauge);
      job.write("bench.csv", csv);
      describe(job, scenario, gauge, plan.longest_silence_s);
    }
    const std::string document = document_of(scenario, options, recorded), text = text_of(scenario, recorded);
    job.write("control.json", document);
    job.write("table.txt", text);
    const std::string believed = options.device == "simulated" ? believed_rig(options.scenario) : "";
    const int status =
        job.finish({document, text}, recorded.stopped.empty() ? done : failure,
                   "diagnose " + job.where().string() + (believed.empty() ? "" : " --rig " + believed));
    rows.remove();
    return recorded.by_user && status == failure ? static_cast<int>(interrupted) : status;
  } catch (const output::CannotWrite&) {
    say(fmt::format("what was recorded{} is in {}", rows.complete() ? "" : " until the disk was full",
                    rows.path().string()));
    throw;
  }
}

int control(const ControlOptions& options) {
  if (const std::string why = misplaced(options); !why.empty()) {
    say(why);
    return usage_error;
  }
  std::vector<input::Problem> warnings;
  const Scenario scenario = input::read_scenario(std::filesystem::path(options.scenario), warnings);
  for (const auto& warning : warnings) say(input::to_text(warning));
  if (const Unfit found = unfit(scenario); !found.why.empty()) refuse(options.scenario, found);
  if (options.wiring.full_scale_V && scenario.rig.command_unit() == plant::CommandUnit::V) {
    say("--full-scale is of a stage behind the output; this rig's valve takes its volts as they are");
    return usage_error;
  }
  const run::Briefing briefing = run::briefing_of(scenario);
  auto controller = briefing.make(briefing.settings.front(), 0, scenario.loads_kg.front());
  const bench::LoopPlan plan = loop_of(scenario, briefing, options);
  if (!options.dry_run) return on_bench(options, scenario, briefing, std::move(controller), plan);
  std::string why = options.device == "serial" ? bench::unusual_stage(scenario.rig) : "";
  if (options.device == "comedi") why = bench::unusual_range(options.wiring, scenario.rig);
  if (!why.empty()) say("warning: " + why);
  bench::PatientClock clock;
  return show(options, scenario,
              bench::drive(*device_of(scenario, options), std::move(controller), plan, clock));
}

}  // namespace

void add_control(CLI::App& app, Asked& asked) {
  CLI::App& verb = add_verb(app, "control", to_compare,
                            "Let the controller of a scenario drive a bench in real time; record a data set");
  ControlOptions& options = asked.when(verb, control);
  add_input(verb, options.scenario, "scenario", "Scenario file with one load and one controller",
            "SCENARIO.yaml");
  add_out(verb, options, "out/<name>-control");
  add_json(verb, options);
  verb.add_option("--device", options.device, "What is driven (default: simulated)")
      ->check(one_of("device", {"simulated", "serial", "comedi"}))
      ->type_name("");
  verb.add_option("--port", options.port, "Serial port or board, such as /dev/ttyACM0 or /dev/comedi0")
      ->type_name("FILE");
  add_wiring(verb, options.wiring);
  add_number(verb, "--most-missed", options.most_missed_ticks, 0, 1000,
             "Ticks in a row that may be missed before the watchdog vents (default: 3)");
  verb.add_flag("--dry-run", options.dry_run,
                "Show what would be sent, at a simulated bench; nothing is opened");
  verb.add_flag("--verbose", options.verbose,
                "Of --dry-run: show every command, not the first and last five");
  verb.footer(
      "Examples:\n"
      "  mckibben control my.yaml --dry-run\n"
      "  mckibben control my.yaml --device simulated\n"
      "  mckibben control my.yaml --device serial --port /dev/ttyACM0\n"
      "  mckibben control my.yaml --device comedi --port /dev/comedi0 --output 1:0 --encoder 8:10\n"
      "Writes dataset.yaml, rig.yaml and bench.csv, which replay and diagnose read, and control.json.\n"
      "However it ends, the last command is the DAC's lowest: the valve vents.\n");
}

}  // namespace mckibben::cli
