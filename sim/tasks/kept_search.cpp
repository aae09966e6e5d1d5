// See the header.
#include <cstring>

#include <fmt/format.h>

#include <sim/input/diagnostics.hpp>
#include <sim/input/fields_json.hpp>
#include <sim/input/hash.hpp>
#include <sim/output/file.hpp>
#include <sim/tasks/kept_search.hpp>

namespace mckibben::tasks {
namespace {

using input::Json;

/// What a search depends on.
Json heading_of(const std::vector<domain::InputFile>& inputs) {
  std::string all;
  for (const domain::InputFile& file : inputs) all += file.sha256;
  return {{"schema", "mckibben-search/1"}, {"version", MCKIBBEN_VERSION}, {"inputs", input::sha256_hex(all)}};
}

[[noreturn]] void refuse(const std::filesystem::path& file, const char* why) {
  throw input::BadInput({{input::Severity::error, file.string(), input::nowhere,
                          fmt::format("{}; begin again without --resume", why), ""}});
}

}  // namespace

std::string bytes_of(const identify::Simulated& simulated, const std::vector<domain::InputFile>& inputs) {
  Json heading = heading_of(inputs);
  Json& shapes = heading["shapes"] = Json::array();
  for (const Eigen::MatrixXd& one : simulated) shapes.push_back({one.rows(), one.cols()});
  std::string bytes = heading.dump() + "\n";
  for (const Eigen::MatrixXd& one : simulated)
    bytes.append(reinterpret_cast<const char*>(one.data()),
                 static_cast<std::size_t>(one.size()) * sizeof(double));
  return bytes;
}

identify::Simulated simulated_in(const std::filesystem::path& file,
                                 const std::vector<domain::InputFile>& inputs) {
  const std::optional<std::string> bytes = output::read_regular(file);
  if (!bytes)
    throw input::MissingInput(fmt::format(
        "{}: no such file: a diagnosis leaves it where its search was ended before it was through",
        file.string()));
  const std::size_t line = std::min(bytes->find('\n'), bytes->size());
  const Json heading =
      Json::parse(bytes->begin(), bytes->begin() + static_cast<std::ptrdiff_t>(line), nullptr,
                  /*allow_exceptions=*/false);
  const Json wanted = heading_of(inputs);
  if (!heading.is_object() || heading.value("schema", "") != wanted.at("schema"))
    refuse(file, "this is no search that was kept");
  if (heading.value("version", "") != wanted.at("version"))
    refuse(file, "this is a search of another version");
  if (heading.value("inputs", "") != wanted.at("inputs"))
    refuse(file, "this is a search on other data, or on another rig");
  identify::Simulated simulated;
  std::size_t at = line + 1;
  for (const Json& shape : heading.at("shapes")) {
    Eigen::MatrixXd one(shape.at(0).get<Eigen::Index>(), shape.at(1).get<Eigen::Index>());
    const std::size_t size = static_cast<std::size_t>(one.size()) * sizeof(double);
    if (at + size > bytes->size()) refuse(file, "the file is not whole");
    std::memcpy(one.data(), bytes->data() + at, size);
    at += size;
    simulated.push_back(std::move(one));
  }
  return simulated;
}

}  // namespace mckibben::tasks
