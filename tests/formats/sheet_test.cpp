// Spreadsheets and .tdms as text: what is where, dates, and what damaged ones say.
#include <bit>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <sstream>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <zip.h>

#include <sim/formats/sheet.hpp>
#include <sim/formats/sheet_text.hpp>
#include <sim/formats/table.hpp>

#include "scratch.hpp"

namespace mckibben::formats {
namespace {

std::string xlsx(const std::vector<std::pair<std::string, std::string>>& parts) {
  const Scratch folder;
  const std::string path = folder / "a.xlsx";
  zip_t* archive = zip_open(path.c_str(), ZIP_CREATE, nullptr);
  for (const auto& [name, text] : parts)
    zip_file_add(archive, name.c_str(), zip_source_buffer(archive, text.data(), text.size(), 0),
                 ZIP_FL_OVERWRITE);
  EXPECT_EQ(zip_close(archive), 0);
  std::ostringstream bytes;
  bytes << std::ifstream(path, std::ios::binary).rdbuf();
  return bytes.str();
}

const std::vector<std::pair<std::string, std::string>> workbook{
    {"xl/workbook.xml",
     "<workbook xmlns:r='r'><sheets><sheet name='one' r:id='a'/><sheet name='two' "
     "r:id='b'/></sheets></workbook>"},
    {"xl/_rels/workbook.xml.rels",
     "<Relationships><Relationship Id='a' Target='worksheets/sheet1.xml'/><Relationship Id='b' "
     "Target='/xl/worksheets/sheet2.xml'/></Relationships>"},
    {"xl/sharedStrings.xml", "<sst><si><t>Zeit</t></si><si><r><t>We</t></r><r><t>g</t></r></si></sst>"},
    {"xl/styles.xml",
     "<styleSheet><numFmts><numFmt numFmtId='170' formatCode='yyyy\\-mm\\-dd'/><numFmt numFmtId='171' "
     "formatCode='0.0 \"days\"'/></numFmts><cellXfs><xf numFmtId='0'/><xf numFmtId='170'/><xf "
     "numFmtId='171'/></cellXfs></styleSheet>"},
    {"xl/worksheets/sheet1.xml",
     "<worksheet><sheetData><row r='1'><c r='A1' t='s'><v>0</v></c><c r='C1' t='s'><v>1</v></c></row><row "
     "r='3'><c r='A3'><v>0.02</v></c><c r='B3' s='1'><v>45415.5</v></c><c r='C3' s='2'><v>1.5</v></c></row>"
     "</sheetData></worksheet>"},
    {"xl/worksheets/sheet2.xml",
     "<x:worksheet><x:sheetData><x:row><x:c t='inlineStr'><x:is><x:t>a&lt;b</x:t></x:is></x:c></x:row></"
     "x:sheetData></x:worksheet>"}};

TEST(Xlsx, CellsStandWhereTheyAre) {
  const auto sheets = sheets_of_xlsx(xlsx(workbook));
  ASSERT_EQ(sheets.size(), 2u);
  EXPECT_EQ(sheets[0].name, "one");
  EXPECT_EQ(sheets[0].text, "Zeit\t\tWeg\t\n\n0.02\t2024-05-03 12:00:00.000000\t1.5\t\n");
  EXPECT_EQ(sheets[0].numbers, 3u);
  EXPECT_EQ(sheets[1].text, "a<b\t\n");
}

TEST(Xlsx, WhatIsNoneOrDamagedIsSaid) {
  const std::string whole = xlsx(workbook);
  EXPECT_THROW(sheets_of_xlsx(xlsx({{"content.xml", "<a/>"}})), BadFile);
  auto broken = workbook;
  broken[4].second = "<worksheet><sheetData>";
  EXPECT_THROW(sheets_of_xlsx(xlsx(broken)), BadFile);
  for (std::size_t size = 0; size < whole.size(); size += 97)
    EXPECT_THROW(sheets_of_xlsx(whole.substr(0, size)), BadFile) << size;
}

// 100 000 levels ended the program.
TEST(Xlsx, RunsOfTextDoNotNest) {
  const auto deep = [&](std::size_t levels) {
    std::string open, close;
    for (std::size_t k = 0; k < levels; ++k) {
      open += "<r>";
      close += "</r>";
    }
    auto nested = workbook;
    nested[2].second = "<sst><si>" + open + "<t>Zeit</t>" + close + "</si><si><t>Weg</t></si></sst>";
    return sheets_of_xlsx(xlsx(nested))[0].text;
  };
  EXPECT_TRUE(deep(1).starts_with("Zeit\t\tWeg\t\n"));
  EXPECT_TRUE(deep(1'000'000).starts_with("\t\tWeg\t\n"));
}

TEST(Xls, NumbersTextsAndDatesStandWhereTheyAre) {
  const auto sheets = sheets_of_xls(MCKIBBEN_TEST_DATA "/two_sheets.xls");
  ASSERT_EQ(sheets.size(), 2u);
  EXPECT_EQ(sheets[0].name, "one");
  EXPECT_EQ(sheets[0].text,
            "Zeit\tDruck\tDatum\tWeg\t\ns\tbar\t\tmm\t\n0\t0.5\t2024-05-03 12:00:00\t3\t\n"
            "0.02\t1.25\t2024-05-03 12:00:01\t\t\n0.04\t-2\t2024-05-03 12:00:02\t7.125\t\n");
  EXPECT_EQ(sheets[0].numbers, 11u);
  EXPECT_EQ(sheets[1].text, "\t\t\n\tnur Text\t\n");
  EXPECT_EQ(sheets[1].numbers, 0u);
}

TEST(Xls, WhatIsDamagedIsRefused) {
  std::ostringstream bytes;
  bytes << std::ifstream(MCKIBBEN_TEST_DATA "/two_sheets.xls", std::ios::binary).rdbuf();
  const Scratch folder;
  for (const std::size_t size : {0U, 8U, 600U, 2000U})
    EXPECT_THROW(sheets_of_xls(folder.write("a.xls", bytes.str().substr(0, size))), BadFile) << size;
}

TEST(Sheets, SerialsAreDates) {
  EXPECT_EQ(date_of_serial(45415.598), "2024-05-03 14:21:07.200000");
  EXPECT_EQ(date_of_serial(0.25), "06:00:00.000000");
  EXPECT_EQ(date_of_serial(-1.0), "");
}

template <class T>
std::string raw(T value) {
  std::string bytes(sizeof(T), '\0');
  std::memcpy(bytes.data(), &value, sizeof(T));
  return bytes;
}
std::string text(const std::string& value) {
  return raw(static_cast<std::uint32_t>(value.size())) + value;
}

/// Two channels of three doubles, with a rate and units.
std::string tdms(double second_increment) {
  std::string objects = raw(std::uint32_t{3}) + text("/'b'") + raw(0xFFFFFFFFU) + raw(std::uint32_t{0});
  for (const auto& [name, unit, increment] : {std::tuple{"p", "bar", 0.5}, {"it''s", "mm", second_increment}})
    objects += text(fmt::format("/'b'/'{}'", name)) + raw(std::uint32_t{20}) + raw(std::uint32_t{10}) +
               raw(std::uint32_t{1}) + raw(std::uint64_t{3}) + raw(std::uint32_t{2}) + text("unit_string") +
               raw(std::uint32_t{0x20}) + text(unit) + text("wf_increment") + raw(std::uint32_t{10}) +
               raw(increment);
  std::string values;
  for (const double value : {1.0, 2.0, 3.0, 4.0, 5.0, 6.0}) values += raw(value);
  const auto segment = [&](std::uint32_t contents, const std::string& meta) {
    return "TDSm" + raw(contents) + raw(std::uint32_t{4713}) +
           raw(std::uint64_t{meta.size() + values.size()}) + raw(std::uint64_t{meta.size()}) + meta + values;
  };
  return segment(2 | 4 | 8, objects) + segment(8, "");
}

TEST(Tdms, ChannelsSegmentsUnitsAndRates) {
  const auto sheets = sheets_of_tdms(tdms(0.5));
  ASSERT_EQ(sheets.size(), 1u);
  EXPECT_EQ(sheets[0].text,
            "time\tp\tit's\ns\tbar\tmm\n0\t1\t4\n0.5\t2\t5\n1\t3\t6\n1.5\t1\t4\n2\t2\t5\n2.5\t3\t6\n");
  EXPECT_TRUE(sheets_of_tdms(tdms(0.25))[0].text.starts_with("time\tp\ttime of it's\tit's\n"))
      << "rates differ";
}

/// A channel's property as a double, a text or a stamp of seconds since 1904.
std::string property(const std::string& name, double value) {
  return text(name) + raw(std::uint32_t{10}) + raw(value);
}
std::string property(const std::string& name, const std::string& value) {
  return text(name) + raw(std::uint32_t{0x20}) + text(value);
}
std::string start(std::int64_t second, std::uint64_t part) {
  return text("wf_start_time") + raw(std::uint32_t{0x44}) + raw(part) + raw(second);
}

/// Channels a, b, ... of two doubles, 1 and 2, each with its properties.
std::string tdms_with(const std::vector<std::vector<std::string>>& properties) {
  std::string objects = raw(static_cast<std::uint32_t>(properties.size())), values;
  for (std::size_t k = 0; k < properties.size(); ++k) {
    objects += text(fmt::format("/'g'/'{}'", static_cast<char>('a' + k))) + raw(std::uint32_t{20}) +
               raw(std::uint32_t{10}) + raw(std::uint32_t{1}) + raw(std::uint64_t{2}) +
               raw(static_cast<std::uint32_t>(properties[k].size()));
    for (const std::string& each : properties[k]) objects += each;
    values += raw(1.0) + raw(2.0);
  }
  return "TDSm" + raw(std::uint32_t{2 | 4 | 8}) + raw(std::uint32_t{4713}) +
         raw(std::uint64_t{objects.size() + values.size()}) + raw(std::uint64_t{objects.size()}) + objects +
         values;
}

TEST(Tdms, ChannelsThatStartLaterHaveAClockOfTheirOwn) {
  const std::string step = property("wf_increment", 0.5);
  constexpr std::int64_t day = 3797590921;
  constexpr std::uint64_t quarter = 1ULL << 62U;
  EXPECT_EQ(
      sheets_of_tdms(tdms_with({{step, start(day + 1, quarter)}, {step, start(day, 2 * quarter)}}))[0].text,
      "time\ta\ttime of b\tb\ns\t-\ts\t-\n0.75\t1\t0\t1\n1.25\t2\t0.5\t2\n");
  for (const std::int64_t same : {day, std::int64_t{0}})  // 0: it was never set
    EXPECT_EQ(sheets_of_tdms(tdms_with({{step, start(day, 0)}, {step, start(same, 0)}}))[0].text,
              "time\ta\tb\ns\t-\t-\n0\t1\t1\n0.5\t2\t2\n");
}

TEST(Tdms, CountsAreScaled) {
  const auto of = [](std::vector<std::string> said) {
    return sheets_of_tdms(tdms_with({std::move(said)}))[0].text.substr(4);
  };
  const std::string two = property("NI_Number_Of_Scales", 2.0);
  const std::vector<std::string> line{two, property("NI_Scale[1]_Scale_Type", std::string("Linear")),
                                      property("NI_Scale[1]_Linear_Slope", 0.5),
                                      property("NI_Scale[1]_Linear_Y_Intercept", 3.0)};
  EXPECT_EQ(of(line), "3.5\n4\n");
  auto more = line;
  more.push_back(property("NI_Scaling_Status", std::string("scaled")));
  EXPECT_EQ(of(more), "1\n2\n") << "it has been";
  more = line;
  for (const std::string& each : {property("NI_Scale[0]_Scale_Type", std::string("Polynomial")),
                                  property("NI_Scale[0]_Polynomial_Coefficients_Size", 3.0),
                                  property("NI_Scale[0]_Polynomial_Coefficients[1]", 1.0),
                                  property("NI_Scale[0]_Polynomial_Coefficients[2]", 1.0),
                                  property("NI_Scale[1]_Linear_Input_Source", 0.0)})
    more.push_back(each);
  EXPECT_EQ(of(more), "4\n6\n") << "x + x^2, and that in the line";
  try {
    of({two, property("NI_Scale[1]_Scale_Type", std::string("Thermocouple"))});
    ADD_FAILURE();
  } catch (const BadFile& bad) {
    EXPECT_STREQ(
        bad.what(),
        "its channel a holds counts with a scale of the kind Thermocouple, which is not read; save it "
        "scaled, or export it as text");
  }
}

/// Channels of bytes, so many in each.
std::string tdms_of(const std::vector<std::size_t>& lengths) {
  std::string objects = raw(static_cast<std::uint32_t>(lengths.size()));
  std::size_t bytes = 0;
  for (std::size_t k = 0; k < lengths.size(); ++k) {
    objects += text(fmt::format("/'b'/'{}'", k)) + raw(std::uint32_t{20}) + raw(std::uint32_t{5}) +
               raw(std::uint32_t{1}) + raw(std::uint64_t{lengths[k]}) + raw(std::uint32_t{0});
    bytes += lengths[k];
  }
  return "TDSm" + raw(std::uint32_t{2 | 4 | 8}) + raw(std::uint32_t{4713}) +
         raw(std::uint64_t{objects.size() + bytes}) + raw(std::uint64_t{objects.size()}) + objects +
         std::string(bytes, '\1');
}

// 1.4 MB became 10 GB of empty cells.
TEST(Tdms, ManyChannelsBesideALongOneAreRefused) {
  std::vector<std::size_t> lengths(9000, 1);
  lengths.front() = 20'000;
  EXPECT_THROW(sheets_of_tdms(tdms_of(lengths)), BadFile);
  EXPECT_EQ(sheets_of_tdms(tdms_of({2, 1}))[0].text, "0\t1\n-\t-\n1\t1\n1\t\n");
}

TEST(Tdms, DamagedOnesAreRefusedOrRead) {
  const std::string whole = tdms(0.5);
  for (std::size_t size = 1; size < 150; ++size)
    EXPECT_THROW(sheets_of_tdms(whole.substr(0, size)), BadFile) << size;
  for (std::size_t at = 0; at < whole.size(); ++at) {
    std::string spoilt = whole;
    spoilt[at] = '\xFF';
    try {
      sheets_of_tdms(spoilt);
    } catch (const BadFile&) {
    }
  }
}

}  // namespace
}  // namespace mckibben::formats
