// Layout of a campaign's documents; see the header.
#include <sim/input/campaign_file.hpp>
#include <sim/input/dataset_file.hpp>
#include <sim/input/hash.hpp>
#include <sim/output/campaign_folder.hpp>
#include <sim/output/campaign_json.hpp>
#include <sim/output/json_parts.hpp>
#include <sim/run/simulate.hpp>

namespace mckibben::output {

using input::Json;

namespace {

Json runs_json(const std::vector<run::EndedRun>& runs) {
  Json list = Json::array();
  for (const auto& run : runs)
    if (run.failure.empty())
      list.push_back({{"id", run.job.id},
                      {"file", run.job.id + ".csv"},
                      {"load", input::quantity_json(run.job.load_kg, "kg")}});
  return list;
}

}  // namespace

std::string digest_of(const domain::Campaign& campaign) {
  std::string text = input::campaign_json(campaign).dump();
  for (const auto& current : campaign.currents)
    if (const auto* recorded = std::get_if<controllers::RecordedCurrent>(&current.current))
      text += Json(recorded->samples_mA).dump();
  return input::sha256_hex(text);
}

Json entry_json(const domain::Campaign& campaign, const run::EndedRun& run) {
  Json entry{{"id", run.job.id},
             {"load_kg", run.job.load_kg},
             {"current", campaign.currents[run.job.current].name},
             {"repeat", run.job.repeat}};
  if (!run.failure.empty()) {
    entry["failure"] = run.failure;
    return entry;
  }
  entry["file"] = run.job.id + ".csv";
  entry["rows"] = run.rows;
  entry["largest_contraction_ratio"] = run.largest_contraction_ratio;
  entry["solver"] = solver_json(run.solver);
  return entry;
}

run::EndedRun ended_run(const run::CampaignJob& job, const Json& entry) {
  if (entry.contains("failure")) return {job, entry.at("failure").get<std::string>()};
  return {job, "", entry.at("rows").get<std::size_t>(), entry.at("largest_contraction_ratio").get<double>(),
          counters_of(entry.at("solver"))};
}

// A load cell makes it one with a clock of its own, whose contraction says that it is counted.
Json dataset_json(const plant::Rig& rig, const std::string& name, const std::vector<run::EndedRun>& runs) {
  Json data{{"schema", input::dataset_schema}, {"rig", name}};
  if (rig.load_cell.fitted)
    data["columns"] = {{"contraction",
                        {{"column", "contraction_ratio"},
                         {"unit", "count"},
                         {"factor", 1.0 / run::contraction_per_count(rig)}}},
                       {"force", {{"column", "force_N"}, {"unit", "N"}}}};
  data["runs"] = runs_json(runs);
  return data;
}

Json truth_json(const domain::Campaign& campaign, const std::vector<run::EndedRun>& runs) {
  return {{"schema", "mckibben-truth/1"},
          {"seed", campaign.seed},
          {"noise", input::to_json(campaign.noise)},
          {"rig", input::to_json(campaign.rig)},
          {"runs", runs_json(runs)}};
}

std::string json_of(const domain::Campaign& campaign, const std::vector<run::EndedRun>& runs) {
  Json document = heading_json("mckibben-campaign-run/1", campaign.inputs);
  document["seed"] = campaign.seed;
  document["tolerance"] = campaign.rig.integrator.tolerance;
  // As its owner knows it; what is hidden stands in truth.yaml.
  domain::Campaign known = campaign;
  known.rig = plant::nominal(known.rig);
  document["campaign"] = input::campaign_json(known);
  document["campaign"].erase("noise");
  document["runs"] = Json::array();
  for (const auto& run : runs) document["runs"].push_back(entry_json(campaign, run));
  return text_of(document);
}

}  // namespace mckibben::output
