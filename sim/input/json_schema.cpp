// Field lists to JSON Schema; see the header. A schema cannot convert units, so a quantity's range stands in
// its description; the program checks it.
#include <string>

#include <fmt/format.h>

#include <sim/input/field_list.hpp>

namespace mckibben::input {
namespace {

constexpr const char* number_pattern = "[+-]?(0|[1-9][0-9]*)([.][0-9]+)?([eE][+-]?[0-9]+)?";

std::string description(const FieldInfo& info) {
  if (info.type != FieldInfo::Type::quantity) return info.meaning;
  return fmt::format("{}; {} to {}", info.meaning, show_limit(info.lowest.get<double>(), info.unit),
                     show_limit(info.highest.get<double>(), info.unit));
}

Json with_unit(std::string_view unit_pattern) {
  return {{"type", "string"}, {"pattern", fmt::format("^{} *{}$", number_pattern, unit_pattern)}};
}

Json quantity_schema(const FieldInfo& info) {
  if (info.unit != "1") return with_unit("[^0-9 .,].*");
  const Json number{{"type", "number"}, {"minimum", info.lowest}, {"maximum", info.highest}};
  return {{"anyOf", {number, with_unit("%?")}}};
}

Json group_schema(const FieldInfo::Group& group);

Json value_schema(const FieldInfo& info) {
  switch (info.type) {
    case FieldInfo::Type::quantity:
      return quantity_schema(info);
    case FieldInfo::Type::integer:
      return {{"type", "integer"}, {"minimum", info.lowest}, {"maximum", info.highest}};
    case FieldInfo::Type::boolean:
      return {{"type", "boolean"}};
    case FieldInfo::Type::choice:
      return {{"enum", info.choices}};
    case FieldInfo::Type::text:
      return {{"type", {"string", "number"}}};  // the reader takes 3 for a text as well
    case FieldInfo::Type::height:
      return {{"anyOf", {Json{{"type", "number"}}, with_unit("[^0-9 .,].*")}}};
    case FieldInfo::Type::draws:
      return {{"type", "object"},
              {"properties", {{"sampling", {{"enum", info.choices}}}}},
              {"additionalProperties", {{"type", "string"}, {"pattern", "^(normal|uniform) "}}}};
    case FieldInfo::Type::laws:  // each the path of a file, or what would stand in it
      return {{"type", "array"}, {"items", {{"type", {"string", "object"}}}}};
    case FieldInfo::Type::named: {
      const Json each =
          info.groups.empty() ? Json{{"type", {"string", "number"}}} : group_schema(info.groups.front());
      return {{"type", "object"}, {"additionalProperties", each}};
    }
    case FieldInfo::Type::structure:
    case FieldInfo::Type::variant:
      break;
  }
  Json choices = Json::array();
  for (const FieldInfo::Group& group : info.groups) choices.push_back(group_schema(group));
  if (info.by_name) choices.push_back({{"type", "string"}});
  return choices.size() == 1 ? choices.front() : Json{{"oneOf", choices}};
}

Json group_schema(const FieldInfo::Group& group) {
  Json properties = Json::object(), required = Json::array();
  if (!group.kind.empty()) {
    properties["kind"] = {{"const", group.kind}};
    required.push_back("kind");
  }
  for (const FieldInfo& info : group.fields) {
    Json schema = value_schema(info);
    if (info.is_list) schema = {{"type", "array"}, {"items", schema}};
    schema["description"] = description(info);
    if (!info.default_value.is_null()) schema["default"] = info.default_value;
    for (const std::string& old : info.in_place_of) {
      Json before = info.type == FieldInfo::Type::variant ? Json{{"type", "object"}} : schema;
      before.update({{"deprecated", true},
                     {"description", fmt::format("write it in {} (mckibben check --upgrade)", info.key)}});
      properties[old] = std::move(before);
    }
    properties[info.key] = std::move(schema);
    if (info.required) required.push_back(info.key);
  }
  Json schema{{"type", "object"}, {"properties", properties}, {"additionalProperties", false}};
  if (!required.empty()) schema["required"] = required;
  return schema;
}

}  // namespace

Json json_schema(std::string_view schema, std::string_view title, const std::vector<FieldInfo>& fields) {
  Json result{{"$schema", "https://json-schema.org/draft/2020-12/schema"}, {"title", title}};
  result.update(group_schema({"", fields}));
  Json properties{{"schema", {{"const", schema}}}};
  properties.update(result["properties"]);
  result["properties"] = std::move(properties);
  if (!result.contains("required")) result["required"] = Json::array();
  result["required"].insert(result["required"].begin(), "schema");
  return result;
}

}  // namespace mckibben::input
