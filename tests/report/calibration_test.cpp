// The page of a calibration says which models are good before it shows a figure.
#include <string>

#include <gtest/gtest.h>

#include <sim/report/report.hpp>

namespace mckibben::report {
namespace {

thesis::Figure figure(const char* number) {
  return {number, "a title", "x", "y", {{"x", {0.0, 1.0}}, {"y", {0.0, 1.0}}}, {{"curve", 0, 1}}};
}

TEST(CalibrationPage, SaysWhichModelsAreGoodAndKeepsTheFiguresBehindTheirMeaning) {
  thesis::CalibrationResult result;
  result.grid.loads_kg = {11.0, 23.0};
  result.grid.speeds_mA_per_s = {5.0, 10.0};
  result.friction[0].mean = result.friction[1].mean = 0.02;
  result.friction[0].standard_deviation = 0.001;
  result.friction[1].standard_deviation = 0.03;
  result.pressure[0].mean_Pa = result.pressure[1].mean_Pa = 1e5;
  result.pressure[0].deviation.joint = 3e4;
  result.pressure[1].deviation.joint = 1e3;
  const std::string html =
      report_html(domain::Dataset{}, result, {}, false, {figure("4.2"), figure("4.18"), figure("4.49")});
  std::size_t at = 0;
  for (const char* part :
       {"Good: friction in contraction (5.0 %), pressure in relaxation (1.0 %).",
        "Rough: pressure in contraction (30.0 %).", "Not usable: friction in relaxation (above 100 %)",
        "<td>below 10 %</td>", "Warning:", "What each figure shows",
        "<h3>Friction coefficient, as calibrated", "<details><summary>1 figure</summary>", "Figure 4.18",
        "Pressure coefficients against load", "Figure 4.49", "not used", "Figure 4.2"}) {
    at = html.find(part, at);
    ASSERT_NE(at, std::string::npos) << part;
  }
  EXPECT_EQ(html.find("Pressure of one load"), std::string::npos);  // no such figure
  EXPECT_EQ(html.find("Lengths in"), std::string::npos);            // nor lengths
}

}  // namespace
}  // namespace mckibben::report
