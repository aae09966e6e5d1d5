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
  return {{"version", MCKIBBEN_VERSION}, {"inputs", input::sha256_hex(all)}};
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
  return input::sealed_bytes(bytes);
}

identify::Simulated simulated_in(const std::filesystem::path& file,
                                 const std::vector<domain::InputFile>& inputs) {
  const std::optional<std::string> kept = output::read_regular(file);
  if (!kept)
    throw input::MissingInput(fmt::format(
        "{}: no such file: a diagnosis leaves it where its search was ended before it was through",
        file.string()));
  const std::optional<std::string> bytes = input::unsealed_bytes(*kept);
  if (!bytes) refuse(file, "this is no search that was kept, or it is damaged");
  const std::size_t line = bytes->find('\n');
  const Json heading = Json::parse(bytes->substr(0, line));
  const Json wanted = heading_of(inputs);
  if (heading.at("version") != wanted.at("version")) refuse(file, "this is a search of another version");
  if (heading.at("inputs") != wanted.at("inputs"))
    refuse(file, "this is a search on other data, or on another rig");
  identify::Simulated simulated;
  std::size_t at = line + 1;
  for (const Json& shape : heading.at("shapes")) {
    Eigen::MatrixXd one(shape.at(0).get<Eigen::Index>(), shape.at(1).get<Eigen::Index>());
    const std::size_t size = static_cast<std::size_t>(one.size()) * sizeof(double);
    std::memcpy(one.data(), bytes->data() + at, size);
    at += size;
    simulated.push_back(std::move(one));
  }
  return simulated;
}

}  // namespace mckibben::tasks
