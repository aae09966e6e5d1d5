// See the header.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <sim/data/amount.hpp>
#include <sim/data/parts.hpp>
#include <sim/diagnose/catalogue.hpp>
#include <sim/diagnose/remarks.hpp>

namespace mckibben::diagnose {

std::vector<std::string> noise_in_words(const domain::Dataset& data, const NoiseFloor& floor) {
  if (floor.repeats >= floor.judged)
    return {
        fmt::format("equal runs differ by {} (rms over sqrt 2), more than a count and its jitter explain: "
                    "this is taken for the noise floor",
                    data::amount_of(data.judged(), floor.repeats, data.rig))};
  if (floor.noisy)
    return {
        fmt::format("the {} scatters by {} from tick to tick (rms), far more than counts "
                    "do: this is taken for the noise floor",
                    plant::name_of(data.judged()), data::amount_of(data.judged(), floor.jitter, data.rig))};
  return {};
}

std::vector<std::string> sheets_in_words(const domain::Dataset& data, const NoiseFloor& floor) {
  std::vector<std::string> words;
  if (floor.command > 0.0)
    words.push_back(fmt::format(
        "the regulator repeats a pressure within {:.2g} mbar; what that does to what was read, {} (rms), "
        "counts "
        "in the noise floor",
        1e-2 * data.rig.valve.repeatability_Pa, data::amount_of(data.judged(), floor.command, data.rig)));
  if (floor.accuracy > 0.0)
    words.push_back(fmt::format("the sensor's accuracy, {}, counts in the noise floor",
                                data::amount_of(data.judged(), floor.accuracy, data.rig)));
  return words;
}

std::vector<std::string> rows_in_words(const domain::Dataset& data, const NoiseFloor& floor) {
  std::vector<std::string> words;
  if (!data.rows_of_stamps) return words;
  const domain::Rows& rows = *data.rows_of_stamps;
  if (rows.rows < rows.stamps)
    words.push_back(fmt::format(
        "of {} stamps {} rows were compared{}, {:.3g} ms apart{}; the inputs were followed at {} "
        "stamps, with all at which they jump or bend",
        rows.stamps, rows.rows,
        data.recorded.skip_s > 0.0
            ? fmt::format(" (none in the first {:g} s of a run: skip)", data.recorded.skip_s)
            : "",
        1e3 * rows.row_s,
        rows.readings < 2.0 ? "" : fmt::format(", each of {:.0f} readings on average", rows.readings),
        rows.inputs));
  if (rows.given_noise_Pa > 0.0)
    words.push_back(
        fmt::format("the noise of the given pressure, {:.2g} mbar, was smoothed; what is left of it in the "
                    "{}, {}, counts in "
                    "the noise floor",
                    1e-2 * rows.given_noise_Pa, plant::name_of(data.judged()),
                    data::amount_of(data.judged(), floor.given, data.rig)));
  if (rows.slack > 0)
    words.push_back(
        fmt::format("{} readings of force are 0, a slack cord: they do not show how far the muscle is from "
                    "pulling, and are not used",
                    rows.slack));
  if (rows.at_the_end > 0)
    words.push_back(fmt::format(
        "{} readings of force are at the end of the load cell's range and are not used", rows.at_the_end));
  if (data.force_is_judged())
    words.push_back(
        "the muscle's length is the input: what acts on the load, on its guide or on the encoder is out of "
        "sight, "
        "and runs are not looked through for faults of a recorder");
  if (data.judged() == Judged::pressure)
    words.push_back(
        "only pressures were read: what acts on the load, and how the muscle pulls, are all but out of "
        "sight");
  const bool pair = data.rig.pair() != nullptr;
  if (pair)
    words.push_back(
        "two muscles turn the joint: effects are looked for on both alike and on each; runs are not looked "
        "through for faults of a recorder, and a load's guide there is none");
  if (data.rig.lever() != nullptr)
    words.push_back("the angle of a lever is read: runs are not looked through for faults of a recorder");
  std::vector<std::string> out;
  if (data.pressure_is_given())
    out.push_back(fmt::format("the muscle{} the input: valve, supply, hose and gas are out of sight",
                              pair ? "s' pressures are" : "'s pressure is"));
  if (data.valve_pressure_is_given())
    out.emplace_back("the valve's pressure is the input: valve and supply are out of sight");
  if (data::are_settled_points(data)) out.emplace_back("points at rest show neither speeds nor times");
  if (!out.empty())
    words.push_back(fmt::format("{}, and with them {}", fmt::join(out, "; "),
                                fmt::join(effects_out_of_sight(data), ", ")));
  return words;
}

}  // namespace mckibben::diagnose
