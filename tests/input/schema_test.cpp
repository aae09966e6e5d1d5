// The JSON Schema and the documentation's tables know every key that the reader knows,
// because all come from one list.
#include <set>

#include <gtest/gtest.h>

#include <sim/input/dataset_file.hpp>
#include <sim/input/field_list.hpp>

#include "good_scenario.hpp"
#include "says.hpp"

namespace mckibben::input {
namespace {

void collect_keys(const Json& value, std::set<std::string>& keys) {
  if (value.is_object())
    for (const auto& [key, inside] : value.items()) {
      keys.insert(key);
      collect_keys(inside, keys);
    }
  if (value.is_array())
    for (const Json& each : value) collect_keys(each, keys);
}

void collect_properties(const Json& schema, std::set<std::string>& keys) {
  if (schema.is_object())
    for (const auto& [word, inside] : schema.items()) {
      if (word == "properties")
        for (const auto& [key, ignored] : inside.items()) keys.insert(key);
      collect_properties(inside, keys);
    }
  if (schema.is_array())
    for (const Json& each : schema) collect_properties(each, keys);
}

TEST(JsonSchema, HoldsEveryKeyOfAResolvedScenario) {
  std::set<std::string> written, known;
  collect_keys(scenario_json(read_text(good_scenario)), written);
  collect_properties(json_schema(scenario_schema, "Scenario", list_fields<Scenario>()), known);
  EXPECT_GT(written.size(), 80u);
  for (const std::string& key : written) EXPECT_TRUE(known.contains(key)) << key;
}

TEST(JsonSchema, SaysWhatIsRequiredAndAllowed) {
  const Json schema = json_schema(scenario_schema, "Scenario", list_fields<Scenario>());
  EXPECT_EQ(schema["required"], (Json{"schema", "loads", "duration", "controllers"}));
  EXPECT_EQ(schema["properties"]["schema"]["const"], "mckibben-scenario/1");
  EXPECT_EQ(schema["additionalProperties"], false);
  EXPECT_EQ(schema["properties"]["target"]["oneOf"].size(), std::variant_size_v<controllers::Target>);
  EXPECT_EQ(schema["properties"]["target"]["oneOf"][0]["properties"]["kind"]["const"], "steps");
  const Json& rig = schema["properties"]["rig"]["oneOf"];
  EXPECT_EQ(rig[1]["type"], "string");
  EXPECT_EQ(rig[0]["properties"]["friction"]["properties"]["law"]["enum"].size(), 4u);
  EXPECT_EQ(rig[0]["properties"]["dac"]["properties"]["bits"]["maximum"], 24);
  EXPECT_EQ(rig[0]["properties"]["muscle"]["properties"]["braid_angle"]["description"],
            "angle between thread and axis at rest, alpha0 (T 2.6); 5 deg to 50 deg");
}

TEST(JsonSchema, KnowsEachKindOfSensorAndTheKeysFromBefore) {
  const Json properties = json_schema("mckibben-rig/1", "Rig", list_fields<Rig>())["properties"];
  const Json& kinds = properties["sensors"]["items"]["oneOf"];
  ASSERT_EQ(kinds.size(), names(plant::SensorKind{}).size() + 1);
  const Json& cell = kinds[4]["properties"];
  EXPECT_EQ(cell["kind"]["const"], "load_cell");
  EXPECT_EQ(cell["signal"]["enum"], Json{"force"});
  EXPECT_TRUE(cell["noise"]["description"].get<std::string>().ends_with("; 0 N to 1000 N"));
  EXPECT_TRUE(kinds[0]["properties"].contains("wheel_ratio"));
  EXPECT_EQ(properties["gauge"]["deprecated"], true);
}

TEST(FieldLists, HaveALineForEachFieldAndASectionForEachKind) {
  const std::string rig = field_lists({{"Rig", list_fields<Rig>()}});
  EXPECT_TRUE(holds(rig, "- `tick` (0.0001 to 1 s; default 0.012 s): time between two readings",
                    "\n    - `bits` (4 to 24; default 12): ", "[laser](#rig-sensors-laser)",
                    "\n### Rig: sensors laser\n"));
  EXPECT_TRUE(holds(field_lists({{"Data set", list_fields<Dataset>()}}),
                    "    - `load` (0 to 500 kg): mass of the load; required where one hangs\n"));
}

TEST(FieldLists, ReferToWhatWasShownBefore) {
  const std::vector<FieldInfo> fields = list_fields<Rig>();
  const std::string twice = field_lists({{"First", fields}, {"Second", fields}});
  EXPECT_TRUE(holds(twice, "- `muscle`, `friction`, ", ": as in [First](#first)\n"));
  EXPECT_EQ(twice.find("time between two readings"), twice.rfind("time between two readings"));
}

}  // namespace
}  // namespace mckibben::input
