// Runs in several formats, and their data package; see the header.
#include <algorithm>
#include <charconv>
#include <set>

#include <fmt/format.h>

#include <plant/plant.hpp>
#include <sim/formats/mat_file.hpp>
#include <sim/formats/netcdf.hpp>
#include <sim/input/fields_json.hpp>
#include <sim/input/number.hpp>
#include <sim/output/run_files.hpp>
#include <sim/run/simulate.hpp>

namespace mckibben::output {
namespace {

using input::Json;

bool is_asked_for(const std::vector<std::string>& formats, std::string_view format) {
  return std::find(formats.begin(), formats.end(), format) != formats.end();
}

/// Names of resources are in small letters, each its own.
std::string resource_name(const std::string& stem, std::set<std::string>& taken) {
  const std::string first = input::lower(stem);
  std::string name = first;
  for (int n = 2; !taken.insert(name).second; ++n) name = fmt::format("{}-{}", first, n);
  return name;
}

Json fields_json(const std::vector<formats::Column>& columns) {
  Json fields = Json::array();
  for (const auto& column : columns)
    fields.push_back({{"name", column.name},
                      {"type", "number"},
                      {"unit", column.unit},
                      {"description", column.meaning},
                      {"constraints", {{"required", true}}}});
  return fields;
}

}  // namespace

std::vector<NamedFile> run_files(const std::string& stem, const formats::Table& table,
                                 const std::vector<std::string>& formats) {
  std::vector<NamedFile> files{{stem + ".csv", csv_of(table.columns)}};
  if (is_asked_for(formats, "mat")) files.push_back({stem + ".mat", formats::mat_of(table)});
  if (is_asked_for(formats, "netcdf")) files.push_back({stem + ".nc", formats::netcdf_of(table)});
  return files;
}

std::vector<std::string> run_file_names(const std::string& stem) {
  return {stem + ".csv", stem + ".mat", stem + ".nc"};
}

std::string datapackage(const Package& package) {
  Json document{{"profile", "tabular-data-package"}, {"title", package.title}, {"resources", Json::array()}};
  const Json common = fields_json(package.columns);
  std::set<std::string> taken;
  for (const auto& run : package.runs)
    document["resources"].push_back(
        {{"name", resource_name(run.stem, taken)},
         {"title", run.title},
         {"path", run.stem + ".csv"},
         {"profile", "tabular-data-resource"},
         {"format", "csv"},
         {"mediatype", "text/csv"},
         {"encoding", "utf-8"},
         {"schema",
          {{"fields", run.columns.empty() ? common : fields_json(run.columns)}, {"missingValues", {""}}}}});
  return document.dump(2) + "\n";
}

std::string program_name() {
  return "mckibben " MCKIBBEN_VERSION;
}

namespace {

void append(std::string& text, double value) {
  char digits[32];
  const auto end = std::to_chars(digits, digits + sizeof digits, value).ptr;
  text.append(digits, end);
}

formats::Column column_of(const run::Recording& recording, const plant::Channel& channel, std::string name,
                          std::string words) {
  formats::Column column{std::move(name), std::string(channel.signal->unit.name), std::move(words), {}};
  column.values.reserve(recording.samples.size());
  for (const run::Sample& row : recording.samples) column.values.push_back(channel.value(row));
  return column;
}

}  // namespace

std::vector<formats::Column> columns_of(const run::Recording& recording, const plant::Rig& rig,
                                        const Targets& targets) {
  std::vector<formats::Column> columns;
  const std::vector<plant::Channel> channels = plant::recorded_channels(rig, recording.driven);
  for (const plant::Channel& channel : channels)
    columns.push_back(column_of(recording, channel, channel.name(), channel.words()));
  for (const auto& [key, values] : targets) {
    if (values.empty()) continue;
    const plant::Channel& channel = plant::channel_of(channels, key);
    columns.push_back({"target_" + channel.name(), std::string(channel.signal->unit.name),
                       std::string(channel.signal->words) + ", as it is wanted", values});
    columns.back().values.resize(recording.samples.size());
  }
  return columns;
}

std::vector<formats::Column> measured_columns(const run::Recording& recording, const plant::Rig& rig) {
  std::vector<formats::Column> columns;
  for (const plant::Channel& channel : plant::measured_channels(rig, recording.driven))
    columns.push_back(column_of(recording, channel, channel.name_in_dataset(), channel.words()));
  return columns;
}

std::string table_of_signals() {
  std::string text =
      "## Columns\n\n| column | of a pair | unit | in files of runs | in a data set's `columns` | meaning |\n"
      "|---|---|---|---|---|---|\n";
  const auto code = [](const std::string& name) { return name.empty() ? "" : "`" + name + "`"; };
  for (const plant::Signal& signal : plant::signals) {
    using plant::InFiles, plant::Needs;
    const bool each = signal.part == plant::Part::muscle;
    const plant::Channel alone{&signal}, of_pair{&signal, each ? 1U : 0U};
    const bool of_pair_only = signal.needs == Needs::pair,
               of_one_only = signal.needs == Needs::one_muscle || signal.needs == Needs::height ||
                             signal.needs == Needs::outer_force || (signal.needs == Needs::cord && !each);
    const std::string one = of_pair_only ? "" : alone.name(), two = of_one_only ? "" : of_pair.name();
    const char* in_files = signal.in_files == InFiles::yes            ? "yes"
                           : signal.in_files == InFiles::no           ? ""
                           : signal.in_files == InFiles::with_effects ? "with effects"
                                                                      : "of a pair; where measured";
    text += fmt::format("| {} | {} | {} | {} | {} | {} |\n", code(one), code(two), signal.unit.name, in_files,
                        code(alone.key_in_dataset()), alone.words());
  }
  return text;
}

std::string csv_of(const std::vector<formats::Column>& columns) {
  constexpr std::size_t usual_cell = 18;
  const std::size_t rows = columns.front().values.size();
  std::string text;
  text.reserve((rows + 1) * columns.size() * usual_cell);
  const auto end_cell = [&](const formats::Column& column) {
    text += &column == &columns.back() ? '\n' : ',';
  };
  for (const auto& column : columns) {
    text += column.name;
    end_cell(column);
  }
  for (std::size_t k = 0; k < rows; ++k)
    for (const auto& column : columns) {
      append(text, column.values[k]);
      end_cell(column);
    }
  return text;
}

std::string thesis_ascii(const run::Recording& recording, const plant::Rig& rig, double load_kg) {
  const plant::Plant plant(rig, load_kg);
  const double per_count = run::contraction_per_count(rig), tick_s = rig.tick_s;
  const auto& samples = recording.samples;
  // Before the first row the rig was at rest.
  const auto counts = [&](std::size_t rows_ago, std::size_t k) {
    return samples[k < rows_ago ? 0 : k - rows_ago].counts;
  };
  std::string text;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const auto last = counts(0, k), before = counts(1, k), earlier = counts(2, k);
    append(text, samples[k].current_mA);
    for (const double value :
         {static_cast<double>(last) * per_count, static_cast<double>(last - before) * per_count / tick_s,
          static_cast<double>(last - 2 * before + earlier) * per_count / (tick_s * tick_s),
          plant.reference_pressure_Pa(samples[k].current_mA) / 1e5}) {
      text += ' ';
      append(text, value);
    }
    text += '\n';
  }
  return text;
}

}  // namespace mckibben::output
