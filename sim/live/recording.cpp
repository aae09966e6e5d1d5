// dataset.yaml, rig.yaml, a CSV for each run, and the truth; see the header.
#include <string_view>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include <plant/instruments.hpp>
#include <sim/domain/number.hpp>
#include <sim/input/fields_json.hpp>
#include <sim/input/rigs.hpp>
#include <sim/input/yaml_writer.hpp>
#include <sim/live/recording.hpp>

namespace mckibben::live {
namespace {

using input::Json;

constexpr const char* unjudged = "1 s";  // of runs that begin on their way

std::string id_of(std::size_t run) {
  return fmt::format("r{:02}", run + 1);
}

/// Times begin with the run.
double row_time_s(const Recording& run, std::size_t row) {
  return static_cast<double>(row) * run.rig.tick_s;
}

/// Under the headings that data sets of pairs are found by; the angle is counted.
std::string measured_csv_of_pair(const Recording& run) {
  const bool gauge = run.rig.gauge.fitted;
  std::string csv = fmt::format("time_s,current_1_mA,current_2_mA,counts{}\n",
                                gauge ? ",muscle_pressure_1_bar,muscle_pressure_2_bar" : "");
  for (std::size_t k = 0; k < run.rows.size(); ++k) {
    const Sample& row = run.rows[k];
    csv +=
        fmt::format("{},{},{},{}", row_time_s(run, k), row.current_mA, row.opposite.current_mA, row.counts);
    csv += gauge ? fmt::format(",{},{}\n", row.shown_Pa / plant::Pa_per_bar,
                               row.opposite.shown_Pa / plant::Pa_per_bar)
                 : "\n";
  }
  return csv;
}

std::string measured_csv(const Recording& run) {
  if (run.rig.pair() != nullptr) return measured_csv_of_pair(run);
  const bool gauge = run.rig.gauge.fitted;
  std::string csv =
      fmt::format("time_s,current_mA,contraction_ratio,counts{}\n", gauge ? ",muscle_pressure_bar" : "");
  for (std::size_t k = 0; k < run.rows.size(); ++k) {
    const Sample& row = run.rows[k];
    csv += fmt::format("{},{},{},{}", row_time_s(run, k), row.current_mA, row.read, row.counts);
    csv += gauge ? fmt::format(",{}\n", row.shown_Pa / plant::Pa_per_bar) : "\n";
  }
  return csv;
}

/// Headings of a muscle, with `number` behind each name; and what stands below them.
std::string true_headings(std::string_view number) {
  return fmt::format(
      ",current{0}_mA,contraction_ratio{0},valve_pressure{0}_bar,muscle_pressure{0}_bar,braid_force{0}_N,"
      "friction_force{0}_N,effects_pull{0}_N",
      number);
}
std::string true_cells(const SideSample& row) {
  return fmt::format(",{},{},{},{},{},{},{}", row.current_mA, row.contraction_ratio,
                     row.valve_Pa / plant::Pa_per_bar, row.muscle_Pa / plant::Pa_per_bar, row.braid_N,
                     row.friction_N, row.effects_N);
}

std::string true_csv(const Recording& run) {
  const bool pair = run.rig.pair() != nullptr;
  std::string csv =
      "time_s" + (pair ? true_headings("_1") + true_headings("_2") + ",angle_rad" : true_headings(""));
  for (std::size_t k = 0; k < run.rows.size(); ++k) {
    const Sample& row = run.rows[k];
    csv += fmt::format("\n{}{}", row_time_s(run, k), true_cells(row));
    if (pair) csv += fmt::format("{},{}", true_cells(row.opposite), row.angle_rad);
  }
  return csv + "\n";
}

/// Everything but the rig itself.
std::string rig_text(const domain::RigFile& rig) {
  return input::to_yaml(input::rig_json(rig));
}

Json runs_json(const std::vector<Recording>& runs) {
  Json list = Json::array();
  for (std::size_t i = 0; i < runs.size(); ++i) {
    list.push_back({{"id", id_of(i)}, {"file", id_of(i) + ".csv"}});
    if (runs[i].rig.pair() == nullptr) list.back()["load"] = domain::write_number(runs[i].load_kg) + " kg";
  }
  return list;
}

}  // namespace

DataSets::DataSets(std::filesystem::path first, std::string session, output::Say say)
    : first_(std::move(first)), session_(std::move(session)), say_(std::move(say)) {}

std::filesystem::path DataSets::folder() const {
  return number_ <= 1 ? first_ : std::filesystem::path(fmt::format("{}-{}", first_.string(), number_));
}

std::filesystem::path DataSets::put(Recording recording) {
  // One start for all of a data set: those that began at rest and those that did not go apart.
  const bool same = !runs_.empty() && runs_.front().settled == recording.settled &&
                    rig_text(runs_.front().rig) == rig_text(recording.rig);
  if (!same) {
    flush();
    runs_.clear();
    ++number_;
  }
  runs_.push_back(std::move(recording));
  written_ = false;
  write();
  return folder();
}

void DataSets::flush() {
  if (!written_) write();
}

void DataSets::write() {
  const Recording& first = runs_.front();
  output::ResultFolder data(folder(), session_, say_);
  output::ResultFolder truth(folder().string() + "-truth", session_, say_);
  Json dataset{{"schema", "mckibben-dataset/1"}, {"rig", "rig.yaml"}};
  if (!first.settled) dataset.update({{"start", "moving"}, {"skip", unjudged}});
  if (first.rig.pair() != nullptr) dataset["columns"]["angle"] = {{"column", "counts"}, {"unit", "count"}};
  dataset["runs"] = runs_json(runs_);
  data.write("dataset.yaml", input::to_yaml(dataset));
  data.write("rig.yaml", rig_text(domain::nominal(first.rig)));
  truth.write("rig.yaml", rig_text(first.rig));
  truth.write("truth.yaml", input::to_yaml({{"schema", "mckibben-truth/1"},
                                            {"rig", input::to_json(first.rig)},
                                            {"runs", runs_json(runs_)}}));
  for (std::size_t i = 0; i < runs_.size(); ++i) {
    data.write(id_of(i) + ".csv", measured_csv(runs_[i]));
    truth.write(id_of(i) + ".csv", true_csv(runs_[i]));
  }
  truth.publish();
  data.publish();
  written_ = true;
}

}  // namespace mckibben::live
