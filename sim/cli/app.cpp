// The help of the program and the order of its verbs.
#include <string>

#include <Eigen/Core>
#include <fmt/format.h>

#include <sim/cli/app.hpp>
#include <sim/cli/verbs.hpp>
#include <sim/engine/versions.hpp>

namespace mckibben::cli {
namespace {

constexpr const char* what_it_is =
    "McKibben simulates a pneumatic muscle that lifts a load: "
    "servo valve, hose, gas, braid, thread friction,\n"
    "encoder and controllers. Given measurements of a real rig, it names the effects (leaks, hysteresis,\n"
    "creep, ...) that the rig shows and the model lacks.\n"
    "\n"
    "Do these three first:\n"
    "  mckibben init my.yaml        writes a scenario with comments, to change as you like\n"
    "  mckibben run my.yaml         simulates it: a table of tracking errors, a plot, CSV files\n"
    "  mckibben diagnose measured/  names the effects that your rig shows and the model lacks\n";

constexpr const char* last_words =
    "mckibben VERB --help explains a verb, with examples. In a checkout, ./mckibben test runs its tests.\n"
    "Results go to stdout, everything else to stderr.\n"
    "Exit status: 0 done, 1 a criterion of yours is not met, 64 usage, 65 bad input file,\n"
    "66 input file missing, 70 numerical failure or a defect of ours, 74 cannot write, 130 interrupted.\n";

/// What CLI11 writes, without what it adds to our words: exclusions, a colon before choices.
class Help : public CLI::Formatter {
  std::string make_option_opts(const CLI::Option* option) const override {
    if (option->get_type_size() == 0) return "";
    std::string type = option->get_type_name();
    if (type.starts_with(':')) type.erase(0, 1);
    const bool many = option->get_expected_max() == CLI::detail::expected_max_vector_size;
    return " " + type + (many ? " ..." : "");
  }
};

std::string versions() {
  return fmt::format("mckibben {}\nSUNDIALS {}, Eigen {}.{}.{}, compiler {}", MCKIBBEN_VERSION,
                     engine::sundials_version(), EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION,
                     EIGEN_MINOR_VERSION, __VERSION__);
}

}  // namespace

CLI::App& add_verb(CLI::App& app, const char* name, const char* group, const char* what_it_does) {
  CLI::App& verb = *app.add_subcommand(name, what_it_does);
  verb.group(group);
  return verb;
}

void build(CLI::App& app, Asked& asked) {
  app.description(what_it_is);
  app.footer(last_words);
  app.formatter(std::make_shared<Help>());
  app.get_formatter()->label("SUBCOMMAND", "VERB ...");
  app.set_version_flag("--version", versions, "Print the versions of program and libraries and stop");
  app.get_help_ptr()->description("Print this help and stop");
  app.require_subcommand(1);
  for (AddVerb* add : all_verbs) add(app, asked);
}

}  // namespace mckibben::cli
