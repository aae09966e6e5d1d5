// Tables as recorders, spreadsheets and scripts leave them: read right from `import` to the reader, asked
// with the candidates, or refused with what to do.
#include <cmath>
#include <functional>
#include <regex>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <sim/input/dataset_file.hpp>
#include <sim/output/recognised.hpp>
#include <sim/recognise/recognise.hpp>

#include "says.hpp"
#include "scratch.hpp"

namespace mckibben::output::makers {
namespace {

constexpr int rows = 80;
constexpr double step_s = 0.02, psi_per_bar = 14.503774;

double bar(int k) {
  return 0.4 + 2.5 * (0.5 - 0.5 * std::cos(0.07 * k)) + 0.002 * (k % 3);
}
double mm(int k) {
  return 3.0 + 25.0 * (0.5 - 0.5 * std::cos(0.07 * (k - 2)));
}
using Line = std::function<std::string(int)>;
std::string all(const Line& line, int count = rows) {
  std::string text;
  for (int k = 0; k < count; ++k) text += line(k) + "\n";
  return text;
}
std::string plain(int k) {
  return fmt::format("{:.3f},{:.4f},{:.3f}", step_s * k, bar(k), mm(k));
}
Line with(const char* form, double of_bar = 1.0, double of_mm = 1.0, double zero_bar = 0.0) {
  return [=](int k) {
    return fmt::format(fmt::runtime(form), step_s * k, of_bar * (bar(k) + zero_bar), of_mm * mm(k));
  };
}
std::string commas(std::string text) {
  for (char& c : text) c = c == '.' ? ',' : c;
  return text;
}

std::string grouped(int number, char between) {
  std::string text = std::to_string(number);
  for (std::size_t at = text.size(); at > 3; text.insert(at, 1, between)) at -= 3;
  return text;
}

struct Kind {
  const char* name;
  std::string text;
  const char* file = "5kg.csv";
  int lacks = 0;  ///< readings of the position
  double tolerance_mm = 2e-3;
};

const Kind read_right[] = {
    {"text_between_rows", "Rig 3 starting\ntime_ms,pressure_kPa,dist_mm\n" + all([](int k) {
                            return fmt::format("{}{},{:.2f},{:.3f}", k == 20 || k == 45 ? "Valve open\n" : "",
                                               20 * k, 100 * bar(k), mm(k));
                          })},
    {"serial_monitor", "14:22:00.990 -> t_ms,p_bar,x_mm\n" + all([](int k) {
                         return fmt::format("14:22:{:06.3f} -> {},{:.4f},{:.3f}", 1.003 + step_s * k, 20 * k,
                                            bar(k), mm(k));
                       }),
     "5kg.txt"},
    {"plotter_labels", all([](int k) {
       return fmt::format("time_ms:{},pressure_bar:{:.4f},laser_mm:{:.3f}", 20 * k, bar(k), mm(k));
     }),
     "5kg.log"},
    {"keys_and_values", all(with("t_s={:.3f} p_bar={:.4f} x_mm={:.3f}")), "5kg.txt"},
    {"json_lines", all(with("{{\"t_s\": {:.3f}, \"p_bar\": {:.4f}, \"x_mm\": {:.3f}}}")), "5kg.json"},
    {"pandas_index", ",t_s,p_bar,x_mm\n" + all([](int k) { return fmt::format("{},{}", k, plain(k)); })},
    {"pandas_dates", ",p_bar,x_mm\n" + all([](int k) {
                       return fmt::format("2024-05-03 14:22:{:09.6f},{:.4f},{:.3f}", 1 + step_s * k, bar(k),
                                          mm(k));
                     })},
    {"ros_seconds_and_nanoseconds",
     "header.seq,header.stamp.secs,header.stamp.nsecs,p_bar,x_mm\n" + all([](int k) {
       const int nano = 120 + 20 * k;
       return fmt::format("{},{},{},{:.4f},{:.3f}", k + 811, 1496842330 + nano / 1000,
                          nano % 1000 * 1'000'000, bar(k), mm(k));
     })},
    {"ros2_nanosec", "stamp.sec,stamp.nanosec,p_bar,x_mm\n" + all([](int k) {
                       return fmt::format("{},{},{:.4f},{:.3f}", 1496842330 + k / 50, k % 50 * 20'000'000,
                                          bar(k), mm(k));
                     })},
    {"means_and_deviations", "t_s,p_bar_mean,p_bar_std,x_mm_mean,x_mm_std\n" + all([](int k) {
                               return fmt::format("{:.3f},{:.4f},0.0{},{:.3f},0.{}", step_s * k, bar(k),
                                                  k % 5 + 1, mm(k), k % 3 + 1);
                             })},
    {"spreads_in_cells", "t_s,p_bar,x_mm\n" + all(with("{:.3f},{:.4f} ± 0.01,{:.3f} +/- 0.1"))},
    {"units_in_cells", "time,pressure,position\n" + all(with("{:.3f} s,{:.4f} bar,{:.3f} mm"))},
    {"camel_case", "timeSec,pressurePsi,positionMm\n" + all(with("{:.3f},{:.4f},{:.3f}", psi_per_bar))},
    {"psi_gauge", "t (s),Pressure (psi g),x (mm)\n" + all(with("{:.3f},{:.4f},{:.3f}", psi_per_bar))},
    {"kPa_absolute", "t [s],p [kPa abs],x [mm]\n" + all(with("{:.3f},{:.3f},{:.3f}", 100, 1, 1.01325))},
    {"kPa_of_a", "t [s],p [kPa(a)],x [mm]\n" + all(with("{:.3f},{:.3f},{:.3f}", 100, 1, 1.01325))},
    {"psi_in_brackets", "t (s),Pressure (psi(g)),x (mm)\n" + all(with("{:.3f},{:.4f},{:.3f}", psi_per_bar))},
    {"psi_of_g", "t (s),Pressure (psi_g),x (mm)\n" + all(with("{:.3f},{:.4f},{:.3f}", psi_per_bar))},
    {"kg_per_cm_squared", "t [s],p [kg/cm²],x [mm]\n" + all(with("{:.3f},{:.5f},{:.3f}", 1.0197162))},
    {"absolute_at_the_end", "t_s,p_kPa_abs,x_mm\n" + all(with("{:.3f},{:.3f},{:.3f}", 100, 1, 1.01325))},
    {"absolute_in_a_line_of_units",
     "t,p,x\ns,bar abs,mm\n" + all(with("{:.3f},{:.4f},{:.3f}", 1, 1, 1.01325))},
    {"kg_per_square_cm", "t [s],p [kg/cm2],x [mm]\n" + all(with("{:.3f},{:.5f},{:.3f}", 1.0197162))},
    {"thousandths_of_an_inch", "t [s],p [bar],x [thou]\n" + all(with("{:.3f},{:.4f},{:.3f}", 1, 39.3700787))},
    {"target_beside", "t_s,p_bar,x_set_mm,x_mm\n" + all([](int k) {
                        return fmt::format("{:.3f},{:.4f},{:.3f},{:.3f}", step_s * k, bar(k), mm(k + 2),
                                           mm(k));
                      })},
    {"model_beside", "t_s,p_bar,x_model_mm,x_mm\n" + all([](int k) {
                       return fmt::format("{:.3f},{:.4f},{:.3f},{:.3f}", step_s * k, bar(k), 1.1 * mm(k),
                                          mm(k));
                     })},
    {"rates_beside", "t [s],p [bar],x [mm],speed [mm/s],pressure rate [bar/s]\n" +
                         all([](int k) { return plain(k) + ",12.5,0.3"; })},
    {"temperature_called_T", "t_s,T_degC,p_bar,x_mm\n" + all([](int k) {
                               return fmt::format("{:.3f},21.{},{:.4f},{:.3f}", step_s * k, k % 9, bar(k),
                                                  mm(k));
                             })},
    {"switch_beside", "t_s,valve,p_bar,x_mm\n" + all([](int k) {
                        return fmt::format("{:.3f},{},{:.4f},{:.3f}", step_s * k, k % 40 < 20 ? 1 : 0, bar(k),
                                           mm(k));
                      })},
    {"no_zero_before_the_point", "t_s,p_bar,x_mm\n" + all([](int k) {
                                   std::string line = "," + plain(k);
                                   for (std::size_t at = 0; (at = line.find(",0.", at)) != std::string::npos;)
                                     line.erase(at + 1, 1);
                                   return line.substr(1);
                                 })},
    {"fortran", " t_s p_bar x_mm\n" + all([](int k) {
                  std::string line = with(" {:.6E} {:.6E} {:.6E}")(k);
                  for (char& c : line) c = c == 'E' ? 'D' : c;
                  return line;
                }),
     "5kg.dat"},
    {"remark_behind_a_row",
     "t_s,p_bar,x_mm\n" + all([](int k) { return plain(k) + (k == 20 ? " # opened" : ""); })},
    {"sums_below", "t_s,p_bar,x_mm\n" + all(plain) + "Mean,1.2,15.3\nMax,2.9,28\n"},
    {"pipes", "t_s | p_bar | x_mm\n------|-------|-----\n" + all(with("{:.3f} | {:.4f} | {:.3f}")),
     "5kg.txt"},
    {"markdown", "| t_s | p_bar | x_mm |\n|---|---|---|\n" + all(with("| {:.3f} | {:.4f} | {:.3f} |")),
     "5kg.md"},
    {"rows_in_brackets", "t_s, p_bar, x_mm\n" + all(with("[{:.3f}, {:.4f}, {:.3f}]")), "5kg.txt"},
    {"spaces_in_thousands", "t_us;p_bar;x_mm\n" + all([](int k) {
                              return fmt::format("{};{:.4f};{:.3f}", grouped(20000 * k, ' '), bar(k), mm(k));
                            })},
    {"apostrophes_in_thousands",
     "t_us;p_bar;x_mm\n" +
         all([](int k) { return fmt::format("{};{:.4f};{:.3f}", grouped(20000 * k, '\''), bar(k), mm(k)); })},
    {"a_minus_of_text_programs",
     "t_s,p_bar,x_mm\n" +
         all([](int k) { return fmt::format("{:.3f},{:.4f},−{:.3f}", step_s * k, bar(k), 40 - mm(k)); })},
    {"counter_of_32_bits", "millis,p_bar,x_mm\n" + all([](int k) {
                             return fmt::format("{},{:.4f},{:.3f}", (4294966296LL + 20 * k) % 4294967296LL,
                                                bar(k), mm(k));
                           })},
    {"two_clocks_of_one_name", "t_s,p_bar,t_s,x_mm\n" + all([](int k) {
                                 return fmt::format("{0:.3f},{1:.4f},{2:.3f},{3:.3f}", step_s * k, bar(k),
                                                    step_s * k, mm(k));
                               })},
    {"german_spreadsheet", "Zeit [s];Druck [bar];Weg [mm]\r\n" + commas(all(with("{:.3f};{:.4f};{:.3f}\r")))},
    {"scope_says_its_step", "Model,MSO2014\nSample Interval,2.0E-02\n,\nTIME,p_bar,x_mm\n" + all(plain)},
    {"half_past_midnight",
     "Timestamp,p_bar,x_mm\n" + all([](int k) {
       const double at = 59.0 + step_s * k;
       return at < 60 ? fmt::format("5/13/2024 11:59:{:06.3f} PM,{:.4f},{:.3f}", at, bar(k), mm(k))
                      : fmt::format("5/14/2024 12:00:{:06.3f} AM,{:.4f},{:.3f}", at - 60, bar(k), mm(k));
     })},
};

/// A folder with a table, what `import` writes of it and what the reader gets.
class Bench {
 protected:
  recognise::Recognised recognised(const Kind& kind) {
    folder_.write(kind.file, kind.text);
    folder_.write("rig.yaml", "schema: mckibben-rig/1\nbase: festo_dmsp_10\ntick: 20 ms\n");
    return recognise::recognise({folder_ / kind.file}, true);
  }
  void expect_truth(const Kind& kind, std::string dataset) {
    dataset = std::regex_replace(dataset, std::regex("load: FILL_IN"), "load: 5 kg");
    dataset = std::regex_replace(dataset, std::regex("zero: FILL_IN"), "zero: 3");
    ASSERT_EQ(std::regex_replace(dataset, std::regex("#[^\n]*"), "").find("FILL_IN"), std::string::npos)
        << dataset;
    if (dataset.find("start:") == std::string::npos) dataset += "start: settled\n";
    folder_.write("dataset.yaml", dataset);
    const input::Dataset data = input::read_dataset(folder_);
    const domain::Measurement& measured = *data.runs.at(0).measured;
    ASSERT_EQ(measured.time_s.size(), static_cast<std::size_t>(rows)) << dataset;
    const auto &pressure_Pa = measured.given("muscle_pressure"), &ratio = measured.read("contraction");
    int lacks = 0;
    for (int k = 0; k < rows; ++k) {
      const auto row = static_cast<std::size_t>(k);
      EXPECT_NEAR(measured.time_s[row] - measured.time_s[0], step_s * k, 1e-6) << k << dataset;
      EXPECT_NEAR(pressure_Pa[row], 1e5 * bar(k), 30.0) << k << dataset;
      lacks += std::isnan(ratio[row]) ? 1 : 0;
      if (!std::isnan(ratio[row])) {
        EXPECT_NEAR((ratio[row] - ratio[0]) * 1e3 * data.rig.muscle.rest_length_m, mm(k) - mm(0),
                    kind.tolerance_mm)
            << k;
      }
    }
    EXPECT_EQ(lacks, kind.lacks);
  }

  Scratch folder_;
};

class Makers : public ::testing::TestWithParam<Kind>, protected Bench {};

TEST_P(Makers, ReadRight) {
  const recognise::Recognised found = recognised(GetParam());
  expect_truth(GetParam(), dataset_yaml(found, std::filesystem::path(folder_), "rig.yaml"));
}
INSTANTIATE_TEST_SUITE_P(Each, Makers, ::testing::ValuesIn(read_right),
                         [](const auto& each) { return std::string(each.param.name); });

class MakersApart : public ::testing::Test, protected Bench {};

TEST_F(MakersApart, PlaceholdersAreMissingReadings) {
  for (const char* none :
       {"-", "--", "n/a", "#N/A", "NA", "null", "None", ".", "*****", "#DIV/0!", "OVLD", "nan"}) {
    SCOPED_TRACE(none);
    const Kind kind{"placeholder", "t_s,p_bar,x_mm\n" + all([&](int k) {
                                     return k % 30 == 10
                                                ? fmt::format("{:.3f},{:.4f},{}", step_s * k, bar(k), none)
                                                : plain(k);
                                   }),
                    "5kg.csv", 3};
    expect_truth(kind, dataset_yaml(recognised(kind), std::filesystem::path(folder_), "rig.yaml"));
  }
}

TEST_F(MakersApart, LoadCellsThatShowAMass) {
  const Kind kind{"kg", "t_s,p_bar,x_mm,Force [kg]\n" + all([](int k) { return plain(k) + ",5.1"; })};
  const std::string dataset = dataset_yaml(recognised(kind), std::filesystem::path(folder_), "rig.yaml");
  EXPECT_TRUE(holds(dataset, "force: {column: \"Force [kg]\", unit: kgf}"));
  expect_truth(kind, dataset);
  EXPECT_NEAR(input::read_dataset(folder_).runs[0].measured->read("force")[0], 50.0138, 1e-3);
}

/// What is asked, and with which words.
TEST_F(MakersApart, WhatIsNotSureIsAsked) {
  const std::pair<std::string, const char*> asked[] = {
      {"Var1,Var2,Var3\n" + all(plain), "time: {column: Var1, unit: FILL_IN}"},
      {"Date,p_bar,x_mm\n" + all([](int k) {
         return fmt::format("{:.9f},{:.4f},{:.3f}", 45415.598 + step_s * k / 86400, bar(k), mm(k));
       }),
       "or d, as Excel counts days"},
      {"time_s,p_bar,x_mm\n" + all(with("about {:.3f},{:.4f},{:.3f}")),
       "holds what is read as no number, such as about"},
      {"t_ms,p_bar,encoder\n" +
           all([](int k) { return fmt::format("{},{:.4f},0x{:04X}", 20 * k, bar(k), 100 + 7 * k); }),
       "contraction: {column: encoder, unit: FILL_IN"},
      {"t_s,p1_bar,p2_bar,angle_deg\n" +
           all([](int k) { return fmt::format("{:.3f},{:.4f},2,{:.3f}", step_s * k, bar(k), mm(k)); }),
       "of two muscles write muscle_pressure_1"},
      {"t_s,p [V abs],x_mm\n" + all(plain), "zero: FILL_IN"},
      {"t_s,p_bar,x_mm\n" + all([](int k) { return k == 7 ? std::string("0.140,oops,3") : plain(k); }),
       "p_bar: 1 of its 80 cells hold no number, such as oops in line 9"},
      {"t_s,p_bar,contraction [mm],Kraft [N]\n" + all([](int k) { return plain(k) + ",50"; }),
       "load: FILL_IN"},
  };
  for (const auto& [text, words] : asked) {
    const Kind kind{"asked", text, "r.csv"};
    EXPECT_TRUE(holds(dataset_yaml(recognised(kind), std::filesystem::path(folder_), "rig.yaml"), words))
        << text.substr(0, 80);
  }
}

TEST_F(MakersApart, WhatIsNoTableSaysWhatToDo) {
  const auto refused = [&](const std::string& text) {
    try {
      recognised({"refused", text, "r.csv"});
    } catch (const input::BadInput& bad) {
      return std::string(bad.what());
    }
    return std::string();
  };
  EXPECT_TRUE(holds(refused("<html><table><tr><td>1</td></tr></table></html>"), "save it as .xlsx or CSV"));
  std::string across[3] = {"t_s", "p_bar", "x_mm"};
  for (int k = 0; k < 40; ++k) {
    across[0] += fmt::format(",{:.3f}", step_s * k);
    across[1] += fmt::format(",{:.4f}", bar(k));
    across[2] += fmt::format(",{:.3f}", mm(k));
  }
  EXPECT_TRUE(holds(refused(across[0] + "\n" + across[1] + "\n" + across[2] + "\n"), "transpose the table"));
  EXPECT_TRUE(holds(refused("t_s,p_bar\n0,1\n0.1,1.1\n0.2,1.2\n0.3,1.3\n\nt_s,x_mm,F_N\n0,1,2\n0.1,1,2\n"),
                    "a file of its own"));
}

}  // namespace
}  // namespace mckibben::output::makers
