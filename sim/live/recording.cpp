// dataset.yaml, rig.yaml, a CSV for each run, and the truth; see the header.
#include <utility>

#include <fmt/format.h>

#include <sim/domain/number.hpp>
#include <sim/input/fields_json.hpp>
#include <sim/input/rigs.hpp>
#include <sim/input/yaml_writer.hpp>
#include <sim/live/recording.hpp>
#include <sim/output/campaign_json.hpp>
#include <sim/output/run_files.hpp>

namespace mckibben::live {
namespace {

using input::Json;

constexpr const char* unjudged = "1 s";  // of runs that begin on their way

std::string id_of(std::size_t run) {
  return fmt::format("r{:02}", run + 1);
}

/// Everything but the rig itself.
std::string rig_text(const plant::Rig& rig) {
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
  if (Json columns = output::columns_json(first.rig); !columns.empty())
    dataset["columns"] = std::move(columns);
  dataset["runs"] = runs_json(runs_);
  data.write("dataset.yaml", input::to_yaml(dataset));
  data.write("rig.yaml", rig_text(plant::nominal(first.rig)));
  truth.write("rig.yaml", rig_text(first.rig));
  truth.write("truth.yaml", input::to_yaml({{"schema", "mckibben-truth/1"},
                                            {"rig", input::to_json(first.rig)},
                                            {"runs", runs_json(runs_)}}));
  for (std::size_t i = 0; i < runs_.size(); ++i) {
    const Recording& run = runs_[i];
    data.write(id_of(i) + ".csv", output::csv_of(output::measured_columns(run.rows, run.rig)));
    truth.write(id_of(i) + ".csv", output::csv_of(output::columns_of(run.rows, run.rig)));
  }
  truth.publish();
  data.publish();
  written_ = true;
}

}  // namespace mckibben::live
