// The results of an ensemble on their way to disk: blocks of runs one by one into OUT.unfinished, so that an
// interrupted one goes on where it stopped, and in their order into one NetCDF file. At the end OUT takes its
// place with that file and ensemble.json.
//
// OUT.unfinished/  plan.json     whose blocks these are
//                  blocks/N      block N, sealed; N.part, one that was interrupted
//                  data/         what will be OUT
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <sim/domain/campaign.hpp>
#include <sim/formats/netcdf.hpp>
#include <sim/output/folder.hpp>
#include <sim/run/ensemble.hpp>

namespace mckibben::output {

/// What becomes known of a number over all runs that have it (Welford 1962).
struct Moments {
  std::size_t runs = 0;
  double mean = 0.0, squares = 0.0, lowest = 0.0, highest = 0.0;

  void count(double value);
  /// Of the sample; 0 for fewer than two.
  double deviation() const;
};

class EnsembleFolder : public ResumedFolder {
 public:
  /// Opens OUT.unfinished.
  EnsembleFolder(const std::filesystem::path& destination, const domain::Campaign& campaign, run::Keep keep,
                 Say say);
  EnsembleFolder(const EnsembleFolder&) = delete;
  EnsembleFolder& operator=(const EnsembleFolder&) = delete;

  const run::EnsembleShape& shape() const { return shape_; }
  std::size_t all_runs() const { return shape_.runs; }

  /// Whether a block is on disk.
  bool has(std::size_t block) const;
  /// A block to be made: what an interruption left of it, or an empty one.
  run::EnsembleBlock begin(std::size_t block) const;
  /// Writes one that is whole, or keeps what there is of it. From any thread. Throws CannotWrite.
  void put(std::size_t block, const run::EnsembleBlock& runs) const;

  /// Enters all blocks that come next and are there into the file; rank 0 only, one thread at a time. Throws
  /// CannotWrite.
  void gather();
  /// Whether all are.
  bool gathered() const { return gathered_ == shape_.blocks(); }
  /// Runs on disk, whole blocks and parts of them.
  std::size_t runs_there() const;

  /// Lets the folder take its place, once all is gathered. Throws CannotWrite.
  void publish();

  /// ensemble.json, and the table of what was drawn and what came of it.
  std::string document() const;
  std::string table() const;
  std::size_t failed() const { return failed_; }

 private:
  std::filesystem::path file_of(std::size_t block) const;
  std::optional<run::EnsembleBlock> read(const std::filesystem::path& path, std::size_t block) const;
  void into_file(const std::function<void()>& work) const;
  void count(const run::EnsembleBlock& block);

  const domain::Campaign& campaign_;
  run::Keep keep_;
  run::EnsembleShape shape_;
  std::optional<formats::NetcdfRuns> file_;
  std::size_t gathered_ = 0, failed_ = 0;
  std::vector<Moments> moments_;
  std::vector<std::string> failures_;  ///< the first of them
};

}  // namespace mckibben::output
