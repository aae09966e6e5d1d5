// Lines that are no rows, formats, and what is said of files that cannot be read.
#include <array>
#include <cmath>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <sim/input/diagnostics.hpp>
#include <sim/input/quantity.hpp>
#include <sim/recognise/recognise.hpp>

#include "says.hpp"
#include "scratch.hpp"

namespace mckibben::recognise {
namespace {

class RowsAndFormats : public ::testing::Test {
 protected:
  /// Of a table of 200 rows: `row(k)` is a line.
  template <class Row>
  Recognised of(const std::string& head, const Row& row, const std::string& name = "5kg.csv") const {
    std::string text = head;
    for (int k = 0; k < 200; ++k) text += row(k) + "\n";
    return recognise({folder_.write(name, text)}, true);
  }
  static double drive(int k) { return 0.5 - 0.5 * std::cos(0.03 * k); }
  static const ColumnGuess& column(const Recognised& found, const char* key) {
    return *found.maps[0].find(key);
  }

  Scratch folder_;
};

TEST_F(RowsAndFormats, OtherUnitsFurtherDownAreAnotherTable) {
  const auto other_units = [](int k) {
    return fmt::format("{}{:.3f},{:.3f},{:.2f}", k == 100 ? "t,p,x\n[s],[kPa],[mm]\n" : "", 0.012 * k,
                       5 * drive(k), 10 * drive(k));
  };
  EXPECT_EQ(of("t,p,x\n[s],[kPa],[mm]\n", other_units).tables.at(0).rows(), 200u) << "the same units";
  try {
    of("t,p,x\n[s],[bar],[mm]\n", other_units);
    FAIL();
  } catch (const input::BadInput& bad) {
    EXPECT_TRUE(holds(bad.what(), "csv:104:1", "other headings or units"));
  }
}

TEST_F(RowsAndFormats, LinesThatAreNoRowsAreSaidAndLeftOut) {
  const auto row = [](int k) {
    return fmt::format("{}{:.3f},{:.3f},{:.3f}", k > 0 && k % 50 == 0 ? "Avg,2.5,4.2\n" : "", 0.012 * k,
                       5 * drive(k), 10 * drive(k));
  };
  for (const char* head : {"t,p,x\ns,bar,mm\n,gauge,encoder\n", "t,p,x\ns,bar,mm\n0..10,0..6,0..30\n",
                           "t_s,p_bar,x_mm\n1,2,3\n"}) {
    const Recognised found = of(head, row);
    EXPECT_EQ(found.tables[0].rows(), 200u) << head;
    EXPECT_EQ(found.tables[0].columns.at(0).values.at(1), 0.012) << head;
    EXPECT_TRUE(holds(found.tables[0].note, "3 rows with a word")) << found.tables[0].note;
    EXPECT_EQ(found.tables[0].words.at(0).substr(0, 5), "line ") << head;
  }
}

TEST_F(RowsAndFormats, NamesOfColumnsDoNotBeginAsNumbers) {
  try {
    of("t_s,5 kg,11 kg\n", [](int k) { return fmt::format("{},{:.3f},{:.3f}", 12 * k, drive(k), drive(k)); });
    FAIL();
  } catch (const input::BadInput& bad) {
    EXPECT_TRUE(holds(bad.what(), "csv:1:1: ", "a word, t_s, where", "x_5 kg"));
  }
}

TEST_F(RowsAndFormats, RecordsAndLabelsWithUnits) {
  const auto values = [](int k) { return std::array{0.012 * k, 5 * drive(k), 10 * drive(k)}; };
  const auto json = [&](int k) {
    const auto [t, p, x] = values(k);
    return fmt::format("{}{{\"t_s\": {},\n \"p_bar\": {:.3f}, \"mode\": \"on off\", \"x_mm\": {:.3f}}}{}",
                       k == 0 ? "[" : "", t, p, x, k == 199 ? "]" : ",");
  };
  const auto python = [&](int k) {
    const auto [t, p, x] = values(k);
    return fmt::format("{{'t_s': {}, 'p_bar': {:.3f}, 'x_mm': {:.3f}}}", t, p, x);
  };
  const auto labels = [&](int k) {
    const auto [t, p, x] = values(k);
    return fmt::format("t:{} ms p:{:.1f} kPa x:{:.3f} mm", 1000 * t, 100 * p, x);
  };
  for (const Recognised& found : {of("", json), of("", python), of("", labels)}) {
    EXPECT_EQ(found.tables[0].rows(), 200u);
    EXPECT_TRUE(holds(column(found, "muscle_pressure").column.value, "p"));
    EXPECT_FALSE(column(found, "contraction").unit.open());
  }
  EXPECT_EQ(column(of("", labels), "muscle_pressure").unit.value, "kPa");
  EXPECT_EQ(of("[",
               [](int k) {
                 return fmt::format("{{\"t_s\": {},\n\"arm\": {{\"x_mm\": {}, \"p_bar\": {}}}}},", 0.012 * k,
                                    k, drive(k));
               })
                .tables[0]
                .find("t_s")
                ->values.at(1),
            0.012)
      << "records in records";
  try {  // whose x?
    of("[\n", [](int k) { return fmt::format("{{\"t\": {}, \"arm\": {{\"x\": {}, \"t\": 1}}}},", k, k); });
    FAIL();
  } catch (const input::BadInput& bad) {
    EXPECT_TRUE(holds(bad.what(), "no column of numbers"));
  }
  try {
    recognise({folder_.write("5kg.txt", "{\"t\": [0, 1], \"p\": [1, 2]}\n")}, true);
    FAIL();
  } catch (const input::BadInput& bad) {
    EXPECT_TRUE(holds(bad.what(), "this looks like JSON"));
  }
}

TEST_F(RowsAndFormats, ChannelsOfLabViewWithClocksOfTheirOwn) {
  const auto of_x = [&](const char* x0, const char* delta_x) {
    return of(
        fmt::format("LabVIEW Measurement\t\nSeparator\tTab\nX_Columns\tNo\n***End_of_Header***\t\n"
                    "Channels\t2\nX0\t{}\nDelta_X\t{}\n***End_of_Header***\t\t\n"
                    "X_Value\tI [mA]\tx [mm]\tComment\n",
                    x0, delta_x),
        [](int k) { return fmt::format("\t{:.3f}\t{:.3f}", 4 + drive(k), drive(k)); }, "5kg.lvm");
  };
  EXPECT_EQ(of_x("3.6e9\t3.6e9", "0.5\t0.5").maps[0].find("time"), nullptr) << "one clock";
  for (const Recognised& found : {of_x("0\t0.25", "0.5\t0.5"), of_x("0\t0", "0.5\t1")}) {
    EXPECT_EQ(column(found, "time").column.value, "time_s");
    ASSERT_TRUE(column(found, "contraction").time);
    EXPECT_EQ(column(found, "contraction").time->value, "time of x [mm]");
  }
  EXPECT_EQ(of_x("0\t0.25", "0.5\t0.5").tables[0].find("time of x [mm]")->values.at(1), 0.75);
}

TEST_F(RowsAndFormats, AClockThatIsNamedAfterItsQuantityIsThatQuantitys) {
  const Recognised found = of("time,p_bar,time of x_mm,x_mm\n", [](int k) {
    return fmt::format("{:.3f},{:.3f},{:.3f},{:.3f}", 0.012 * k, 5 * drive(k), 1 + 0.012 * k, 10 * drive(k));
  });
  ASSERT_TRUE(column(found, "contraction").time) << "however late it is";
  EXPECT_EQ(column(found, "contraction").time->value, "time of x_mm");
}

TEST_F(RowsAndFormats, AYearIsNoUnitOfAClock) {
  EXPECT_TRUE(holds(input::unit_problem("years", "s"), "too long a unit"));
  EXPECT_EQ(input::unit_problem("h", "s"), "");
  const Recognised found = of("Time (years),p_bar,x_mm\n", [](int k) {
    return fmt::format("{:.3f},{:.3f},{:.3f}", 1e7 + 0.012 * k, 5 * drive(k), 10 * drive(k));
  });
  EXPECT_TRUE(column(found, "time").unit.open());
}

TEST_F(RowsAndFormats, AStampBeforeLabelsIsTheTime) {
  const Recognised found = of("", [](int k) {
    return fmt::format("14:22:{:06.3f} -> p:{:.3f} bar x:{:.3f} mm", 0.012 * k, 5 * drive(k), 10 * drive(k));
  });
  EXPECT_EQ(column(found, "time").column.value, "monitor_time");
  EXPECT_NEAR(found.tables[0].find("monitor_time")->values.at(1), 0.012, 1e-9);
}

TEST_F(RowsAndFormats, AMassWithASignThatMayBeEither) {
  const Recognised found = of(
      "t_s,p_bar,x_mm,Load\n",
      [](int k) {
        return fmt::format("{:.3f},{:.3f},{:.3f},\"11,138 kg\"", 0.012 * k, 5 * drive(k), 10 * drive(k));
      },
      "a.csv");
  EXPECT_EQ(of(
                "t_s,p_bar,x_mm,Load\n",
                [](int k) {
                  return fmt::format("{:.3f},{:.3f},{:.3f},11.138 kg", 0.012 * k, 5 * drive(k),
                                     10 * drive(k));
                },
                "a.csv")
                .runs[0]
                .load->value,
            "11.138 kg");
  ASSERT_TRUE(found.runs[0].load);
  EXPECT_TRUE(found.runs[0].load->open());
  EXPECT_TRUE(holds(found.runs[0].load->reason, "11,138 kg", "decimals"));
}

}  // namespace
}  // namespace mckibben::recognise
