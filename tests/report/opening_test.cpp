// What the page of a diagnosis opens with: which run, which lines, what is marked on the rig.
#include <string>
#include <tuple>

#include <gtest/gtest.h>

#include <plant/effects.hpp>
#include <sim/diagnose/priors.hpp>
#include <sim/report/opening.hpp>
#include <sim/report/report.hpp>
#include <sim/report/rig_parts.hpp>

#include "count.hpp"
#include "diagnosed.hpp"
#include "says.hpp"

namespace mckibben::report {
namespace {

using output::diagnosed;

domain::Dataset measured_as(const diagnose::Diagnosis& found) {
  domain::Dataset data = output::measured();
  for (std::size_t i = 0; i < data.runs.size(); ++i) {
    data.runs[i].read("contraction", found.runs[i].measured);
    data.runs[i].current_mA.assign(found.runs[i].measured.size(), 15.0);
  }
  return data;
}

/// The opening of the page: up to its table.
std::string opening(const diagnose::Diagnosis& found) {
  const std::string html = report_html(measured_as(found), found, {}, {});
  const auto at = html.find("<figure class='opening'>");
  return at == html.npos ? "" : html.substr(at, html.find("</figure>", at) - at);
}

TEST(Opening, IsOfTheUnseenRunWhoseErrorShrankMost) {
  diagnose::Diagnosis found = diagnosed();
  EXPECT_EQ(telling_run(found)->id, "r06");  // the heavier of the two
  found.runs[4].nominal_rmse = 0.02;
  EXPECT_EQ(telling_run(found)->id, "r05");
  found.runs[0].nominal_rmse = 0.05;  // a fit has seen it
  EXPECT_EQ(telling_run(found)->id, "r05");
  found.runs[4].corrected_rmse = 0.02;
  EXPECT_EQ(telling_run(found)->id, "r06");
  found.runs[5].left_out = true;
  EXPECT_EQ(telling_run(found)->id, "r05");
  found.runs.clear();
  EXPECT_EQ(telling_run(found), nullptr);
  EXPECT_TRUE(lacks(opening(diagnosed()), "r05"));
  EXPECT_TRUE(holds(opening(diagnosed()), "<figcaption>r06, 18.87 kg, held out."));
}

TEST(Opening, ShowsMeasuredBeforeAndAfterButNotBetween) {
  const std::string html = opening(diagnosed());
  EXPECT_EQ(count(html, "<svg role='img'"), 2u);
  EXPECT_EQ(count(html, "<path class='given' d='M0 5"), 1u);           // in the key
  EXPECT_EQ(count(html, "<path class='given' d='"), 3u);               // over time, and as a loop
  EXPECT_EQ(count(html, "<path class='run c1 d1' data-run='1'"), 3u);  // and its error
  EXPECT_EQ(count(html, "<path class='run c0 d0' data-run='0'"), 3u);
  EXPECT_TRUE(lacks(html, "recalibrated"));
}

TEST(Opening, IsAFileOfItsOwnWithItsStyleInside) {
  diagnose::Diagnosis found = diagnosed();
  const std::string svg = before_after_svg(measured_as(found), found, {}, {});
  EXPECT_TRUE(svg.starts_with("<svg xmlns='http://www.w3.org/2000/svg'"));
  EXPECT_EQ(count(svg, "class='run c1 d1'"), 4u);  // the key, over time, the error, the loop
  EXPECT_EQ(count(svg, "class='run c0 d0'"), 4u);
  EXPECT_TRUE(holds(svg, "<style>", ".c1 { color: #d55e00; }", ">measured<", ">corrected<", ">1 muscle_leak<",
                    "<text x='14.0' y='24.0'>r06, 18.87 kg, held out."));
  EXPECT_TRUE(lacks(svg, "var("));  // drawing programs know no variables
  found.runs.clear();
  EXPECT_EQ(before_after_svg(measured_as(found), found, {}, {}), "");
}

TEST(Opening, TheBandIsAsHighAsTheNoiseFloorOnEachSide) {
  diagnose::Diagnosis found = diagnosed();
  const auto band_px = [&] {
    const std::string html = opening(found);
    const auto at = html.find("height='", html.find("class='band'")) + 8;
    return std::stod(html.substr(at));
  };
  // Errors from about -0.012 to a little above 0 over 118 px, widened.
  found.gap.noise_floor = 1e-3;
  const double one = band_px();
  EXPECT_GT(one, 12.0);
  EXPECT_LT(one, 20.0);
  found.gap.noise_floor = 5e-4;
  EXPECT_NEAR(band_px(), 0.5 * one, 1.0);
}

TEST(Opening, MarksWhatWasAddedWithItsSize) {
  diagnose::Diagnosis found = diagnosed();
  const std::string html = opening(found);
  EXPECT_EQ(count(html, "class='mark c0'"), 3u);  // leak, dead band, law
  EXPECT_TRUE(holds(html, "<circle class='mark c0' cx='64' cy='38'", ">1 muscle_leak<", ">0.619 l/(min bar)<",
                    "<circle class='mark c0' cx='46' cy='118'", ">2 valve_dead_band<", ">3 a law of force<"));
  EXPECT_EQ(count(html, "class='without'"), 1u);
  found.stand_ins = found.effects;
  EXPECT_TRUE(holds(opening(found), ">and 2 more<"));
}

TEST(Opening, WithoutEffectsMarksNumbersThatMovedAndElseNothing) {
  diagnose::Diagnosis found = diagnosed();
  found.effects.clear();
  found.residual_law.clear();
  EXPECT_TRUE(holds(opening(found), ">1 muscle.rest_radius<"));
  EXPECT_EQ(count(opening(found), "class='mark c0'"), 1u);  // the others moved less than is promised
  found.recalibrated.clear();
  EXPECT_EQ(count(opening(found), "class='mark c0'"), 0u);
  EXPECT_TRUE(lacks(opening(found), "class='without'"));
}

TEST(Opening, OfTwoMusclesNamesWhatWasFoundWithoutADrawing) {
  diagnose::Diagnosis found = diagnosed();
  found.gap.judged = diagnose::Judged::angle;
  domain::Dataset data = output::measured();
  data.rig = plant::thesis_pair();
  const std::string html = report_html(data, found, {}, {});
  EXPECT_TRUE(holds(html, "<figure class='opening'>", ">1 muscle_leak<"));
  EXPECT_TRUE(lacks(html, "class='mark c0' cx=", "class='without'"));
}

TEST(RigParts, EveryEffectAndEveryNumberHasAPlace) {
  const auto check = [](std::string_view name) { EXPECT_TRUE(part_of(name)) << name; };
  std::apply([&](const auto&... effect) { (check(effect.name), ...); }, plant::Effects::Table{});
  for (const auto& number : diagnose::nominal_parameters({}))
    EXPECT_TRUE(part_of(number.path)) << number.path;
  EXPECT_EQ(part_of("effects.muscle_leak.conductance"), Part::muscle);
  EXPECT_EQ(part_of("hose.conductance"), Part::hose);
  EXPECT_EQ(part_of("my_law"), std::nullopt);
}

TEST(RigParts, TwoMarksOfOnePartStandBesideEachOther) {
  const std::string svg = rig_drawing({Part::valve, Part::valve}, false);
  EXPECT_EQ(count(svg, "cx='46' cy='118'"), 1u);
  EXPECT_EQ(count(svg, "cx='66' cy='118'"), 1u);
  EXPECT_LT(svg.size(), rig_drawing({Part::valve, Part::valve}, true).size());  // a gauge is drawn
}

TEST(DiagnosisPage, PrintsItsStoryAndLeavesTheRestToTheScreen) {
  domain::Dataset data = output::measured();
  const std::string html = report_html(data, diagnosed(), {}, {});
  for (const char* chapter : {"Where they disagree", "What explains it", "What else it could be"})
    EXPECT_TRUE(holds(html, "<section class='on-screen'><h2>" + std::string(chapter))) << chapter;
  for (const char* chapter : {"What was added", "How far the gap shrank", "What to measure next"})
    EXPECT_TRUE(holds(html, "<section><h2>" + std::string(chapter))) << chapter;
  EXPECT_TRUE(holds(html, "<section class='on-screen'><h2 id='runs'>"));
  EXPECT_EQ(count(html, "<section"), count(html, "</section>"));
}

TEST(Opening, OfValvesThatAreOpenOrShutAsksForNoPressure) {
  diagnose::Diagnosis found = diagnosed();
  domain::Dataset data = measured_as(found);
  for (plant::Rig* const rig : {&data.rig, &found.corrected}) rig->valve.kind = plant::ValveKind::on_off;
  const std::string html = report_html(data, found, {}, {});
  EXPECT_TRUE(lacks(html, "commanded pressure", "\"reference_pressure\":{", "a slow loop without it"));
}

}  // namespace
}  // namespace mckibben::report
