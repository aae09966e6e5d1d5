// Runs the built program as a user would and collects what it says.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include <gtest/gtest.h>

#include "says.hpp"
#include "scratch.hpp"

namespace mckibben::cli {

struct Said {
  int status = -1;
  std::string out, err;
};

/// Runs `mckibben ARGUMENTS` through the shell, in `folder`.
Said mckibben(const std::string& arguments, const std::filesystem::path& folder);

/// Runs a script of sh in `folder`, in which "$M" is the program; the status is the script's.
Said shell(const std::string& script, const std::filesystem::path& folder);

std::string read_text(const std::filesystem::path& path);
void write_text(const std::filesystem::path& path, const std::string& text);

/// Every file below a folder with its content.
std::map<std::string, std::string> contents(const std::filesystem::path& folder);

/// A scenario that takes no time: one load, one waveform, one second.
inline constexpr const char* quick_scenario =
    "schema: mckibben-scenario/1\n"
    "loads: [11.138 kg, 16.138 kg]\n"
    "duration: 1 s\n"
    "target: {kind: sine, mean: 0.09, amplitude: 0.02, period: 1 s}\n"
    "controllers:\n"
    "  - {kind: sine_current, low: 5 mA, high: 9 mA, period: 1 s}\n"
    "  - {kind: static_inverse, assumed_load: 14 kg}\n"
    "noise: {encoder_jitter: 1e-4}\n";

/// A test with a folder of its own, in which the program runs.
class InAFolder : public testing::Test {
 protected:
  Said run(const std::string& arguments) { return mckibben(arguments, scratch); }
  Scratch scratch;
};
class WithQuickScenario : public InAFolder {
 protected:
  void SetUp() override { write_text(scratch / "quick.yaml", quick_scenario); }
};

/// A campaign that is just enough for a calibration: three sines with each load.
inline std::string campaign_of_sines(const std::string& loads = "[11.138 kg, 14 kg, 18.87 kg, 23.406 kg]") {
  return "schema: mckibben-campaign/1\nloads: " + loads +
         "\ncurrents:\n"
         "  - {duration: 7.2 s, current: {kind: sine_current, low: 0 mA, high: 20 mA, period: 2.4 s}}\n"
         "  - {duration: 10.8 s, current: {kind: sine_current, low: 0 mA, high: 20 mA, period: 3.6 s}}\n"
         "  - {duration: 18 s, current: {kind: sine_current, low: 0 mA, high: 20 mA, period: 6 s}}\n";
}

}  // namespace mckibben::cli
