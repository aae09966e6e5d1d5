// The verb effects, and effects through the verbs that simulate: run, replay and dataset, which hides them.
#include <filesystem>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

#include <plant/effects.hpp>
#include <sim/input/dataset_file.hpp>
#include <sim/input/fields_json.hpp>
#include <sim/input/synonyms.hpp>

#include "program.hpp"

namespace mckibben::cli {
namespace {

namespace fs = std::filesystem;
using input::Json;

constexpr const char* hidden_campaign =
    "schema: mckibben-campaign/1\n"
    "rig: leaky.yaml\n"
    "loads: [13.87 kg]\n"
    "currents:\n"
    "  - {duration: 2.4 s, current: {kind: sine_current, low: 4 mA, high: 18 mA, period: 2.4 s}}\n"
    "noise: {encoder_jitter: 1e-5, ripple: 200 Pa}\n";

class EffectsVerb : public InAFolder {
 protected:
  void SetUp() override {
    write_text(scratch / "leaky.yaml",
               "schema: mckibben-rig/1\n"
               "joint: {load_offset: 0.25 kg}\n"
               "effects:\n"
               "  muscle_leak: {conductance: 3e-10 m3/(s.Pa)}\n"
               "  supply_droop: {line_resistance: 1e8 s.Pa/kg}\n"
               "  encoder_backlash: {width: 1 mm}\n");
    write_text(scratch / "hidden.yaml", hidden_campaign);
  }
};

TEST_F(EffectsVerb, ListsEveryEffectWithAllThereIsToSay) {
  const auto said = run("effects --json");
  ASSERT_EQ(said.status, 0) << said.err;
  const Json document = Json::parse(said.out);
  EXPECT_EQ(document.at("schema"), "mckibben-effects/1");
  ASSERT_EQ(document.at("effects").size(), plant::Effects::count - 1);
  EXPECT_EQ(document.at("residual_law").at("name"), "residual_law");
  const std::string text = run("effects").out;
  const std::string page = read_text(MCKIBBEN_SOURCE_DIR "/docs/effects.md");
  for (const auto& effect : document.at("effects")) {
    for (const char* key : {"name", "acts_on", "law", "meaning", "source"}) {
      const auto word = effect.at(key).get<std::string>();
      EXPECT_FALSE(word.empty());
      EXPECT_TRUE(holds(text, word)) << word;
    }
    EXPECT_TRUE(holds(page, effect.at("name").get<std::string>() + '`'))
        << "docs/effects.md lacks " << effect.at("name");
    bool has_size = false;
    for (const auto& parameter : effect.at("parameters")) {
      EXPECT_TRUE(holds(text, parameter.at("key").get<std::string>()));
      has_size = has_size || parameter.contains("absent");
    }
    EXPECT_TRUE(has_size) << effect.at("name");
  }
}

TEST_F(EffectsVerb, ItsExamplesWork) {
  const Json document = Json::parse(run("effects --json").out);
  int count = 0;
  auto all = document.at("effects");
  all.push_back(document.at("residual_law"));
  for (const auto& effect : all)
    for (const auto& example : effect.at("examples")) {
      Json rig{{"schema", "mckibben-rig/1"}};
      rig.update(example);
      write_text(scratch / "example.yaml", rig.dump());
      const auto said = run("check example.yaml");
      EXPECT_EQ(said.status, 0) << said.err;
      ++count;
    }
  EXPECT_GT(count, static_cast<int>(plant::Effects::count));  // bladder_elasticity has two laws
}

TEST_F(EffectsVerb, TellsOneByItsName) {
  const auto said = run("effects bladder_elasticity valve_lag");
  ASSERT_EQ(said.status, 0) << said.err;
  EXPECT_TRUE(holds(said.out, "    effects:\n      bladder_elasticity:\n        variant: saturating\n",
                    "valve_lag: "));
  EXPECT_TRUE(lacks(said.out, "muscle_leak"));
  EXPECT_EQ(Json::parse(run("effects valve_lag --json").out).at("effects").size(), 1u);
  ASSERT_EQ(run("effects muscle_leak --out list --json").status, 0);
  EXPECT_EQ(read_text(scratch / "list/effects.json"), run("effects muscle_leak --json").out);
  EXPECT_TRUE(holds(read_text(scratch / "list/muscle_leak.svg"), "<svg"));
  EXPECT_FALSE(fs::exists(scratch / "list/valve_lag.svg"));
}

TEST_F(EffectsVerb, TakesTermsOfTheField) {
  EXPECT_EQ(run("effects Preisach").out, run("effects bladder_hysteresis").out);
  EXPECT_EQ(run("effects 'dead zone'").out, run("effects valve_dead_band").out);
}

TEST_F(EffectsVerb, SaysWhatATermIsThatIsNoEffect) {
  const auto said = run("effects 'Smith predictor'");
  EXPECT_EQ(said.status, 64);
  EXPECT_TRUE(
      holds(said.err, "Smith predictor is not an effect; here: `model_inverse_feedback`", "your_words.md"));
  EXPECT_TRUE(holds(run("effects hysterisis").err, "unknown effect hysterisis; did you mean hysteresis?"));
}

TEST_F(EffectsVerb, KnowsEachTermOfItsPage) {
  ASSERT_GT(input::synonyms().size(), 80u);
  for (const input::Synonym& one : input::synonyms()) {
    const auto said = run("effects '" + one.term + "'");
    EXPECT_TRUE(holds(said.out + said.err, one.names.empty() ? one.here : one.names.front()));
    EXPECT_TRUE(lacks(said.err, "unknown effect"));
  }
}

TEST_F(EffectsVerb, SaysWhichLawOfOnesOwnIsTooMuchToBeDrawn) {
  write_text(scratch / "push.yaml",
             "schema: mckibben-hypothesis/1\nname: push\nsentence: something pushes\nadds: force\n"
             "law: F\nparameters: {F: {unit: N, typical: 3000, range: [0, 5000]}}\n");
  const Said said = mckibben("effects --hypothesis push.yaml --out pictures", scratch);
  EXPECT_EQ(said.status, 70);
  EXPECT_TRUE(holds(said.err, "push cannot be drawn"));
  EXPECT_TRUE(lacks(said.err, "defect"));
  EXPECT_FALSE(fs::exists(scratch / "pictures"));
}

TEST_F(EffectsVerb, AnUnknownNameIsAUsageError) {
  const auto said = run("effects muscle_leek");
  EXPECT_EQ(said.status, 64);
  EXPECT_EQ(said.out, "");
  EXPECT_TRUE(holds(said.err, "unknown effect muscle_leek; did you mean muscle_leak?"));
}

TEST_F(EffectsVerb, RunWorksWithThemAndRunJsonNamesThem) {
  std::string text = quick_scenario;
  write_text(scratch / "nominal.yaml", text);
  write_text(scratch / "with.yaml", text + "rig: leaky.yaml\n");
  const auto nominal = Json::parse(run("run nominal.yaml --json").out);
  const auto said = run("run with.yaml --json");
  ASSERT_EQ(said.status, 0) << said.err;
  const auto with = Json::parse(said.out);
  const auto& effects = with.at("scenario").at("rig").at("effects");
  EXPECT_EQ(effects.size(), 3u);  // those that are on, and no other
  EXPECT_EQ(effects.at("muscle_leak").at("conductance"), "3e-10 m3/(s.Pa)");
  EXPECT_FALSE(nominal.at("scenario").at("rig").contains("effects"));
  EXPECT_GT(with.at("runs").at(0).at("ledger").at("air_leaked_kg").get<double>(), 0.0);
  EXPECT_EQ(nominal.at("runs").at(0).at("ledger").at("air_leaked_kg"), 0.0);
  // The controller that turns the nominal model round gives the same currents as without them.
  const auto currents = [&](const std::string& name) {
    std::string column;
    std::istringstream lines(read_text((scratch / "out") / name / "11.138kg_static_inverse.csv"));
    for (std::string line; std::getline(lines, line);)
      column.append(line, 0, line.find(',', line.find(',') + 1)).append(1, '\n');
    return column;
  };
  EXPECT_EQ(currents("nominal"), currents("with"));
}

TEST_F(EffectsVerb, ADatasetHidesThemAndTheTruthTells) {
  const auto said = run("dataset hidden.yaml --json");
  ASSERT_EQ(said.status, 0) << said.err;
  EXPECT_TRUE(holds(read_text(scratch / "out/hidden/dataset.yaml"), "rig: thesis\n"));
  for (const auto& entry : fs::recursive_directory_iterator(scratch / "out/hidden")) {
    const std::string text = entry.is_regular_file() ? read_text(entry.path()) : "";
    EXPECT_TRUE(lacks(text, "muscle_leak", "supply_droop", "encoder_backlash", "0.25 kg", "ripple"))
        << entry.path();
  }
  const std::string truth = read_text(scratch / "out/hidden-truth/truth.yaml");
  EXPECT_TRUE(holds(truth, "muscle_leak", "supply_droop", "encoder_backlash", "load_offset: 0.25 kg",
                    "ripple: 200 Pa"));

  // The nominal rig does not explain it; the true one does, to the jitter of a count.
  const auto rmse = [&](const std::string& options) {
    const auto replayed = run("replay out/hidden --json --out back " + options);
    EXPECT_EQ(replayed.status, 0) << replayed.err;
    return Json::parse(replayed.out).at("runs").at(0).at("rmse").get<double>();
  };
  EXPECT_GT(rmse(""), 3e-3);
  EXPECT_LT(rmse("--rig leaky.yaml"), 1e-3);
}

TEST_F(EffectsVerb, ARigThatDiffersBesidesIsWrittenWithoutThem) {
  write_text(scratch / "leaky.yaml", read_text(scratch / "leaky.yaml") + "gauge: {fitted: true}\n");
  ASSERT_EQ(run("dataset hidden.yaml").status, 0);
  const auto dataset = input::read_dataset(scratch / "out/hidden");
  EXPECT_NE(dataset.rig.sensors.of(plant::Sensed::muscle_pressure), nullptr);
  EXPECT_TRUE(dataset.rig.effects.absent());
  EXPECT_EQ(dataset.rig.joint.load_offset_kg, 0.0);
}

}  // namespace
}  // namespace mckibben::cli
