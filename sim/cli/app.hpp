// The command line as CLI11 reads it: the one list of verbs and options from which help comes.
#pragma once

#include <functional>
#include <memory>

#include <CLI/CLI.hpp>

namespace mckibben::cli {

/// What a verb does in the processes that a launcher starts of it: nothing but in rank 0, or a share.
enum class Ranks { only_first, share };

/// What the command line asks for.
struct Asked {
  std::function<int()> chosen;  ///< does what the verb is for
  Ranks ranks = Ranks::only_first;

  /// Once `verb` is read, what is asked for is `work` with its options. Returns these, at their defaults, to
  /// be filled by the command line; they live as long as the verb.
  template <class Own>
  Own& when(CLI::App& verb, int (*work)(const Own&), Ranks of_verb = Ranks::only_first) {
    const auto options = std::make_shared<Own>();
    verb.callback([this, options, work, of_verb] {
      chosen = [options, work] { return work(*options); };
      ranks = of_verb;
    });
    return *options;
  }
};

/// Adds all verbs; parsing then fills `asked`.
void build(CLI::App& app, Asked& asked);

/// Adds one of them; `group`: the heading of the help under which it stands.
CLI::App& add_verb(CLI::App& app, const char* name, const char* group, const char* what_it_does);

}  // namespace mckibben::cli
