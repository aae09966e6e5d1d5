// The results of a campaign on their way to disk: runs are written one by one into OUT.unfinished, so that a
// campaign that was interrupted goes on where it stopped. At the end the data set takes its place as OUT and
// the truth, which no calibration reads, as OUT-truth.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <sim/domain/campaign.hpp>
#include <sim/formats/table.hpp>
#include <sim/output/folder.hpp>
#include <sim/run/campaign.hpp>

namespace mckibben::output {

class CampaignFolder : public ResumedFolder {
 public:
  /// Opens OUT.unfinished. `formats`: of the runs, besides CSV (run_formats).
  CampaignFolder(const std::filesystem::path& destination, const domain::Campaign& campaign,
                 std::vector<std::string> formats, Say say);

  /// All runs of the campaign.
  const std::vector<run::CampaignJob>& jobs() const { return jobs_; }
  /// Whether a run is on disk, as it was written or since it was opened.
  bool has(const run::CampaignJob& job) const;
  std::size_t runs_there() const;
  std::size_t all_runs() const { return jobs_.size(); }

  /// Writes the files of one run; from any thread, one call for each run. Throws CannotWrite.
  void put(const run::CampaignRun& run) const;

  /// What each run came to, once none is missing.
  std::vector<run::EndedRun> runs() const;

  /// Makes report.html of the data set in a folder; asked if there is a run in it.
  using Report = std::function<std::string(const std::filesystem::path& data)>;
  /// Lets both folders take their places, once every file is there as it was written: both or neither. Says
  /// what was set aside. Throws CannotWrite.
  void publish(const std::vector<run::EndedRun>& runs, const Report& report) const;

  /// Where the data set says which rig made it: its rig.yaml, or a shipped rig by name in dataset.yaml.
  std::string rig_in() const;

  /// The folder of the truth.
  const std::filesystem::path& truth() const { return truth_; }

 private:
  void remove_damaged() const;
  Digests write_rest(const std::vector<run::EndedRun>& runs, const Report& report) const;

  formats::Table table_of(const run::CampaignRun& run, const char* what,
                          std::vector<formats::Column> columns) const;
  std::string package(const char* what, std::vector<formats::Column> columns,
                      const std::vector<run::EndedRun>& runs) const;

  const domain::Campaign& campaign_;
  std::vector<std::string> formats_;
  std::vector<run::CampaignJob> jobs_;
  std::filesystem::path truth_;
};

/// The text of campaign.json: the campaign with every default, versions, hashes of the input files, and of
/// each run rows, counted contraction and solver counts. Nothing in it is truth.
std::string json_of(const domain::Campaign& campaign, const std::vector<run::EndedRun>& runs);

}  // namespace mckibben::output
