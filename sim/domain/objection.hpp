// What is wrong with a data set, whoever found it: the reader of its file knows where that stands there.
#pragma once

#include <cstddef>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include <sim/domain/dataset.hpp>

namespace mckibben::domain {

/// A run and the load that it seems to have.
struct SeemingLoad {
  std::size_t run;
  double load_kg;
};

struct Objection {
  std::string quantity;           ///< as in the data set's file: contraction, current, muscle_pressure, load
  std::vector<std::size_t> runs;  ///< ascending; none: it is to the data set as a whole
  std::string message;            ///< what is wrong, and what to write instead
  bool certain = true;            ///< the numbers are not what they are called: nothing follows from them
  std::vector<SeemingLoad> exchanged{};  ///< loads that have each other's labels, and what they should be
};

/// As "run r02: MESSAGE", "runs r01, r02: MESSAGE" or "all runs: MESSAGE".
std::string text_of(const Dataset& data, const Objection& objection);

/// The objections with such messages.
std::vector<Objection> with_runs_named(const Dataset& data, std::vector<Objection> objections);

/// A data set that can be read but not used (exit status 65). `what()` has a line for each objection.
class UnfitData : public std::runtime_error {
 public:
  UnfitData(const Dataset& data, std::vector<Objection> objections);
  /// The objection is to the data set as a whole.
  UnfitData(const Dataset& data, std::string message)
      : UnfitData(data, std::vector<Objection>{{"", {}, std::move(message)}}) {}

  const std::filesystem::path& path() const { return path_; }
  /// Their messages name the runs.
  const std::vector<Objection>& objections() const { return objections_; }

 private:
  UnfitData(std::filesystem::path path, std::vector<Objection> objections);

  std::filesystem::path path_;
  std::vector<Objection> objections_;
};

}  // namespace mckibben::domain
