// The verbs and their options, as CLI11 reads them: the one list from which help and completion come.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include <sim/cli/verbs.hpp>

namespace mckibben::cli {

/// What the command line asks for.
struct Asked {
  Options options;
  std::string path, kind = "scenario", format = "json", study, plan, other, shell;
  std::vector<std::string> names;
  CalibrateOptions calibration;
  MapOptions targets;
  double tolerance = 0.0;
  std::optional<double> allowed;
  std::function<int()> chosen;  ///< does what the verb is for
};

/// Adds all verbs; parsing then fills `asked`.
void build(CLI::App& app, Asked& asked);

// Parts of it.
void add_simulating_verbs(CLI::App& app, Asked& asked);
void add_model_verbs(CLI::App& app, Asked& asked);
void add_comparing_verbs(CLI::App& app, Asked& asked);
void add_helping_verbs(CLI::App& app, Asked& asked);

}  // namespace mckibben::cli
