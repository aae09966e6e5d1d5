// Tables that nobody described: what is told of them, with the reason, and what is left open.
#include <cmath>
#include <filesystem>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <sim/formats/mat_file.hpp>
#include <sim/input/diagnostics.hpp>
#include <sim/recognise/headings.hpp>
#include <sim/recognise/recognise.hpp>

#include "says.hpp"
#include "scratch.hpp"

namespace mckibben::recognise {
namespace {

namespace fs = std::filesystem;

struct Case {
  const char *name, *line_below, *key, *unit;
};

TEST(Headings, WordsAndUnitsTell) {
  for (const Case& one : {Case{"t [ms]", "", "time", "ms"},
                          {"Zeit", "s", "time", "s"},
                          {"time_s", "", "time", "s"},
                          {"Strom (A)", "", "command", "A"},
                          {"U_soll_V", "", "command", "V"},
                          {"p_set [bar]", "", "command", "bar"},
                          {"Druck", "mbar", "muscle_pressure", "mbar"},
                          {"p_muscle_kPa", "", "muscle_pressure", "kPa"},
                          {"Laser", "mm", "contraction", "mm"},
                          {"angle [°]", "", "contraction", "deg"},
                          {"phi / Grad", "", "contraction", "deg"},
                          {"Winkel_Grad", "", "contraction", "deg"},
                          {"Winkel [Winkelgrad]", "", "contraction", "deg"},
                          {"Winkel [grad]", "", "contraction", ""},
                          {"Kraft/N", "", "force", "N"},
                          {"Sollspannung [V]", "", "command", "V"},
                          {"Steuerspannung [V]", "", "command", "V"},
                          {"Muskeldruck [bar]", "", "muscle_pressure", "bar"},
                          {"Versorgungsdruck [bar]", "", "", "bar"},
                          {"Seilzugweg [mm]", "", "contraction", "mm"},
                          {"drawwire (V)", "", "contraction", "V"},
                          {"draw-wire sensor [V]", "", "contraction", "V"},
                          {"string potentiometer [V]", "", "contraction", "V"},
                          {"Seilzugsensor [V]", "", "contraction", "V"},
                          {"Wegaufnehmer [V]", "", "contraction", "V"},
                          {"Linearpoti [V]", "", "contraction", "V"},
                          {"wire tension [N]", "", "force", "N"},
                          {"Offset [V]", "", "", "V"},
                          {"AI3 [N]", "", "force", "N"},
                          {"p_m", "", "muscle_pressure", ""},
                          {"I1_mA", "", "command", "mA"},
                          {"Verkuerzung [mm]", "", "contraction", "mm"},
                          {"supply pressure [bar]", "", "", "bar"},
                          {"Temperatur", "K", "", "K"},
                          {"AI3", "", "", ""},
                          {"laser", "V", "contraction", "V"}}) {
    const Heading heading = heading_of({one.name, one.line_below, false, {}});
    EXPECT_EQ(heading.quantity == nullptr ? "" : heading.quantity->key, one.key) << one.name;
    EXPECT_EQ(heading.unit, one.unit) << one.name;
  }
  EXPECT_TRUE(heading_of({"Verkürzung", "", false, {}}).is_contraction);
  EXPECT_FALSE(heading_of({"laser", "V", false, {}}).unit_fits) << "a sensor's voltage is no length";
}

TEST(Loads, StandInNames) {
  EXPECT_EQ(load_in("load_5kg_run2"), "5 kg");
  EXPECT_EQ(load_in("m5,5kg"), "5.5 kg");
  EXPECT_EQ(load_in("10kg, 10,0 kg"), "10 kg");
  EXPECT_EQ(load_in("run2_11p138_kg"), "11.138 kg");
  EXPECT_EQ(load_in("lift 500g"), "500 g");
  EXPECT_EQ(load_in("Messung_520g_tri"), "520 g");
  EXPECT_EQ(load_in("Messung_5200_g_tri"), "5200 g");
  EXPECT_EQ(load_in("Messung_20g_tri"), std::nullopt) << "of grease, of a shock";
  EXPECT_EQ(load_in("Last: 20 LB"), "20 lb");
  for (const char* none : {"run5", "5kgf", "p10bar", "kg"}) EXPECT_EQ(load_in(none), std::nullopt) << none;
}

class Recognise : public ::testing::Test {
 protected:
  fs::path write(const std::string& name, const std::string& text) const { return folder_.write(name, text); }
  /// A run of 200 rows: `row(k)` is a line, k rows from the beginning.
  template <class Row>
  fs::path run(const std::string& name, const std::string& head, const Row& row) const {
    std::string text = head;
    for (int k = 0; k < 200; ++k) text += row(k) + "\n";
    return write(name, text);
  }
  static double drive(int k) { return 0.5 - 0.5 * std::cos(0.03 * k); }

  Scratch folder_;
};

const Setting* setting(const std::vector<Setting>& list, const std::string& key) {
  for (const Setting& each : list)
    if (each.key == key) return &each;
  return nullptr;
}

TEST_F(Recognise, ALaserThatFallsAndARegulatorInVolts) {
  const auto row = [](int k) {
    return fmt::format("{};{:.3f};{:.1f};{:.3f}", 10 * k, 9 * drive(k), 412.5 - 30 * drive(k), 5 * drive(k));
  };
  const Recognised found = recognise({run("load_5kg_run1.csv", "Zeit;Soll;Laser;Druck\nms;V;mm;bar\n", row),
                                      run("b_7,5kg.csv", "Zeit;Soll;Laser;Druck\nms;V;mm;bar\n", row)},
                                     false);
  ASSERT_EQ(found.maps.size(), 1u);
  const MapGuess& map = found.maps[0];
  EXPECT_EQ(map.find("time")->unit.value, "ms");
  EXPECT_EQ(map.find("command")->column.value, "Soll");
  EXPECT_EQ(map.find("contraction")->factor->value, "-1");
  EXPECT_NEAR(std::stod(map.find("contraction")->zero->value), 412.5, 0.6) << "where the command is lowest";
  EXPECT_TRUE(holds(map.find("contraction")->zero->reason, "where Soll is lowest, 0 V"));
  EXPECT_FALSE(map.find("muscle_pressure")->input);
  EXPECT_EQ(found.runs[0].load->value, "5 kg");
  EXPECT_EQ(found.runs[1].load->value, "7.5 kg");
  EXPECT_EQ(setting(found.dataset, "start")->told.value, "settled");
  EXPECT_EQ(setting(found.rig, "valve.span_command")->told.value, "10 V");
  EXPECT_TRUE(setting(found.rig, "valve.span_pressure")->told.open());
  EXPECT_EQ(setting(found.rig, "tick")->told.value, "10 ms");
  ASSERT_NE(setting(found.rig, "sensors.contraction.kind"), nullptr) << "else the thesis's encoder";
  EXPECT_EQ(setting(found.rig, "sensors.contraction.kind")->told.value, "laser");
  EXPECT_EQ(setting(found.rig, "sensors.contraction.resolution")->told.value, "0.1 mm");
  EXPECT_EQ(found.open(), 7u) << "muscle's three, valve's four";
  EXPECT_EQ(recognise({folder_ / "b_7,5kg.csv"}, true).open(), 0u) << "the rig is known";
  const auto shown_mm = shown(found.tables[0], *map.find("contraction"));
  EXPECT_NEAR(shown_mm[105], 30.0, 0.7) << "up as the muscle contracts";
}

TEST_F(Recognise, WhatNothingTellsIsLeftOpen) {
  const auto row = [](int k) {
    return fmt::format("{},{},{},{},7", k * 0.012, 16 * drive(k), drive(k), drive(k));
  };
  const Recognised found = recognise({run("a.csv", "time,current [mA],x,y,AI7\n", row)}, false);
  const MapGuess& map = found.maps[0];
  EXPECT_TRUE(map.find("time")->unit.open()) << "no unit is said";
  EXPECT_TRUE(map.find("contraction")->column.open()) << "x or y";
  EXPECT_NE(map.find("contraction")->column.reason.find("x; y"), std::string::npos);
  EXPECT_EQ(map.find("current")->unit.value, "mA");
  EXPECT_EQ(map.ignored.at(0).value, "AI7");
  EXPECT_TRUE(found.runs[0].load->open());
}

TEST_F(Recognise, RowsThatNoRecorderTakesAskForTheUnitOfTime) {
  const auto found = [&](const char* unit, double step) {
    const auto row = [&](int k) { return fmt::format("{:.10g},{},{}", k * step, 10 * drive(k), drive(k)); };
    return recognise({run("5kg.csv", fmt::format("Zeit [{}],Valve voltage,Weg [mm]\n", unit), row)}, false);
  };
  for (const auto& [unit, step, says] :
       {std::tuple("s", 20.0, "rows are 20000 ms apart: is it s, or ms, with rows 20 ms apart?"),
        std::tuple("s", 1.0, "or ms, with rows 1 ms apart?"),
        std::tuple("ms", 0.02, "rows are 0.02 ms apart: is it ms, or s, with rows 20 ms apart?")}) {
    const Recognised asked = found(unit, step);
    const ColumnGuess& time = *asked.maps[0].find("time");
    EXPECT_TRUE(time.unit.open()) << step;
    EXPECT_TRUE(holds(time.unit.reason, says));
    EXPECT_EQ(time.factor->value, "1") << "whatever the heading says";
    EXPECT_EQ(setting(asked.rig, "tick"), nullptr) << "the base's";
    EXPECT_TRUE(holds(asked.maps[0].find("command")->unit.reason, "write one, as V;"));
  }
  EXPECT_EQ(setting(found("ms", 20.0).rig, "tick")->told.value, "20 ms");
}

TEST_F(Recognise, OurOwnRowsEachTickNeedNothing) {
  const auto row = [](int k) {
    return fmt::format("{},{},{}", k * 0.012, k < 5 ? 0.0 : 16 * drive(k), k < 5 ? 0.0 : 0.2 * drive(k));
  };
  const Recognised found = recognise({run("9kg.csv", "time_s,current_mA,contraction_ratio\n", row)}, true);
  EXPECT_TRUE(found.dataset.empty()) << "no clock of their own";
  EXPECT_EQ(found.open(), 0u);
  EXPECT_FALSE(found.maps[0].find("contraction")->zero);
}

TEST_F(Recognise, APressureWithoutACommandDrives) {
  const auto row = [](int k) {
    return fmt::format("{},{},{}", 7 + k * 0.01 + (k % 3) * 1e-4, 1.0 + 4 * drive(k), 100 * drive(k));
  };
  const Recognised found = recognise({run("a.csv", "t [s],p [bar],F [N]\n", row)}, false);
  EXPECT_EQ(found.maps[0].find("muscle_pressure")->input->value, "input");
  EXPECT_TRUE(setting(found.rig, "mechanics")->told.open()) << "held, or a load that nobody named";
  EXPECT_FALSE(found.runs[0].load);
  EXPECT_EQ(setting(found.rig, "valve.zero_pressure"), nullptr) << "no valve is there";
}

TEST_F(Recognise, LengthsThatABenchHolds) {
  const auto at = [](const char* length) {
    return [=](int k) { return fmt::format("{};{:.3f};{:.2f}", length, 5 * drive(k), 400 * drive(k)); };
  };
  const char* const head = "Länge [mm];Druck [bar];Kraft [N]\n";
  const Recognised found = recognise({run("a.csv", head, at("190")), run("b.csv", head, at("182.5"))}, false);
  const ColumnGuess& length = *found.maps[0].find("contraction");
  EXPECT_EQ(length.input->value, "input");
  EXPECT_EQ(length.factor->value, "-1");
  EXPECT_TRUE(length.zero->open());
  EXPECT_EQ(setting(found.rig, "mechanics")->told.value, "{kind: held_length}");
  EXPECT_NE(setting(found.rig, "joint.length_offset"), nullptr) << "the zero of the bench";
  EXPECT_EQ(setting(found.rig, "joint.reading_offset"), nullptr) << "nothing reads it";
  EXPECT_EQ(setting(found.rig, "tick"), nullptr);
  EXPECT_EQ(found.maps[0].rows->key, "settled");
  EXPECT_EQ(found.open(), 5u) << "muscle's three, its length's zero, what a point took";
  EXPECT_NE(setting(found.rig, "sensors.force.kind"), nullptr);
}

TEST_F(Recognise, AForceThatWasReadHasALoadCell) {
  const auto row = [](int k) { return fmt::format("{:.2f};{:.0f}", 5 * drive(k), 40 * drive(k)); };
  const Recognised found = recognise({run("5kg.csv", "Druck [bar];Kraft [N]\n", row)}, false);
  ASSERT_NE(setting(found.rig, "sensors.force.kind"), nullptr);
  EXPECT_EQ(setting(found.rig, "sensors.force.kind")->told.value, "load_cell");
  ASSERT_NE(setting(found.rig, "sensors.force.resolution"), nullptr);
  EXPECT_EQ(setting(found.rig, "sensors.force.resolution")->told.value, "1 N");
}

TEST_F(Recognise, SheetsNameTheirRuns) {
  const std::filesystem::path book = std::filesystem::path(MCKIBBEN_TEST_DATA) / "sine_and_stair_5kg.xlsx";
  const Recognised alone = recognise({book}, true);
  ASSERT_EQ(alone.runs.size(), 2u);
  EXPECT_EQ(alone.runs[0].id, "slow_sine");
  const auto row = [](int k) { return fmt::format("{},{},{}", k * 0.012, 16 * drive(k), 0.2 * drive(k)); };
  const Recognised among =
      recognise({book, run("9kg.csv", "time_s,current_mA,contraction_ratio\n", row)}, true);
  EXPECT_EQ(among.runs[0].id, "sine_and_stair_5kg_slow_sine");
  EXPECT_EQ(among.runs[2].id, "9kg");
}

TEST_F(Recognise, RunsThatBeginOnTheirWay) {
  const auto row = [](int k) {
    return fmt::format("{},{},{}", k * 0.012, 16 * drive(k + 50), 0.2 * drive(k + 50));
  };
  const Recognised found = recognise({run("9kg.csv", "time_s,current_mA,contraction_ratio\n", row)}, true);
  EXPECT_EQ(setting(found.dataset, "start")->told.value, "moving");
}

TEST_F(Recognise, HeadingsThatAreUnitsAndCountsBeside) {
  const auto row = [](int k) {
    return fmt::format("{},{:.0f},{:.3f},{:.2f}", 20 * k, 100 + 400 * drive(k), 14.5 * drive(k),
                       30 * drive(k));
  };
  const Recognised found = recognise({run("a.csv", "ms,counts,PSI,x_mm\n", row)}, true);
  EXPECT_EQ(found.maps[0].find("muscle_pressure")->column.value, "PSI");
  EXPECT_EQ(found.maps[0].find("muscle_pressure")->unit.value, "PSI");
  EXPECT_EQ(found.maps[0].find("time")->unit.value, "ms");
  EXPECT_EQ(found.maps[0].find("contraction")->column.value, "x_mm");
}

TEST_F(Recognise, TheLineThatNamesTimeIsTheHeading) {
  const auto row = [](int k) { return fmt::format("{:.3f},{:.3f}", 0.02 * k, drive(k)); };
  for (const char* above :
       {"Labels,pressure\nTIME,CH1\n", "LECROY,1,Waveform\nSegment,TrigTime,Since\nTime,Ampl\n"})
    EXPECT_NE(recognise({run("a.csv", above, row)}, true).maps[0].find("time"), nullptr) << above;
}

TEST_F(Recognise, CountersThatBeginAgainAreRuns) {
  const auto row = [](int k) {
    return fmt::format("{},{:.3f},{:.2f}", k % 100, 5 * drive(k), 30 * drive(k));
  };
  const Recognised found = recognise({run("a.csv", "n,p_bar,x_mm\n", row)}, true);
  ASSERT_EQ(found.runs.size(), 2u);
  EXPECT_EQ(found.tables[1].part, std::vector<std::string>{"segment: 2"});
  EXPECT_EQ(found.maps[0].remarks, std::vector<std::string>{"n begins again at row 101: 2 runs"});
  EXPECT_TRUE(found.maps[0].find("time")->factor->open());
  const Recognised rate = recognise({run("b.csv", "fps: 240\nn,p_bar,x_mm\n", row)}, true);
  EXPECT_NEAR(std::stod(rate.maps[0].find("time")->factor->value), 1.0 / 240.0, 1e-9);
}

TEST_F(Recognise, SeveralSensorsInOneTableAreRuns) {
  const auto row = [](int k) {
    return fmt::format("{},{},{:.3f},{:.2f}", 20 * (k / 2), k % 2, drive(k / 2), 30 * drive(k / 2));
  };
  const Recognised found = recognise({run("a.csv", "t_ms,sensor,p_bar,x_mm\n", row)}, true);
  ASSERT_EQ(found.runs.size(), 2u);
  EXPECT_EQ(found.tables[1].part, std::vector<std::string>{"where: {sensor: 1}"});
}

TEST_F(Recognise, ClocksOfReadingsOneAfterTheOtherAreEachItsOwn) {
  const auto row = [](int k) {
    return fmt::format("{},{:.3f},{},{:.2f}", 20 * k, drive(k), 20 * k + 7, 30 * drive(k));
  };
  EXPECT_EQ(recognise({run("a.csv", "t1_ms,p_bar,t2_ms,x_mm\n", row)}, true)
                .maps[0]
                .find("contraction")
                ->time->value,
            "t2_ms");
}

TEST_F(Recognise, ARowMayHaveARemark) {
  const auto row = [](int k) {
    return fmt::format("{},{:.3f},{:.2f}{}", 20 * k, drive(k), 30 * drive(k), k == 40 ? ",knocked" : "");
  };
  EXPECT_EQ(recognise({run("a.csv", "t_ms,p_bar,x_mm,note\n", row)}, true).tables[0].rows(), 200u);
}

TEST_F(Recognise, RowsOfAKnownRigWithoutStampsAreAsked) {
  const auto row = [](int k) { return fmt::format("{:.3f},{:.2f}", 5 * drive(k), 30 * drive(k)); };
  const fs::path file = run("a.csv", "p_bar,x_mm\n", row);
  EXPECT_TRUE(recognise({file}, true).maps[0].rows->told.open());
  EXPECT_EQ(recognise({file}, false).maps[0].rows->told.value, "true") << "its tick is asked";
}

TEST_F(Recognise, WhatNoHeadingNamesHasCandidates) {
  const auto row = [](int k) { return fmt::format("{},{:.3f},{:.2f}", 20 * k, drive(k), 3 * drive(k)); };
  const Recognised found =
      recognise({run("a.csv", "KP 0.72\nTime,Channel A,Channel B\n(ms),(V),(V)\n\n", row)}, true);
  EXPECT_TRUE(holds(found.maps[0].find("contraction")->column.reason, "Channel A (0 to 1 V)", "Channel B"));
  EXPECT_TRUE(holds(found.maps[0].remarks.at(0), "KP 0.72"));
}

TEST_F(Recognise, WithoutALengthNothingIsJudgedAndItIsAsked) {
  const auto row = [](int k) {
    return fmt::format("{},{},{},{},50", 0.012 * k, 9 * drive(k), drive(k), 5 * drive(k));
  };
  const Recognised found =
      recognise({run("a_5kg.csv", "t [s],U_set [V],KTC [V],p [bar],F [N]\n", row)}, true);
  ASSERT_NE(found.maps[0].find("contraction"), nullptr) << "a force alone is no reason to go on without";
  EXPECT_TRUE(found.maps[0].find("contraction")->column.open());
  EXPECT_TRUE(holds(found.maps[0].find("contraction")->column.reason, "perhaps one of: KTC [V]"));
}

TEST_F(Recognise, ReadingsBetweenThoseOfThePressureHaveASign) {
  const auto row = [](int k) {
    return k % 2 == 0 ? fmt::format("{},{:.3f},", 10 * k, drive(k))
                      : fmt::format("{},,{:.2f}", 10 * k, 50 - 30 * drive(k));
  };
  EXPECT_EQ(
      recognise({run("a.csv", "t_ms,p_bar,x_mm\n", row)}, true).maps[0].find("contraction")->factor->value,
      "-1");
}

TEST_F(Recognise, OtherFormats) {
  const auto row = [](int k) { return fmt::format("{} {} {}", k * 0.012, 16 * drive(k), 0.2 * drive(k)); };
  const Recognised numbers = recognise({run("5kg.txt", "# by hand\n", row)}, true);
  EXPECT_EQ(numbers.maps[0].find("time")->column.value, "1");
  EXPECT_TRUE(numbers.maps[0].find("contraction")->column.open());

  const std::string header = "LabVIEW Measurement\t\nSeparator\tTab\nX_Columns\tOne\n***End_of_Header***\t\n";
  const Recognised labview = recognise(
      {write("5kg.lvm",
             header + "Channels\t2\nX0\t0\t0\n***End_of_Header***\t\t\nX_Value\tI [mA]\tx [mm]\tComment\n"
                      "0\t4\t0\n0.012\t8\t1\n0.024\t12\t2\n")},
      true);
  EXPECT_EQ(labview.maps[0].find("time"), nullptr) << "it has its own";
  EXPECT_EQ(labview.maps[0].find("current")->column.value, "I [mA]");

  const formats::Table table{"",
                             {{"time_s", "s", "", {0, 0.012, 0.024}},
                              {"current_mA", "mA", "", {4, 8, 12}},
                              {"contraction_ratio", "1", "", {0, 0.01, 0.02}}},
                             {{"load_kg", 5.0}}};
  const Recognised matlab = recognise({write("5kg.mat", formats::mat_of(table))}, true);
  EXPECT_EQ(matlab.maps[0].find("current")->column.value, "current_mA");
  EXPECT_EQ(matlab.maps[0].ignored.at(0).value, "load_kg") << "one number, not one for each row";
  EXPECT_TRUE(matlab.runs[0].load) << "5 kg, by the file's name";

  EXPECT_THROW(recognise({write("a.xlsx", "x")}, true), input::BadInput);
  EXPECT_THROW(recognise({write("a.csv", "a,b\nx,y\n")}, true), input::BadInput);
  EXPECT_THROW(recognise({folder_ / "none.csv"}, true), input::MissingInput);
}

}  // namespace
}  // namespace mckibben::recognise
