// Tables as people have them: each kind reads to the same numbers as the plain one.
#include <string>

#include <gtest/gtest.h>

#include <sim/input/cells.hpp>
#include <sim/input/dataset_file.hpp>
#include <sim/input/dates.hpp>
#include <sim/input/text_layout.hpp>

#include "scratch.hpp"

namespace mckibben::input {
namespace {

namespace fs = std::filesystem;

struct Kind {
  const char *name, *columns, *table;
};

constexpr const char* german =
    "{time: {column: Zeit, unit: s}, current: {column: Strom, unit: mA}, contraction: {column: Weg, unit: "
    "mm}}";
constexpr const char* dated =
    "{time: {column: Zeit, unit: date}, current: {column: Strom, unit: mA}, "
    "contraction: {column: Weg, unit: mm}}";

const Kind tables[] = {
    {"plain", german, "Zeit,Strom,Weg\n0,4,0\n0.012,4.5,3\n"},
    {"by_number",
     "{time: {column: 1, unit: s}, current: {column: 2, unit: mA}, contraction: {column: 3, unit: mm}}",
     "0, 4, 0\n0.012, 4.5, 3\n"},
    {"headings_behind_a_mark", german, "# Rig 4\n# Zeit Strom Weg\n0 4 0\n0.012 4.5 3\n"},
    {"settings_above", german, "KP;0,72\nSample rate;500,000000\n\nZeit;Strom;Weg\n0;4;0\n0,012;4,5;3\n"},
    {"a_sheet_with_as_many_cells_in_each_line", german,
     "Load;5;;\nKP;0,7;;\nZeit;Strom;Weg;\n0;4;0;\n0,012;4,5;3;\n"},
    {"blank_lines_and_remarks_between", german, "Zeit,Strom,Weg\n0,4,0\n\n# a remark\n0.012,4.5,3\n"},
    {"thousands",
     "{time: {column: Zeit, unit: us}, current: {column: Strom, unit: mA}, contraction: {column: Weg, unit: "
     "mm}}",
     "Zeit;Strom;Weg\n0.0;4;0\n12,000.0;4.5;3\n"},
    {"thousands_without_a_point",
     "{time: {column: Zeit, unit: us}, current: {column: Strom, unit: mA}, contraction: {column: Weg, unit: "
     "mm}}",
     "Zeit;Strom;Weg\n0;4.0;0\n12,000;4.5;3\n"},
    {"thousands_that_another_column_tells",
     "{time: {column: Zeit, unit: us}, current: {column: Strom, unit: mA}, contraction: {column: Weg, unit: "
     "mm}}",
     "Zeit;Strom;Weg\n0;4;0\n12.000;4,5;3\n"},
    {"numbers_of_equal_width", german, "Zeit,Strom,Weg\n00.000,04.0,+00\n00.012,04.5,+03\n"},
    {"rows_that_lack_their_last_cells", german, "Zeit,Strom,Weg,note\n0,4,0\n0.012,4.5,3,7\n"},
    {"headings_again", german, "Zeit,Strom,Weg\n0,4,0\nZeit,Strom,Weg\n0.012,4.5,3\n"},
    {"names_of_several_words",
     "{time: {column: Elapsed time, unit: s}, current: {column: Valve current, unit: mA}, contraction: "
     "{column: Weg, unit: mm}}",
     "Elapsed time   Valve current   Weg\n0 4 0\n0.012 4.5 3\n"},
    {"keys_and_values_above_two_blanks", german, "KP 0.72\nKI 0.1\nZeit Strom Weg\n0 4 0\n0.012 4.5 3\n"},
    {"carriage_returns_alone", german, "Zeit,Strom,Weg\r0,4,0\r0.012,4.5,3\r"},
    {"semicolons_and_decimal_commas", german, "Zeit;Strom;Weg\n0;4;0\n0,012;4,5;3\n"},
    {"byte_order_mark_and_crlf", german, "\xEF\xBB\xBFZeit;Strom;Weg\r\n0;4;0\r\n0,012;4,5;3\r\n"},
    {"units_in_headings",
     "{time: {column: 't [ms]', unit: ms}, current: {column: I (A), unit: A}, "
     "contraction: {column: x_cm, unit: cm}}",
     "t [ms],I (A),x_cm\n0,0.004,0\n12,0.0045,0.3\n"},
    {"a_line_of_units", german, "Zeit;Strom;Weg\n[s];[mA];[mm]\n0;4;0\n0,012;4,5;3\n"},
    {"a_sensor_whose_factor_is_1",
     "{time: {column: Zeit, unit: s}, current: {column: Strom, unit: mA}, "
     "contraction: {column: Weg, unit: mm, factor: 1}}",
     "Zeit;Strom;Weg\n[s];[mA];[V]\n0;4;0\n0,012;4,5;3\n"},
    {"lines_above_and_below", german,
     "Rig 4; run 2\nby;me\n\nZeit;Strom;Weg;\nof recorder;of valve;laser\ns;mA;mm\n\n0;4;0\n0,012;4,5;3\n"},
    {"excel", german, "sep=;\r\nZeit;Strom;Weg;;\r\n0;4;0;;\r\n\"0,012\";\"4,5\";\" 3\"\r\n;;;;\r\n;;;;\r\n"},
    {"excel_quotes_every_cell", german,
     "\"Zeit\",\"Strom\",\"Weg\"\n\"0\",\"4\",\"0\"\n\"0,012\",\"4,5\",\"3\"\n"},
    {"excel_in_an_old_code_page",
     "{time: {column: Zeit, unit: s}, current: {column: Strom, unit: mA}, contraction: {column: Länge, unit: "
     "mm}}",
     "Zeit;Strom;L\xE4nge\n0;4;0\n0,012;4,5;3\n"},
    {"remarks_below_units", german, "Zeit;Strom;Weg\ns;mA;mm\n;valve;laser\n0;4;0\n0,012;4,5;3\n"},
    {"ranges_below_units", german, "Zeit;Strom;Weg\ns;mA;mm\n0..10;4..20;0..30\n0;4;0\n0,012;4,5;3\n"},
    {"numbers_of_columns", german, "Zeit;Strom;Weg\n1;2;3\n0;4;0\n0,012;4,5;3\n"},
    {"records", german,
     "[{'Zeit': 0, 'Strom': 4, 'Weg': 0},\n {'Zeit': 0.012, 'Strom': 4.5,\n  'Weg': 3}]\n"},
    {"labels_and_units", german, "Zeit:0 s Strom:4 mA Weg:0 mm\nZeit:0.012 s Strom:4.5 mA Weg:3 mm\n"},
    {"dates", dated, "Zeit;Strom;Weg\n2024-05-03 23:59:59,990;4;0\n2024-05-04T00:00:00.002;4,5;3\n"},
    {"dates_in_german", dated, "Zeit;Strom;Weg\n03.05.2024 14:22:01,5;4;0\n03.05.2024 14:22:01,512;4,5;3\n"},
    {"dates_in_american", dated,
     "Zeit,Strom,Weg\n5/3/2024 2:22:01.5 PM,4,0\n5/3/2024 2:22:01.512 PM,4.5,3\n"},
    {"dates_with_zones", dated,
     "Zeit;Strom;Weg\n2024-05-03T14:22:01.500+02:00;4;0\n2024-05-03T12:22:01.512Z;4,5;3\n"},
    {"times_of_day", dated, "Zeit,Strom,Weg\n14:22:01.5,4,0\n14:22:01.512,4.5,3\n"},
    {"dates_that_nobody_needs", german, "Datum;Zeit;Strom;Weg\n03.05.2024;0;4;0\n03.05.2024;0,012;4,5;3\n"},
};

class PeopleTables : public ::testing::TestWithParam<Kind> {};

TEST_P(PeopleTables, ReadToTheSameNumbers) {
  const Scratch place;
  place.write("r.csv", GetParam().table);
  place.write("dataset.yaml", std::string("schema: mckibben-dataset/1\nrig: thesis\ncolumns: ") +
                                  GetParam().columns + "\nruns: [{id: r, file: r.csv, load: 5 kg}]\n");
  const Dataset data = read_dataset(place);
  EXPECT_EQ(data.runs[0].current_mA, (std::vector<double>{4.0, 4.5}));
  ASSERT_EQ(data.runs[0].rows(), 2u);
  EXPECT_NEAR(data.runs[0].judged().values[1], 0.01, 1e-15);
}
INSTANTIATE_TEST_SUITE_P(Each, PeopleTables, ::testing::ValuesIn(tables),
                         [](const auto& each) { return std::string(each.param.name); });

TEST(TextLayout, WhatIsNoUnitIsARow) {
  for (const char* text : {"a,b\n0 s,4 mA\n0,4\n", "a,b\nERR,ERR\n0,4\n", "a,b\n1,1\n0,4\n"})
    EXPECT_EQ(layout_of(Source("a.csv", text, ""), {}).first_row, 2u) << text;
  const TextLayout layout = layout_of(Source("a.csv", "remark\na,b\nmA,°\n0,4\n", ""), {});
  EXPECT_EQ(layout.heading, 2u);
  EXPECT_EQ(layout.first_row, 4u);
  EXPECT_EQ(layout.units, (std::vector<std::string>{"mA", "deg"}));
}

TEST(Cells, ErrorsOfExcelInAnyLanguage) {
  for (const char* none : {"#WERT!", "#DIV/0!", "#¡VALOR!", "#NAME?", "#NV", "#N/D", "#NOMBRE!"})
    EXPECT_TRUE(is_missing({none, 0})) << none;
  for (const char* some : {"# late!", "#7", "5", "on!"}) EXPECT_FALSE(is_missing({some, 0})) << some;
}

TEST(Dates, OtherDaysZonesAndWhatIsNone) {
  const auto second = [](const char* first, const char* text) {
    ClockReader clock;
    std::string problem;
    clock.read("t", {first, 0}, problem);
    return clock.read("t", {text, 0}, problem);
  };
  EXPECT_EQ(second("2024-02-28T23:00:00Z", "2024-03-01T01:00:00+02:00"), 86400.0);
  EXPECT_EQ(second("12/31/2024 11:59:59 PM", "1/13/2025 12:00:00 AM"), 12 * 86400.0 + 1.0);
  EXPECT_EQ(second("5/3/2024 11:59 PM", "5/4/2024 12:00 AM"), std::nullopt);  // May or April?
  for (const char* text :
       {"2024-02-30 00:00", "2024-05-03", "24:00", "12:60", "13:00 PM", "", "1.5", "12:00 x"})
    EXPECT_EQ(second("2024-05-03 00:00", text), std::nullopt) << text;
}

}  // namespace
}  // namespace mckibben::input
