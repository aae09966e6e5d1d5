// See the header.
#include <utility>

#include <sim/data/examine.hpp>
#include <sim/diagnose/predict.hpp>
#include <sim/identify/usable.hpp>
#include <sim/run/batch.hpp>

namespace mckibben::identify {
namespace {

std::vector<data::Expected> expected_of(const domain::Dataset& data, unsigned threads) {
  std::vector<data::Expected> expected(data.runs.size());
  run::for_each_job(
      data.runs.size(), threads,
      [&](std::size_t i) {
        const diagnose::Loaded loaded{data.rig, data.runs[i].load_kg};
        expected[i] =
            std::move(diagnose::predict(data.runs[i], {&loaded, 1}, data.rig.integrator.method).front());
      },
      [](std::size_t) {});
  return expected;
}

/// As a warning, and as a fault of its runs where it is one.
void report(const domain::Dataset& data, const data::Finding& finding, Usable& result) {
  const std::string_view consequence = data::consequence_of(finding);
  result.warnings.push_back(data::text_of(data, finding).append(consequence));
  if (finding.kind.empty()) return;
  const bool left_out = finding.severity == data::Severity::left_out;
  for (const std::size_t run : finding.runs)
    result.faulty.push_back(
        {.run = data.runs[run].id,
         .kind = finding.kind,
         .action = left_out ? "left out" : "masked",
         .words = left_out ? "left out, " + finding.message : finding.message + std::string(consequence)});
}

}  // namespace

Usable usable(domain::Dataset& data, unsigned threads) {
  data::Examined examined = data::examine(data, expected_of(data, threads));
  std::vector<bool> left_out = examined.left_out;
  for (const data::Finding& finding : examined.findings)
    if (finding.quantity == "load")
      for (const std::size_t run : finding.runs) left_out[run] = false;  // doubted for its load alone
  std::erase_if(examined.findings, [](const data::Finding& one) { return one.quantity == "load"; });
  data::raise(data, examined.findings);
  for (const auto& [run, channel] : examined.dead_gauges)
    std::erase_if(data.runs[run].readings,
                  [&](const domain::Reading& reading) { return reading.channel == channel; });
  Usable result{.masked = std::move(examined.masked), .runs = {}};
  data::require_enough(data, left_out, examined.findings);
  data::raise_for_diagnosis(data, examined.findings);
  for (const data::Finding& finding : examined.findings)
    if (finding.severity == data::Severity::undecidable)
      result.cannot_tell = finding.message;
    else
      report(data, finding, result);
  for (std::size_t run = 0; run < data.runs.size(); ++run)
    if (!left_out[run]) result.runs.push_back(run);
  return result;
}

}  // namespace mckibben::identify
