// The verb `linearise`: the rig at rest at a place as a linear system, and the margins of its loops.
#include <filesystem>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <sim/cli/results.hpp>
#include <sim/cli/verbs.hpp>
#include <sim/domain/rig_number.hpp>
#include <sim/engine/failure.hpp>
#include <sim/input/common_checks.hpp>
#include <sim/input/file_names.hpp>
#include <sim/input/quantity.hpp>
#include <sim/input/rigs.hpp>
#include <sim/input/scenario_file.hpp>
#include <sim/output/linearised.hpp>
#include <sim/run/briefing.hpp>
#include <sim/run/tune_controller.hpp>

namespace mckibben::cli {
namespace {

struct LineariseOptions : Options {
  std::string file;
  std::vector<std::string> places;
  std::vector<double> loads_kg;  ///< empty: the scenario's, or one
  std::string friction = "sliding", valve = "both", margins, lqr;
  double swing_m_per_s = 0.0;
};

/// A rig, with what is to control it.
struct LinearTask {
  output::Linearised all;
  std::vector<double> loads_kg;
  double hand_m = domain::Hand{}.distance_m;
  std::vector<controllers::Settings> controllers;
};

/// Of a file, or of an option that is as bad as one.
[[noreturn]] void refuse(const std::string& what, const std::string& why) {
  throw input::BadInput({{input::Severity::error, what, input::nowhere, why, ""}});
}

bool is_scenario(const std::string& file) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(file, ignored)) return false;
  const input::YamlFile yaml = input::load_yaml(file);
  const input::Node* schema = yaml.root.find("schema");
  return schema != nullptr &&
         (schema->text.starts_with("mckibben-scenario/") || schema->text.starts_with("mckibben-pair/"));
}

/// With gains for all PIDs: those left open are tuned, as `run` tunes them.
LinearTask task_of(const domain::Scenario& scenario, unsigned threads) {
  LinearTask task{{scenario.name, scenario.rig, {}, {}}, scenario.loads_kg, scenario.hand_m, {}};
  task.all.files = scenario.inputs;
  run::Briefing briefing = run::briefing_of(scenario);
  std::vector<controllers::Settings*> open;
  for (auto& settings : briefing.settings)
    if (const auto* terms = controllers::part_of<controllers::PidForm>(settings);
        terms && terms->needs_tuning() && linear::is_linear(settings))
      open.push_back(&settings);
  if (!open.empty()) {
    const auto tuned = with_progress(scenario.name, [&](const run::ProgressHook& hook) {
      hook("tuning PID", 0, open.size());
      return run::tune_controllers(scenario, briefing, open, threads, [] {});
    });
    for (std::size_t i = 0; i < tuned.size(); ++i)
      if (const auto& [name, why] = std::tie(tuned[i].controller, tuned[i].failure); !why.empty())
        say(fmt::format("{}: {}", name, why));
      else
        task.all.tuned.push_back({name, *controllers::part_of<controllers::PidForm>(*open[i])});
  }
  for (const auto& settings : briefing.settings)
    if (domain::is_given(settings))
      task.all.no_loop.push_back(controllers::name_of(settings));
    else if (!linear::is_linear(settings))
      task.all.not_linear.push_back(controllers::name_of(settings));
    else if (!controllers::part_of<controllers::PidForm>(settings)->needs_tuning())
      task.controllers.push_back(settings);
  return task;
}

LinearTask read_task(const LineariseOptions& options) {
  if (is_scenario(options.file)) {
    std::vector<input::Problem> warnings;
    const domain::Scenario scenario = input::read_scenario(options.file, warnings);
    for (const auto& warning : warnings) say(input::to_text({warning}));
    return task_of(scenario, options.threads);
  }
  LinearTask task;
  task.all.rig = input::read_rig(options.file, task.all.files);
  task.all.name = input::made_file_safe(std::filesystem::path(options.file).stem().string());
  task.loads_kg = {task.all.rig.pair() ? 0.0 : domain::usual_load_kg(task.all.rig)};
  return task;
}

std::optional<double> read_as(const std::string& text, std::string_view unit) {
  try {
    return input::read_quantity(text, unit);
  } catch (const input::BadQuantity&) {
    return std::nullopt;
  }
}

std::optional<double> command_in(const std::string& text, plant::CommandUnit unit) {
  using enum plant::CommandUnit;
  const auto value = read_as(text, unit == bar ? "Pa" : unit == V ? "V" : "A");
  return value ? std::optional(*value * (unit == bar ? 1e-5 : unit == V ? 1.0 : 1e3)) : std::nullopt;
}

/// "10 mA", "2.5 bar", "0.15", "20 deg": the unit says what it is.
linear::Place place_of(std::string_view option, const std::string& text, const plant::Rig& rig) {
  using Of = linear::Place::Of;
  const auto as = [&](std::string_view of) { return read_as(text, of); };
  const auto unit = rig.command_unit();
  if (const auto command = command_in(text, unit)) return {Of::command, *command};
  if (const auto Pa = as("Pa")) return {Of::pressure, *Pa};
  if (const auto position = as(rig.has_angle() ? "rad" : "1")) {
    if (!rig.has_angle() && *position >= 1.0 && !text.ends_with('%'))
      throw CLI::ValidationError(
          fmt::format("{} {}: no contraction ratio is as large; did you mean \"{} {}\"?", option, text, text,
                      name_of(unit)));
    return {Of::position, *position};
  }
  if (const auto length_m = rig.has_angle() ? std::nullopt : as("m"))
    return {Of::position, *length_m / rig.muscle.rest_length_m};
  throw CLI::ValidationError(
      fmt::format("{} {}: no command as \"10 {}\"{} and no {}", option, text, name_of(unit),
                  unit == plant::CommandUnit::bar ? "" : ", no pressure as \"2.5 bar\"",
                  rig.has_angle() ? "joint angle as \"20 deg\"" : "contraction as 0.15 or \"45 mm\""));
}

linear::Question question_of(const LineariseOptions& options, const plant::Rig& rig) {
  linear::Question question;
  if (!options.places.empty()) question.places.clear();
  for (const auto& text : options.places) question.places.push_back(place_of("--at", text, rig));
  if (options.friction == "sticking") question.threads = linear::Threads::sticking;
  if (options.valve == "filling") question.opening = linear::Opening::filling;
  if (options.valve == "venting") question.opening = linear::Opening::venting;
  if (options.swing_m_per_s > 0.0 && question.threads == linear::Threads::sticking)
    throw CLI::ValidationError("--swing: threads that stick damp no swing: take --friction sliding");
  if (options.swing_m_per_s > 0.0) question.swing_m_per_s = options.swing_m_per_s;
  if (!options.margins.empty())
    question.margins = linear::Wanted{
        .phase_rad = plant::degree_rad * positive_quantity("--margins", options.margins, "deg", 85.0)};
  if (!options.lqr.empty()) {
    const auto command = command_in(options.lqr, rig.command_unit());
    if (!command || !(*command > 0.0))
      throw CLI::ValidationError(fmt::format("--lqr {}: a command is wanted, as \"1 {}\"", options.lqr,
                                             name_of(rig.command_unit())));
    question.lqr = linear::Weights{rig.has_angle() ? plant::degree_rad : 0.01, *command};
  }
  return question;
}

plant::Rig loaded(const LinearTask& task, double load_kg) {
  plant::Rig rig = task.all.rig;
  if (plant::Pair* pair = rig.pair()) *pair = plant::with_load_in_hand(*pair, load_kg, task.hand_m);
  return rig;
}

int linearise(const LineariseOptions& options) {
  LinearTask task = read_task(options);
  output::Linearised& all = task.all;
  if (!all.rig.has_angle()) input::require_load(all.rig, options.file, "linearise");
  if (!options.loads_kg.empty()) task.loads_kg = options.loads_kg;
  try {
    all.question = question_of(options, all.rig);
  } catch (const CLI::ValidationError& wrong) {
    say(wrong.what());
    return usage_error;
  }
  Job job(options, "linearise " + options.file, all.name + "-linearise", all.files);
  for (const double load_kg : task.loads_kg)
    for (std::size_t i = 0; i < all.question.places.size(); ++i) {
      const linear::Place& place = all.question.places[i];
      if (const std::string why = all.rig.pair()               ? ""
                                  : !all.rig.can_hang(load_kg) ? input::no_mass(all.rig)
                                                               : domain::too_heavy(load_kg, all.rig);
          !why.empty())
        refuse(options.loads_kg.empty() ? options.file : "--load", fmt::format("{:g} kg: {}", load_kg, why));
      try {
        all.studies.push_back(
            linear::study(loaded(task, load_kg), load_kg, place, all.question, task.controllers));
      } catch (const linear::OutOfReach& why) {
        refuse(options.places.empty() ? options.file : "--at " + options.places[i],
               fmt::format("with {:g} kg: {}", load_kg, why.what()));
      } catch (const std::invalid_argument& why) {
        refuse(options.file, fmt::format("with {:g} kg: {}", load_kg, why.what()));
      } catch (const engine::NumericalFailure& why) {
        say(fmt::format("{:g} kg: {}", load_kg, why.what()));
        return failure;
      }
    }
  const std::string document = output::json_of(all), table = output::table_of(all);
  job.write("linearise.json", document);
  job.write("table.txt", table);
  for (std::size_t i = 0; i < all.studies.size(); ++i) {
    const std::string stem = all.studies.size() == 1 ? "bode" : fmt::format("bode_{}", i + 1);
    job.write(stem + ".csv", output::bode_csv(all, all.studies[i]));
    job.write(stem + ".svg", output::bode_svg(all, all.studies[i]));
  }
  job.write("linearise.py", output::python_control(all));
  job.write("linearise.m", output::matlab(all));
  return job.finish({document, table}, done);
}

}  // namespace

void add_linearise(CLI::App& app, Asked& asked) {
  CLI::App& verb = add_verb(app, "linearise", to_simulate,
                            "A rig at rest as a linear system: poles, zeros, Bode, margins of its loops");
  LineariseOptions& options = asked.when(verb, linearise);
  add_input(verb, options.file, "file", "Scenario with its controllers, or a rig", "SCENARIO|RIG");
  verb.add_option("--at", options.places,
                  "Where: a command \"10 mA\", a muscle pressure \"2.5 bar\", a contraction 0.15 or \"45 "
                  "mm\" or a joint "
                  "angle \"20 deg\"; may be repeated (default: the middle of the valve's commands)")
      ->allow_extra_args(false)
      ->type_name("PLACE");
  add_loads(verb, options.loads_kg,
            "\"11 kg\"; may be repeated (default: the scenario's; of a rig one that the muscle lifts "
            "halfway)",
            true);
  verb.add_option(
          "--friction", options.friction,
          "Threads that slide, whose friction is constant, or stick, whose friction is a spring (default: "
          "sliding)")
      ->check(one_of("friction", {"sliding", "sticking"}))
      ->type_name("");
  add_quantity(
      verb, "--swing", options.swing_m_per_s, "m/s", 10.0,
      "Threads that slide damp a swing of the load of this speed, such as \"50 mm/s\", as they do on "
      "average (default: not at all)",
      "SPEED");
  verb.add_option("--valve", options.valve,
                  "Which way a servo valve opens that is shut at rest (default: both, the mean)")
      ->check(one_of("valve", {"both", "filling", "venting"}))
      ->type_name("");
  verb.add_option("--margins", options.margins,
                  "Find a PID with this phase margin, such as \"60 deg\", and a gain margin of 2 or more")
      ->type_name("PHASE");
  verb.add_option(
          "--lqr", options.lqr,
          "Find a state feedback (LQR) to which this command, such as \"1 mA\", is as bad as an error of "
          "0.01 of contraction ratio or of 1 deg")
      ->type_name("COMMAND");
  add_common(verb, options, "out/<name>-linearise");
  verb.footer(
      "Examples:\n"
      "  mckibben linearise thesis --at \"10 mA\" --load \"11 kg\"\n"
      "  mckibben linearise scenarios/five_loads.yaml --at 0.15 --margins \"60 deg\"\n"
      "  mckibben linearise thesis --at \"2 bar\" --friction sticking --lqr \"1 mA\"\n"
      "Writes linearise.json, table.txt, a Bode plot (bode.svg, bode.csv; of several places or "
      "loads\n"
      "bode_1.svg, bode_1.csv and so on), and the systems for python-control (linearise.py) and MATLAB\n"
      "(linearise.m).\n");
}

}  // namespace mckibben::cli
