// Reading and checking of one law; see the header.
#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <memory>
#include <optional>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include <plant/effects.hpp>
#include <sim/input/hypothesis_keys.hpp>
#include <sim/input/quantity.hpp>
#include <sim/input/suggest.hpp>
#include <sim/input/utf8.hpp>
#include <sim/input/yaml_file.hpp>
#include <sim/input/yaml_reader.hpp>
#include <sim/law/compile.hpp>
#include <sim/law/names.hpp>

namespace mckibben::input {
namespace {

constexpr std::size_t longest_name = 40;
constexpr std::string_view named_keys[] = {"schema", "parameters", "memories"};

bool is_identifier(std::string_view text) {
  return !text.empty() && text.size() <= longest_name &&
         std::isalpha(static_cast<unsigned char>(text[0])) != 0 &&
         std::ranges::all_of(text,
                             [](unsigned char c) { return c < 0x80 && (std::isalnum(c) != 0 || c == '_'); });
}

bool is_small(std::string_view text) {
  return std::ranges::none_of(text, [](unsigned char c) { return std::isupper(c) != 0; });
}

std::vector<std::string_view> effects_of_the_catalogue() {
  return std::apply([](const auto&... effect) { return std::vector<std::string_view>{effect.name...}; },
                    plant::Effects::Table{});
}

/// What a memory is likely to be as large as: integrators' tolerances are shares of it.
double working_size(const law::Dimension& dimension) {
  constexpr std::array<std::pair<law::Dimension, double>, 5> usual{{{law::metre, 0.1},
                                                                    {law::pascal, 1e5},
                                                                    {law::newton, 100.0},
                                                                    {law::metre_per_second, 0.1},
                                                                    {law::ratio, 0.1}}};
  for (const auto& [known, size] : usual)
    if (known == dimension) return size;
  return 1.0;
}

/// Reads one law from a map.
class LawReader {
 public:
  LawReader(const Source& source, const Node& map, Problems& problems)
      : source_(source), map_(map), problems_(problems) {}

  OwnLaw operator()() {
    const std::size_t errors_before = problems_.errors();
    read_struct(source_, map_, written_, problems_, named_keys);
    if (map_.kind != Node::Kind::map) return {};
    check_name();
    parameters();
    memories();
    if (problems_.errors() > errors_before) return {};
    auto programs = compile();
    if (!programs) return {};
    finish(std::move(*programs));
    if (problems_.errors() > errors_before) return {};
    law_.text = std::make_shared<const plant::LawText>(std::move(text_));
    return std::move(law_);
  }

 private:
  void bad(Place place, std::string message) { problems_.error(source_, place, std::move(message)); }
  Place place_of(std::string_view key) const {
    const Node* node = map_.find(key);
    return node == nullptr ? map_.place : node->place;
  }

  void check_name() {
    if (!written_.name.empty() && (!is_identifier(written_.name) || !is_small(written_.name)))
      bad(place_of("name"),
          fmt::format("name = {} must be small letters, digits and _, at most {}, a letter first",
                      shortened(written_.name), longest_name));
    const auto known = effects_of_the_catalogue();
    if (std::ranges::find(known, written_.name) != known.end())
      bad(place_of("name"),
          fmt::format("name = {} is an effect of the catalogue; take another", written_.name));
    if (written_.at == plant::LawPlace::joint && written_.adds != plant::LawTarget::force)
      bad(place_of("at"), "at = joint: only a force acts there");
  }

  /// A map of names, as many as there may be; null if it is none.
  const Node* names_under(std::string_view key, std::size_t most) {
    const Node* node = map_.find(key);
    if (node == nullptr) return nullptr;
    if (node->kind != Node::Kind::map) {
      bad(node->place, fmt::format("{} must be a map of names, not {}", key, node->kind_name()));
      return nullptr;
    }
    if (node->children.size() > most)
      bad(node->children[most].key_place, fmt::format("a law has at most {} {}", most, key));
    for (const Node& child : node->children) check_new_name(child);
    return node;
  }
  void check_new_name(const Node& child) {
    const auto taken = law::reserved_names();
    if (!is_identifier(child.key))
      bad(child.key_place, fmt::format("{} must be letters, digits and _, at most {}, a letter first",
                                       shortened(child.key), longest_name));
    else if (std::ranges::find(taken, child.key) != taken.end())
      bad(child.key_place, fmt::format("{} is taken: laws know {}", child.key, join(taken)));
    else if (std::ranges::find(names_, child.key) != names_.end())
      bad(child.key_place, fmt::format("{} is a parameter already", child.key));
    names_.push_back(child.key);
  }

  void parameters() {
    const Node* node = names_under("parameters", plant::most_law_parameters);
    if (node == nullptr || node->children.empty()) {
      if (node != nullptr || map_.find("parameters") == nullptr)
        bad(node != nullptr ? node->place : map_.place,
            "the key parameters is missing, or empty: the first parameter is the law's size");
      return;
    }
    const std::size_t count = std::min(node->children.size(), plant::most_law_parameters);
    for (std::size_t i = 0; i < count; ++i) parameter(node->children[i], i);
  }
  void parameter(const Node& node, std::size_t index) {
    const std::size_t errors_before = problems_.errors();
    WrittenParameter written;
    read_struct(source_, node, written, problems_);
    if (problems_.errors() > errors_before) return;
    const auto say = [&](std::string_view key, std::string message) {
      bad(node.find(key)->place, fmt::format("{} = {}: {}", key, shortened(node.find(key)->text), message));
    };
    const auto unit = unit_size(written.unit);
    if (!unit) return say("unit", "is not a unit");
    if (written.range.size() != 2 || !(written.range[0] < written.range[1]))
      return bad(node.find("range")->place, "range must be [lowest, highest]");
    const double low = written.range[0], high = written.range[1];
    const auto inside = [&](double value) { return value >= low && value <= high; };
    const std::string range = fmt::format("{:g} to {:g}", low, high);
    if (index == 0 && !inside(0.0))
      return bad(node.find("range")->place,
                 fmt::format("the range {} must hold 0: {} is the law's size, and at 0 the law is absent",
                             range, node.key));
    if (!inside(written.typical)) return say("typical", fmt::format("is out of the range {}", range));
    if (index == 0 && written.typical == 0.0)
      return say("typical", "is the law's size, which is 0 where it is absent");
    if (written.value && !inside(*written.value))
      return say("value", fmt::format("is out of the range {}", range));
    law_.values[index] = written.value.value_or(index == 0 ? 0.0 : written.typical) * unit->size;
    text_.parameters.push_back({node.key, unit->dimension.unit(), written.typical * unit->size,
                                low * unit->size, high * unit->size});
    wording_.parameters.push_back({node.key, unit->dimension});
  }

  void memories() {
    const Node* node = names_under("memories", plant::most_law_memories);
    if (node == nullptr) return;
    for (const Node& child : node->children) {
      if (child.kind != Node::Kind::scalar)
        bad(child.place,
            fmt::format("{} must be a text, its rate of change, not {}", child.key, child.kind_name()));
      wording_.memories.push_back({child.key, child.text});
    }
  }

  std::optional<law::Programs> compile() {
    wording_.adds = written_.adds;
    wording_.law = written_.law;
    std::vector<law::Fault> faults;
    auto programs = law::compile(wording_, unit_size, faults);
    const std::vector<std::string> known = law::known_names(wording_);
    const std::vector<std::string_view> views(known.begin(), known.end());
    for (const law::Fault& fault : faults) {
      const Node& scalar = fault.memory ? map_.find("memories")->children[*fault.memory] : *map_.find("law");
      std::string message = fmt::format("{}: {}", scalar.key, fault.message);
      if (!fault.unknown.empty())
        message += did_you_mean(shortened(fault.unknown), views) + fmt::format(" (known: {})", join(views));
      bad(place_in(source_, scalar, fault.offset), std::move(message));
    }
    return programs;
  }

  void finish(law::Programs programs) {
    text_.name = written_.name;
    text_.sentence = written_.sentence;
    text_.adds = written_.adds;
    text_.at = written_.at;
    text_.law = written_.law;
    text_.program = std::move(programs.law);
    text_.knows_time = programs.knows_time;
    for (std::size_t i = 0; i < programs.memories.size(); ++i) {
      auto& memory = programs.memories[i];
      text_.memories.push_back({wording_.memories[i].name, wording_.memories[i].rate, memory.dimension.unit(),
                                working_size(memory.dimension), std::move(memory.rate)});
    }
    check_vanishes();
  }

  /// Without size there must be nothing: looked at in a few places of the range of use.
  void check_vanishes() {
    std::array<double, plant::most_law_parameters> values{};
    for (std::size_t i = 1; i < text_.parameters.size(); ++i) values[i] = text_.parameters[i].typical;
    for (int i = 0; i < 8; ++i) {
      const double e = 0.01 + 0.03 * i, sign = i % 2 == 0 ? 1.0 : -1.0;
      plant::LawNumbers<double, double> known{
          {e, 0.3 * e, sign * 0.02 * (i + 1), 0.5e5 * (i + 1), 0.45e5 * (i + 1), 15.0 * (i + 1),
           20.0 * (i + 1), 0.55e5 * (i + 1), 0.7 * i},
          values,
          {}};
      for (std::size_t k = 0; k < text_.memories.size(); ++k)
        known.memories[k] = sign * 0.1 * (i + 1) * text_.memories[k].size;
      const double left = plant::value_of(text_.program, known);
      values[0] = text_.parameters[0].typical;
      const double whole = plant::value_of(text_.program, known);
      values[0] = 0.0;
      if (!(std::abs(left) > 1e-9 * std::abs(whole))) continue;
      const std::string& size = text_.parameters[0].name;
      return bad(
          place_of("law"),
          fmt::format("law: with {} = 0 it is {:.3g} {}, not 0; the first parameter, {}, is the law's size: "
                      "without it the law must vanish",
                      size, left, law::dimension_of(text_.adds).unit(), size));
    }
  }

  const Source& source_;
  const Node& map_;
  Problems& problems_;
  WrittenLaw written_;
  law::Wording wording_;
  std::vector<std::string> names_;  ///< of parameters and memories
  plant::LawText text_;
  OwnLaw law_;
};

}  // namespace

OwnLaw read_law(const Source& source, const Node& map, Problems& problems) {
  return LawReader(source, map, problems)();
}

}  // namespace mckibben::input
