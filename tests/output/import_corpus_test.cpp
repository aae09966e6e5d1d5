// Tables of many makers, over format, clock, unit and layout, with the truth known: what `import` takes them
// for is written as a data set, what it left open is filled in with the truth, and the reader must get the
// truth. So everything is read right or asked about, and nothing is misread in silence.
#include <cmath>
#include <functional>
#include <regex>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <sim/input/dataset_file.hpp>
#include <sim/input/quantity.hpp>
#include <sim/output/recognised.hpp>
#include <sim/recognise/recognise.hpp>

#include "scratch.hpp"

namespace mckibben::output {
namespace {

constexpr int rows = 60;
constexpr double step_s = 0.02;

double pressure_bar(int k) {
  return 0.4 + 2.5 * (0.5 - 0.5 * std::cos(0.07 * k)) + 0.002 * (k % 3);
}
double rise_mm(int k) {
  return 3.0 + 25.0 * (0.5 - 0.5 * std::cos(0.07 * k));
}

/// How text is laid out.
struct Form {
  const char* name;
  const char* ending;
  const char* separator;
  bool comma = false;  ///< decimal
  bool headings = true;
  enum class Units { brackets, suffix, line } units = Units::brackets;
  const char* above = "";  ///< the table
  bool trailing = false;   ///< a separator at the end of each row
  const char* end = "\n";
  bool utf16 = false;
};

struct Clock {
  const char* name;
  const char* heading;
  const char* unit;  ///< empty: its name says it
  std::function<std::string(int)> cell;
  double tolerance_s = 1e-9;
  const char* above = "";
  int runs = 1;
  double step = step_s;
};

struct Unit {
  const char *name, *pressure, *rise;
};

const Form forms[] = {
    {"comma", "csv", ","},
    {"semicolon", "csv", ";", true},
    {"tabs", "txt", "\t", false, true, Form::Units::line},
    {"blanks", "dat", "  ", false, true, Form::Units::suffix},
    {"hash_headings", "txt", " ", false, true, Form::Units::suffix, "# rig 4\n# "},
    {"comma_in_txt", "txt", ", ", false, false},
    {"no_ending", "", ",", false, true, Form::Units::line},
    {"settings", "csv", ";", true, true, Form::Units::line, "KP;0,72\nGain;500,000000\n\n"},
    {"excel", "csv", ";", true, true, Form::Units::line, "Load;x;;\nKP;0,72;;\n", true},
    {"cr_alone", "csv", ",", false, true, Form::Units::brackets, "", false, "\r"},
    {"crlf", "csv", ",", false, true, Form::Units::brackets, "", true, "\r\n"},
    {"utf16", "txt", "\t", false, true, Form::Units::brackets, "", false, "\r\n", true},
    {"putty", "log", ", ", false, false, Form::Units::brackets,
     "=~=~=~=~=~=~=~= PuTTY log 2025.01.02 03:04:05 =~=~=~=~=~=~=~=\n"},
};

const Clock clocks[] = {
    {"seconds", "t", "s", [](int k) { return fmt::format("{:.3f}", step_s * k); }},
    {"milliseconds", "time", "ms", [](int k) { return fmt::format("{}", 20 * k); }},
    {"millis", "millis", "", [](int k) { return fmt::format("{}", 20 * k + 1234); }},
    {"micros", "micros", "", [](int k) { return fmt::format("{}", 20000 * k + 1234567); }},
    {"epoch_s", "stamp", "s",
     [](int k) { return fmt::format("{}.{:06}", 1700000000 + k / 50, 20000 * (k % 50)); }},
    {"epoch_ms", "timestamp", "", [](int k) { return fmt::format("{}", 1700000000123LL + 20LL * k); }},
    {"epoch_ns", "%time", "",
     [](int k) { return fmt::format("{}", 1700000000123456789LL + 20000000LL * k); }},
    {"interval", "dt", "ms", [](int k) { return fmt::format("{}", 20 + k % 2 * 0); }},
    {"counter", "sample", "", [](int k) { return fmt::format("{}", k); }, 1e-9, "Fs = 50 Hz\n"},
    {"coarse", "t", "ms", [](int k) { return fmt::format("{}", static_cast<int>(0.7 * k)); }, 1e-3, "", 1,
     0.7e-3},
    {"restart", "t", "ms", [](int k) { return fmt::format("{}", 20 * (k % 30)); }, 1e-9, "", 2},
    {"of_the_day", "Uhrzeit", "", [](int k) { return fmt::format("23:59:{:06.3f}", 58.0 + 0.02 * k); }},
};

const Unit units[] = {{"bar_mm", "bar", "mm"},   {"kPa_cm", "kPa", "cm"},    {"PSI_inches", "PSI", "inches"},
                      {"psig_in", "psig", "in"}, {"mbar_m", "mbar", "m"},    {"MPa_mm", "MPa", "mm"},
                      {"mmHg_mm", "mmHg", "mm"}, {"kgf_mm", "kgf/cm2", "mm"}};

std::string number(double value, bool comma) {
  std::string text = fmt::format("{:.7g}", value);
  if (text.find_first_of("e") != std::string::npos) text = fmt::format("{:.9f}", value);
  if (comma && text.find('.') != std::string::npos) text[text.find('.')] = ',';
  return text;
}

double in_unit(double value, const char* ours, const char* unit) {
  std::vector<double> one{1.0};
  input::convert_units(one, unit, ours);
  return value / one.front();
}

std::string utf16(const std::string& text) {
  std::string bytes = "\xFF\xFE";
  for (const char c : text) bytes += c, bytes += '\0';
  return bytes;
}

std::string heading(const Form& form, const char* name, const char* unit) {
  if (*unit == '\0' || form.units == Form::Units::line) return name;
  return form.units == Form::Units::brackets ? fmt::format("{} [{}]", name, unit)
                                             : fmt::format("{}_{}", name, unit);
}

std::string table(const Form& form, const Clock& clock, const Unit& unit) {
  const std::string sep = form.separator,
                    end = form.trailing ? form.separator + std::string(form.end) : form.end;
  std::string text = std::string(clock.above) + form.above;
  if (form.headings) {
    text += heading(form, clock.heading, clock.unit) + sep + heading(form, "pressure", unit.pressure) + sep +
            heading(form, "laser", unit.rise) + end;
    if (form.units == Form::Units::line)
      text +=
          std::string(*clock.unit == '\0' ? "-" : clock.unit) + sep + unit.pressure + sep + unit.rise + end;
  }
  for (int k = 0; k < rows; ++k) {
    std::string cell = clock.cell(k);
    if (form.comma && cell.find('.') != std::string::npos) cell[cell.find('.')] = ',';
    text += cell + sep + number(in_unit(pressure_bar(k), "bar", unit.pressure), form.comma) + sep +
            number(in_unit(rise_mm(k), "mm", unit.rise), form.comma) + end;
  }
  if (std::string_view(form.end) != "\n") {
    std::string lines;
    for (const char c : text)
      if (c != '\n' || lines.ends_with('\r'))
        lines += c;
      else
        lines += form.end;
    text = lines;
  }
  return form.utf16 ? utf16(text) : text;
}

/// What is left open, filled in.
std::string filled(std::string text, const Form& form, const Clock& clock, const Unit& unit) {
  const auto in_line_of = [&](const std::string& key, const char* what, const std::string& value) {
    text = std::regex_replace(text, std::regex("(  " + key + ": \\{[^\\n]*" + what + ": )\"?FILL_IN\"?"),
                              "$1" + value);
  };
  const auto quoted = [](const char* value) { return '"' + std::string(value) + '"'; };
  const bool named = form.headings;
  in_line_of("time", "unit", quoted(*clock.unit != '\0' ? clock.unit : "ms"));
  in_line_of("muscle_pressure", "unit", quoted(unit.pressure));
  in_line_of("contraction", "unit", quoted(unit.rise));
  in_line_of("contraction", "column", named ? "laser" : "3");
  in_line_of("muscle_pressure", "column", named ? "pressure" : "2");
  text = std::regex_replace(text, std::regex("zero: \"?FILL_IN\"?"), "zero: 0");
  text = std::regex_replace(text, std::regex("factor: \"?FILL_IN\"?"), "factor: 1");
  return std::regex_replace(text, std::regex("load: \"?FILL_IN\"?"), "load: 5 kg");
}

/// A table without headings names nothing but its clock: what is in it is asked.
std::string described_by_hand(const recognise::Recognised& found, const std::string& file, const Unit& unit) {
  const auto* time = found.maps[0].find("time");
  EXPECT_TRUE(found.maps[0].find("contraction") == nullptr ||
              found.maps[0].find("contraction")->column.open());
  return fmt::format(
      "schema: mckibben-dataset/1\nrig: rig.yaml\ncolumns:\n  time: {{column: {}, unit: FILL_IN}}\n"
      "  muscle_pressure: {{column: 2, unit: \"{}\", as: input}}\n  contraction: {{column: 3, unit: "
      "\"{}\"}}\n"
      "runs: [{{id: a, file: {}, load: 5 kg}}]\n",
      time == nullptr ? "1" : time->column.value, unit.pressure, unit.rise, file);
}

void expect_truth(const domain::Run& run, const Clock& clock, int first, double rest_length_mm) {
  ASSERT_TRUE(run.measured);
  const auto& measured = *run.measured;
  ASSERT_EQ(measured.time_s.size(), static_cast<std::size_t>(rows / clock.runs));
  const auto &pressure = measured.given("muscle_pressure"), &ratio = measured.read("contraction");
  ASSERT_EQ(pressure.size(), measured.time_s.size());
  ASSERT_EQ(ratio.size(), measured.time_s.size());
  for (std::size_t k = 0; k < measured.time_s.size(); ++k) {
    const int at = first + static_cast<int>(k);
    EXPECT_NEAR(measured.time_s[k] - measured.time_s[0], clock.step * static_cast<double>(k),
                clock.tolerance_s + 1e-7)
        << k;
    EXPECT_NEAR(pressure[k], 1e5 * pressure_bar(at), 20.0) << k;
    EXPECT_NEAR((ratio[k] - ratio[0]) * rest_length_mm, rise_mm(at) - rise_mm(first), 1e-3) << k;
  }
}

void try_one(const Form& form, const Clock& clock, const Unit& unit) {
  SCOPED_TRACE(fmt::format("{} / {} / {}", form.name, clock.name, unit.name));
  const Scratch folder;
  const std::string file = *form.ending == '\0' ? "run" : fmt::format("run.{}", form.ending);
  const std::string text = table(form, clock, unit);
  folder.write(file, text);
  folder.write("rig.yaml", "schema: mckibben-rig/1\nbase: festo_dmsp_10\ntick: 20 ms\n");
  try {
    const recognise::Recognised found = recognise::recognise({folder / file}, true);
    const std::string written = form.headings ? dataset_yaml(found, std::filesystem::path(folder), "rig.yaml")
                                              : described_by_hand(found, file, unit);
    std::string dataset = filled(written, form, clock, unit);
    if (dataset.find("start:") == std::string::npos) dataset += "start: settled\n";
    folder.write("dataset.yaml", dataset);
    const std::string keys = std::regex_replace(dataset, std::regex("#[^\\n]*"), "");
    ASSERT_EQ(keys.find("FILL_IN"), std::string::npos) << "asked for what the table says:\n" << dataset;
    try {
      const input::Dataset data = input::read_dataset(folder);
      ASSERT_EQ(data.runs.size(), static_cast<std::size_t>(clock.runs)) << dataset;
      for (int i = 0; i < clock.runs; ++i)
        expect_truth(data.runs[static_cast<std::size_t>(i)], clock, i * rows / clock.runs,
                     1e3 * data.rig.muscle.rest_length_m);
    } catch (const input::BadInput& bad) {
      FAIL() << "import wrote what the reader refuses: " << bad.what() << "\n" << dataset;
    }
  } catch (const input::BadInput& bad) {
    FAIL() << bad.what() << "\n" << text.substr(0, 300);
  }
}

TEST(ImportCorpus, EveryFormReadsRight) {
  for (const Form& form : forms)
    for (const std::size_t clock : {0U, 1U}) try_one(form, clocks[clock], units[0]);
}

TEST(ImportCorpus, EveryClockReadsRight) {
  for (const Clock& clock : clocks)
    for (const std::size_t form : {0U, 1U, 2U}) try_one(forms[form], clock, units[0]);
}

TEST(ImportCorpus, EveryUnitReadsRight) {
  for (const Unit& unit : units)
    for (const std::size_t form : {0U, 1U, 2U}) try_one(forms[form], clocks[1], unit);
}

}  // namespace
}  // namespace mckibben::output
