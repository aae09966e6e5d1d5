// How much is read of a file: each limit is said where it is passed, and what a message quotes is short.
#include <string>

#include <gtest/gtest.h>

#include <sim/input/json_file.hpp>
#include <sim/input/limits.hpp>
#include <sim/input/quantity.hpp>
#include <sim/input/readers.hpp>
#include <sim/input/yaml_file.hpp>

namespace mckibben::input {
namespace {

/// The first problem as LINE:COL: MESSAGE.
std::string first_of(const std::vector<Problem>& problems) {
  if (problems.empty()) return "accepted";
  const Problem& first = problems.front();
  return std::to_string(first.place.line) + ":" + std::to_string(first.place.column) + ": " + first.message;
}

std::string of_csv(const std::string& text) {
  const Source source("a.csv", text, "");
  const std::string_view required[] = {"time_s"};
  Problems problems;
  {
    TableProblems found(source, problems);
    read_table(source, required, {}, found);
  }
  return first_of(problems.sorted());
}

std::string of_lvm(const std::string& text) {
  const Source source("a.lvm", text, "");
  const WantedColumn wanted[] = {{"time_s", "", true}};
  Problems problems;
  {
    TableProblems found(source, problems);
    read_lvm(source, wanted, 0, found);
  }
  return first_of(problems.sorted());
}

std::string of_yaml(const std::string& text) {
  try {
    parse_yaml(Source("a.yaml", text, ""));
  } catch (const BadInput& bad) {
    return first_of(bad.problems());
  }
  return "accepted";
}

std::string of_json(const std::string& text) {
  try {
    read_json(Source("run.json", text, ""));
  } catch (const BadInput& bad) {
    return first_of(bad.problems());
  }
  return "accepted";
}

TEST(Limits, OfTables) {
  const std::string line(longest_line_bytes + 1, ','), head = "LabVIEW Measurement\n";
  EXPECT_EQ(of_csv(line), "1:1: this line has 1048577 bytes; at most 1048576 are read");
  EXPECT_EQ(of_csv("time_s\n" + line), "2:1: this line has 1048577 bytes; at most 1048576 are read");
  EXPECT_EQ(of_lvm(head + line), "2:1: this line has 1048577 bytes; at most 1048576 are read");
  const std::string columns(most_columns, ',');
  EXPECT_EQ(of_csv("time_s" + columns), "1:1: there are 10001 columns; at most 10000 are read");
  EXPECT_EQ(of_lvm(head + "***End_of_Header***\n" + std::string(most_columns, '\t') + "I\n1\n"),
            "3:1: there are 10001 columns; at most 10000 are read");
  EXPECT_EQ(of_csv(std::string(most_rows + 1, '\n')), "4000001:1: more than 4000000 rows");
}

TEST(Limits, OfYaml) {
  EXPECT_EQ(of_yaml("a: " + std::string(longest_line_bytes, '[')),
            "1:1: this line has 1048579 bytes; at most 1048576 are read");
  EXPECT_EQ(of_yaml("a: \"x\\u001b[2J\"\n"), "1:4: control characters are not accepted");
}

TEST(Limits, OfJson) {
  EXPECT_EQ(of_json("{\"a\":\n [1, 1e999]}"), "2:6: 1e999 is too large for a number");
  EXPECT_EQ(of_json("{\"a\":\n [1, x]}"), "2:6: is not JSON from here on; it was changed or cut off");
  EXPECT_EQ(of_json(std::string("\n").append(100, '[')), "2:65: nested deeper than 64 levels");
  EXPECT_EQ(of_json("[ ]"), "accepted");
}

TEST(Limits, OfWhatIsQuoted) {
  const std::string much(8'000'000, 'x');
  EXPECT_LT(unit_problem(much, "m").size(), 200u);
  try {
    read_quantity("5 " + much, "m");
    FAIL();
  } catch (const BadQuantity& bad) {
    EXPECT_LT(std::string(bad.what()).size(), 200u);
  }
  const std::string word(1'000'000, 'x');
  for (const std::string& said :
       {of_yaml("a: *" + word), of_yaml("a: &" + word + " 1"), of_yaml("a: !" + word + " 1"),
        of_yaml(word + ": 1\n" + word + ": 1\n"), of_csv(word + "\n"), of_csv("time_s\n" + word)})
    EXPECT_LT(said.size(), 300u);
}

// Takes long and much where each value is watched; the name keeps it out of the build with sanitizers.
TEST(Memory, OfManyValues) {
  std::string many = "[0";
  for (std::size_t i = 0; i < most_json_values; ++i) many += ",0";
  EXPECT_NE(of_json(many + "]").find("more than 1000000 values"), std::string::npos);
  std::string list = "a:\n";
  for (std::size_t i = 0; i < most_yaml_values; ++i) list += "- 1\n";
  EXPECT_NE(of_yaml(list).find("more than 500000 keys and values"), std::string::npos);
}

}  // namespace
}  // namespace mckibben::input
