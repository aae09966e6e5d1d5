// MAT-files and NetCDF files from the inside: round trip, refusals, damage. That other programs read them,
// and that we read theirs, is tested beside this with scipy, ncdump and Octave.
#include <algorithm>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include <sim/formats/mat_file.hpp>
#include <sim/formats/netcdf.hpp>

namespace mckibben::formats {
namespace {

Table table() {
  return {"two rows",
          {{"time_s", "s", "time", {0.0, 0.012}}, {"current_mA", "mA", "current", {4.0, 0.1 + 0.2}}},
          {{"load_kg", 11.138}, {"source", "mckibben"}}};
}

std::string refusal(const std::string& bytes) {
  try {
    read_mat(bytes, {"time_s"});
  } catch (const BadFile& bad) {
    return bad.what();
  }
  return "";
}

TEST(MatFile, ReadsBackWhatItWrote) {
  const std::string bytes = mat_of(table());
  EXPECT_EQ(bytes, mat_of(table()));
  const MatContents read = read_mat(bytes, {"current_mA", "load_kg", "current_mA(:,1)"});
  EXPECT_EQ(read.names, (std::vector<std::string>{"time_s", "current_mA", "load_kg"}));
  ASSERT_EQ(read.found.size(), 3u);
  EXPECT_EQ(read.found[0].values, table().columns[1].values);
  EXPECT_EQ(read.found[1].values, std::vector<double>{11.138});
  EXPECT_EQ(read.found[2].values, table().columns[1].values);
}

TEST(MatFile, SaysWhatIsNotAVector) {
  const std::vector<std::string> wanted{"nothing",       "units",    "title",       "units.time_s",
                                        "units.nothing", "time_s.x", "time_s(:,2)", "time_s(:,x)"};
  const std::vector<std::string> said{
      "there is no variable nothing", "units is a struct",          "title is text",
      "units.time_s is text",         "units has no field nothing", "time_s is not a struct",
      "time_s has 1 columns",         "time_s(:,x) is no column"};
  const MatContents read = read_mat(mat_of(table()), wanted);
  for (std::size_t i = 0; i < wanted.size(); ++i)
    EXPECT_TRUE(read.found[i].problem.starts_with(said[i])) << read.found[i].problem;
}

TEST(MatFile, WhatSimulinkLogsIsReadByItsLabels) {
  std::ostringstream bytes;
  bytes << std::ifstream(MCKIBBEN_TEST_DATA "/structure_with_time.mat", std::ios::binary).rdbuf();
  const MatContents read = read_mat(
      bytes.str(), {"Data.time", "Data.signals(2).values", "Data.signals.values", "Data.signals(3).values"});
  EXPECT_EQ(read.found[0].problem, "");
  EXPECT_EQ(read.found[1].problem, "");
  EXPECT_EQ(read.found[1].values.size(), read.found[0].values.size());
  EXPECT_EQ(read.found[2].problem, "Data.signals is an array of 2 structs; name one: Data.signals(1)");
  EXPECT_TRUE(read.found[3].problem.starts_with("Data.signals")) << read.found[3].problem;
  const auto labelled = std::ranges::find(read.vectors, "Data.signals(1).values", &MatContents::Vector::name);
  ASSERT_NE(labelled, read.vectors.end());
  EXPECT_EQ(labelled->label, "pressure");
}

/// An element of a MAT-file: type, size, content, filled up to eight bytes.
std::string element(std::uint32_t type, std::string content) {
  std::string bytes(8, '\0');
  const auto size = static_cast<std::uint32_t>(content.size());
  std::memcpy(bytes.data(), &type, 4);
  std::memcpy(bytes.data() + 4, &size, 4);
  content.resize((content.size() + 7) / 8 * 8);
  return bytes + content;
}

TEST(MatFile, ObjectsSayWhatToWriteInMatlab) {
  const std::string flags("\x11\0\0\0\0\0\0\0", 8);
  const std::string bytes =
      mat_of(table()) + element(14, element(6, flags) + element(1, "ts") + element(1, "MCOS") +
                                        element(1, "timeseries") + element(14, ""));
  const MatContents read = read_mat(bytes, {"ts.Data", "ts", "time_s"});
  for (const std::size_t i : {0U, 1U})
    EXPECT_NE(read.found[i].problem.find("ts is an object of class timeseries"), std::string::npos)
        << read.found[i].problem;
  EXPECT_NE(read.found[0].problem.find("t = ts.Time; x = squeeze(ts.Data)"), std::string::npos);
  EXPECT_EQ(read.found[2].problem, "");
  ASSERT_EQ(read.objects.size(), 1u);
}

TEST(MatFile, TellsItsRelatives) {
  const std::string whole = mat_of(table());
  std::string later = "MATLAB 7.3 MAT-file" + whole.substr(19), other = whole;
  other[125] = 3;
  EXPECT_NE(refusal(later).find("save it with -v7"), std::string::npos) << refusal(later);
  EXPECT_NE(refusal("\x89HDF\r\n\x1A\n and more").find("HDF5"), std::string::npos);
  EXPECT_NE(refusal("# Created by Octave 7.3.0").find("save it with -v7"), std::string::npos);
  EXPECT_NE(refusal(other).find("version 0x0300"), std::string::npos) << refusal(other);
  EXPECT_EQ(refusal(""), "the file is empty");
  EXPECT_NE(refusal("time_s,current_mA\n").find("not a MAT-file of level 5"), std::string::npos);
  EXPECT_EQ(refusal(whole.substr(0, 128)), "there are no variables in it");
}

TEST(MatFile, CutOffAnywhereIsNoticed) {
  const std::string whole = mat_of(table());
  for (std::size_t size = 1; size < whole.size(); size += 7)
    EXPECT_NE(refusal(whole.substr(0, size)), "") << size << " bytes";
}

TEST(MatFile, SizesThatCannotBeAreNotBelieved) {
  const std::size_t rows = 128 + 8 + 16 + 8;  // heading, tag, flags, tag of the dimensions
  for (const std::size_t byte : {1, 3}) {     // some thousand numbers, and a billion; two are there
    std::string bytes = mat_of(table());
    ASSERT_EQ(bytes[rows], 2);
    bytes[rows + byte] = 0x3F;
    EXPECT_NE(refusal(bytes).find("its 1. variable: its sizes and contents do not agree"), std::string::npos)
        << refusal(bytes);
  }
}

TEST(MatFile, BigEndianNumbersAreRead) {
  std::string bytes = mat_of(table()).substr(0, 124) + std::string("\1\0MI", 4);
  const auto words = [&bytes](std::initializer_list<unsigned char> low_bytes) {
    for (const unsigned char low : low_bytes) bytes.append(3, '\0') += static_cast<char>(low);
  };
  words({14, 56, 6, 8, 11, 0, 5, 8, 1, 3, 0});  // an array of uint16, 1 x 3
  bytes.replace(bytes.size() - 4, 4, std::string("\0\1\0\1n\0\0\0", 8));
  bytes += std::string("\0\0\0\4\0\0\0\6\1\0\0\2\0\3\0\0", 16);
  EXPECT_EQ(read_mat(bytes, {"n"}).found[0].values, (std::vector<double>{256.0, 2.0, 3.0}));
}

/// A variable of cells, or a struct, that says it has more elements than it holds.
std::string hollow(char kind, std::size_t count) {
  const auto word = [](std::size_t value) {
    std::string bytes;
    for (unsigned shift = 0; shift < 32; shift += 8) bytes += static_cast<char>(value >> shift & 0xFFU);
    return bytes;
  };
  std::string parts = word(6) + word(8) + kind + std::string(7, '\0');  // flags
  parts += word(5) + word(8) + word(1) + word(count);                   // dimensions
  parts += word(1U << 16U | 1U) + "c" + std::string(3, '\0');           // name
  if (kind == 2) parts += word(4U << 16U | 5U) + word(8) + word(1) + word(8) + "x" + std::string(7, '\0');
  return mat_of(table()).substr(0, 128) + word(14) + word(parts.size()) + parts;
}

TEST(MatFile, RoomIsNotMadeForWhatIsOnlySaid) {
  for (const char kind : {'\1', '\2'}) {
    EXPECT_EQ(refusal(hollow(kind, 1U << 30U)),
              "its 1. variable: it has more than 16777216 elements, which is more than is read");
    EXPECT_EQ(refusal(hollow(kind, 1U << 20U)),
              "its 1. variable: its sizes and contents do not agree: the file is damaged");
  }
  EXPECT_EQ(refusal(hollow(1, 0)), "");
}

TEST(NetcdfFile, SameBytesFromManyThreads) {
  const std::string wanted = netcdf_of(table());
  EXPECT_TRUE(wanted.starts_with("\x89HDF"));
  std::vector<std::string> made(4);
  std::vector<std::thread> threads;
  for (std::string& one : made) threads.emplace_back([&one] { one = netcdf_of(table()); });
  for (std::thread& thread : threads) thread.join();
  for (const std::string& one : made) EXPECT_EQ(one, wanted);
}

TEST(NetcdfFile, NamesThatCannotBeAreRefused) {
  Table bad = table();
  bad.columns[1].name = "a/b";
  EXPECT_THROW(netcdf_of(bad), BadFile);
}

}  // namespace
}  // namespace mckibben::formats
