// Every file in tests/bad must be refused with exactly the problems that its first comment lines announce:
// `# expect: [FILE:]LINE:COL: part of the message`. A further bad file is just one more file there.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <sim/input/calibration_file.hpp>
#include <sim/input/campaign_file.hpp>
#include <sim/input/dataset_file.hpp>
#include <sim/input/hypothesis_file.hpp>
#include <sim/input/rigs.hpp>
#include <sim/input/scenario_file.hpp>

namespace mckibben::input {
namespace {

namespace fs = std::filesystem;

const fs::path folder = fs::path(MCKIBBEN_SOURCE_DIR) / "tests/bad";

std::vector<fs::path> bad_files() {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == ".yaml") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

/// What reading the file says; the file's name tells what it is.
std::string said_about(const fs::path& file) {
  std::vector<InputFile> inputs;
  try {
    std::vector<Problem> warnings;
    const std::string name = file.filename().string();
    if (name.starts_with("rig_"))
      read_rig(file.string(), inputs);
    else if (name.starts_with("dataset_"))
      read_dataset(file);
    else if (name.starts_with("calibration_"))
      read_calibration(file, inputs);
    else if (name.starts_with("campaign_"))
      read_campaign(file);
    else if (name.starts_with("hypothesis_"))
      read_hypothesis(file.string(), inputs);
    else
      read_scenario(file, warnings);
  } catch (const BadInput& error) {
    return error.what();
  } catch (const MissingInput& error) {
    return error.what();
  }
  return "";
}

std::vector<std::string> expected_in(const fs::path& file) {
  static const std::regex form("# expect: (.*\\.\\w+:)?(\\d+:\\d+: .*)");
  std::vector<std::string> expected;
  std::ifstream stream(file);
  std::smatch parts;
  for (std::string line; std::getline(stream, line) && std::regex_match(line, parts, form);)
    expected.push_back((parts[1].matched ? parts[1].str() : file.filename().string() + ":") + parts[2].str());
  return expected;
}

/// `FILE:LINE:COL: message` of each problem in a text, the file without its folder.
std::vector<std::string> problems_in(const std::string& text) {
  static const std::regex form("(.*/)?([^/:]+:\\d+:\\d+: )error: (.*)");
  std::vector<std::string> problems;
  std::istringstream stream(text);
  std::smatch parts;
  for (std::string line; std::getline(stream, line);)
    if (std::regex_match(line, parts, form)) problems.push_back(parts[2].str() + parts[3].str());
  return problems;
}

/// Messages name other files by their path; the announcement does so from this folder.
std::string without_folder(std::string text) {
  const std::string prefix = folder.string() + "/";
  for (std::size_t at; (at = text.find(prefix)) != std::string::npos;) text.erase(at, prefix.size());
  return text;
}

void expect_announced(const fs::path& file) {
  SCOPED_TRACE(file.filename().string());
  const std::vector<std::string> expected = expected_in(file);
  const std::vector<std::string> problems = problems_in(without_folder(said_about(file)));
  EXPECT_FALSE(expected.empty()) << "no `# expect:` line";
  for (const std::string& problem : problems)
    EXPECT_TRUE(std::any_of(expected.begin(), expected.end(),
                            [&](const std::string& part) { return problem.starts_with(part); }))
        << "not announced: " << problem;
  for (const std::string& part : expected)
    EXPECT_TRUE(std::any_of(problems.begin(), problems.end(),
                            [&](const std::string& problem) { return problem.starts_with(part); }))
        << "not reported: " << part;
  EXPECT_EQ(problems.size(), expected.size());
}

// One test for all files, so that a file is tested from the moment it is put there.
TEST(BadFiles, AreRefusedWithExactlyTheExpectedProblems) {
  const std::vector<fs::path> files = bad_files();
  EXPECT_GE(files.size(), 100u);
  for (const fs::path& file : files) expect_announced(file);
}

}  // namespace
}  // namespace mckibben::input
