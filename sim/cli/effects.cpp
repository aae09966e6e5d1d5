// The verb effects: the catalogue of what a rig may have besides the nominal, from the table that the plant
// computes with (plant/effects.hpp) and the lists that the reader checks with.
#include <algorithm>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <vector>

#include <fmt/format.h>

#include <plant/effects.hpp>
#include <sim/cli/results.hpp>
#include <sim/cli/verbs.hpp>
#include <sim/diagnose/catalogue.hpp>
#include <sim/diagnose/parameter.hpp>
#include <sim/input/field_list.hpp>
#include <sim/input/hypothesis_file.hpp>
#include <sim/input/synonyms.hpp>
#include <sim/input/yaml_writer.hpp>
#include <sim/output/effect_pictures.hpp>
#include <sim/output/grid.hpp>

namespace mckibben::cli {
namespace {

using input::FieldInfo;
using input::Json;

/// One effect of the table, its types forgotten.
struct Entry {
  std::string_view name;
  std::string acts_on;
  std::string_view law, sentence, source;
  std::vector<plant::Variant> variants;
  std::vector<FieldInfo> fields;
  std::optional<input::OwnLaw> own{};  ///< what it is if it is none of the table
};

template <class E>
std::string acts_on() {
  std::vector<std::string_view> list;
  list.reserve(E::hooks.size() + 1);
  for (const plant::Hook hook : E::hooks) list.push_back(plant::words(hook));
  if (plant::Remembers<E>) list.push_back("with a memory");
  return fmt::format("{}", fmt::join(list, ", "));
}

template <class E>
Entry entry_of() {
  return {E::name,
          acts_on<E>(),
          E::law,
          E::sentence,
          E::source,
          {E::variants.begin(), E::variants.end()},
          input::list_fields<E>()};
}

/// A law of the user's own; its texts are the law's.
Entry entry_of(const input::OwnLaw& law) {
  const plant::LawText& text = *law.text;
  Entry entry{text.name,
              std::string(plant::name_of(text.adds)),
              text.law,
              text.sentence,
              "a hypothesis of the user's own",
              {},
              {},
              law};
  if (!text.memories.empty()) entry.acts_on += ", with a memory";
  const auto& size = text.parameters.front();
  plant::Variant variant{
      "", size.name, 0.0, size.typical, size.lowest < 0.0 ? plant::Sign::either : plant::Sign::positive, 0.0};
  entry.variants.push_back(variant);
  for (const auto& p : text.parameters) {
    FieldInfo info;
    info.key = p.name;
    info.type = FieldInfo::Type::quantity;
    info.unit = p.unit;
    info.lowest = p.lowest;
    info.highest = p.highest;
    info.default_value = input::quantity_json(p.typical, p.unit);
    entry.fields.push_back(std::move(info));
  }
  return entry;
}

std::vector<Entry> catalogue() {
  return std::apply(
      [](const auto&... effect) { return std::vector{entry_of<std::decay_t<decltype(effect)>>()...}; },
      plant::Effects::Table{});
}

/// Not an effect with a name of its own, but what a diagnosis writes where it knows none.
bool is_residual(const Entry& entry) {
  return entry.variants.empty();
}

const FieldInfo& field(const Entry& entry, std::string_view key) {
  return *std::find_if(entry.fields.begin(), entry.fields.end(),
                       [key](const auto& info) { return info.key == key; });
}

Json quantity(const Entry& entry, std::string_view key, double value) {
  return input::quantity_json(value, field(entry, key).unit);
}

/// How a rig file switches it on, one way for each law variant.
std::vector<Json> examples(const Entry& entry) {
  std::vector<Json> list;
  if (entry.own) {
    input::OwnLaw law = *entry.own;
    for (std::size_t i = 0; i < law.text->parameters.size(); ++i)
      law.values.at(i) = law.text->parameters[i].typical;
    const std::string key(diagnose::of_laws);
    return {{{"effects", {{key, Json::array({input::hypothesis_json(law)})}}}}};
  }
  for (const plant::Variant& variant : entry.variants) {
    Json keys = Json::object();
    if (!variant.name.empty()) keys["variant"] = variant.name;
    for (const plant::Variant& law : entry.variants) {
      if (law.name != variant.name && law.name != variant.adds_to) continue;
      keys[std::string(law.amplitude)] = quantity(entry, law.amplitude, law.absent + law.typical);
      if (!law.shape.empty()) keys[std::string(law.shape)] = quantity(entry, law.shape, law.middle);
    }
    list.push_back({{"effects", {{std::string(entry.name), keys}}}});
  }
  if (is_residual(entry))
    list.push_back(
        {{"effects",
          {{std::string(entry.name), {{"terms", {Json{{"of", "P e"}, {"coefficient", "-2 N"}}}}}}}}});
  return list;
}

Json parameter_json(const Entry& entry, const FieldInfo& info) {
  Json json{{"key", info.key}, {"meaning", info.meaning}};
  if (info.type == FieldInfo::Type::quantity) {
    json["unit"] = info.unit;
    json["lowest"] = info.lowest;
    json["highest"] = info.highest;
    json["default"] = info.default_value;
    for (const plant::Variant& variant : entry.variants)
      if (variant.amplitude == info.key) json["absent"] = variant.absent;
  }
  if (!info.choices.empty()) json["choices"] = info.choices;
  for (const auto& group : info.groups)
    for (const FieldInfo& inside : group.fields) json["each"].push_back(parameter_json(entry, inside));
  return json;
}

Json json_of(const Entry& entry) {
  Json json{{"name", entry.name},         {"acts_on", entry.acts_on}, {"law", entry.law},
            {"meaning", entry.sentence},  {"source", entry.source},   {"parameters", Json::array()},
            {"examples", examples(entry)}};
  for (const FieldInfo& info : entry.fields) json["parameters"].push_back(parameter_json(entry, info));
  return json;
}

std::string range(const FieldInfo& info) {
  if (info.type == FieldInfo::Type::quantity)
    return fmt::format("{:g} to {:g}", info.lowest.get<double>(), info.highest.get<double>());
  return info.choices.empty() ? "" : fmt::format("{}", fmt::join(info.choices, ", "));
}

void add_rows(const std::vector<FieldInfo>& fields, const std::string& indent, output::Grid& grid) {
  for (const FieldInfo& info : fields) {
    const auto text = info.default_value.is_string() ? info.default_value.get<std::string>()
                      : info.default_value.is_null() ? ""
                                                     : info.default_value.dump();
    grid.add({"  " + indent + info.key, info.unit == "1" ? "" : info.unit, range(info), text, info.meaning});
    for (const auto& group : info.groups) add_rows(group.fields, indent + "  ", grid);
  }
}

std::string details(const Entry& entry) {
  std::string text = fmt::format("{}: {}\n  acts on  {}\n  law      {}\n  source   {}\n", entry.name,
                                 entry.sentence, entry.acts_on, entry.law, entry.source);
  output::Grid grid({"  parameter", "unit", "range", "default", "meaning"}, 5);
  add_rows(entry.fields, "", grid);
  return text + grid.text();
}

std::string how_to(const Entry& entry) {
  std::string text;
  for (const Json& example : examples(entry)) {
    text += text.empty() ? "\n  in a rig file, for example:\n" : "\n  or:\n";
    const std::string yaml = input::to_yaml(example);
    for (std::size_t at = 0; at < yaml.size(); at = yaml.find('\n', at) + 1)
      text += "    " + yaml.substr(at, yaml.find('\n', at) + 1 - at);
  }
  return text;
}

std::string overview(const std::vector<Entry>& all) {
  output::Grid grid({"name", "acts on", "size", "what it is"}, 4);
  for (const Entry& entry : all) {
    std::string size;
    for (const plant::Variant& variant : entry.variants)
      if (variant.adds_to.empty()) size += (size.empty() ? "" : " or ") + std::string(variant.amplitude);
    if (!is_residual(entry))
      grid.add({std::string(entry.name), entry.acts_on, size, std::string(entry.sentence)});
  }
  std::string text = fmt::format(
      "Effects that a rig may have in addition to the nominal model; absent unless the rig file gives a "
      "size.\n\n{}\n",
      grid.text());
  for (const Entry& entry : all)
    text += (is_residual(entry) ? "A force without a name, as diagnose writes it:\n\n" : "") +
            details(entry) + "\n";
  return text + "How to switch one on: mckibben effects NAME\n";
}

std::vector<std::string> names_of_effects() {
  std::vector<std::string> names;
  for (const Entry& entry : catalogue()) names.emplace_back(entry.name);
  return names;
}

/// Whether the effect has this name, here or in the field: `hysteresis` is two of them.
bool is_called(const Entry& entry, std::string_view name) {
  const input::Synonym* term = input::synonym(name);
  return entry.name == name || (term != nullptr && std::ranges::count(term->names, entry.name) > 0);
}

/// Takes names of effects, and terms of the field that are some. Of its other terms it says what they are
/// here.
CLI::Validator known_effect() {
  const auto check = [](std::string& text) -> std::string {
    const auto all = catalogue();
    if (std::ranges::any_of(all, [&](const Entry& entry) { return is_called(entry, text); })) return {};
    if (const input::Synonym* term = input::synonym(text))
      return fmt::format("{} is not an effect; here: {} (docs/your_words.md)", text, term->here);
    std::vector<std::string> terms;  // the page is read only where somebody is at a loss
    for (const input::Synonym& term : input::synonyms()) terms.push_back(term.term);
    return one_of("effect", names_of_effects(), terms)(text);
  };
  return {check, one_of("effect", names_of_effects()).get_description()};
}

struct EffectsOptions : Options {
  std::vector<std::string> names;  ///< of effects, here or in the field; none for all
  std::vector<std::string> hypotheses;
};

int list_effects(const EffectsOptions& options) {
  const std::vector<Entry> all = catalogue();
  std::vector<Entry> named;
  named.reserve(options.names.size());
  for (const auto& name : options.names)
    for (const Entry& entry : all)
      if (is_called(entry, name)) named.push_back(entry);
  plant::Rig rig;
  std::vector<domain::InputFile> inputs;
  for (const std::string& file : options.hypotheses)
    rig.effects.laws.list.push_back(input::read_hypothesis(file, inputs));
  for (const auto& law : rig.effects.laws.list) named.push_back(entry_of(law));
  const std::vector<Entry>& chosen = named.empty() ? all : named;

  Json document{{"schema", "mckibben-effects/1"}, {"effects", Json::array()}};
  for (const Entry& entry : chosen) {
    if (is_residual(entry))
      document["residual_law"] = json_of(entry);
    else
      document["effects"].push_back(json_of(entry));
  }
  const std::string json = document.dump(2) + "\n";
  std::string text = named.empty() ? overview(all) : "";
  for (const Entry& entry : named) text += (text.empty() ? "" : "\n") + details(entry) + how_to(entry);
  Job job(options, "effects", std::nullopt, inputs);
  job.write("effects.json", json);
  for (const Entry& entry : chosen) {
    if (!job.has_folder() || is_residual(entry)) continue;
    std::string picture;
    try {
      picture = output::effect_svg(entry.name, rig);
    } catch (const std::runtime_error& error) {
      say(
          fmt::format("mckibben: {} cannot be drawn: with it, at its typical values, the rig cannot be "
                      "simulated: {}",
                      entry.name, error.what()));
      return failure;
    }
    job.write(std::string(entry.name) + ".svg", picture);
  }
  return job.finish({json, text}, done);
}

}  // namespace

void add_effects(CLI::App& app, Asked& asked) {
  CLI::App& verb = add_verb(app, "effects", to_find_out,
                            "The catalogue of effects that a rig may have: laws, parameters, sources");
  EffectsOptions& options = asked.when(verb, list_effects);
  verb.add_option("names", options.names, "Only these, with how to switch them on")
      ->check(known_effect())
      ->type_name("");
  add_common(verb, options, "nothing is written");
  add_hypotheses_option(verb, options.hypotheses, "are shown likewise");
  verb.footer(
      "Examples:\n"
      "  mckibben effects                                 all of them\n"
      "  mckibben effects muscle_leak                     its law, and what to write into a rig file\n"
      "  mckibben effects hysteresis                      the field's terms too: docs/your_words.md\n"
      "  mckibben effects --out pictures                  effects.json, and a picture of what each does\n"
      "  mckibben effects --hypothesis my_law.yaml --out pictures\n");
}

}  // namespace mckibben::cli
