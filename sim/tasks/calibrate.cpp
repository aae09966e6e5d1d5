// See the header.
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include <sim/data/judged.hpp>
#include <sim/input/dataset_file.hpp>
#include <sim/tasks/calibrate.hpp>
#include <sim/thesis/processing.hpp>

namespace mckibben::tasks {

domain::Dataset ticked(domain::Dataset data, const std::function<void(const std::string&)>& say) {
  if (!data.own_clock || !input::why_unfit(domain::Purpose::calibration, data).empty()) {
    input::require_ticks(data, "calibrate");
    return data;
  }
  data = data::with_rows(std::move(data));
  data.rig.tick_s = data.row_s();
  constexpr double uneven = 0.1;  // of a row
  for (const domain::Run& run : data.runs)
    for (std::size_t k = 1; k < run.time_s.size(); ++k)
      if (const double step_s = run.time_s[k] - run.time_s[k - 1];
          std::abs(step_s - data.row_s()) > uneven * data.row_s())
        thesis::refuse(data, fmt::format("calibrate cannot take it: stamps of run {} are {:.6g} ms apart at "
                                         "{:.6g} s, others {:.6g} ms, and too few to make even rows of them",
                                         run.id, 1e3 * step_s, run.time_s[k], 1e3 * data.row_s()));
  say(fmt::format("rows {:.6g} ms apart are made of the stamps", 1e3 * data.row_s()));
  return data;
}

}  // namespace mckibben::tasks
