// What each verb does. All throw what `cli.cpp` turns into an exit status, and return one otherwise.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <sim/thesis/calibrate.hpp>

namespace mckibben::cli {

/// Options that verbs share.
struct Options {
  std::string out;  ///< results folder; empty for out/<name>
  bool json = false;
  unsigned threads = 0;  ///< 0: all the machine has
  std::optional<std::uint64_t> seed;
  std::vector<std::string> formats;  ///< of runs, besides CSV: of output::run_formats
  std::string rig;                   ///< rig that replaces the data set's; empty for none
};

/// What `calibrate` may be asked for besides.
struct CalibrateOptions {
  thesis::Options fits;
  bool kgf = false;  ///< pressures of figures and report in kgf/m2
};

/// What `map` may be asked for besides.
struct MapOptions {
  std::vector<double> loads_kg;   ///< empty for the thesis's
  bool up = false, down = false;  ///< neither for both
  int ratios = 30, speeds = 5;    ///< how many targets
  double fastest_per_s = 0.5;     ///< the largest target speed
  bool extrapolate_load = false, extrapolate_target = false;
};

/// Writes a scenario with comments, to start from. Throws output::CannotWrite if there is a file already.
int write_scenario(const std::string& path, const Options& options);
int run_scenario(const std::string& path, const Options& options);
int make_dataset(const std::string& path, const Options& options);
int replay_dataset(const std::string& path, const Options& options);
/// `plan`: where to write the next experiment as a campaign; empty for nowhere.
int diagnose_dataset(const std::string& path, const Options& options, const std::string& plan);
int calibrate_dataset(const std::string& path, const Options& options, const CalibrateOptions& how);
int map_errors(const std::string& path, const Options& options, const MapOptions& how);
/// `name`: one of study::names; `path` the campaign's.
int make_study(const std::string& name, const std::string& path, const Options& options);
/// Is the program sound here? `tolerance`: of the integration.
int examine(double tolerance, const Options& options);
/// Compares two folders that `run` or `replay` wrote. `tolerance`: largest difference of the contraction
/// ratio that is allowed, if the user sets one.
int compare_folders(const std::string& left, const std::string& right, std::optional<double> tolerance,
                    const Options& options);
int check_files(const std::vector<std::string>& paths, const Options& options);
/// Every name that `list_effects` knows.
std::vector<std::string> names_of_effects();
/// The catalogue of effects, or those of these names, which must be known.
int list_effects(const std::vector<std::string>& names, const Options& options);
/// A script that completes verbs, options and values; `shell`: bash or zsh.
int print_completion(const std::string& shell, const Options& options);
/// `kind`: scenario, campaign, rig or dataset; `format`: json (JSON Schema), markdown (table of keys) or yaml
/// (the rig `thesis` with every value, whatever the kind).
int print_schema(const std::string& kind, const std::string& format);

}  // namespace mckibben::cli
