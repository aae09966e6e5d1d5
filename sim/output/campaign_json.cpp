// Layout of a campaign's documents; see the header.
#include <sim/data/amount.hpp>
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

Json runs_json(const plant::Rig& rig, const std::vector<run::EndedRun>& runs) {
  Json list = Json::array();
  for (const auto& run : runs) {
    if (!run.failure.empty()) continue;
    Json entry{{"id", run.job.id}, {"file", run.job.id + ".csv"}};
    if (rig.pair() == nullptr) entry["load"] = input::quantity_json(run.job.load_kg, "kg");
    list.push_back(std::move(entry));
  }
  return list;
}

/// A column whose numbers are counts of the encoder, times what one is.
Json counted_json(const char* column, double per_count) {
  return {{"column", column}, {"unit", "count"}, {"factor", 1.0 / per_count}};
}

}  // namespace

std::string digest_of(const domain::Campaign& campaign) {
  std::string text = input::campaign_json(campaign).dump();
  for (const auto& current : campaign.currents)
    for (const auto* one : {&current.current, &current.current_1, &current.current_2})
      if (const auto* recorded =
              one->has_value() ? std::get_if<controllers::RecordedCurrent>(&**one) : nullptr)
        text += Json(recorded->samples_mA).dump();
  return input::sha256_hex(text);
}

Json entry_json(const domain::Campaign& campaign, const run::EndedRun& run) {
  const bool pair = campaign.rig.pair() != nullptr;
  Json entry{{"id", run.job.id}};
  if (!pair) entry["load_kg"] = run.job.load_kg;
  entry["current"] = campaign.currents[run.job.current].name;
  entry["repeat"] = run.job.repeat;
  if (!run.failure.empty()) {
    entry["failure"] = run.failure;
    return entry;
  }
  entry["file"] = run.job.id + ".csv";
  entry["rows"] = run.rows;
  if (campaign.rig.has_angle())
    entry["angle_rad"] = span_json(run.angle_rad);
  else
    entry["largest_contraction_ratio"] = run.largest_contraction_ratio;
  entry["solver"] = solver_json(run.solver);
  if (!run.doubts.empty()) entry["doubts"] = run.doubts;
  return entry;
}

run::EndedRun ended_run(const run::CampaignJob& job, const Json& entry) {
  if (entry.contains("failure")) return {job, entry.at("failure").get<std::string>()};
  run::EndedRun run{.job = job,
                    .rows = entry.at("rows").get<std::size_t>(),
                    .solver = counters_of(entry.at("solver")),
                    .doubts = entry.value("doubts", std::vector<std::string>{})};
  if (entry.contains("angle_rad"))
    run.angle_rad = {entry.at("angle_rad").at("lowest").get<double>(),
                     entry.at("angle_rad").at("highest").get<double>()};
  else
    run.largest_contraction_ratio = entry.at("largest_contraction_ratio").get<double>();
  return run;
}

Json columns_json(const plant::Rig& rig) {
  const bool cell = rig.sensors.of(plant::Sensed::force) != nullptr;
  Json columns = Json::object();
  if (rig.has_angle())
    columns["angle"] = counted_json("angle_rad", data::reading_per_count(rig));
  else if (cell)
    columns["contraction"] = counted_json("contraction_ratio", run::contraction_per_count(rig));
  if (cell)
    for (const plant::Channel& channel : plant::measured_channels(rig, {.pair = rig.pair() != nullptr}))
      if (channel.signal->reads == "force")
        columns[plant::Channel{&plant::signal_of("force"), channel.muscle}.key_in_dataset()] = {
            {"column", channel.name_in_dataset()}, {"unit", "N"}};
  return columns;
}

Json dataset_json(const plant::Rig& rig, const std::string& name, const std::vector<run::EndedRun>& runs) {
  Json data{{"schema", input::dataset_schema}, {"rig", name}};
  if (Json columns = columns_json(rig); !columns.empty()) data["columns"] = std::move(columns);
  data["runs"] = runs_json(rig, runs);
  return data;
}

Json truth_json(const domain::Campaign& campaign, const std::vector<run::EndedRun>& runs) {
  return {{"schema", "mckibben-truth/1"},
          {"seed", campaign.seed},
          {"input_files", heading_json("", campaign.inputs)["input_files"]},
          {"noise", input::to_json(campaign.noise, {campaign.rig.command_unit()})},
          {"rig", input::to_json(campaign.rig)},
          {"runs", runs_json(campaign.rig, runs)}};
}

std::string json_of(const domain::Campaign& campaign, const std::vector<run::EndedRun>& runs) {
  Json document = heading_json("mckibben-campaign-run/1", campaign.inputs);
  document["seed"] = campaign.seed;
  document["tolerance"] = campaign.rig.integrator.tolerance;
  // As its owner knows it; what is hidden stands in truth.yaml.
  domain::Campaign known = campaign;
  known.rig = known.known;
  document["campaign"] = input::campaign_json(known);
  document["campaign"].erase("noise");
  document.erase("input_files");  // their names, and its own, may tell what is hidden
  document["campaign"].erase("name");
  document["runs"] = Json::array();
  for (const auto& run : runs) document["runs"].push_back(entry_json(campaign, run));
  return text_of(document);
}

}  // namespace mckibben::output
