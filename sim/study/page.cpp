// See the header.
#include <fmt/format.h>

#include <sim/study/page.hpp>

namespace mckibben::study {

namespace {

/// Whether it is the campaign whose pages are checked in: `docs/studies`, which a test keeps up to date.
bool is_shipped(const domain::Campaign& campaign) {
  return campaign.inputs.size() == 1 && campaign.inputs.front().sha256 == MCKIBBEN_THESIS_CAMPAIGN_SHA256;
}

}  // namespace

std::string table(const std::vector<std::vector<std::string>>& rows) {
  std::string text;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    text += '|';
    for (const auto& cell : rows[r]) text += ' ' + cell + " |";
    text += '\n';
    if (r > 0) continue;
    text += '|';
    for (std::size_t c = 0; c < rows[r].size(); ++c) text += c == 0 ? "---|" : "---:|";
    text += '\n';
  }
  return text + '\n';
}

std::string text_of(const thesis::Estimate& estimate, double factor) {
  std::string text =
      fmt::format("{:.3g} +- {:.1g}", factor * estimate.value, factor * estimate.standard_error);
  return estimate.determined() ? text : text + " (" + estimate.why_not + ")";
}

std::string bias_and_spread(const Tally& tally) {
  return fmt::format("{:+.2f} +- {:.2f}", tally.mean(), tally.deviation());
}

input::Json json_of(const Tally& tally) {
  return {{"mean", tally.mean()}, {"standard_deviation", tally.deviation()}, {"rows", tally.count()}};
}

std::string heading(const Evidence& evidence, const std::string& name, const std::string& title) {
  const auto& grid = evidence.from_current.grid;
  std::string text = fmt::format("# {}\n\n", title);
  text += fmt::format(
      "Made by `mckibben study {0}` from the campaign `{1}`, {2} runs: loads from {3:g} to {4:g} kg, current "
      "speeds nu from {5:.1f} to {6:.1f} mA/s. Every number on this page is "
      "computed{8}.\n\n![{7}]({0}.svg)\n\n",
      name, evidence.campaign.name, evidence.dataset.runs.size(), grid.loads_kg.front(), grid.loads_kg.back(),
      grid.speeds_mA_per_s.front(), grid.speeds_mA_per_s.back(), title,
      is_shipped(evidence.campaign) ? "; a test makes the page again and compares" : "");
  for (const auto& id : evidence.failed) text += fmt::format("Run {} failed and is left out.\n\n", id);
  return text;
}

}  // namespace mckibben::study
