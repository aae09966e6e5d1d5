// See the header.
#include <utility>

#include <sim/data/examine.hpp>
#include <sim/diagnose/predict.hpp>
#include <sim/identify/usable.hpp>
#include <sim/run/batch.hpp>

namespace mckibben::identify {

Usable usable(domain::Dataset& data, unsigned threads) {
  std::vector<data::Expected> expected(data.runs.size());
  run::for_each_job(
      data.runs.size(), threads,
      [&](std::size_t i) {
        const diagnose::Loaded loaded{data.rig, data.runs[i].load_kg};
        expected[i] =
            std::move(diagnose::predict(data.runs[i], {&loaded, 1}, data.rig.integrator.method).front());
      },
      [](std::size_t) {});
  data::Examined examined = data::examine(data, expected);
  std::vector<char> doubted(data.runs.size(), 0);  // for its load alone
  for (const data::Finding& finding : examined.findings)
    if (finding.quantity == "load")
      for (const std::size_t run : finding.runs) doubted[run] = 1;
  std::erase_if(examined.findings, [](const data::Finding& one) { return one.quantity == "load"; });
  data::raise(data, examined.findings);
  for (const std::size_t run : examined.dead_gauges) data.runs[run].muscle_pressure_Pa.reset();
  for (const std::size_t run : examined.dead_opposite_gauges) data.runs[run].opposite_pressure_Pa.reset();
  Usable result{std::move(examined.masked), {}};
  for (std::size_t run = 0; run < data.runs.size(); ++run)
    if (!examined.left_out[run] || doubted[run] != 0) result.runs.push_back(run);
  return result;
}

}  // namespace mckibben::identify
