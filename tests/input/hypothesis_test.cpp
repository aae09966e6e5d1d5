// Laws in files and in rigs: read, written and read again; and where in a file an expression's error is
// shown.
#include <gtest/gtest.h>

#include <sim/domain/rig_number.hpp>
#include <sim/input/field_list.hpp>
#include <sim/input/fields_json.hpp>
#include <sim/input/hypothesis_file.hpp>

#include "rig_text.hpp"
#include "scratch.hpp"

namespace mckibben::input {
namespace {

const std::string cord_creep = R"yaml(schema: mckibben-hypothesis/1
name: cord_creep
sentence: the cord stretches slowly under the load
adds: force
law: "-k * (x - q)"
memories: {q: "(x - q) / tau"}
parameters:
  k: {unit: N/mm, typical: 0.3, range: [0, 5]}
  tau: {unit: s, typical: 3, range: [0.2, 60], value: 4}
)yaml";

std::string faults_of(const std::string& text) {
  const Scratch scratch;
  std::vector<InputFile> inputs;
  try {
    read_hypothesis(scratch.write("law.yaml", text).string(), inputs);
  } catch (const BadInput& bad) {
    std::string all;
    for (const Problem& problem : bad.problems())
      all += std::to_string(problem.place.line) + ":" + std::to_string(problem.place.column) + ": " +
             problem.message + "\n";
    return all;
  }
  return "";
}
std::string with_law(const std::string& law) {
  std::string text = cord_creep;
  const auto at = text.find("law: \"");
  return text.replace(at, text.find('\n', at) - at, "law: " + law);
}

TEST(Hypothesis, IsReadInSi) {
  const Scratch scratch;
  std::vector<InputFile> inputs;
  const OwnLaw law = read_hypothesis(scratch.write("law.yaml", cord_creep).string(), inputs);
  ASSERT_EQ(inputs.size(), 1u);
  const plant::LawText& text = *law.text;
  EXPECT_EQ(text.name, "cord_creep");
  ASSERT_EQ(text.parameters.size(), 2u);
  EXPECT_EQ(text.parameters[0].unit, "N/m");
  EXPECT_DOUBLE_EQ(text.parameters[0].typical, 300.0);
  EXPECT_DOUBLE_EQ(text.parameters[0].highest, 5000.0);
  EXPECT_TRUE(law.absent());
  EXPECT_EQ(law.values[1], 4.0);
  ASSERT_EQ(text.memories.size(), 1u);
  EXPECT_EQ(text.memories[0].unit, "m");
  // What is written is the same law.
  Json written = hypothesis_json(law);
  written["schema"] = hypothesis_schema;
  const OwnLaw again = read_hypothesis(scratch.write("again.yaml", written.dump()).string(), inputs);
  EXPECT_EQ(*again.text, text);
}

TEST(Hypothesis, InARigIsWrittenWithItsValues) {
  const Scratch scratch;
  scratch.write("creep.yaml", cord_creep);
  const std::string rig_text =
      "schema: mckibben-rig/1\nbase: thesis\neffects:\n  hypotheses:\n    - creep.yaml\n"
      "    - {name: push, sentence: a push, adds: force, law: F, parameters: "
      "{F: {unit: N, typical: 1, range: [-9, 9], value: 2.5}}}\n";
  std::vector<InputFile> inputs;
  const Rig rig = read_rig(scratch.write("rig.yaml", rig_text).string(), inputs);
  ASSERT_EQ(rig.effects.laws.list.size(), 2u);
  EXPECT_EQ(inputs.size(), 2u);
  EXPECT_FALSE(rig.effects.absent());
  const Json written = rig_json(rig);
  ASSERT_EQ(written.at("effects").at("hypotheses").size(), 1u);  // the one without size is left out
  const Rig again = read_rig(scratch.write("again.yaml", written.dump()).string(), inputs);
  EXPECT_EQ(*again.effects.laws.list[0].text, *rig.effects.laws.list[1].text);
  EXPECT_EQ(again.effects.laws.list[0].values[0], 2.5);
  EXPECT_EQ(rig_json(again), written);
}

TEST(Hypothesis, NumbersHaveAPathAndARange) {
  Rig rig = rig_of(
      "effects: {hypotheses: [{name: push, sentence: a push, adds: force, law: F, parameters: "
      "{F: {unit: N, typical: 1, range: [-9, 9], value: 2.5}}}]}");
  const auto found = domain::find_number(rig, "effects.hypotheses.push.F");
  ASSERT_NE(found.value, nullptr);
  EXPECT_EQ(*found.value, 2.5);
  EXPECT_EQ(found.unit, "N");
  EXPECT_EQ(found.lowest, -9.0);
}

TEST(Hypothesis, ErrorsInAnExpressionAreShownInItsLine) {
  EXPECT_EQ(faults_of(with_law("\"-k * (x - q) * taw\"")).substr(0, 36),
            "5:22: law: unknown name taw; did you");
  EXPECT_EQ(faults_of(with_law("-k * (x - q) + t")).substr(0, 5), "5:19:");
  EXPECT_EQ(faults_of(with_law("'-k * (x - q) * e +'")).substr(0, 5), "5:25:");
  EXPECT_EQ(faults_of(with_law(">\n  -k * (x - q)\n    + 3 [N] *\n  (e + v)")).substr(0, 5), "8:6: ");
  EXPECT_EQ(faults_of(with_law("|\n  -k *\n\n  (x - zz)")).substr(0, 5), "8:8: ");
  EXPECT_EQ(faults_of(with_law("\"-k * (x -\n  q) + é\"")).substr(0, 5), "6:8: ");
  std::string rate = cord_creep;
  rate.replace(rate.find("(x - q) / tau"), 13, "(x - q) * tau");
  EXPECT_EQ(faults_of(rate), "6:16: q: (x - q) * tau is in m.s; q is in m, so that its rate is m/s\n");
}

TEST(Hypothesis, TheFirstParameterIsTheSize) {
  EXPECT_NE(faults_of(with_law("-k * (x - q) + 1 [N]")).find("with k = 0 it is 1 N, not 0"),
            std::string::npos);
  std::string text = cord_creep;
  text.replace(text.find("[0, 5]"), 6, "[1, 5]");
  EXPECT_EQ(faults_of(text).substr(0, 5), "8:40:");
}

TEST(Hypothesis, WhatMustNotBeIsSaidAllAtOnce) {
  const std::string said = faults_of(
      "schema: mckibben-hypothesis/1\nname: muscle_leak\nsentence: it leaks\nadds: outflow\nat: joint\nlaw: "
      "c\n"
      "memories: {P: e}\nparameters: {c: {unit: kg/s, typical: 5, range: [0, 1]}, t: {unit: nope, typical: "
      "1, "
      "range: [1, 0]}}\n");
  for (const char* part :
       {"2:7: name = muscle_leak is an effect of the catalogue", "5:5: at = joint: only a force",
        "7:12: P is taken", "typical = 5: is out of the range 0 to 1", "t is taken",
        "unit = nope: is not a unit"})
    EXPECT_NE(said.find(part), std::string::npos) << part << " in\n" << said;
  EXPECT_NE(faults_of("schema: mckibben-hypothesis/1\nname: a\nsentence: b\nadds: force\nlaw: 1 [N]\n")
                .find("the key parameters is missing"),
            std::string::npos);
}

TEST(Hypothesis, HasASchema) {
  const Json schema = json_schema(hypothesis_schema, "Hypothesis", hypothesis_fields());
  EXPECT_TRUE(schema.at("properties").contains("parameters"));
  EXPECT_EQ(schema.at("properties").at("parameters").at("additionalProperties").at("properties").size(), 4u);
}

}  // namespace
}  // namespace mckibben::input
