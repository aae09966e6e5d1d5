// Reading and writing of calibrations; see the header.
#include <fmt/format.h>

#include <sim/input/calibration_file.hpp>
#include <sim/input/fields_json.hpp>
#include <sim/input/yaml_reader.hpp>
#include <sim/input/yaml_writer.hpp>

namespace mckibben::input {
namespace {

/// Finds lists of a pressure model that are empty; the visitor of a field list.
class PolynomialCheck {
 public:
  PolynomialCheck(const YamlFile& file, std::string_view model, Problems& problems)
      : source_(file.source), model_(*file.root.find(model)), problems_(problems) {}

  void required(std::string_view key, const controllers::InLoad& polynomial, const auto&...) {
    if (polynomial.empty())
      problems_.error(source_, model_.find(key)->place,
                      fmt::format("{}: at least one coefficient is needed", key));
  }

 private:
  const Source& source_;
  const Node& model_;
  Problems& problems_;
};

void check_range(const YamlFile& file, const controllers::CalibratedRange& range, Problems& problems) {
  const Node& node = *file.root.find("range");
  const auto ordered = [&](std::string_view key, double lowest, double highest) {
    if (lowest > highest)
      problems.error(file.source, node.find(key)->place,
                     fmt::format("{} = {} is above the highest, {}", key, lowest, highest));
  };
  ordered("lowest_ratio", range.lowest_ratio, range.highest_ratio);
  ordered("lowest_load", range.lowest_load_kg, range.highest_load_kg);
  ordered("lowest_speed", range.lowest_speed_mA_per_s, range.highest_speed_mA_per_s);
}

plant::CommandUnit unit_of_commands(const YamlFile& file, Problems& problems) {
  const Node* said = file.root.find("command_unit");
  const plant::CommandUnit unit = plant::command_unit_of(said == nullptr ? "mA" : said->text);
  if (said != nullptr && name_of(unit) != said->text)
    problems.error(file.source, said->place,
                   fmt::format("command_unit = {}: it is mA, V or bar", said->text));
  return unit;
}

}  // namespace

controllers::Calibration read_calibration(const std::filesystem::path& path, std::vector<InputFile>& inputs) {
  const YamlFile file =
      path == shipped_calibration
          ? parse_yaml(Source(std::string(shipped_calibration), std::string(thesis_calibration), ""))
          : load_yaml(path);
  Problems problems;
  controllers::Calibration calibration;
  constexpr std::string_view also_allowed[] = {"schema"};
  if (begin_file(file, calibration_schema, problems))
    read_struct(file.source, file.root, calibration, problems, also_allowed,
                {unit_of_commands(file, problems)});
  if (problems.errors() == 0) {
    PolynomialCheck contraction(file, "contraction", problems), relaxation(file, "relaxation", problems);
    controllers::ContractionModel::fields(calibration.contraction, contraction);
    controllers::RelaxationModel::fields(calibration.relaxation, relaxation);
    check_range(file, calibration.range, problems);
  }
  problems.raise(inputs);
  return calibration;
}

std::string wrong_rig(const controllers::Calibration& calibration, const plant::Rig& rig, bool weighs) {
  const std::string made = calibration.command_unit.value_or("mA");
  if (const std::string_view taken = name_of(rig.command_unit()); made != taken)
    return fmt::format(
        "made with a rig that is commanded in {}, and this one is in {}; calibrate with this rig "
        "(calibrate --rig)",
        made, taken);
  const bool counted = calibration.tube_pull.has_value();
  if (weighs && counted == rig.effects.get<plant::BladderElasticity>().absent())
    return fmt::format(
        "the rig file of its data has {} bladder_elasticity, and this rig has {}: it would weigh "
        "the tube's pull as load; if the data are of this rig, calibrate them with its file (calibrate "
        "--rig)",
        counted ? "a" : "no", counted ? "none" : "one");
  return "";
}

std::string calibration_yaml(const controllers::Calibration& calibration) {
  return to_yaml(file_json(calibration_schema, calibration,
                           {plant::command_unit_of(calibration.command_unit.value_or("mA"))}));
}

}  // namespace mckibben::input
