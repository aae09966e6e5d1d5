// Plan, files and end of a campaign's folders; see the header.
//
// OUT.unfinished/  plan.json          whose runs these are
//                  data/, truth/      what will be OUT and OUT-truth
//                  runs/<id>.json     a run's entry in campaign.json, size and digest of its files; written
//                  last,
//                                     so it says that the run is there, and whether it is as it was written
//                  publish            while both take their places (publication.hpp)
#include <algorithm>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include <sim/domain/number.hpp>
#include <sim/engine/versions.hpp>
#include <sim/input/campaign_file.hpp>
#include <sim/input/hash.hpp>
#include <sim/input/rigs.hpp>
#include <sim/input/yaml_writer.hpp>
#include <sim/output/campaign_folder.hpp>
#include <sim/output/campaign_json.hpp>
#include <sim/output/run_files.hpp>
#include <sim/run/simulate.hpp>

namespace mckibben::output {
namespace fs = std::filesystem;
namespace {

using input::Json;

constexpr const char* plan_schema = "mckibben-campaign-plan/1";

Json plan_of(const domain::Campaign& campaign, const std::vector<run::CampaignJob>& jobs,
             const std::vector<std::string>& formats) {
  Json plan{{"schema", plan_schema},
            {"program", {{"mckibben", MCKIBBEN_VERSION}, {"sundials", engine::sundials_version()}}},
            {"campaign_sha256", digest_of(campaign)},
            {"formats", formats},
            {"ids", Json::array()}};
  for (const auto& job : jobs) plan["ids"].push_back(job.id);
  return plan;
}

std::optional<Json> read_json(const fs::path& path) {
  const auto text = read_regular(path);
  if (!text) return std::nullopt;
  try {
    return Json::parse(*text);
  } catch (const Json::exception&) {
    return std::nullopt;
  }
}

/// Files of one run inside OUT.unfinished.
struct RunFiles {
  explicit RunFiles(const std::string& id)
      : data("data/" + id),
        truth("truth/" + id),
        ascii("data/thesis/" + id + ".txt"),
        entry("runs/" + id + ".json") {}
  std::string data, truth;  ///< without ending
  std::string ascii, entry;
};

/// What runs/<id>.json holds, sealed by its own digest.
Json sealed(const Json& entry, const Json& files) {
  return {{"entry", entry}, {"files", files}, {"sha256", input::sha256_hex(entry.dump() + files.dump())}};
}

/// Whether a run's files and entry are as they were written.
bool is_whole(const fs::path& folder, const Json& record) {
  try {
    if (record != sealed(record.at("entry"), record.at("files"))) return false;
    for (const auto& file : record.at("files")) {
      const auto content = read_regular(folder / file.at("name").get<std::string>());
      if (!content || content->size() != file.at("bytes").get<std::size_t>() ||
          input::sha256_hex(*content) != file.at("sha256").get<std::string>())
        return false;
    }
    return true;
  } catch (const Json::exception&) {
    return false;
  }
}

/// All files that a campaign with these ids can have written there.
FileNames files_of(const std::vector<std::string>& ids) {
  FileNames names{plan_name,         record_name,          "data/dataset.yaml",
                  "data/rig.yaml",   "data/campaign.json", "data/report.html",
                  "truth/truth.yaml"};
  for (const char* folder : {"data/", "truth/"})
    for (const char* file : {package_file, manifest_name}) names.insert(std::string(folder) + file);
  for (const auto& id : ids) {
    const RunFiles files(id);
    names.insert({files.ascii, files.entry});
    for (const auto& stem : {files.data, files.truth})
      for (auto& name : run_file_names(stem)) names.insert(std::move(name));
  }
  return names;
}

/// What a folder with this plan may hold for us to remove it. A plan is written whole or not at all, so what
/// is no plan is not ours.
FileNames files_in(const std::string& text) {
  try {
    const Json plan = Json::parse(text);
    if (plan.at("schema") == plan_schema) return files_of(plan.at("ids").get<std::vector<std::string>>());
  } catch (const Json::exception&) {
    // Somebody else's.
  }
  return {};
}

/// Columns of a run's tables: of what was measured, and of the truth.
struct TwoTables {
  std::vector<formats::Column> measured, truth;
};

TwoTables tables_of(const run::Recording& recording, const plant::Rig& rig) {
  return {measured_columns(recording, rig), columns_of(recording, rig)};
}

/// The same without values.
TwoTables heads_of(const plant::Rig& rig) {
  run::Recording none;
  none.driven.pair = rig.pair() != nullptr;
  return tables_of(none, rig);
}

/// The shipped rig's name, if this is one; otherwise empty.
std::string shipped_name(const plant::Rig& rig) {
  const Json wanted = input::rig_json(rig);
  return input::shipped_rig_where([&](const plant::Rig& one) { return input::rig_json(one) == wanted; });
}

}  // namespace

CampaignFolder::CampaignFolder(const fs::path& destination, const domain::Campaign& campaign,
                               std::vector<std::string> formats, Say say)
    : ResumedFolder(destination, std::move(say)),
      campaign_(campaign),
      formats_(std::move(formats)),
      jobs_(run::jobs_of(campaign)),
      truth_(result_path(destination_.string() + "-truth")) {
  std::erase(formats_, "csv");
  std::sort(formats_.begin(), formats_.end());
  formats_.erase(std::unique(formats_.begin(), formats_.end()), formats_.end());
  open(plan_of(campaign_, jobs_, formats_).dump(2) + "\n", files_in, campaign.job(), {truth_},
       [this](bool kept) {
         if (kept) remove_damaged();
       });
}

bool CampaignFolder::has(const run::CampaignJob& job) const {
  return fs::exists(unfinished_ / RunFiles(job.id).entry);
}

std::size_t CampaignFolder::runs_there() const {
  return static_cast<std::size_t>(std::ranges::count_if(jobs_, [this](const auto& job) { return has(job); }));
}

// A run that is not as it was written is made again: nothing else in the folder tells whether it was its rows
// or its entry that somebody changed.
void CampaignFolder::remove_damaged() const {
  std::string damaged;
  std::size_t there = 0, count = 0;
  for (const auto& job : jobs_) {
    const fs::path entry = unfinished_ / RunFiles(job.id).entry;
    const auto record = read_json(entry);
    if (record && is_whole(unfinished_, *record))
      ++there;
    else if (fs::remove(entry) && ++count <= 3)
      damaged += (count > 1 ? ", " : "") + job.id;
  }
  say_(fmt::format("{}: {} of {} runs are there already; going on", unfinished_.string(), there,
                   jobs_.size()));
  if (count > 0)
    say_(fmt::format("{} run{} not as written, and made again: {}{}", count, count == 1 ? " is" : "s are",
                     damaged, count > 3 ? ", ..." : ""));
}

void CampaignFolder::put(const run::CampaignRun& run) const {
  const RunFiles files(run.job.id);
  Json written = Json::array();
  const auto write = [&](const std::string& name, const std::string& text) {
    write_staged(unfinished_ / name, text);
    written.push_back({{"name", name}, {"bytes", text.size()}, {"sha256", input::sha256_hex(text)}});
  };
  if (run.recording.failure.empty()) {
    const plant::Rig& rig = campaign_.rig;
    if (!rig.has_angle()) write(files.ascii, thesis_ascii(run.recording, rig, run.job.load_kg));
    auto [measured_columns, true_columns] = tables_of(run.recording, rig);
    const auto measured = table_of(run, "measured", std::move(measured_columns));
    const auto truth = table_of(run, "truth", std::move(true_columns));
    for (const auto& [stem, table] : {std::pair{&files.data, &measured}, std::pair{&files.truth, &truth}})
      for (const auto& file : run_files(*stem, *table, formats_)) write(file.name, file.content);
  }
  write_staged(unfinished_ / files.entry,
               sealed(entry_json(campaign_, run::ended(campaign_, run)), written).dump(2) + "\n");
}

formats::Table CampaignFolder::table_of(const run::CampaignRun& run, const char* what,
                                        std::vector<formats::Column> columns) const {
  std::vector<formats::Attribute> attributes{{"source", program_name()}};
  if (campaign_.rig.pair() == nullptr) attributes.emplace_back("load_kg", run.job.load_kg);
  attributes.emplace_back("current", campaign_.currents[run.job.current].name);
  attributes.emplace_back("repeat", static_cast<double>(run.job.repeat));
  attributes.emplace_back("seed", std::to_string(campaign_.seed));
  return {fmt::format("{}, {}", run.job.id, what), std::move(columns), std::move(attributes)};
}

std::string CampaignFolder::package(const char* what, std::vector<formats::Column> columns,
                                    const std::vector<run::EndedRun>& runs) const {
  Package package{fmt::format("a campaign, {}", what), std::move(columns), {}};
  for (const auto& run : runs) {
    if (!run.failure.empty()) continue;
    std::string holds = campaign_.currents[run.job.current].name;
    if (campaign_.rig.pair() == nullptr)
      holds = fmt::format("{} kg, {}", domain::write_kg(run.job.load_kg), holds);
    package.runs.push_back({run.job.id, std::move(holds)});
  }
  return datapackage(package);
}

std::vector<run::EndedRun> CampaignFolder::runs() const {
  std::vector<run::EndedRun> list;
  for (const auto& job : jobs_)
    list.push_back(ended_run(job, read_json(unfinished_ / RunFiles(job.id).entry).value().at("entry")));
  return list;
}

std::string CampaignFolder::rig_in() const {
  const std::string name = shipped_name(campaign_.known);
  return name.empty() ? "rig.yaml" : fmt::format("dataset.yaml (rig: {})", name);
}

// What stands in both folders beside the runs.
Digests CampaignFolder::write_rest(const std::vector<run::EndedRun>& runs, const Report& report) const {
  Digests files;
  const auto write = [&](const std::string& name, const std::string& text) {
    write_staged(unfinished_ / name, text);
    files[name] = input::sha256_hex(text);
  };
  std::string rig = shipped_name(campaign_.known);
  if (rig.empty()) {
    rig = "rig.yaml";
    write("data/" + rig, input::to_yaml(input::rig_json(campaign_.known)));
  }
  write("data/dataset.yaml", input::to_yaml(dataset_json(campaign_.rig, rig, runs)));
  write("data/campaign.json", json_of(campaign_, runs));
  auto [measured, truth] = heads_of(campaign_.rig);
  write(std::string("data/") + package_file, package("measured", std::move(measured), runs));
  write(std::string("truth/") + package_file, package("truth", std::move(truth), runs));
  if (std::any_of(runs.begin(), runs.end(), [](const auto& run) { return run.failure.empty(); }))
    write("data/report.html", report(unfinished_ / "data"));
  write("truth/truth.yaml", input::to_yaml(truth_json(campaign_, runs)));
  return files;
}

void CampaignFolder::publish(const std::vector<run::EndedRun>& runs, const Report& report) const {
  writing(unfinished_, [&] {
    Digests files = write_rest(runs, report);
    for (const auto& job : jobs_) {
      const Json record = read_json(unfinished_ / RunFiles(job.id).entry).value_or(Json::object());
      for (const auto& file : record.value("files", Json::array()))
        files[file.at("name").get<std::string>()] = file.at("sha256").get<std::string>();
    }
    // The campaign's name may tell what is hidden.
    const std::string of_data =
        fmt::format("dataset {}{}", input::secret_mark, input::sha256_hex(campaign_.job()).substr(0, 16));
    ResumedFolder::publish({{"truth", truth_, campaign_.job()}, {"data", destination_, of_data}}, files);
  });
}

}  // namespace mckibben::output
