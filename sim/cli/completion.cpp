// The verb `completion`: a script for bash or zsh, written from the verbs and options that the program itself
// reads (CLI11), so that none is missing. It needs no package and never starts the program.
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <sim/cli/app.hpp>
#include <sim/cli/exit_status.hpp>
#include <sim/cli/options.hpp>
#include <sim/cli/results.hpp>
#include <sim/cli/verbs.hpp>
#include <sim/input/fields_json.hpp>

namespace mckibben::cli {
namespace {

/// What may stand for a value.
struct Value {
  enum class Kind { none, words, folder, file, other } kind = Kind::none;
  std::vector<std::string> words;
};

Value value_of(const CLI::Option& option) {
  if (option.get_items_expected_max() == 0) return {};  // a flag
  const std::string type = option.get_type_name();
  const auto open = type.find('{');
  if (open != std::string::npos)  // a list of choices, as one_of writes it
    return {Value::Kind::words, CLI::detail::split(type.substr(open + 1, type.find('}') - open - 1), ',')};
  const std::string name = type.substr(0, type.find(':'));
  if (name == "DIR" || name == "FOLDER") return {Value::Kind::folder, {}};
  for (const char* quantity : {"N", "LOAD", "SPEED", "RATIO"})
    if (name == quantity) return {Value::Kind::other, {}};
  return {Value::Kind::file, {}};
}

std::vector<const CLI::Option*> options_of(const CLI::App& app, bool positional) {
  return app.get_options(
      [positional](const CLI::Option* option) { return option->nonpositional() != positional; });
}

std::vector<std::string> names_in(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : options_of(app, false))
    for (auto& name : names_of(*option)) names.push_back(std::move(name));
  return names;
}

// ---- bash

/// The words that set COMPREPLY to what the value may be.
std::string bash_reply(const Value& value) {
  switch (value.kind) {
    case Value::Kind::words:
      return fmt::format("_mckibben_words '{}'", fmt::join(value.words, " "));
    case Value::Kind::folder:
      return "_mckibben_paths -d";
    case Value::Kind::file:
      return "_mckibben_paths -f";
    default:
      return ":";
  }
}

std::string bash_of(const CLI::App& verb) {
  std::string text = fmt::format("    {})\n      case $prev in\n", verb.get_name());
  for (const CLI::Option* option : options_of(verb, false)) {
    const Value value = value_of(*option);
    if (value.kind != Value::Kind::none)
      text +=
          fmt::format("        {}) {}; return ;;\n", fmt::join(names_of(*option), "|"), bash_reply(value));
  }
  text += fmt::format("      esac\n      if [[ $cur == -* ]]; then _mckibben_words '{}'; return; fi\n",
                      fmt::join(names_in(verb), " "));
  text += "      case $place in\n";
  int place = 0;
  for (const CLI::Option* option : options_of(verb, true)) {
    const bool many = option->get_expected_max() == CLI::detail::expected_max_vector_size;
    text += fmt::format("        {}) {} ;;\n", many ? "*" : std::to_string(place++),
                        bash_reply(value_of(*option)));
  }
  return text + "      esac ;;\n";
}

/// Options that are followed by a value: needed to count the arguments that are none.
std::string with_value(const CLI::App& verb) {
  std::vector<std::string> names;
  for (const CLI::Option* option : options_of(verb, false))
    if (value_of(*option).kind != Value::Kind::none)
      for (auto& name : names_of(*option)) names.push_back(std::move(name));
  return names.empty() ? ""
                       : fmt::format("    {}:{}", verb.get_name(),
                                     fmt::join(names, fmt::format("|{}:", verb.get_name())));
}

std::string bash_script(const CLI::App& app) {
  const auto verbs = app.get_subcommands({});
  std::vector<std::string> names, valued;
  for (const CLI::App* verb : verbs) {
    names.push_back(verb->get_name());
    if (auto line = with_value(*verb); !line.empty()) valued.push_back(std::move(line));
  }
  std::string text = fmt::format(
      R"(# bash completion for mckibben; written by `mckibben completion bash`.
_mckibben_words() {{ mapfile -t COMPREPLY < <(compgen -W "$1" -- "$cur"); }}
_mckibben_paths() {{
  compopt -o filenames 2> /dev/null || true
  mapfile -t COMPREPLY < <(compgen "$1" -- "$cur")
}}
_mckibben_has_value() {{
  case $1 in
{}) return 0 ;;
  esac
  return 1
}}
_mckibben() {{
  local cur=${{COMP_WORDS[COMP_CWORD]}} prev=${{COMP_WORDS[COMP_CWORD - 1]}} verb=${{COMP_WORDS[1]}} place=0 i
  COMPREPLY=()
  if ((COMP_CWORD == 1)); then
    _mckibben_words '{} {}'
    return
  fi
  for ((i = 2; i < COMP_CWORD; i++)); do
    if _mckibben_has_value "$verb:${{COMP_WORDS[i]}}"; then
      i=$((i + 1))
      if [[ ${{COMP_WORDS[i]}} == = ]]; then i=$((i + 1)); fi # bash splits --out=DIR in three
    elif [[ ${{COMP_WORDS[i]}} != -* ]]; then
      place=$((place + 1))
    fi
  done
  if [[ $cur == = ]]; then
    cur=
  elif [[ $prev == = ]]; then
    prev=${{COMP_WORDS[COMP_CWORD - 2]}}
  fi
  case $verb in
)",
      fmt::join(valued, "|\\\n"), fmt::join(names, " "), fmt::join(names_in(app), " "));
  for (const CLI::App* verb : verbs) text += bash_of(*verb);
  return text + "  esac\n}\ncomplete -F _mckibben mckibben\n";
}

// ---- zsh

/// Safe inside single quotes and inside the brackets of _arguments.
std::string zsh_text(const std::string& text) {
  std::string safe;
  for (const char c : text.substr(0, text.find('(')))
    safe += c == '\''                          ? std::string("'\\''")
            : c == '[' || c == ']' || c == ':' ? fmt::format("\\{}", c)
                                               : std::string(1, c);
  while (safe.ends_with(' ')) safe.pop_back();
  return safe;
}

std::string zsh_value(const Value& value, const std::string& name) {
  switch (value.kind) {
    case Value::Kind::words:
      return fmt::format(":{}:({})", name, fmt::join(value.words, " "));
    case Value::Kind::folder:
      return fmt::format(":{}:_files -/", name);
    case Value::Kind::file:
      return fmt::format(":{}:_files", name);
    case Value::Kind::other:
      return fmt::format(":{}: ", name);
    case Value::Kind::none:
      break;
  }
  return "";
}

std::string zsh_of(const CLI::App& verb) {
  std::string text = fmt::format("    {})\n      _arguments", verb.get_name());
  for (const CLI::Option* option : options_of(verb, false))
    for (const auto& name : names_of(*option))
      text += fmt::format(" \\\n        '{}[{}]{}'", name, zsh_text(option->get_description()),
                          zsh_value(value_of(*option), "value"));
  int place = 0;
  for (const CLI::Option* option : options_of(verb, true)) {
    const bool many = option->get_expected_max() == CLI::detail::expected_max_vector_size;
    text += fmt::format(" \\\n        '{}{}'", many ? "*" : std::to_string(++place),
                        zsh_value(value_of(*option), option->get_name()));
  }
  return text + " ;;\n";
}

std::string zsh_script(const CLI::App& app) {
  std::string text =
      "#compdef mckibben\n# zsh completion for mckibben; written by `mckibben completion zsh`.\n"
      "_mckibben() {\n  local -a verbs=(\n";
  for (const CLI::App* verb : app.get_subcommands({}))
    text += fmt::format("    '{}:{}'\n", verb->get_name(), zsh_text(verb->get_description()));
  text += fmt::format(
      "  )\n  if ((CURRENT == 2)); then\n    _describe verb verbs\n    compadd -- {}\n    return\n  fi\n"
      "  shift words\n  ((CURRENT--))\n  case $words[1] in\n",
      fmt::join(names_in(app), " "));
  for (const CLI::App* verb : app.get_subcommands({})) text += zsh_of(*verb);
  return text +
         "  esac\n}\n"
         "if [[ ${funcstack[1]} == _mckibben ]]; then _mckibben \"$@\"; else compdef _mckibben mckibben; "
         "fi\n";
}

struct CompletionOptions : Options {
  std::string shell;  ///< bash or zsh
};

int print_completion(const CompletionOptions& options) {
  CLI::App app("", "mckibben");
  Asked asked;
  build(app, asked);
  const std::string script = options.shell == "zsh" ? zsh_script(app) : bash_script(app);
  const input::Json document{
      {"schema", "mckibben-completion/1"}, {"shell", options.shell}, {"script", script}};
  print(options, {document.dump(2) + "\n", script});
  return done;
}

}  // namespace

void add_completion(CLI::App& app, Asked& asked) {
  CLI::App& verb = add_verb(app, "completion", to_find_out,
                            "Print a script by which the shell completes verbs, options and values");
  CompletionOptions& options = asked.when(verb, print_completion);
  verb.add_option("shell", options.shell, "For which shell")
      ->required()
      ->check(one_of("shell", {"bash", "zsh"}))
      ->type_name("");
  add_json(verb, options);
  verb.footer(
      "Examples:\n"
      "  mckibben completion bash > ~/.local/share/bash-completion/completions/mckibben\n"
      "  mckibben completion zsh > ~/.zfunc/_mckibben     where ~/.zfunc is in fpath, before compinit\n"
      "Or for this session only: source <(mckibben completion bash)\n");
}

}  // namespace mckibben::cli
