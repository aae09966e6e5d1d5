// Files and lists of laws, read and written; see the header. One law: law_reader.cpp.
#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include <sim/input/fields_json.hpp>
#include <sim/input/hypothesis_file.hpp>
#include <sim/input/hypothesis_keys.hpp>
#include <sim/input/yaml_reader.hpp>

namespace mckibben::input {
namespace {

OwnLaw read_law_file(const YamlFile& file, Problems& problems) {
  if (!begin_file(file, hypothesis_schema, problems)) return {};
  return read_law(file.source, file.root, problems);
}

/// A law named in another file.
OwnLaw read_other_file(const Source& source, const Node& node, Problems& problems) {
  OwnLaw law;
  read_other(source, node, problems, [&] {
    law = read_law_file(load_yaml((source.folder() / node.text).lexically_normal()), problems);
  });
  return law;
}

}  // namespace

OwnLaw read_hypothesis(const std::string& path, std::vector<InputFile>& inputs) {
  Problems problems;
  OwnLaw law = read_law_file(load_yaml(path), problems);
  problems.raise(inputs);
  return law;
}

void read_named(const Source& source, const Node& node, OwnLaws& into, Problems& problems) {
  if (node.kind != Node::Kind::list)
    return problems.error(
        source, node.place,
        fmt::format("hypotheses must be a list of files or laws, not {}", node.kind_name()));
  if (node.children.size() > plant::most_written_laws)
    return problems.error(source, node.place, fmt::format("at most {} laws", plant::most_written_laws));
  into.list.clear();
  for (const Node& each : node.children) {
    OwnLaw law = each.kind == Node::Kind::scalar ? read_other_file(source, each, problems)
                                                 : read_law(source, each, problems);
    if (!law.text) continue;
    const auto same = [&](const OwnLaw& other) { return other.text->name == law.text->name; };
    if (std::ranges::any_of(into.list, same))
      problems.error(source, each.place, fmt::format("two laws have the name {}", law.text->name));
    else
      into.list.push_back(std::move(law));
  }
  const auto report = [&](std::string_view, std::string_view message) {
    problems.error(source, node.place, std::string(message));
  };
  into.rules(report);
}

Json hypothesis_json(const OwnLaw& law) {
  const plant::LawText& text = *law.text;
  Json json{
      {"name", text.name}, {"sentence", text.sentence}, {"adds", std::string(plant::name_of(text.adds))}};
  if (text.at != plant::LawPlace::side) json["at"] = std::string(plant::name_of(text.at));
  json["law"] = text.law;
  for (const auto& memory : text.memories) json["memories"][memory.name] = memory.rate;
  for (std::size_t i = 0; i < text.parameters.size(); ++i) {
    const auto& p = text.parameters[i];
    json["parameters"][p.name] = {{"unit", p.unit}, {"typical", p.typical}, {"range", {p.lowest, p.highest}}};
    if (!law.absent()) json["parameters"][p.name]["value"] = law.values[i];
  }
  return json;
}

std::vector<FieldInfo> hypothesis_fields() {
  std::vector<FieldInfo> fields = list_fields<WrittenLaw>();
  FieldInfo memories;
  memories.key = "memories";
  memories.type = FieldInfo::Type::named;
  memories.meaning = "at most 12 numbers that begin at 0: of each its rate of change, an expression";
  fields.push_back(memories);
  FieldInfo parameters = memories;
  parameters.key = "parameters";
  parameters.required = true;
  parameters.groups.push_back({"", list_fields<WrittenParameter>()});
  parameters.meaning = "at most 6; the first is the law's size: at 0 the law adds nothing";
  fields.push_back(std::move(parameters));
  return fields;
}

}  // namespace mckibben::input
