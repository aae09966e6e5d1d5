// XML of both versions; see the header.
#include <map>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include <sim/domain/number.hpp>
#include <sim/fmu/description.hpp>
#include <sim/fmu/model/variables.hpp>

namespace mckibben::fmu {
namespace {

std::string escaped(std::string_view text) {
  std::string safe;
  for (const char c : text) {
    if (c == '&')
      safe += "&amp;";
    else if (c == '<')
      safe += "&lt;";
    else if (c == '>')
      safe += "&gt;";
    else if (c == '"')
      safe += "&quot;";
    else
      safe += c;
  }
  return safe;
}

std::string attribute(std::string_view name, std::string_view value) {
  return fmt::format(" {}=\"{}\"", name, escaped(value));
}
std::string attribute(std::string_view name, double value) {
  return attribute(name, domain::write_number(value));
}

/// What is known of units in base units; an importer may convert those, and passes over the others.
std::string base_of(std::string_view unit) {
  static const std::map<std::string_view, std::string_view> bases{
      {"mA", "A=\"1\" factor=\"0.001\""},
      {"V", "kg=\"1\" m=\"2\" s=\"-3\" A=\"-1\""},
      {"Pa", "kg=\"1\" m=\"-1\" s=\"-2\""},
      {"bar", "kg=\"1\" m=\"-1\" s=\"-2\" factor=\"100000\""},
      {"s-1", "s=\"-1\""},
      {"rad s-1", "rad=\"1\" s=\"-1\""},
      {"N m", "kg=\"1\" m=\"2\" s=\"-2\""},
      {"N m rad-1", "kg=\"1\" m=\"2\" s=\"-2\" rad=\"-1\""},
      {"N", "kg=\"1\" m=\"1\" s=\"-2\""},
      {"N/m", "kg=\"1\" s=\"-2\""},
      {"N.s/m", "kg=\"1\" s=\"-1\""},
      {"kg", "kg=\"1\""},
      {"kg.m2", "kg=\"1\" m=\"2\""},
      {"kg/m3", "kg=\"1\" m=\"-3\""},
      {"m", "m=\"1\""},
      {"m3", "m=\"3\""},
      {"s", "s=\"1\""},
      {"1/s", "s=\"-1\""},
      {"Hz", "s=\"-1\""},
      {"K", "K=\"1\""},
      {"rad", "rad=\"1\""}};
  const auto found = bases.find(unit);
  return found == bases.end() ? "" : fmt::format("<BaseUnit {}/>", found->second);
}

bool has_unit(const Variable& variable) {
  return !variable.unit.empty() && variable.unit != "1";
}

std::string units_xml(const std::vector<Variable>& list) {
  std::map<std::string, std::string> units;
  for (const Variable& each : list)
    if (has_unit(each)) units[each.unit] = base_of(each.unit);
  std::string xml = "  <UnitDefinitions>\n";
  for (const auto& [unit, base] : units)
    xml += fmt::format("    <Unit{}>{}</Unit>\n", attribute("name", unit), base);
  return xml + "  </UnitDefinitions>\n";
}

/// Causality and what follows from it.
std::string causes(const Variable& variable) {
  switch (variable.role) {
    case Role::time:
      return R"( causality="independent" variability="continuous")";
    case Role::input:
      return R"( causality="input" variability="continuous")";
    case Role::parameter:
      return R"( causality="parameter" variability="fixed" initial="exact")";
    case Role::output:
      break;
  }
  return fmt::format(R"( causality="output" variability="{}" initial="calculated")",
                     variable.whole ? "discrete" : "continuous");
}

std::string numbers(const Variable& variable) {
  std::string xml;
  if (has_unit(variable)) xml += attribute("unit", variable.unit);
  if (variable.role == Role::input || variable.role == Role::parameter)
    xml += attribute("min", variable.lowest) + attribute("max", variable.highest) +
           attribute("start", variable.start);
  return xml;
}

std::string variable_xml(const Variable& variable, Version version) {
  const std::string common = attribute("name", variable.name) +
                             fmt::format(" valueReference=\"{}\"", variable.reference) + causes(variable) +
                             (variable.meaning.empty() ? "" : attribute("description", variable.meaning));
  if (version == Version::two)
    return fmt::format("    <ScalarVariable{}><{}{}/></ScalarVariable>\n", common,
                       variable.whole ? "Integer" : "Real", numbers(variable));
  return fmt::format("    <{}{}{}/>\n", variable.whole ? "Int64" : "Float64", common, numbers(variable));
}

/// Outputs show what earlier steps have done: no input acts on them at once, so no loop is algebraic.
std::string structure_xml(const std::vector<Variable>& list, Version version) {
  std::string outputs, initial;
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (list[i].role != Role::output) continue;
    const bool two = version == Version::two;
    const std::string which =
        two ? fmt::format("index=\"{}\"", i + 1) : fmt::format("valueReference=\"{}\"", list[i].reference);
    outputs += fmt::format("    <{} {} dependencies=\"\"/>\n", two ? "Unknown" : "Output", which);
    initial += fmt::format("    <{} {}/>\n", two ? "Unknown" : "InitialUnknown", which);
  }
  if (version == Version::two)
    outputs = "    <Outputs>\n" + outputs + "    </Outputs>\n    <InitialUnknowns>\n" + initial +
              "    </InitialUnknowns>\n";
  else
    outputs += initial;
  return "  <ModelStructure>\n" + outputs + "  </ModelStructure>\n";
}

}  // namespace

std::string description_xml(const Description& about, const plant::Rig& rig) {
  const bool two = about.version == Version::two;
  const std::vector<Variable> list = variables_of(rig, about.true_states);
  std::string xml = fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<fmiModelDescription fmiVersion=\"{}\"{}{}{}{} variableNamingConvention=\"structured\">\n"
      "  <CoSimulation modelIdentifier=\"{}\" canHandleVariableCommunicationStepSize=\"true\" "
      "{}=\"true\" {}=\"true\"/>\n",
      two ? "2.0" : "3.0", attribute("modelName", about.name),
      attribute(two ? "guid" : "instantiationToken", about.token),
      attribute("description", "A pneumatic muscle, its valve and what it moves"),
      attribute("generationTool", "mckibben " MCKIBBEN_VERSION), model_identifier,
      two ? "canGetAndSetFMUstate" : "canGetAndSetFMUState",
      two ? "canSerializeFMUstate" : "canSerializeFMUState");
  xml += units_xml(list);
  xml += "  <LogCategories>\n    <Category name=\"logStatusError\"/>\n  </LogCategories>\n";
  xml += fmt::format("  <DefaultExperiment startTime=\"0\" stopTime=\"20\" stepSize=\"{}\"/>\n",
                     domain::write_number(rig.tick_s));
  xml += "  <ModelVariables>\n";
  for (const Variable& variable : list) xml += variable_xml(variable, about.version);
  return xml + "  </ModelVariables>\n" + structure_xml(list, about.version) + "</fmiModelDescription>\n";
}

}  // namespace mckibben::fmu
