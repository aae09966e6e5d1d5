// Parsing of the command line (CLI11) and the one place where failures become exit statuses.
#include <cstdio>
#include <filesystem>
#include <functional>
#include <new>
#include <sstream>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <sim/cli/app.hpp>
#include <sim/cli/cli.hpp>
#include <sim/cli/results.hpp>
#include <sim/cluster/crew.hpp>
#include <sim/formats/table.hpp>
#include <sim/input/diagnostics.hpp>
#include <sim/input/finding_places.hpp>
#include <sim/input/utf8.hpp>
#include <sim/output/folder.hpp>
#include <sim/run/batch.hpp>

namespace mckibben::cli {
namespace {

/// Says on stderr what went wrong with the machine. What is wrong with the input or the command line is wrong
/// in all processes of a crew, and rank 0 says it.
void complain(const std::string& text) {
  const int rank = cluster::crew().rank;
  tell_anyway(fmt::format("mckibben{}: {}\n", rank == 0 ? "" : fmt::format(" (rank {})", rank), text));
}

/// Does it and says on stderr what went wrong.
int guarded(const std::function<int()>& work) {
  const auto say = [](const char* text) { fmt::print(stderr, "{}\n", text); };
  try {
    const int status = work();
    check_printed();
    return status;
  } catch (const input::BadInput& error) {
    say(error.what());
    return bad_input;
  } catch (const data::UnfitData& error) {
    say(to_text(input::problems_of(error.path(), error.findings())).c_str());
    return bad_input;
  } catch (const input::MissingInput& error) {
    complain(error.what());
    return missing_input;
  } catch (const output::CannotWrite& error) {
    complain(error.what());
    return cannot_write;
  } catch (const formats::BadFile& error) {
    complain(error.what());
    return cannot_write;
  } catch (const run::Interrupted&) {
    say("mckibben: interrupted before there was a result; nothing was written, earlier results are as they "
        "were.\nThe same command begins again.");
    return interrupted;
  } catch (const std::filesystem::filesystem_error& error) {
    complain(fmt::format("cannot use {}: {}", error.path1().string(), error.code().message()));
    return cannot_write;
  } catch (const std::system_error& error) {
    complain(fmt::format("this machine does not give what is needed: {}", error.what()));
    return failure;
  } catch (const std::bad_alloc&) {
    complain("there is not enough memory for this");
    return failure;
  } catch (const std::exception& error) {
    complain(fmt::format("{}\nThis is a defect of the program; please report it.", error.what()));
    return failure;
  }
}

/// `verb` is empty before one is known.
int wrong_usage(const std::string& verb, std::string_view what) {
  const std::string name = verb.empty() ? "mckibben" : "mckibben " + verb;
  fmt::print(stderr, "{}: {}\n{} --help explains what it takes.\n", name, what, name);
  return usage_error;
}

/// Names of files go into results and lists of files, which are UTF-8 in lines; empty if all can.
std::string odd_name(const std::vector<std::string_view>& arguments) {
  constexpr const char* rule =
      "holds control characters or is not UTF-8, which no result can name; rename it";
  const auto is_odd = [](std::string_view text) {
    return text.find_first_of("\n\t") != std::string_view::npos || input::printable(text) != text;
  };
  for (const std::string_view text : arguments)
    if (is_odd(text)) return fmt::format("the name {} {}", input::printable(text), rule);
  std::error_code ignored;
  const std::string here = std::filesystem::current_path(ignored).string();
  return is_odd(here) ? fmt::format("the current folder, {}, {}", input::printable(here), rule) : "";
}

/// Reads the command line and does what it asks for.
int parse_and_do(int argc, char** argv) {
  CLI::App app("", "mckibben");
  Asked asked;
  build(app, asked);
  const std::vector<std::string_view> arguments(argv + (argc > 0 ? 1 : 0), argv + argc);
  if (const std::string odd = odd_name(arguments); !odd.empty()) return wrong_usage("", odd);
  if (const std::string wrong = unknown_word(app, arguments); !wrong.empty()) {
    fmt::print(stderr, "mckibben: {}\n", wrong);
    return usage_error;
  }
  if (arguments.empty()) return wrong_usage("", "a verb is missing; to begin: mckibben init my.yaml");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) {
      std::ostringstream help;
      app.exit(error, help);
      print(help.str());
      return done;
    }
    const auto verbs = app.get_subcommands();
    return wrong_usage(verbs.empty() ? "" : verbs.front()->get_name(), error.what());
  }
  run::catch_interrupts();
  if (asked.ranks == Ranks::only_first && !cluster::crew().alone()) {
    if (!cluster::crew().leads()) return done;
    fmt::print(stderr, "mckibben: {} is not shared out; one of {} processes does all of it\n",
               app.get_subcommands().front()->get_name(), cluster::crew().size);
  }
  return asked.chosen();
}

}  // namespace

int run(int argc, char** argv) {
  if (!cluster::crew().leads()) keep_quiet();
  return guarded([&] { return parse_and_do(argc, argv); });
}

}  // namespace mckibben::cli
