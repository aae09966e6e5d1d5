// Parsing of the command line (CLI11) and the one place where failures become exit statuses.
#include <cstdio>
#include <functional>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <sim/cli/app.hpp>
#include <sim/cli/cli.hpp>
#include <sim/cli/exit_status.hpp>
#include <sim/cli/options.hpp>
#include <sim/cli/results.hpp>
#include <sim/input/diagnostics.hpp>
#include <sim/output/folder.hpp>
#include <sim/run/batch.hpp>

namespace mckibben::cli {
namespace {

// Runs a verb and says on stderr what went wrong.
int guarded(const std::function<int()>& verb) {
  const auto say = [](const char* text) { fmt::print(stderr, "{}\n", text); };
  try {
    const int status = verb();
    if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0)
      throw output::CannotWrite("cannot write to standard output");
    return status;
  } catch (const input::BadInput& error) {
    say(error.what());
    return bad_input;
  } catch (const input::MissingInput& error) {
    fmt::print(stderr, "mckibben: {}\n", error.what());
    return missing_input;
  } catch (const output::CannotWrite& error) {
    fmt::print(stderr, "mckibben: {}\n", error.what());
    return cannot_write;
  } catch (const run::Interrupted&) {
    say("mckibben: interrupted before there was a result; nothing was written, earlier results are as they "
        "were.\nThe same command begins again.");
    return interrupted;
  } catch (const std::exception& error) {
    fmt::print(stderr, "mckibben: {}\nThis is a defect of the program; please report it.\n", error.what());
    return failure;
  }
}

/// `verb` is empty before one is known.
int wrong_usage(const std::string& verb, std::string_view what) {
  const std::string name = verb.empty() ? "mckibben" : "mckibben " + verb;
  fmt::print(stderr, "{}: {}\n{} --help explains what it takes.\n", name, what, name);
  return usage_error;
}

}  // namespace

int run(int argc, char** argv) {
  CLI::App app("", "mckibben");
  Asked asked;
  build(app, asked);
  const std::vector<std::string_view> arguments(argv + (argc > 0 ? 1 : 0), argv + argc);
  if (const std::string wrong = unknown_word(app, arguments); !wrong.empty()) {
    fmt::print(stderr, "mckibben: {}\n", wrong);
    return usage_error;
  }
  if (arguments.empty()) return wrong_usage("", "a verb is missing; to begin: mckibben init my.yaml");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0)
      return guarded([&] {
        std::ostringstream help;
        app.exit(error, help);
        print(help.str());
        return done;
      });
    const auto verbs = app.get_subcommands();
    return wrong_usage(verbs.empty() ? "" : verbs.front()->get_name(), error.what());
  }
  run::catch_interrupts();
  return guarded(asked.chosen);
}

}  // namespace mckibben::cli
