// Reading of campaigns, and the rules that need more than one field; see the header.
#include <cmath>
#include <unordered_map>

#include <fmt/format.h>

#include <sim/input/campaign_file.hpp>
#include <sim/input/common_checks.hpp>
#include <sim/input/fields_json.hpp>
#include <sim/input/file_names.hpp>
#include <sim/input/rigs.hpp>
#include <sim/input/variation_file.hpp>
#include <sim/input/yaml_reader.hpp>

namespace mckibben::input {
namespace {

// Names of runs are longer by load and repeat, and must still be file-safe.
constexpr std::size_t longest_current_name = 80;

/// That of its one waveform, if it has a name; otherwise its place.
std::string default_name(const std::optional<CampaignWaveform>& waveform, std::size_t place,
                         std::size_t count) {
  if (waveform) {
    const auto [own, kind] = std::visit(
        [](const auto& one) { return std::pair<std::string, std::string_view>(one.name, one.kind); },
        *waveform);
    if (own != kind) return own;
  }
  const std::size_t width = std::max<std::size_t>(2, std::to_string(count).size());
  return fmt::format("c{:0{}}", place + 1, width);
}

/// Keys that are required of one muscle, or of two. `pair`: the rig that was read has two; an entry that has
/// what two need asks for them, too, whatever is wrong with the rig.
void check_keys(const YamlFile& file, bool pair, Problems& problems) {
  const Node* currents = file.root.find("currents");
  if (currents == nullptr || currents->kind != Node::Kind::list) return;
  const auto need = [&](const Node& node, const char* key) {
    if (node.find(key) == nullptr)
      problems.error(file.source, node.place, fmt::format("the key {} is missing", key));
  };
  for (const Node& node : currents->children) {
    if (node.kind != Node::Kind::map || node.find("current") != nullptr) continue;
    if (node.find("current_1") != nullptr || node.find("current_2") != nullptr) pair = true;
    for (const char* key : pair ? std::vector{"current_1", "current_2"} : std::vector{"current"})
      need(node, key);
  }
  if (!pair) need(file.root, "loads");
}

/// What a campaign on two muscles has in place of loads and of one current each.
void check_pair(const YamlFile& file, const Campaign& campaign, Problems& problems) {
  if (!campaign.loads_kg.empty())
    problems.error(file.source, file.root.find("loads")->place,
                   "loads: the rig's two muscles turn a link, no load hangs there; what the link carries is "
                   "the rig's mechanics: link_mass, link_length and link_inertia");
  if (!campaign.vary.absent())
    problems.error(file.source, file.root.find("vary")->place,
                   "vary: rigs are drawn of one muscle only; give each rig of a pair a campaign of its own");
}

/// Whether an entry's currents are for as many muscles as the rig has.
bool fits(const YamlFile& file, const Node& node, bool pair, Problems& problems) {
  for (const char* key : pair ? std::vector{"current"} : std::vector{"current_1", "current_2"})
    if (const Node* wrong = node.find(key)) {
      problems.error(file.source, wrong->place,
                     pair ? "current: the rig has two muscles; give current_1 and current_2"
                          : fmt::format("{}: the rig has one muscle, driven by current; two are rig: "
                                        "thesis_pair, or mechanics: {{kind: pair}}",
                                        key));
      return false;
    }
  return true;
}

void check_currents(const YamlFile& file, Campaign& campaign, Problems& problems) {
  const Node& nodes = *file.root.find("currents");
  if (campaign.rig.valve.seals())
    problems.error(
        file.source, nodes.place,
        "currents: the rig's muscle is sealed (valve: {kind: none}), so that nothing is commanded; a "
        "scenario runs it");
  if (campaign.currents.empty())
    problems.error(file.source, nodes.place, "currents: at least one current is needed");
  const plant::Pair* pair = campaign.rig.pair();
  std::unordered_map<std::string, std::size_t> first;
  for (std::size_t i = 0; i < campaign.currents.size(); ++i) {
    CampaignCurrent& current = campaign.currents[i];
    const Node& node = nodes.children[i];
    if (!fits(file, node, pair != nullptr, problems)) continue;
    const Node* given = node.find("name");
    if (given == nullptr) {
      if (pair == nullptr) given = node.find("current")->find("name");
      current.name = default_name(current.current, i, campaign.currents.size());
    }
    const Place place = given != nullptr ? given->place : node.place;
    const auto [earlier, is_new] = first.try_emplace(current.name, node.place.line);
    if (!is_file_safe(current.name))
      problems.error(file.source, place, fmt::format("name = {}: {}", current.name, file_safe_rule));
    else if (current.name.size() > longest_current_name)
      problems.error(file.source, place,
                     fmt::format("name: {} letters are too many; at most {}", current.name.size(),
                                 longest_current_name));
    else if (!is_new)
      problems.error(file.source, place,
                     fmt::format("the name {} is already that of the current in line {}; give each a name",
                                 current.name, earlier->second));
    if (std::llround(current.duration_s / campaign.rig.tick_s) < 1)
      problems.error(file.source, node.find("duration")->place,
                     fmt::format("duration = {}: shorter than half a tick of {} ms",
                                 node.find("duration")->text, 1e3 * campaign.rig.tick_s));
    const auto complete = [&](const char* key, CampaignWaveform& waveform, const plant::Rig& rig) {
      complete_current(waveform, file.source, *node.find(key), rig, problems);
    };
    if (pair == nullptr) {
      complete("current", *current.current, campaign.rig);
    } else {
      complete("current_1", *current.current_1, campaign.rig);
      complete("current_2", *current.current_2, plant::opposite_rig(campaign.rig));
    }
  }
}

/// Each repeat of an ordinary campaign is files of its own.
void check_repeats(const YamlFile& file, const Campaign& campaign, Problems& problems) {
  constexpr int most_repeats = 10000;
  const Node* given = file.root.find("repeats");
  if (given != nullptr && campaign.vary.absent() && campaign.repeats > most_repeats)
    problems.error(file.source, given->place,
                   fmt::format("repeats = {}: without vary at most {}", given->text, most_repeats));
}

/// A simulation without noise, as a diagnosis makes, stays at the edge of a band that noise shakes it from.
void warn_of_noise_in_band(const YamlFile& file, const Campaign& campaign, Problems& problems) {
  const plant::Valve& valve = campaign.rig.valve;
  const Node* noise = file.root.find("noise");
  if (noise == nullptr || !valve.is_regulator() || valve.dead_band_Pa <= 0.0 ||
      campaign.noise.current_mA <= 0.0)
    return;
  problems.warning(
      file.source, noise->find("current")->place,
      fmt::format(
          "noise of the command shakes the regulator out of the edges of its dead band of {:.3g} mbar; "
          "no model of a diagnosis does that, and creep, drifts or a leak may be found in its place: "
          "leave one of the two out of data in which effects are to be found",
          1e3 * valve.dead_band_Pa / plant::Pa_per_bar));
}

/// What a campaign's rig has besides its base is there to be found.
plant::Rig known_rig(const YamlFile& file, const plant::Rig& rig) {
  const Node* node = file.root.find("rig");
  const plant::Rig base = node == nullptr ? plant::Rig{} : read_base(file.source, *node);
  plant::Rig known = rig;
  known.effects = base.effects;
  known.joint.load_offset_kg = base.joint.load_offset_kg;
  if (plant::Pair* pair = known.pair())
    pair->opposite.effects = base.pair() != nullptr ? base.pair()->opposite.effects : base.effects;
  return known;
}

}  // namespace

Campaign read_campaign(Source source, std::vector<Problem>* warnings) {
  const YamlFile file = parse_yaml(std::move(source));
  Problems problems;
  Campaign campaign;
  campaign.name = made_file_safe(std::filesystem::path(file.source.name()).stem().string());
  constexpr std::string_view also_allowed[] = {"schema"};
  if (begin_file(file, campaign_schema, problems)) {
    read_struct(file.source, file.root, campaign, problems, also_allowed);
    check_keys(file, campaign.rig.pair() != nullptr, problems);
    check_gauge_error(file, campaign.rig, problems);
    read_variation(file, campaign, problems);
  }
  if (problems.errors() == 0) {
    check_name(file, campaign.name, problems);
    if (campaign.rig.pair() != nullptr) {
      check_pair(file, campaign, problems);
    } else {
      check_lifts_a_load(file, campaign.rig, problems);
      if (file.root.find("loads") != nullptr)  // else its currents are for two muscles, which is said below
        check_loads(file, campaign.loads_kg, campaign.rig, problems);
    }
    check_currents(file, campaign, problems);
    check_repeats(file, campaign, problems);
    warn_of_noise_in_band(file, campaign, problems);
  }
  problems.raise(campaign.inputs, warnings);
  campaign.known = known_rig(file, campaign.rig);
  return campaign;
}

Campaign read_campaign(const std::filesystem::path& path, std::vector<Problem>* warnings) {
  return read_campaign(Source::load(path, largest_yaml_bytes), warnings);
}

Json campaign_json(const Campaign& campaign) {
  return file_json(campaign_schema, campaign);
}

}  // namespace mckibben::input
