// Runs in several formats, and their data package; see the header.
#include <algorithm>
#include <cctype>
#include <set>

#include <fmt/format.h>

#include <sim/formats/mat_file.hpp>
#include <sim/formats/netcdf_file.hpp>
#include <sim/input/fields_json.hpp>
#include <sim/output/csv.hpp>
#include <sim/output/run_files.hpp>

namespace mckibben::output {
namespace {

using input::Json;

bool is_asked_for(const std::vector<std::string>& formats, std::string_view format) {
  return std::find(formats.begin(), formats.end(), format) != formats.end();
}

/// Names of resources are in small letters, each its own.
std::string resource_name(const std::string& stem, std::set<std::string>& taken) {
  std::string name = stem;
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const std::string first = name;
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

}  // namespace mckibben::output
