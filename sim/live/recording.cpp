// dataset.yaml, rig.yaml, a CSV for each run, and the truth; see the header.
#include <utility>

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

std::string measured_csv(const Recording& run) {
  const bool gauge = run.rig.gauge.fitted;
  std::string csv =
      fmt::format("time_s,current_mA,contraction_ratio,counts{}\n", gauge ? ",muscle_pressure_bar" : "");
  for (std::size_t k = 0; k < run.rows.size(); ++k) {
    const Sample& row = run.rows[k];
    csv += fmt::format("{},{},{},{}", row_time_s(run, k), row.current_mA, row.read_ratio, row.counts);
    csv += gauge ? fmt::format(",{}\n", row.shown_Pa / plant::Pa_per_bar) : "\n";
  }
  return csv;
}

std::string true_csv(const Recording& run) {
  std::string csv =
      "time_s,current_mA,contraction_ratio,valve_pressure_bar,muscle_pressure_bar,braid_force_N,"
      "friction_force_N,effects_pull_N\n";
  for (std::size_t k = 0; k < run.rows.size(); ++k) {
    const Sample& row = run.rows[k];
    csv += fmt::format("{},{},{},{},{},{},{},{}\n", row_time_s(run, k), row.current_mA, row.contraction_ratio,
                       row.valve_Pa / plant::Pa_per_bar, row.muscle_Pa / plant::Pa_per_bar, row.braid_N,
                       row.friction_N, row.effects_N);
  }
  return csv;
}

/// Everything but the rig itself.
std::string rig_text(const domain::RigFile& rig) {
  return input::to_yaml(input::rig_json(rig));
}

Json runs_json(const std::vector<Recording>& runs) {
  Json list = Json::array();
  for (std::size_t i = 0; i < runs.size(); ++i)
    list.push_back({{"id", id_of(i)},
                    {"file", id_of(i) + ".csv"},
                    {"load", domain::write_number(runs[i].load_kg) + " kg"}});
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
  dataset["runs"] = runs_json(runs_);
  data.write("dataset.yaml", input::to_yaml(dataset));
  data.write("rig.yaml", rig_text(plant::nominal(first.rig)));
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
