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

std::string text_of(const Json& document) {
  return document.dump(2) + "\n";
}

}  // namespace mckibben::output
