// dataset.yaml, rig.yaml, a CSV for each run, and the truth; see the header.
#include <algorithm>
#include <array>
#include <span>
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

using Runs = std::span<const Recording>;

Json runs_json(Runs runs) {
  Json list = Json::array();
  for (std::size_t i = 0; i < runs.size(); ++i) {
    list.push_back({{"id", id_of(i)}, {"file", id_of(i) + ".csv"}});
    if (runs[i].rig.pair() == nullptr) list.back()["load"] = domain::write_number(runs[i].load_kg) + " kg";
  }
  return list;
}

/// What goes with the rows, into the folder of what was measured and that of the truth.
template <class Folder>
void describe(Folder& data, Folder& truth, Runs runs) {
  const Recording& first = runs.front();
  Json dataset{{"schema", "mckibben-dataset/1"}, {"rig", "rig.yaml"}};
  if (!first.settled) dataset.update({{"start", "moving"}, {"skip", unjudged}});
  if (Json columns = output::columns_json(first.rig); !columns.empty())
    dataset["columns"] = std::move(columns);
  dataset["runs"] = runs_json(runs);
  data.write("dataset.yaml", input::to_yaml(dataset));
  data.write("rig.yaml", rig_text(first.known));
  truth.write("rig.yaml", rig_text(first.rig));
  truth.write("truth.yaml", input::to_yaml({{"schema", "mckibben-truth/1"},
                                            {"rig", input::to_json(first.rig)},
                                            {"runs", runs_json(runs)}}));
}

std::array<std::string, 2> tables_of(const Recording& run) {
  return {output::csv_of(output::measured_columns(run.rows, run.rig)),
          output::csv_of(output::columns_of(run.rows, run.rig))};
}

}  // namespace

DataSets::DataSets(std::filesystem::path first, std::string session, output::Say say)
    : first_(std::move(first)), session_(std::move(session)), say_(std::move(say)) {}

std::filesystem::path DataSets::folder() const {
  return number_ <= 1 ? first_ : std::filesystem::path(fmt::format("{}-{}", first_.string(), number_));
}

Recording Recording::from(std::size_t row) const {
  Recording part{.rig = rig, .known = known, .number = number, .load_kg = load_kg, .settled = settled};
  part.rows.driven = rows.driven;
  part.rows.samples.assign(rows.samples.begin() + static_cast<std::ptrdiff_t>(row), rows.samples.end());
  return part;
}

std::filesystem::path DataSets::put(Recording recording) {
  follow(recording.from(rows_of(recording.number)));  // all of it, should it not be written now
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
  output::ResultFolder data(folder(), session_, say_);
  output::ResultFolder truth(folder().string() + "-truth", session_, say_);
  describe(data, truth, runs_);
  for (std::size_t i = 0; i < runs_.size(); ++i) {
    const auto [measured, true_values] = tables_of(runs_[i]);
    data.write(id_of(i) + ".csv", measured);
    truth.write(id_of(i) + ".csv", true_values);
  }
  truth.publish();
  data.publish();
  written_ = true;
  for (const Recording& run : runs_) drop(run.number);
}

void DataSets::begin(Followed& one, const Recording& first) {
  const auto tables = tables_of(first.from(first.rows.samples.size()));
  const std::string name = id_of(0) + ".csv";
  try {
    one.folders.emplace_back(first_, name, tables[0], say_);
    one.folders.emplace_back(first_.string() + "-truth", name, tables[1], say_);
    describe(one.folders.front(), one.folders.back(), {&first, 1});
  } catch (const output::CannotWrite& cannot) {
    one.folders.clear();
    say_(fmt::format("until it ends, the recording is in memory only: {}", cannot.what()));
  }
}

void DataSets::follow(const Recording& further) {
  auto one = std::ranges::find(followed_, further.number, &Followed::number);
  if (one == followed_.end()) {
    one = followed_.insert(one, Followed{further.number});
    begin(*one, further);
  }
  one->rows += further.rows.samples.size();
  if (one->folders.empty() || further.rows.samples.empty()) return;
  const auto without_head = [](const std::string& table) { return table.substr(table.find('\n') + 1); };
  const auto tables = tables_of(further);
  one->folders.front().append(without_head(tables[0]));
  one->folders.back().append(without_head(tables[1]));
}

std::size_t DataSets::rows_of(std::uint64_t number) const {
  const auto one = std::ranges::find(followed_, number, &Followed::number);
  return one == followed_.end() ? 0 : one->rows;
}

void DataSets::drop(std::uint64_t number) {
  const auto one = std::ranges::find(followed_, number, &Followed::number);
  if (one == followed_.end()) return;
  for (output::Unfinished& folder : one->folders) folder.remove();
  followed_.erase(one);
}

}  // namespace mckibben::live
