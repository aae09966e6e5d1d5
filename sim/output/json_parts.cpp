// See the header.
#include <sim/engine/versions.hpp>
#include <sim/output/json_parts.hpp>

namespace mckibben::output {

using input::Json;

namespace {

Json inputs_json(const std::vector<domain::InputFile>& files) {
  Json list = Json::array();
  for (const auto& file : files) list.push_back({{"file", file.name}, {"sha256", file.sha256}});
  return list;
}

}  // namespace

Json heading_json(const char* schema, const std::vector<domain::InputFile>& files) {
  return {{"schema", schema},
          {"program", {{"mckibben", MCKIBBEN_VERSION}, {"sundials", engine::sundials_version()}}},
          {"input_files", inputs_json(files)}};
}

Json solver_json(const engine::Counters& counters) {
  return {{"steps", counters.steps},
          {"rejected_steps", counters.rejected_steps},
          {"right_hand_sides", counters.right_hand_sides},
          {"jacobians", counters.jacobians},
          {"events", counters.events},
          {"stiff_from_tick", counters.stiff_from_tick < 0 ? Json(nullptr) : Json(counters.stiff_from_tick)}};
}

engine::Counters counters_of(const Json& solver) {
  const Json& from = solver.at("stiff_from_tick");
  return {.steps = solver.at("steps").get<long>(),
          .rejected_steps = solver.at("rejected_steps").get<long>(),
          .right_hand_sides = solver.at("right_hand_sides").get<long>(),
          .jacobians = solver.at("jacobians").get<long>(),
          .events = solver.at("events").get<long>(),
          .stiff_from_tick = from.is_null() ? -1 : from.get<long>()};
}

Json ledger_json(const plant::Rig& rig, const run::Recording& recording) {
  const auto& books = recording.ledger;
  Json ledger{
      {"air_drawn_kg", books.air_drawn_kg},
      {"air_vented_kg", books.air_vented_kg},
      {"air_leaked_kg", books.air_leaked_kg},
      {"braid_work_J", books.braid_work_J},
      {"thread_friction_work_J", books.thread_friction_work_J},
      {"guide_work_J", books.guide_work_J},
      {"stop_work_J", books.stop_work_J},
      {"effects_work_J", books.effects_work_J},
      {"unexplained_share", {{"gas", recording.imbalance.gas}, {"energy", recording.imbalance.energy}}}};
  if (rig.effects.warm())
    ledger.update({{"valve_air_kg", books.valve_air_kg},
                   {"muscle_air_kg", books.muscle_air_kg},
                   {"air_inflow_J", books.air_inflow_J},
                   {"gas_work_J", books.gas_work_J}});
  if (!rig.effects.get<plant::GasTemperature>().absent()) ledger["gas_heat_J"] = books.gas_heat_J;
  return ledger;
}

Json span_json(const run::Span& span) {
  return {{"lowest", span.low}, {"highest", span.high}};
}

std::string text_of(const Json& document) {
  return document.dump(2) + "\n";
}

/// Thesis 2.3: what contraction did to the muscle.
Json contraction_json(const plant::Rig& rig, const run::Recording& recording) {
  const char* said[] = {"safe", "risk", "impossible"};
  return {
      {"largest_ratio", recording.largest_contraction_ratio},
      {"verdict", said[static_cast<int>(plant::danger_of(rig.muscle, recording.largest_contraction_ratio))]}};
}

}  // namespace mckibben::output
