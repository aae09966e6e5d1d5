// Campaigns that draw their rigs: one NetCDF file, the same whatever threads and ranks, whole after an
// interruption, in memory that does not grow.
#include <cstdlib>
#include <regex>
#include <string>

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <sim/input/fields_json.hpp>

#include "program.hpp"

namespace mckibben::cli {
namespace {

namespace fs = std::filesystem;

std::string ensemble_of(int repeats, const std::string& vary) {
  return "schema: mckibben-campaign/1\nloads: [11.138 kg]\nnoise: {encoder_jitter: 5e-5}\nseed: 7\n"
         "currents: [{name: sine, duration: 0.24 s, current: {kind: sine_current, low: 0 mA, high: 20 mA, "
         "period: 2.4 s}}]\nrepeats: " +
         std::to_string(repeats) + "\nvary: " + vary + "\n";
}

constexpr const char* usual_vary =
    "{muscle.rest_radius: normal 7.5 mm ± 1 %, friction.scale: uniform 0.8 .. 1.2}";

class EnsembleOf : public InAFolder {
 protected:
  void write(int repeats, const std::string& vary = usual_vary) {
    write_text(scratch / "e.yaml", ensemble_of(repeats, vary));
  }
  std::string netcdf(const std::string& out) { return read_text(scratch / (out + "/ensemble.nc")); }
};

TEST_F(EnsembleOf, WritesOneFileWithDrawsMetricsAndRows) {
  write(150);
  const auto said = run("dataset e.yaml --json");
  ASSERT_EQ(said.status, 0) << said.err;
  const auto document = input::Json::parse(said.out);
  EXPECT_EQ(read_text(scratch / "out/e/ensemble.json"), said.out);
  EXPECT_EQ(document.at("runs"), 150);
  EXPECT_EQ(document.at("campaign").at("vary").at("muscle.rest_radius"), "normal 0.0075 m ± 7.5e-05 m");
  const auto& radius = document.at("numbers").at(3);
  EXPECT_EQ(radius.at("name"), "muscle_rest_radius");
  EXPECT_NEAR(radius.at("mean").get<double>(), 7.5e-3, 2.5e-5);
  EXPECT_GT(document.at("numbers").at(7).at("deviation").get<double>(), 0.0);  // the rigs differ
  EXPECT_FALSE(fs::exists(scratch / "out/e.unfinished"));
  if (std::system("command -v ncdump > /dev/null 2>&1") != 0)
    GTEST_SKIP() << "ncdump (netcdf-bin) is not installed";
  const auto dumped = shell("ncdump -v repeat,contraction_ratio out/e/ensemble.nc", scratch);
  EXPECT_TRUE(holds(dumped.out, "run = 150 ;")) << dumped.out << dumped.err;
  EXPECT_TRUE(holds(dumped.out, "time = 20 ;", "148, 149, 150 ;"));
}

TEST_F(EnsembleOf, TakesNoFormat) {
  write(2);
  const auto said = run("dataset e.yaml --format mat");
  EXPECT_EQ(said.status, 64);
  EXPECT_TRUE(holds(said.err, "--format does not apply to a campaign with `vary`"));
  EXPECT_FALSE(fs::exists(scratch / "out"));
}

TEST_F(EnsembleOf, MayBeOfFewerRunsThanAreWrittenAtOnce) {
  write(5);
  EXPECT_EQ(run("dataset e.yaml").status, 0);
}

TEST_F(EnsembleOf, IsTheSameOnAnyThreadsAndRanks) {
  write(200, "{sampling: latin_hypercube, muscle.rest_radius: normal 7.5 mm ± 1 %}");
  ASSERT_EQ(run("dataset e.yaml --out one --threads 1").status, 0);
  ASSERT_EQ(run("dataset e.yaml --out four --threads 4").status, 0);
  const auto said = shell(
      "export SLURM_JOB_ID=7 SLURM_STEP_ID=1 SLURM_STEP_NUM_TASKS=3\n"
      "for n in 1 2; do SLURM_PROCID=$n \"$M\" dataset e.yaml --out ranks & done\n"
      "SLURM_PROCID=0 \"$M\" dataset e.yaml --out ranks > said; status=$?; wait; exit $status",
      scratch);
  ASSERT_EQ(said.status, 0) << said.err;
  EXPECT_FALSE(netcdf("one").empty());
  EXPECT_EQ(netcdf("one"), netcdf("four"));
  EXPECT_EQ(netcdf("one"), netcdf("ranks"));
  EXPECT_EQ(read_text(scratch / "one/ensemble.json"), read_text(scratch / "ranks/ensemble.json"));
}

TEST_F(EnsembleOf, InterruptedItGoesOnToTheSameFile) {
  write(800);
  ASSERT_EQ(run("dataset e.yaml --out whole --keep summary").status, 0);
  const auto stopped = shell(
      "\"$M\" dataset e.yaml --out parts --keep summary --threads 1 & pid=$!\n"
      "until [ -e parts.unfinished/blocks/2 ] || ! kill -0 $pid; do sleep 0.005; done\n"
      "kill -TERM $pid; wait $pid",
      scratch);
  ASSERT_EQ(stopped.status, 130) << stopped.err;
  std::smatch found;
  ASSERT_TRUE(std::regex_search(stopped.err, found, std::regex("interrupted; (\\d+) of 800 runs are in")))
      << stopped.err;
  const auto said = run("dataset e.yaml --out parts --keep summary");
  ASSERT_EQ(said.status, 0) << said.err;
  EXPECT_TRUE(holds(said.err, found[1].str() + " of 800 runs are there already; going on"));
  EXPECT_EQ(netcdf("whole"), netcdf("parts"));
  EXPECT_EQ(read_text(scratch / "whole/ensemble.json"), read_text(scratch / "parts/ensemble.json"));
}

TEST_F(EnsembleOf, BlocksThatSomebodyChangedAreMadeAgain) {
  write(800);
  ASSERT_EQ(run("dataset e.yaml --out whole --keep summary").status, 0);
  shell(
      "\"$M\" dataset e.yaml --out parts --keep summary --threads 1 & pid=$!\n"
      "until [ -e parts.unfinished/blocks/2 ] || ! kill -0 $pid; do sleep 0.005; done\n"
      "kill -KILL $pid; wait $pid",
      scratch);
  write_text(scratch / "parts.unfinished/blocks/1", "spoilt");
  const auto said = run("dataset e.yaml --out parts --keep summary");
  ASSERT_EQ(said.status, 0) << said.err;
  EXPECT_TRUE(holds(said.err, "block 1 is not as written, and made again"));
  EXPECT_EQ(netcdf("whole"), netcdf("parts"));
}

TEST_F(EnsembleOf, ARigThatCannotBeFailsAloneAndIsNamed) {
  write(100, "{valve.supply_pressure: uniform 4.5 bar .. 8 bar}");  // it must give up to 5 bar
  const auto said = run("dataset e.yaml --keep summary");
  EXPECT_EQ(said.status, 70) << said.err;
  EXPECT_TRUE(holds(said.out, "valve.supply_pressure: must not be below span_pressure"));
  const auto document = input::Json::parse(read_text(scratch / "out/e/ensemble.json"));
  const int failed = document.at("failed");
  EXPECT_GT(failed, 0);
  EXPECT_EQ(document.at("numbers").at(3).at("runs"), 100);  // what was drawn
  EXPECT_EQ(document.at("numbers").at(4).at("runs"), 100 - failed);
}

TEST_F(EnsembleOf, MemoryDoesNotGrowWithTheNumberOfRuns) {
  const auto peak_kB = [&](int repeats) {
    write(repeats);
    const auto said = shell(
        "/usr/bin/env python3 -c 'import os, resource, subprocess, sys\n"
        "subprocess.run(sys.argv[1:], check=True, stdout=subprocess.DEVNULL)\n"
        "print(resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss)' "
        "\"$M\" dataset e.yaml --threads 1 --out grows",
        scratch);
    EXPECT_EQ(said.status, 0) << said.err;
    return std::strtol(said.out.c_str(), nullptr, 10);
  };
  const long few = peak_kB(200), many = peak_kB(6000);
  EXPECT_GT(few, 1000);
  EXPECT_LT(many, few + few / 4);
}

}  // namespace
}  // namespace mckibben::cli
