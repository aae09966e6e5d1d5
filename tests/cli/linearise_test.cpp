// The verb linearise from end to end: its files, and that other programs would read them.
#include <cmath>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

#include <sim/input/fields_json.hpp>

#include "program.hpp"

namespace mckibben::cli {
namespace {

constexpr const char* loops =
    "schema: mckibben-scenario/1\nloads: [11 kg]\nduration: 1 s\n"
    "target: {kind: steps, start: 0.1, moves: []}\n"
    "controllers:\n"
    "  - {kind: pid, name: soft, proportional: 8 mA, integral_time: 0.2 s, derivative_time: 0.05 s}\n"
    "  - {kind: pid, name: wild, proportional: 300 mA, integral_time: 0.2 s, derivative_time: 0.05 s}\n"
    "  - {kind: static_inverse, assumed_load: 11 kg}\n";

class Linearise : public InAFolder {
 protected:
  void SetUp() override { write_text(scratch / "loops.yaml", loops); }
  input::Json result_of(const std::string& arguments) {
    const Said said = mckibben("linearise " + arguments + " --json", scratch);
    EXPECT_EQ(said.status, 0) << said.err;
    return input::Json::parse(said.out);
  }
};

TEST_F(Linearise, SaysPolesAndMarginsAndWritesWhatItSays) {
  const auto at_height = result_of("loops.yaml --at '45 mm'");
  const auto document = result_of("loops.yaml --at 0.15 --margins '60 deg' --lqr '1 mA'");
  const auto folder = scratch / "out" / "loops-linearise";
  for (const char* file :
       {"linearise.json", "table.txt", "bode.csv", "bode.svg", "linearise.py", "linearise.m"})
    EXPECT_FALSE(read_text(folder / file).empty()) << file;
  EXPECT_EQ(document.at("schema"), "mckibben-linearise/1");
  EXPECT_EQ(document.at("not_linear"), input::Json::array({"static_inverse"}));
  const auto& point = document.at("points").at(0);
  EXPECT_EQ(point.at("poles_per_s").size(), 4u);
  EXPECT_EQ(at_height.at("points").at(0).at("A"), point.at("A"));
  EXPECT_EQ(point.at("states").size(), point.at("A").size());
  EXPECT_NEAR(point.at("outputs").at(0).at("at").get<double>(), 0.15, 1e-3);
  ASSERT_EQ(point.at("loops").size(), 4u);
  const auto &soft = point.at("loops").at(0), &wild = point.at("loops").at(1),
             &found = point.at("loops").at(2);
  EXPECT_TRUE(soft.at("stable").get<bool>());
  EXPECT_GT(soft.at("gain_margin").get<double>(), 1.0);
  EXPECT_FALSE(wild.at("stable").get<bool>());
  EXPECT_TRUE(wild.at("gain_margin").is_null());
  EXPECT_GT(wild.at("calmed_m_per_s").get<double>(), 0.0);
  EXPECT_GE(found.at("phase_margin_rad").get<double>(), 1.0471);
  EXPECT_EQ(found.at("binding_margin"), "gain");
  EXPECT_FALSE(soft.contains("binding_margin"));
  EXPECT_EQ(point.at("lqr").size(), 4u);
  const std::string table = read_text(folder / "table.txt");
  const std::string way_out = " m/s die out: --swing \"";
  EXPECT_TRUE(holds(table, "wild               unstable without friction; swings slower than"));
  ASSERT_TRUE(holds(table, way_out));
  const std::string from_speed = table.substr(table.find(way_out) + way_out.size());
  const std::string swing = " --swing '" + from_speed.substr(0, from_speed.find('"')) + "'";
  const auto calmer = result_of("loops.yaml --at 0.15" + swing).at("points").at(0).at("loops").at(1);
  EXPECT_GT(calmer.at("gain_margin").get<double>(), 1.0) << swing;
  EXPECT_TRUE(holds(read_text(folder / "table.txt"), "; swings faster than ", " m/s grow"));
  result_of("loops.yaml --at 0.15 --swing '5 m/s'");
  EXPECT_TRUE(
      holds(read_text(folder / "table.txt"), "wild               unstable in this swing; swings slower"));
  EXPECT_TRUE(holds(table, point.at("pid_by_margins").get<std::string>()));
  EXPECT_TRUE(holds(table, "; the gain margin binds\n"));
}

TEST_F(Linearise, PidByMarginsCanBePastedIntoTheScenario) {
  const auto document = result_of("loops.yaml --at 0.15 --margins '60 deg'");
  const auto line = document.at("points").at(0).at("pid_by_margins").get<std::string>();
  write_text(scratch / "pasted.yaml", std::string(loops) + "  - " + line + "\n");
  const auto again = result_of("pasted.yaml --at 0.15");
  const auto& pasted = again.at("points").at(0).at("loops").at(2);
  EXPECT_EQ(pasted.at("name"), "pid_by_margins");
  EXPECT_NEAR(pasted.at("phase_margin_rad").get<double>(),
              document.at("points").at(0).at("loops").at(2).at("phase_margin_rad").get<double>(), 2e-3);
}

/// The speed up to which swings die out is where `--swing` tells stable loops from unstable ones.
TEST_F(Linearise, SwingsThatDieOutAreThoseInWhichTheLoopIsStable) {
  const auto wild = [&](const std::string& swing) {
    return result_of("loops.yaml --at 0.15" + swing).at("points").at(0).at("loops").at(1);
  };
  const auto speed = wild("").at("calmed_m_per_s").get<double>();
  EXPECT_TRUE(wild(" --swing '" + std::to_string(0.98 * speed) + " m/s'").at("stable").get<bool>());
  EXPECT_FALSE(wild(" --swing '" + std::to_string(1.02 * speed) + " m/s'").at("stable").get<bool>());
}

/// Gains that a scenario leaves out are told once for all points, and make the same loop when pasted.
TEST_F(Linearise, TunedGainsCanBePastedIntoTheScenario) {
  const std::string open =
      "schema: mckibben-scenario/1\nloads: [11 kg, 14 kg]\nduration: 0.5 s\n"
      "target: {kind: steps, start: 0.1, moves: [{at: 0.1 s, to: 0.12}]}\ncontrollers:\n"
      "  - {kind: pid, feedback_delay_ticks: 2";
  write_text(scratch / "open.yaml", open + ", proportional: 6 mA, integral_time: 0.3 s}\n");
  const auto tuned = result_of("open.yaml --at 0.12");
  ASSERT_EQ(tuned.at("tuned").size(), 1u);
  const auto gains = tuned.at("tuned").at(0).at("gains").get<std::string>();
  EXPECT_TRUE(holds(read_text(scratch / "out" / "open-linearise" / "table.txt"),
                    "\ngains tuned, as by `run`\n  pid: " + gains + "\n"));
  write_text(scratch / "pasted.yaml", open + ", " + gains + "}\n");
  const auto pasted = result_of("pasted.yaml --at 0.12");
  EXPECT_TRUE(pasted.at("tuned").empty());
  for (const std::size_t point : {0, 1}) {
    const auto of = [&](const input::Json& all) { return all.at("points").at(point).at("loops").at(0); };
    ASSERT_TRUE(of(tuned).at("stable").get<bool>());
    EXPECT_NEAR(of(pasted).at("gain_margin").get<double>() / of(tuned).at("gain_margin").get<double>(), 1.0,
                2e-3);
  }
}

/// A gain of a lever is for a radian, here as in the scenario.
TEST_F(Linearise, LoopsOfALeverHaveTheMarginsThatTheirLinesPromise) {
  const std::string lever = "schema: mckibben-scenario/1\nrig: " MCKIBBEN_SOURCE_DIR
                            "/scenarios/rigs/forearm.yaml\nloads: [2 kg]\nduration: 1 s\n"
                            "target: {kind: steps, start: 30 deg, moves: []}\ncontrollers:\n";
  write_text(scratch / "lever.yaml",
             lever + "  - {kind: pid, proportional: 2 mA/rad, integral_time: 1 s, derivative_time: 0.1 s}\n");
  const auto document = result_of("lever.yaml --at '50 deg' --margins '60 deg'");
  const auto& point = document.at("points").at(0);
  ASSERT_EQ(point.at("loops").size(), 2u);
  const auto line = point.at("pid_by_margins").get<std::string>();
  EXPECT_TRUE(holds(line, " mA/rad, "));
  write_text(scratch / "pasted.yaml", lever + "  - " + line + "\n");
  const auto again = result_of("pasted.yaml --at '50 deg'");
  const double pasted = again.at("points").at(0).at("loops").at(0).at("gain_margin").get<double>();
  EXPECT_NEAR(pasted / point.at("loops").at(1).at("gain_margin").get<double>(), 1.0, 2e-3);  // four digits
}

/// It shows no margin as small as was asked for: a peak of the gain would have it with a hair more.
TEST_F(Linearise, AResonanceThatBindsBelowZeroDecibelsIsSaid) {
  result_of(MCKIBBEN_SOURCE_DIR
            "/scenarios/rigs/forearm.yaml --load '2 kg' --at '45 deg' --margins '60 deg' --out arm");
  EXPECT_TRUE(holds(read_text(scratch / "arm" / "table.txt"), "; the resonance at 0.8",
                    " Hz is just below 0 dB: any more gain, and the phase margin there is 5"));
}

/// In place of python-control a module that keeps what it is handed.
TEST_F(Linearise, PythonProgramMakesTheSystem) {
  const auto document = result_of("loops.yaml --at 0.15 --lqr '1 mA' --out made");
  write_text(scratch / "control.py", "def ss(A, B, C, D, **names):\n    return A, B, C, D, names\n");
  write_text(
      scratch / "use.py",
      "import json, runpy\nmade = runpy.run_path('made/linearise.py')\nA, B, C, D, names = made['rig']\n"
      "print(json.dumps([A, B, C, D, names['states'], made['lqr'][0]]))\n");
  const Said said = shell("PYTHONPATH=. python3 use.py", scratch);
  ASSERT_EQ(said.status, 0) << said.err;
  const auto made = input::Json::parse(said.out);
  const auto& point = document.at("points").at(0);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(made.at(i), point.at(std::string(1, "ABCD"[i])));
  EXPECT_EQ(made.at(4).size(), point.at("states").size());
  EXPECT_EQ(made.at(5).at(0), point.at("lqr"));
  EXPECT_TRUE(holds(read_text(scratch / "made" / "linearise.m"), "rig = points{1};"));
}

/// A law that knows of delays, and to which muscles it goes.
TEST_F(Linearise, StateFeedbackSaysWhatItActsOn) {
  write_text(
      scratch / "late.yaml",
      "schema: mckibben-rig/1\nbase: thesis\neffects: {command_delay: {time: 30 ms}, reading_delay: {time: "
      "10 ms}}\n");
  const auto late = result_of("late.yaml --at 0.12 --load '11 kg' --swing '50 mm/s' --lqr '1 mA' --out late");
  const auto& point = late.at("points").at(0);
  EXPECT_EQ(point.at("lqr_of_commands_before").size(), 4u);
  EXPECT_TRUE(point.at("loops").at(0).at("stable").get<bool>());
  const std::string table = read_text(scratch / "late" / "table.txt");
  EXPECT_TRUE(holds(table, "- F (commands before - base), F of the latest first: ", "x is 0.01 s late"));
  for (const char* file : {"linearise.m", "linearise.py"})
    EXPECT_TRUE(holds(read_text(scratch / "late" / file),
                      "u = -K x, of the system sampled every tick (0.012 s)",
                      "_of_commands_before: F, u = -K x - F (u before)"));
  result_of("thesis_pair --at '10 deg' --lqr '1 mA' --out two");
  for (const char* file : {"linearise.m", "linearise.py"})
    EXPECT_TRUE(
        holds(read_text(scratch / "two" / file), "it goes to muscle 1 with plus and to muscle 2 with minus"));
}

TEST_F(Linearise, SaysWhatHasNoLoop) {
  write_text(scratch / "given.yaml", std::string(loops) +
                                         "  - {kind: step_current, name: up, start: 8 mA, "
                                         "moves: []}\n");
  const auto document = result_of("given.yaml --at 0.15");
  EXPECT_EQ(document.at("not_linear"), input::Json::array({"static_inverse"}));
  EXPECT_EQ(document.at("no_loop"), input::Json::array({"up"}));
  EXPECT_TRUE(holds(read_text(scratch / "out" / "given-linearise" / "table.txt"),
                    "up: plays a command and has no loop\n"));
}

TEST_F(Linearise, BodeSaysWhatIsARigsAndWhatALoops) {
  result_of("loops.yaml --at 0.15 --lqr '1 mA'");
  EXPECT_TRUE(holds(read_text(scratch / "out" / "loops-linearise" / "bode.csv"),
                    "rig_gain,rig_phase_deg,soft_loop_gain,soft_loop_phase_deg,wild_loop_gain,",
                    ",lqr_loop_gain,"));
}

/// The Bode table is the response of the matrices that are exported, where no load sticks.
TEST_F(Linearise, BodeBeginsAtTheGainAtRest) {
  const auto document = result_of("thesis --at '10 mA' --load '11 kg'");
  std::istringstream rows(read_text(scratch / "out" / "thesis-linearise" / "bode.csv"));
  std::string head, first;
  std::getline(rows, head);
  std::getline(rows, first);
  EXPECT_EQ(head, "frequency_Hz,rig_gain,rig_phase_deg");
  const double gain = std::stod(first.substr(first.find(',') + 1));
  EXPECT_NEAR(gain / document.at("points").at(0).at("gain_at_rest").get<double>(), 1.0, 1e-4);
}

TEST_F(Linearise, TakesPlacesOfEachKindAndLoads) {
  const auto document = result_of(
      "thesis --at '10 mA' --at '2 bar' --at 0.2 --load '11 kg' --load '16 kg' --friction sticking --valve "
      "filling");
  ASSERT_EQ(document.at("points").size(), 6u);
  EXPECT_NEAR(document.at("points").at(1).at("outputs").at(1).at("at").get<double>(), 2e5, 100.0);
  EXPECT_EQ(document.at("threads"), "sticking");
  EXPECT_FALSE(read_text(scratch / "out" / "thesis-linearise" / "bode_6.svg").empty());
  const auto pair = result_of("thesis_pair --at '10 deg'");
  EXPECT_EQ(pair.at("points").at(0).at("inputs").size(), 2u);
  EXPECT_NEAR(pair.at("points").at(0).at("outputs").at(0).at("at").get<double>(), 0.1745, 1e-3);
}

TEST_F(Linearise, SaysWhatItCannotDo) {
  const Said far = run("linearise thesis --at 0.9");
  EXPECT_EQ(far.status, 65);
  EXPECT_TRUE(holds(far.err, "a contraction ratio of 0.9 is out of reach: commands give "));
  EXPECT_TRUE(holds(run("linearise thesis --at '0 bar'").err,
                    "a muscle pressure of 0 bar is out of reach: commands give 0.5 to 5 bar"));
  EXPECT_TRUE(
      holds(run("linearise thesis_pair --at '90 deg'").err, "a joint angle of 90 deg is out of reach"));
  EXPECT_TRUE(holds(run("linearise thesis --friction sticking --swing '1 m/s'").err,
                    "--swing: threads that stick damp no swing: take --friction sliding"));
  EXPECT_TRUE(holds(run("linearise thesis --margins '2 rad'").err, "must be above 0 and at most 85 deg"));
  write_text(scratch / "sealed.yaml", "schema: mckibben-rig/1\nvalve: {kind: none}\n");
  const Said sealed = run("linearise sealed.yaml");
  EXPECT_EQ(sealed.status, 65);
  EXPECT_TRUE(holds(sealed.err, "its valve keeps no pressure that follows a command"));
  const Said unit = run("linearise thesis --at '10 kg'");
  EXPECT_EQ(unit.status, 64);
  EXPECT_TRUE(
      holds(unit.err, "--at 10 kg: no command as \"10 mA\", no pressure as \"2.5 bar\" and no contraction"));
  EXPECT_TRUE(holds(run("linearise thesis --at 15").err,
                    "--at 15: no contraction ratio is as large; did you mean \"15 mA\"?"));
  for (const std::string one : {"0.1", "1", "'1 V'", "'0 mA'"})
    EXPECT_TRUE(holds(run("linearise thesis --lqr " + one).err, ": a command is wanted, as \"1 mA\"")) << one;
  EXPECT_TRUE(holds(run("linearise thesis --swing 50").err, "it is measured in m/s: for example 50 mm/s"));
  EXPECT_TRUE(holds(run("linearise thesis --margins 60").err,
                    "--margins: 60 has no unit; it is measured in deg: for example 60 deg"));
  EXPECT_TRUE(holds(run("linearise thesis --load 11").err, "--load: 11 has no unit; it is measured in kg"));
  EXPECT_TRUE(holds(run("linearise thesis --load '500 g' --load '501 kg'").err,
                    "--load: 501 kg must be 0 or more and at most 500 kg"));
}

/// As the loads of a scenario may be.
TEST_F(Linearise, TakesAnEmptyHand) {
  const auto document = result_of("thesis_pair --load '0 kg' --load '1 kg'");
  EXPECT_EQ(document.at("points").at(0).at("title"), "0 kg at 12 mA and 12 mA");
  EXPECT_EQ(document.at("points").at(1).at("title"), "1 kg at 12 mA and 12 mA");
}

/// The rig's file has no error in it.
TEST_F(Linearise, PlacesOutOfReachAreTheOptions) {
  const Said said = run("linearise thesis --at '30 mA'");
  EXPECT_EQ(said.status, 65);
  EXPECT_TRUE(holds(said.err, "--at 30 mA: error: with ", "the valve answers to commands from 4 to 20 mA"));
  EXPECT_TRUE(lacks(said.err, "thesis:1:1"));
  EXPECT_TRUE(holds(run("linearise thesis --load '400 kg'").err, "--load: error: 400 kg: "));
}

TEST_F(Linearise, HelpAndFolderAgreeOnBodePlotsOfSeveralPlaces) {
  EXPECT_TRUE(
      holds(run("linearise --help").out, "(bode.svg, bode.csv; of several", "bode_1.svg, bode_1.csv"));
}

/// bladder_hysteresis keeps its tension at rest.
TEST_F(Linearise, AMemoryThatHoldsIsAPoleAtZero) {
  write_text(
      scratch / "rig.yaml",
      "schema: mckibben-rig/1\nbase: thesis\neffects: {bladder_hysteresis: {force: 5 N, stroke: 8 mm}}\n");
  const Said said = run("linearise rig.yaml");
  EXPECT_TRUE(holds(said.out, "  pole  0 ", " 0 Hz\n")) << said.err;
  EXPECT_TRUE(lacks(said.out, "e-13", "e-14", "e-15", "e-16"));
}

/// Where names take several rows, the panels and their headings stand below them.
TEST_F(Linearise, NamesInABodePlotDoNotRunIntoItsHeadings) {
  const auto drawn = [&](const std::string& list, double height) {
    write_text(scratch / "named.yaml", list);
    result_of("named.yaml --at 0.15");
    const std::string svg = read_text(scratch / "out" / "named-linearise" / "bode.svg");
    EXPECT_TRUE(holds(svg, "height='" + std::to_string(static_cast<int>(height)) + "'"))
        << svg.substr(0, 200);
    EXPECT_TRUE(holds(svg, "translate(0 " + std::to_string(static_cast<int>(height) - 560) + ")"));
  };
  std::string list = loops;
  drawn(list, 560.0);
  for (const char digit : {'1', '2', '3', '4', '5', '6'})
    list += std::string("  - {kind: pid, name: a_loop_with_a_rather_long_name_") + digit +
            ", proportional: 8 mA, integral_time: 0.2 s, derivative_time: 0.05 s}\n";
  drawn(list, 560.0 + 2 * 18.0);
}

}  // namespace
}  // namespace mckibben::cli
