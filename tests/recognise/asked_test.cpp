// What can be read in two ways is asked, and never misread in silence.
#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <sim/input/diagnostics.hpp>
#include <sim/recognise/headings.hpp>
#include <sim/recognise/recognise.hpp>

#include "asked_fixture.hpp"
#include "says.hpp"

namespace mckibben::recognise {
namespace {

TEST_F(Asked, ASignMayStandBeforeDecimalsOrBetweenThousands) {
  const auto pascals = [](const char* time, const char* sign) {
    return [=](int k) {
      const int p = 50000 + 1000 * static_cast<int>(300 * drive(k));
      return fmt::format("{}{};{}{}{:03};{:.0f}", 12 * k, time, p / 1000, sign, p % 1000 + k % 7,
                         100 * drive(k));
    };
  };
  const Recognised either = of("t [ms];p [Pa];x [mm]\n", pascals("", "."));
  EXPECT_TRUE(column(either, "muscle_pressure").factor->open());
  EXPECT_TRUE(holds(column(either, "muscle_pressure").factor->reason, "50.000", "1000"));
  const Recognised german = of("t [ms];p [Pa];x [mm]\n", pascals(",0", "."));
  EXPECT_FALSE(column(german, "muscle_pressure").factor) << "the other column's comma is its decimal sign";
  EXPECT_NEAR(german.tables[0].find("p [Pa]")->values[100], 349002, 1500);
  const auto counting = [](int k) {
    const int t = 12 * k;
    return fmt::format("{}{},{:.0f},{:.0f}", t < 1000 ? "" : fmt::format("\"{},", t / 1000),
                       t < 1000 ? std::to_string(t) : fmt::format("{:03}\"", t % 1000), 16 * drive(k),
                       100 * drive(k));
  };
  const Recognised over = of("t [ms],I [mA],x [mm]\n", counting);
  EXPECT_EQ(over.runs.size(), 1u) << "996 goes on to 1,008";
  EXPECT_DOUBLE_EQ(over.tables[0].columns[0].values[84], 1008.0);
}

TEST_F(Asked, ARateOfOneThousandIsNoRateOfOne) {
  const auto row = [](int k) { return fmt::format("{},{:.3f},{:.3f}", k, 5 * drive(k), 10 * drive(k)); };
  EXPECT_EQ(column(of("Sample rate: 1,000 Hz\nn,p_bar,x_mm\n", row), "time").factor->value, "0.001");
  EXPECT_EQ(of("Backup interval: 1 s\nn,p_bar,x_mm\n", row).maps[0].find("time"), nullptr);
}

TEST_F(Asked, WhatCanStandWhereNoUnitIsSaid) {
  const auto row = [](int k) {
    return fmt::format("{:.3f},{:.0f},{:.3f}", 0.012 * k, 102 + 150 * drive(k), 10 * drive(k));
  };
  const auto guess = column(of("t_s,pressure,x_mm\n", row), "muscle_pressure");
  EXPECT_TRUE(guess.unit.open());
  EXPECT_TRUE(holds(guess.unit.reason, "as bar; of numbers of an ADC bar with factor: ", "and zero: "));
}

TEST_F(Asked, ALineBetweenRowsNamesTheLoadBelow) {
  const auto row = [](int k) {
    return fmt::format("{}{:.3f},{:.3f},{:.2f}", k == 100 ? "Run 2: load 7 kg\n" : "", 0.012 * k,
                       5 * drive(k), 10 * drive(k));
  };
  const Recognised found = of("Run 1: load 5 kg\nt_s,p_bar,x_mm\n", row, "runs.csv");
  ASSERT_EQ(found.runs.size(), 2u);
  EXPECT_EQ(found.runs[0].load->value, "5 kg");
  EXPECT_EQ(found.runs[1].load->value, "7 kg");
  EXPECT_EQ(found.tables[0].part, std::vector<std::string>{"to: 1.188 s"});
  EXPECT_EQ(found.tables[1].part, std::vector<std::string>{"from: 1.2 s"});
  const auto again = [](int k) {
    return fmt::format("{}{:.3f},{:.3f},{:.2f}", k == 100 ? "Run 2, load 7 kg, cold, new\n" : "",
                       0.012 * (k % 100), 5 * drive(k), 10 * drive(k));
  };
  const Recognised restarted = of("Run 1: load 5 kg\nt_s,p_bar,x_mm\n", again, "runs.csv");
  ASSERT_EQ(restarted.runs.size(), 2u);
  EXPECT_EQ(restarted.runs[1].load->value, "7 kg");
  EXPECT_EQ(restarted.tables[1].part, std::vector<std::string>{"segment: 2"});
}

TEST_F(Asked, AnotherTableBelowIsRefused) {
  const auto row = [](int k) {
    return fmt::format("{}{:.3f},{:.3f},{:.2f}", k == 100 ? "t_s,p_kPa,x_mm\n" : "", 0.012 * k, 5 * drive(k),
                       10 * drive(k));
  };
  try {
    of("t_s,p_bar,x_mm\n", row);
    FAIL();
  } catch (const input::BadInput& bad) {
    EXPECT_TRUE(holds(bad.what(), "csv:102:1", "another table begins here"));
  }
}

TEST_F(Asked, OfSeveralMassesTheOneThatAWordCallsALoad) {
  const auto load = [&](const std::string& name, const std::string& line) {
    const auto row = [](int k) {
      return fmt::format("{},{:.3f},{:.3f}", 12 * k, 5 * drive(k), 10 * drive(k));
    };
    const Recognised found = of(line + "t_ms,p_bar,x_mm\n", row, name);
    return found.runs[0].load->value;
  };
  EXPECT_EQ(load("a.csv", "# Muscle mass: 250 g\n# Load 11.138 kg\n"), "11.138 kg");
  EXPECT_EQ(load("a.csv", "# tare 0.250 kg, payload 10.888 kg\n"), "10.888 kg");
  EXPECT_EQ(load("m0.5kg_payload_11.138kg.csv", ""), "11.138 kg");
  EXPECT_EQ(load("muscle20g_load11.138kg.csv", ""), "11.138 kg");
  EXPECT_EQ(load("a.csv", "# Mass: 5 kg\n"), "5 kg");
  for (const char* candidate :
       {"# max. load 20 kg\n", "# Next load: 15 kg\n", "# Calibrated with 10 kg weight\n",
        "# Tare weight 2 kg\n", "# Loads 5 kg to 20 kg\n", "# load 11 kg + 0.138 kg\n",
        "# Muscle mass: 250 g\n", "# Accelerometer 2 g range\n", "# bench 2, max 20 kg\n",
        "# Spring 2 kg/m\n"})
    EXPECT_EQ(load("a.csv", candidate), domain::fill_in) << candidate;
  for (const char* name :
       {"exp2g.csv", "max20kg_run1.csv", "sweep_5-20kg.csv", "DMSP-10-300N_85g.csv", "grease_5g_run.csv"})
    EXPECT_EQ(load(name, ""), domain::fill_in) << name;
  EXPECT_EQ(load("run_500g.csv", ""), "500 g");
  EXPECT_EQ(load("5kg.csv", "# load 7 kg\n"), domain::fill_in) << "they disagree";
  EXPECT_EQ(load("5kg.csv", "# load 5 kg\n"), "5 kg");
}

TEST_F(Asked, TheZeroOfWhatStillMovesWhereItsDriveIsLowest) {
  const auto late = [](const char* form, double zero, double size) {
    return [=](int k) {
      const double i = k % 100 < 50 ? 4.0 : 16.0, x = 0.5 + 0.5 * std::sin(0.0628 * (k % 100 - 62));
      return fmt::format("{},{:.1f},{}", 12 * k, i, fmt::format(fmt::runtime(form), zero + size * x));
    };
  };
  EXPECT_TRUE(column(of("t_ms,I_mA,x_mm\n", late("{:.2f}", 1.0, 70.0)), "contraction").zero->open());
  EXPECT_FALSE(column(of("t_ms,I_mA,Strain (%)\n", late("{:.2f}", 0.0, -25.0)), "contraction").zero);
  EXPECT_EQ(column(of("t_ms,I_mA,Length (%)\n", late("{:.2f}", 100.0, -25.0)), "contraction").zero->value,
            "100");
  EXPECT_EQ(
      column(of("t_ms,I_mA,Normalized length (1)\n", late("{:.4f}", 1.0, -0.25)), "contraction").zero->value,
      "1");
  const Recognised length = of("t_ms,I_mA,muscle length (mm)\n", late("{:.2f}", 299.0, -70.0), "5kg.csv",
                               {.tick_s = 0.012, .rest_length_m = 0.3});
  EXPECT_EQ(column(length, "contraction").zero->value, "300");
  const Recognised unit = of("t_ms,I_mA,encoder\n", late("{:.0f}", 984.0, 300.0));
  EXPECT_TRUE(column(unit, "contraction").zero->open()) << "its unit is open";
}

TEST_F(Asked, TheZeroOfWhatOtherLoadsStretch) {
  const auto zero = [&](double stretched_mm, double moves_mm, const std::string& gauge = "comment",
                        const std::string& other = "") {
    std::vector<std::filesystem::path> files;
    for (int load = 0; load < 2; ++load) {
      std::string text =
          fmt::format("t [ms];u [V];{};Weg [mm]\n", load == 0 || other.empty() ? gauge : other);
      for (int k = 0; k < 200; ++k)
        text += fmt::format("{};{:.3f};{:.3f};{:.3f}\n", 12 * k, 10 * drive(k), 6 * drive(k),
                            80 - 40 * drive(k) + stretched_mm * load + (k < 5 ? moves_mm * k : 0));
      files.push_back(folder_.write(fmt::format("{}kg.csv", 5 + 5 * load), text));
    }
    return column(recognise(files, true, {}), "contraction").zero.value();
  };
  EXPECT_TRUE(lacks(zero(0.0, 0.0).reason, "differs"));
  EXPECT_TRUE(holds(zero(8.0, 0.0).reason, "differs between the tables, as loads do, by 8"));
  EXPECT_TRUE(holds(zero(0.0, 2.0).reason, "it still moves by"));
  EXPECT_FALSE(zero(0.0, 0.0, "p [bar]").doubtful);
  EXPECT_TRUE(holds(zero(0.0, 0.0, "p [bar]").reason, "if a load hangs there, it is the zero under it"));
  EXPECT_TRUE(zero(0.3, 0.0, "p [bar]").doubtful);
  EXPECT_TRUE(
      holds(zero(0.3, 0.0, "p [bar]").reason, "differs between the tables, ", "reading_offset: 0 mm ± 1 mm"));
  EXPECT_TRUE(
      holds(zero(0.3, 0.0, "p [bar]", "pressure [bar]").reason, "79.856 mm (5kg), 80.156 mm (10kg), as"))
      << "tables whose columns have other names";
}

TEST_F(Asked, AFactorInAHeadingAndTwoUnits) {
  const auto row = [](int k) {
    return fmt::format("{},{:.3f},{:.3f}", 12 * k, 50 * drive(k), 10 * drive(k));
  };
  for (const char* head :
       {"t_ms,p*10 [bar],x_mm\n", "t_ms,Pressure x10 (bar),x_mm\n", "t_ms,p/10 [bar],x_mm\n"})
    EXPECT_TRUE(column(of(head, row), "muscle_pressure").factor->open()) << head;
  const Recognised milli = of("t_ms,Pressure (mPa),x_mm\n", row);
  EXPECT_TRUE(column(milli, "muscle_pressure").unit.open());
  const Recognised two = of("t_ms,p_bar,x_mm\ns,bar,mm\n", row);
  EXPECT_TRUE(column(two, "time").unit.open());
  EXPECT_EQ(column(two, "time").factor->value, "1") << "else the reader asks again";
  EXPECT_TRUE(column(of("Sample rate: 1000 Hz\nt_ms,p_bar,x_mm\n", row), "time").unit.open());
  EXPECT_EQ(heading_of({"x_1", "", false}).unit, "") << "the first of several";
}

TEST_F(Asked, WhatSomethingReadsIsNoCommand) {
  const auto row = [](int k) {
    return fmt::format("{},{:.3f},{:.3f}", 12 * k, 4 + 16 * drive(k), 10 * drive(k));
  };
  for (const char* head : {"t_ms,Transmitter (mA),x_mm\n", "t_ms,Sensor voltage (V),x_mm\n"}) {
    const Recognised found = of(head, row);
    EXPECT_TRUE(column(found, "command").column.open()) << head;
    EXPECT_TRUE(holds(column(found, "command").column.reason, "perhaps one of")) << head;
    EXPECT_EQ(column(found, "command").unit.reason, "the unit of the column that you write") << head;
  }
}

TEST_F(Asked, StartIsWrittenWhereCheckNeedsIt) {
  const auto line = [](double t_s, int k) {
    return fmt::format("{:.3f},{:.3f},{:.4f}", t_s, k < 5 ? 0.0 : 16 * drive(k - 5),
                       k < 5 ? 0.0 : 0.2 * drive(k - 5));
  };
  const char* const head = "time_s,current_mA,contraction_ratio\n";
  const auto ticks = [&](int k) { return line(0.012 * k, k); };
  const KnownRig rig{.tick_s = 0.012, .rest_length_m = 0.3};
  EXPECT_EQ(start(of(head, ticks, "5kg.csv", rig)), "");
  EXPECT_EQ(start(of(head, ticks, "5kg.csv", {.tick_s = 0.001, .rest_length_m = 0.3})), "settled")
      << "not the rig's tick";
  EXPECT_EQ(start(of(
                head, [&](int k) { return line(0.012 * (k / 2), k); }, "5kg.csv", rig)),
            "settled")
      << "stamps repeat";
  const Recognised lacks = of(
      head, [&](int k) { return k == 40 ? fmt::format("{:.3f},7.000,", 0.012 * k) : ticks(k); }, "5kg.csv",
      rig);
  EXPECT_EQ(start(lacks), "settled");
  EXPECT_TRUE(holds(lacks.maps[0].remarks.at(0), "1 of its 200 cells are empty, the first in line 42"));
}

TEST_F(Asked, RowsThatHaveLostACellAreSaidAndLeftOut) {
  const auto row = [](int k) {
    return k == 40 ? fmt::format("{},{:.3f}", 12 * k, 10 * drive(k))
                   : fmt::format("{},{:.3f},{:.3f}", 12 * k, 5 * drive(k), 10 * drive(k));
  };
  const Recognised found = of("t_ms,p_bar,x_mm\n", row);
  EXPECT_EQ(found.tables[0].rows(), 199u);
  EXPECT_TRUE(holds(found.maps[0].remarks.at(0), "1 row lacks cells, the first in line 42"));
}

TEST_F(Asked, ZerosBeforeNumbersAndStampsThatNobodyReads) {
  const auto padded = [](int k) {
    return fmt::format("{:07.3f},{:06.3f},{:06.2f}", 12.0 * k, 5 * drive(k), 10 * drive(k));
  };
  const Recognised found = of("t_ms,p_bar,x_mm\n", padded);
  EXPECT_DOUBLE_EQ(found.tables[0].find("t_ms")->values[1], 12.0);
  std::string worded = "time,p_bar,x_mm\n";  // more than can be labels
  for (int k = 0; k < 300; ++k)
    worded += fmt::format("May{:03}th,{:.3f},{:.2f}\n", k, 5 * drive(k), 10 * drive(k));
  EXPECT_TRUE(holds(column(recognise({folder_.write("5kg.csv", worded)}, true), "time").column.reason,
                    "read as no number", "May000th"));
}

TEST_F(Asked, RowsInTheOrderOfTheirClockNeedAStart) {
  const auto plain = [](int k) {
    return fmt::format("{:.3f},{:.2f},{:.3f},{:.3f}", 0.012 * k, 4 + 12 * drive(k), 5 * drive(k),
                       10 * drive(k));
  };
  const std::string head = "t_s,I_mA,p_bar,x_mm\n";
  const KnownRig ticks{0.012, 0.3};
  EXPECT_EQ(start(of(head, plain, "5kg.csv", ticks)), "") << "a row each tick";
  const auto said = [&](const Recognised& found, const char* what) {
    EXPECT_EQ(start(found), "settled") << what;
    EXPECT_TRUE(std::ranges::any_of(found.maps[0].remarks, [&](const std::string& remark) {
      return holds(remark, what);
    })) << what;
  };
  said(of(
           head, [&](int k) { return plain(199 - k); }, "5kg.csv", ticks),
       "newest rows");
  said(of(
           head, [&](int k) { return plain(k) + (k == 50 ? "\n" + plain(k) : ""); }, "5kg.csv", ticks),
       "stands twice");
  said(of(
           head, [&](int k) { return plain(k) + (k == 199 ? "\n1.2,11,2,3" : ""); }, "5kg.csv", ticks),
       "is left out");
}

TEST_F(Asked, DaysBesideAClockThatGoesOverMidnightAreNoRuns) {
  const auto row = [](int k) {
    const int ms = (86399000 + 12 * k) % 86400000;
    return fmt::format("0{}.05.2024,{:02}:{:02}:{:02}.{:03},{:.3f},{:.2f}", ms > 1000000 ? 3 : 4,
                       ms / 3600000, ms / 60000 % 60, ms / 1000 % 60, ms % 1000, 5 * drive(k), 10 * drive(k));
  };
  EXPECT_EQ(of("Date,Time,p_bar,x_mm\n", row).runs.size(), 1u);
}

TEST_F(Asked, WhatStandsForNoneAndWhatIsNoMusclePressure) {
  const auto row = [](int k) {
    return fmt::format("{},6.1,{:.3f},{}", 12 * k, 5 * drive(k),
                       k % 20 == 7 ? "-9999" : fmt::format("{:.2f}", 10 * drive(k)));
  };
  const Recognised found = of("t_ms,Netzdruck_bar,p_bar,x_mm\n", row);
  EXPECT_EQ(column(found, "muscle_pressure").column.value, "p_bar");
  ASSERT_TRUE(column(found, "contraction").missing);
  EXPECT_EQ(column(found, "contraction").missing->value, "-9999");
  EXPECT_FALSE(column(found, "muscle_pressure").missing);
}

TEST_F(Asked, ALineOfNamesAboveOneOfNamesAndUnits) {
  const auto row = [](int k) {
    return fmt::format("{:.3f}\t{:.3f}\t{:.2f}", 0.012 * k, 5 * drive(k), 10 * drive(k));
  };
  const Recognised found =
      of("Zeit  1 - Standardmessrate\tMuskeldruck\tWeg\nZeit [s]\tDruck [bar]\tWeg [mm]\n", row);
  EXPECT_EQ(column(found, "time").unit.value, "s");
  EXPECT_EQ(column(found, "muscle_pressure").column.value, "Druck [bar]");
}

TEST_F(Asked, AMassAloneInARowIsTheTitleOfTheRowsBelow) {
  for (const char* commas : {"", ",,"}) {
    const auto row = [&](int k) {
      return fmt::format("{}{:.3f},{:.3f},{:.2f}",
                         k == 100 ? fmt::format("7 kg{}\nt_s,p_bar,x_mm\n", commas) : "", 0.012 * (k % 100),
                         5 * drive(k), 10 * drive(k));
    };
    const Recognised found = of(fmt::format("5 kg{}\nt_s,p_bar,x_mm\n", commas), row, "runs.csv");
    ASSERT_EQ(found.runs.size(), 2u);
    EXPECT_EQ(found.runs[0].load->value, "5 kg");
    EXPECT_EQ(found.runs[1].load->value, "7 kg");
    EXPECT_EQ(found.tables[1].rows(), 100u);
  }
}

TEST_F(Asked, ATitleThatNamesNoLoadMaySayAnother) {
  const auto row = [](int k) {
    return fmt::format("{}{:.3f},{:.3f},{:.2f}", k == 100 ? "as above, heavier\nt_s,p_bar,x_mm\n" : "",
                       0.012 * (k % 100), 5 * drive(k), 10 * drive(k));
  };
  const Recognised found = of("load 5 kg\nt_s,p_bar,x_mm\n", row, "runs.csv");
  ASSERT_EQ(found.runs.size(), 2u);
  EXPECT_EQ(found.runs[0].load->value, "5 kg");
  EXPECT_EQ(found.runs[1].load->value, domain::fill_in);
}

TEST_F(Asked, UnitsThatAreNotTheLastWord) {
  const auto row = [](int k) { return fmt::format("{},{:.3f},{:.3f}", .1 * k, 5 * drive(k), 10 * drive(k)); };
  const auto guess = [&](const char* head, const char* key) { return column(of(head, row), key); };
  EXPECT_TRUE(guess("Time in 10 ms,p_bar,x_mm\n", "time").factor->open());
  EXPECT_EQ(guess("Seconds of day,p_bar,x_mm\n", "time").unit.value, "s");
  EXPECT_TRUE(guess("t_s,Pressure in 100 kPa,x_mm\n", "muscle_pressure").factor->open());
  EXPECT_TRUE(guess("t_s,Pressure in percent of 10 bar,x_mm\n", "muscle_pressure").unit.open());
  EXPECT_TRUE(guess("t_s,Pressure * 100 (bar),x_mm\n", "muscle_pressure").factor->open());
}

TEST_F(Asked, WhatIsNoCommandAndNoPressureOfTheMuscle) {
  const auto with = [&](const char* heading, auto&& reading) {
    return of(fmt::format("t_s,Valve (mA),{},x_mm\n", heading), [&](int k) {
      return fmt::format("{:.3f},{:.3f},{:.4f},{:.3f}", 0.012 * k, 4 + 12 * drive(k), reading(k),
                         10 * drive(k));
    });
  };
  const auto muscle = [](int k) { return 5 * drive(k); };
  EXPECT_FALSE(column(with("p_bar", muscle), "muscle_pressure").column.open());
  const Recognised supply =
      with("P_sys (bar)", [](int k) { return 6.0 - 0.3 * drive(k - 5) + 0.01 * (k % 3); });
  EXPECT_TRUE(column(supply, "muscle_pressure").column.open());
  EXPECT_TRUE(holds(column(supply, "muscle_pressure").column.reason, "does not follow Valve (mA)"));
  const auto sensor = [](int k) {
    return fmt::format("{:.3f},{:.3f},{:.3f}", 0.012 * k, 4 + 12 * drive(k), 10 * drive(k));
  };
  EXPECT_TRUE(column(of("t_s,PT1 (mA),x_mm\n", sensor), "command").column.open());
  const Recognised sags = of("t_s,p (bar),Contraction (mm)\n", [](int k) {
    return fmt::format("{:.3f},{:.3f},{:.3f}", 0.012 * k, 6.0 - 0.9 * drive(k), 10 * drive(k));
  });
  EXPECT_TRUE(column(sags, "contraction").factor->open())
      << "a contraction does not fall with the muscle's pressure";
}

TEST_F(Asked, TheZeroWhereTheMuscleIsNotEmpty) {
  const auto from = [&](double lowest_bar) {
    return column(of("t_s,p_bar,x_mm\n",
                     [&](int k) {
                       return fmt::format("{:.3f},{:.3f},{:.3f}", 0.012 * k, lowest_bar + 4 * drive(k),
                                          3 + 10 * drive(k));
                     }),
                  "contraction")
        .zero->value;
  };
  EXPECT_EQ(from(0.0), "3.056") << "the median of 2 % of its drive";
  EXPECT_EQ(from(0.5), domain::fill_in);
}

TEST_F(Asked, RecordsThatTakeTurnsAreNoCoarseClock) {
  const auto row = [](int k) {
    const int n = k / 2;
    return fmt::format("{:.3f},{},{:.3f},{:.3f}", 0.012 * n, 1 + k % 2, 5 * drive(n + 30 * (k % 2)),
                       10 * drive(n + 30 * (k % 2)));
  };
  EXPECT_EQ(of("t_s,Node,p_bar,x_mm\n", row).tables[0].part, std::vector<std::string>{"where: FILL_IN"});
}

TEST_F(Asked, ExportsThatKnowNoOrderAreSorted) {
  const auto row = [](int k) {
    const int n = (k * 77) % 200;
    return fmt::format("{:.3f},{:.3f},{:.3f}", 0.012 * n, 5 * drive(n), 10 * drive(n));
  };
  const Recognised found = of("t_s,p_bar,x_mm\n", row);
  ASSERT_EQ(found.runs.size(), 1u);
  EXPECT_TRUE(std::ranges::is_sorted(found.tables[0].columns[0].values));
  EXPECT_EQ(start(found), "settled");
  const Recognised in_ms = of("t_ms,p_bar,x_mm\n", [](int k) {
    const int n = (k * 77) % 200;
    return fmt::format("{},{:.3f},{:.3f}", 12 * n, 5 * drive(n), 10 * drive(n));
  });
  EXPECT_TRUE(std::ranges::is_sorted(in_ms.tables[0].columns[0].values)) << "no milliseconds of a second";
  EXPECT_DOUBLE_EQ(in_ms.tables[0].columns[0].values.back(), 12.0 * 199);
}

}  // namespace
}  // namespace mckibben::recognise
