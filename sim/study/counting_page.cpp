// The page, picture and document of the study of counting.
#include <algorithm>

#include <fmt/format.h>

#include <sim/study/counting.hpp>
#include <sim/study/page.hpp>
#include <sim/study/page_json.hpp>

namespace mckibben::study {
namespace {

using input::Json;

std::vector<std::string> row_of(const std::string& name, const Counted& sums) {
  const auto text = [](const Tally& tally) { return fmt::format("{:.4f}", tally.rms()); };
  return {name, text(sums.truly), text(sums.error), text(sums.rounding), text(sums.lateness)};
}

std::string differences(const std::vector<double>& shown, const std::map<double, Counted>& by_speed,
                        const Counted& all) {
  std::vector<std::vector<std::string>> rows{
      {"nu [mA/s]", "true", "error of the counted", "of that rounding", "of that lateness"}};
  for (const double speed : shown) rows.push_back(row_of(fmt::format("{:.1f}", speed), by_speed.at(speed)));
  rows.push_back(row_of("all speeds", all));
  return table(rows);
}

std::vector<std::string> row_of(const std::string& name, const Errors& errors) {
  std::vector<std::string> row{name};
  for (const Tally& tally : errors) row.push_back(bias_and_spread(tally));
  return row;
}

std::string weighings(const std::vector<double>& shown, const Weighings& weighed) {
  std::vector<std::vector<std::string>> rows{{""}};
  for (const auto name : accelerations) rows[0].push_back(fmt::format("acceleration {}", name));
  for (const auto& [load_kg, errors] : weighed.by_load)
    rows.push_back(row_of(fmt::format("{:g} kg", load_kg), errors));
  for (const double speed : shown)
    rows.push_back(row_of(fmt::format("{:.1f} mA/s", speed), weighed.by_speed.at(speed)));
  rows.push_back(row_of("all rows", weighed.all));
  rows.push_back(row_of("means of whole runs", weighed.runs));
  return table(rows);
}

/// The first whole contraction under the lightest load and the fastest current.
thesis::Figure counting_picture(const Evidence& evidence) {
  const auto& grid = evidence.from_current.grid;
  const double tick_s = evidence.campaign.rig.tick_s;
  thesis::Figure figure;
  figure.title = fmt::format("acceleration in one contraction, {:g} kg, {:.1f} mA/s", grid.loads_kg.front(),
                             grid.speeds_mA_per_s.back());
  figure.x_label = "time [s]";
  figure.y_label = "acceleration [m/s2]";
  figure.columns = {{"time_s", {}},
                    {"true_acceleration_m_per_s2", {}},
                    {"counted_acceleration_m_per_s2", {}},
                    {"true_speed_per_s", {}},
                    {"counted_speed_per_s", {}}};
  const double most_s = 0.5;  // left out within a contraction; between two there is more
  const Row *first = nullptr, *last = nullptr;
  for (const Row& row : evidence.rows) {
    if (row.direction != thesis::Direction::contraction || row.load_kg != grid.loads_kg.front() ||
        row.speed_mA_per_s != grid.speeds_mA_per_s.back())
      continue;
    if (last && (row.run != last->run || static_cast<double>(row.row - last->row) * tick_s > most_s)) break;
    if (!first) first = &row;
    last = &row;
  }
  for (std::size_t k = first ? first->row : 1; last && k <= last->row; ++k) {
    const Row row = look_at(evidence, first->run, k, first->direction, first->speed_mA_per_s);
    const double values[] = {static_cast<double>(k) * tick_s, row.truly.acceleration_m_per_s2,
                             row.counted.acceleration_m_per_s2, row.truly.speed_per_s,
                             row.counted.speed_per_s};
    for (std::size_t c = 0; c < figure.columns.size(); ++c) figure.columns[c].values.push_back(values[c]);
  }
  figure.curves = {{"true", 0, 1}, {"counted", 0, 2, true}};
  return figure;
}

Json json_of(const Counted& sums) {
  return {{"true_rms", sums.truly.rms()},
          {"error_rms", sums.error.rms()},
          {"rounding_rms", sums.rounding.rms()},
          {"lateness_rms", sums.lateness.rms()}};
}

Json json_of(const Errors& errors) {
  Json all;
  for (std::size_t i = 0; i < errors.size(); ++i)
    all[std::string(accelerations[i])] = study::json_of(errors[i]);
  return all;
}

Json json_of(const Weighings& weighed) {
  Json all;
  const auto add = [&](const char* list, const char* key, double value, const Errors& errors) {
    all[list].push_back({{key, value}, {"error_kg", json_of(errors)}});
  };
  for (const auto& [load, errors] : weighed.by_load) add("by_load", "load_kg", load, errors);
  for (const auto& [speed, errors] : weighed.by_speed)
    add("by_speed", "current_speed_mA_per_s", speed, errors);
  all["all_rows"] = json_of(weighed.all);
  all["means_of_runs"] = json_of(weighed.runs);
  return all;
}

Json numbers_of(const Counting& counting) {
  Json all{{"speed_step_per_s", counting.speed_step_per_s},
           {"acceleration_step_per_s2", counting.acceleration_step_per_s2},
           {"speed_per_s", json_of(counting.all_speed_per_s)},
           {"acceleration_m_per_s2", json_of(counting.all_acceleration_m_per_s2)},
           {"load_all_else_true", json_of(counting.alone)},
           {"load_as_the_thesis", json_of(counting.thesiss)}};
  for (const auto& [speed, sums] : counting.speed_per_s)
    all["by_current_speed"].push_back(
        {{"current_speed_mA_per_s", speed},
         {"speed_per_s", json_of(sums)},
         {"acceleration_m_per_s2", json_of(counting.acceleration_m_per_s2.at(speed))}});
  return all;
}

}  // namespace

Study study_counting(const Evidence& evidence) {
  const Counting counting = measure_counting(evidence);
  const auto shown = shown_speeds(evidence.from_current.grid);
  const plant::Rig& rig = evidence.campaign.rig;
  std::string page = heading(evidence, "counting", "Speed and acceleration from counts");
  page += fmt::format(
      "One count more or less in a tick of {:g} ms changes the contraction speed by {:.3f} 1/s and its "
      "acceleration by {:.2f} 1/s2, which is {:.2f} m/s2 of the load. So the picture's dots stand on lines "
      "that far apart.\n\n",
      1e3 * rig.tick_s, counting.speed_step_per_s, counting.acceleration_step_per_s2,
      counting.acceleration_step_m_per_s2);
  const Counted& w = counting.all_speed_per_s;
  page +=
      "## Speed and acceleration\n\nRoot mean squares over the rows that the calibration uses. Rounding is "
      "what whole counts add to the difference of true positions; lateness is what that difference, which is "
      "a mean over the last ticks, differs from the value at the instant.\n\nContraction speed [1/s]:\n\n" +
      differences(shown, counting.speed_per_s, w) + "Acceleration of the load [m/s2]:\n\n" +
      differences(shown, counting.acceleration_m_per_s2, counting.all_acceleration_m_per_s2);
  const auto& by_speed = counting.acceleration_m_per_s2;
  const auto ratio = [&](double speed) {
    return by_speed.at(speed).error.rms() / by_speed.at(speed).truly.rms();
  };
  const double slow = ratio(shown.front()), fast = ratio(shown.back());
  page += fmt::format(
      "The counted speed is wrong by {:.0f} % of the speed itself, the counted acceleration by {:.1f} times "
      "the acceleration itself with the slowest current and {:.1f} times with the fastest. {}\n\n",
      100.0 * w.error.rms() / w.truly.rms(), slow, fast,
      slow > 1.0 && fast < 1.0 ? "So with slow currents it is better left out, with fast ones not."
                               : "What is above 1 is better left out.");
  page +=
      "## The load weighed with it (T 4.31)\n\nError in kg over the rows of contraction, mean +- standard "
      "deviation; each row weighs by itself, as in T 4.31. The last line is over the means of whole runs.\n\n"
      "With true pressure and true friction, so that only the acceleration (and what T 4.31 does not "
      "have: the guide's damping and the wheel's inertia) is left:\n\n" +
      weighings(shown, counting.alone) +
      "As the thesis: pressure from the current, friction calibrated with it and with counted "
      "accelerations:\n\n" +
      weighings(shown, counting.thesiss);
  const Weighings& alone = counting.alone;
  page += fmt::format(
      "With all else true, a single row scatters by {:.2f} kg with counted accelerations, by {:.2f} kg "
      "without any and by {:.2f} kg with the true one. Over a whole run the rounding cancels: its mean is "
      "off by {:+.2f}, {:+.2f} and {:+.2f} kg.\n",
      alone.all[counted].deviation(), alone.all[neglected].deviation(), alone.all[truly].deviation(),
      alone.runs[counted].mean(), alone.runs[neglected].mean(), alone.runs[truly].mean());
  return {"counting", std::move(page), counting_picture(evidence),
          document_of(evidence, "counting", numbers_of(counting))};
}

}  // namespace mckibben::study
