// `normal MIDDLE ± DEVIATION`, `uniform LOW .. HIGH`; see the header. All that can be drawn must be within
// the documented range of the number, so that no draw is ever refused for it.
#include <algorithm>
#include <optional>
#include <string_view>

#include <fmt/format.h>

#include <sim/domain/rig_number.hpp>
#include <sim/input/field_kinds.hpp>
#include <sim/input/number.hpp>
#include <sim/input/quantity.hpp>
#include <sim/input/suggest.hpp>
#include <sim/input/utf8.hpp>
#include <sim/input/variation_file.hpp>

namespace mckibben::input {
namespace {

using domain::RigNumber, domain::Varied;

constexpr const char* sampling_key = "sampling";

struct Parts {
  std::string_view left, right;
};

/// What stands on both sides of a sign.
std::optional<Parts> parted(std::string_view text, std::string_view sign) {
  const auto at = text.find(sign);
  if (at == std::string_view::npos) return std::nullopt;
  return Parts{trimmed(text.substr(0, at)), trimmed(text.substr(at + sign.size()))};
}

Usual usual(const RigNumber& number) {
  return {*number.value, number.lowest, number.highest};
}

std::string how_to(const RigNumber& number) {
  const double middle = *number.value != 0.0 ? *number.value : 0.5 * (number.lowest + number.highest);
  const std::string shown = show_limit(middle, number.unit);
  return fmt::format(
      "it must be `normal MIDDLE ± DEVIATION` or `uniform LOW .. HIGH`, for example normal {} ± 1 %", shown);
}

/// Throws BadQuantity for whatever is wrong.
Varied drawn_normal(std::string_view text, const RigNumber& number) {
  auto parts = parted(text, "±");
  if (!parts) parts = parted(text, "+-");
  if (!parts) throw BadQuantity(how_to(number));
  const double middle = read_quantity(parts->left, number.unit, usual(number));
  const double deviation = parts->right.ends_with('%') ? read_quantity(parts->right, "1") * std::abs(middle)
                                                       : read_quantity(parts->right, number.unit);
  if (!(deviation > 0.0))
    throw BadQuantity(fmt::format("the deviation, {}, must be above 0", shortened(parts->right)));
  return Varied::normal(middle, deviation);
}

Varied drawn_uniform(std::string_view text, const RigNumber& number) {
  const auto parts = parted(text, "..");
  if (!parts) throw BadQuantity(how_to(number));
  const auto read = [&](std::string_view end) { return read_quantity(end, number.unit, usual(number)); };
  const double low = read(parts->left), high = read(parts->right);
  if (!(low < high))
    throw BadQuantity(fmt::format("{} must be below {}", shortened(parts->left), shortened(parts->right)));
  return Varied::uniform(low, high);
}

Varied drawn(std::string_view text, const RigNumber& number) {
  const std::string_view whole = trimmed(text);
  const auto gap = whole.find(' ');
  const std::string_view law = whole.substr(0, gap);
  const std::string_view rest = gap == std::string_view::npos ? "" : trimmed(whole.substr(gap));
  if (law != "normal" && law != "uniform") throw BadQuantity(how_to(number));
  Varied found = law == "normal" ? drawn_normal(rest, number) : drawn_uniform(rest, number);
  if (!(found.low >= number.lowest && found.high <= number.highest))
    throw BadQuantity(fmt::format(
        "draws from {} to {}{} leave the range of this number: {} to {}", show_limit(found.low, number.unit),
        show_limit(found.high, number.unit), law == "normal" ? " (4 deviations to either side)" : "",
        show_limit(number.lowest, number.unit), show_limit(number.highest, number.unit)));
  return found;
}

/// Reads the entries of one campaign.
class Reading {
 public:
  Reading(const Source& source, domain::Campaign& campaign, Problems& problems)
      : source_(source),
        campaign_(campaign),
        problems_(problems),
        paths_(domain::paths_of_numbers(campaign.rig)) {}

  void operator()(const Node& entry) {
    if (entry.key == sampling_key) return sampling(entry);
    const RigNumber number = domain::find_number(campaign_.rig, entry.key);
    if (number.value == nullptr) return unknown(entry);
    if (entry.key == "tick")
      return bad(entry.key_place, "tick cannot be drawn: the times of all runs are the same");
    if (entry.kind != Node::Kind::scalar) return bad(entry.place, entry.key + ": " + how_to(number));
    try {
      Varied found = drawn(entry.text, number);
      found.path = entry.key;
      found.unit = number.unit;
      campaign_.vary.numbers.push_back(std::move(found));
    } catch (const BadQuantity& error) {
      bad(entry.place, fmt::format("{} = {}: {}", entry.key, shortened(entry.text), error.what()));
    }
  }

 private:
  void bad(Place place, std::string message) { problems_.error(source_, place, std::move(message)); }

  void sampling(const Node& entry) {
    const auto choices = spellings<domain::Sampling>();
    const auto found = std::find(choices.begin(), choices.end(), entry.text);
    if (found == choices.end())
      return bad(entry.place, fmt::format("{} = {} is not one of: {}", sampling_key, shortened(entry.text),
                                          join(choices)));
    campaign_.vary.sampling =
        names(domain::Sampling{})[static_cast<std::size_t>(found - choices.begin())].first;
  }

  void unknown(const Node& entry) {
    const std::vector<std::string_view> known(paths_.begin(), paths_.end());
    bad(entry.key_place,
        fmt::format("{} is no number of the rig{}; name it by its keys in a rig file, such as "
                    "muscle.rest_radius",
                    shortened(entry.key), did_you_mean(entry.key, known)));
  }

  const Source& source_;
  domain::Campaign& campaign_;
  Problems& problems_;
  std::vector<std::string> paths_;
};

}  // namespace

void read_variation(const YamlFile& file, domain::Campaign& campaign, Problems& problems) {
  const Node* node = file.root.find("vary");
  if (node == nullptr || node->kind == Node::Kind::null) return;  // said already
  const auto names_a_number = [](const Node& entry) { return entry.key != sampling_key; };
  if (node->kind != Node::Kind::map ||
      std::none_of(node->children.begin(), node->children.end(), names_a_number)) {
    problems.error(
        file.source, node->place,
        "vary must be a map of numbers of the rig, such as {muscle.rest_radius: normal 7.5 mm ± 1 %}");
    return;
  }
  Reading read(file.source, campaign, problems);
  for (const Node& entry : node->children) read(entry);
}

}  // namespace mckibben::input
