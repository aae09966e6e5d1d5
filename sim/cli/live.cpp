// The verb `live`: a rig in the browser, moved by hand in real time.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <string>

#include <fmt/format.h>

#include <sim/cli/results.hpp>
#include <sim/cli/verbs.hpp>
#include <sim/domain/rig_number.hpp>
#include <sim/input/common_checks.hpp>
#include <sim/input/fields_json.hpp>
#include <sim/input/file_names.hpp>
#include <sim/input/rigs.hpp>
#include <sim/live/server.hpp>
#include <sim/run/batch.hpp>

namespace mckibben::cli {
namespace {

namespace fs = std::filesystem;

struct LiveOptions : Options {
  std::string rig;
  int port = 0;
  double load_kg = 0.0;
};

int show_live(const LiveOptions& options) {
  std::vector<domain::InputFile> inputs;
  const plant::Rig rig = input::read_rig(options.rig, inputs);
  const bool pair = rig.pair() != nullptr;
  if (!rig.has_angle()) input::require_load(rig, options.rig, "live");
  const double load_kg = options.load_kg > 0.0 ? options.load_kg : domain::usual_load_kg(rig);
  const std::string why = !pair                   ? domain::too_heavy(load_kg, rig)
                          : options.load_kg > 0.0 ? "two muscles turn a link; no load hangs there"
                                                  : "";
  if (!why.empty()) {
    say(fmt::format("--load {:g} kg: {}", load_kg, why));
    return bad_input;
  }
  const std::string name = input::made_file_safe(fs::path(options.rig).stem().string());
  const fs::path where = destination(options, name + "-live");
  keep_apart(where, inputs);
  live::Host host(rig, load_kg, live::DataSets(where, "live " + options.rig + " " + live::new_token(), say));
  live::Sweep slow{.low_mA = rig.valve.zero_command};
  slow.high_mA = std::min(rig.valve.span_command, rig.dac.largest_command);
  host.obey(slow);  // the page opens moving
  const live::Server server(host, live::page_of(name, rig, live::Session(rig, load_kg)), options.port);
  const input::Json document{{"schema", "mckibben-live/1"}, {"address", server.address()}};
  print(options, {document.dump(2) + "\n", server.address() + "\n"});
  std::fflush(stdout);  // whoever reads it through a pipe wants it now
  say("the page is at this address, on this machine; Ctrl-C ends it");
  while (!run::interrupted()) host.write_recordings(say);
  host.finish(say);  // what was recorded is on disk before anybody is waited for
  return done;
}

}  // namespace

void add_live(CLI::App& app, Asked& asked) {
  CLI::App& verb = add_verb(app, "live", to_simulate,
                            "Move a rig by hand in the browser, switch its effects; record data sets");
  LiveOptions& options = asked.when(verb, show_live);
  add_input(verb, options.rig, "rig", "Rig file, or the name of a shipped rig", "RIG");
  add_quantity(verb, "--load", options.load_kg, "kg", 500.0,
               "The load at first, such as \"16.138 kg\" (default: one that the muscle lifts halfway)",
               "LOAD");
  add_number(verb, "--port", options.port, 1, 65535, "Port of 127.0.0.1 (default: one that is free)");
  add_out(verb, options, "out/<name>-live");
  add_json(verb, options);
  verb.footer(
      "Examples:\n"
      "  mckibben live thesis\n"
      "  mckibben live my_rig.yaml --load \"5 kg\" --port 8080\n"
      "Prints the address of a page, which only this machine can see, and goes on until Ctrl-C.\n"
      "What is recorded in the page is a data set, which replay and diagnose read.\n");
}

}  // namespace mckibben::cli
