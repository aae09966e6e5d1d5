// Plan, blocks, file and end of an ensemble; see the header.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <sim/engine/versions.hpp>
#include <sim/input/campaign_file.hpp>
#include <sim/input/hash.hpp>
#include <sim/output/campaign_json.hpp>
#include <sim/output/ensemble_folder.hpp>
#include <sim/output/grid.hpp>
#include <sim/output/json_parts.hpp>
#include <sim/output/manifest.hpp>
#include <sim/output/run_files.hpp>

namespace mckibben::output {
namespace fs = std::filesystem;
namespace {

using input::Json;

constexpr const char *ensemble_file = "ensemble.nc", *document_file = "ensemble.json";
constexpr std::size_t most_failures_told = 20;

/// Everything that the bytes depend on.
Json plan_of(const domain::Campaign& campaign, const run::EnsembleShape& shape, run::Keep keep) {
  return {{"schema", "mckibben-ensemble-plan/2"},
          {"program", {{"mckibben", program_name()}, {"sundials", engine::sundials_version()}}},
          {"campaign_sha256", digest_of(campaign)},
          {"keep", keep == run::Keep::rows ? "rows" : "summary"},
          {"runs", shape.runs},
          {"runs_in_block", shape.in_block}};
}

std::vector<formats::Column> columns_of(const std::vector<run::Kept>& kept) {
  std::vector<formats::Column> columns;
  columns.reserve(kept.size());
  for (const auto& each : kept) columns.push_back({each.name, each.unit, each.meaning, {}});
  return columns;
}

formats::RunsLayout layout_of(const domain::Campaign& campaign, const run::EnsembleShape& shape) {
  std::string currents;
  for (const auto& current : campaign.currents) currents += (currents.empty() ? "" : ", ") + current.name;
  formats::RunsLayout layout{
      campaign.name,
      {{"source", program_name()}, {"seed", std::to_string(campaign.seed)}, {"currents", currents}},
      shape.runs,
      shape.in_block,
      {},
      columns_of(shape.of_run),
      columns_of(shape.of_row)};
  for (std::size_t row = 0; row < shape.rows; ++row)
    layout.time_s.push_back(static_cast<double>(row) * campaign.rig.tick_s);
  return layout;
}

/// What OUT.unfinished with this plan may hold for us to remove it.
FileNames files_in(const fs::path& folder, const std::string& plan) {
  if (plan.find("mckibben-ensemble-plan/") == std::string::npos) return {};
  FileNames names{plan_name, record_name};
  for (const char* name : {ensemble_file, document_file, manifest_name})
    names.insert(std::string("data/") + name);
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(folder / "blocks", none))
    if (const auto name = entry.path().filename();
        name.string().find_first_not_of("0123456789.part") == std::string::npos)
      names.insert("blocks/" + name.string());
  return names;
}

}  // namespace

void Moments::count(double value) {
  if (std::isnan(value)) return;
  lowest = runs == 0 ? value : std::min(lowest, value);
  highest = runs == 0 ? value : std::max(highest, value);
  const double before = value - mean;
  mean += before / static_cast<double>(++runs);
  squares += before * (value - mean);
}

double Moments::deviation() const {
  return runs < 2 ? 0.0 : std::sqrt(squares / static_cast<double>(runs - 1));
}

EnsembleFolder::EnsembleFolder(const fs::path& destination, const domain::Campaign& campaign, run::Keep keep,
                               Say say)
    : ResumedFolder(destination, std::move(say)),
      campaign_(campaign),
      keep_(keep),
      shape_(campaign, keep),
      moments_(shape_.of_run.size()) {
  const auto files = [this](const std::string& plan) { return files_in(unfinished_, plan); };
  open(plan_of(campaign, shape_, keep).dump(2) + "\n", files, campaign.job(), {}, [&](bool kept) {
    fs::create_directories(unfinished_ / "blocks");
    fs::create_directories(unfinished_ / "data");
    if (kept)
      say_(fmt::format("{}: {} of {} runs are there already; going on", unfinished_.string(), runs_there(),
                       shape_.runs));
    into_file([&] { file_.emplace(unfinished_ / "data" / ensemble_file, layout_of(campaign_, shape_)); });
  });
}

fs::path EnsembleFolder::file_of(std::size_t block) const {
  return unfinished_ / "blocks" / std::to_string(block);
}

bool EnsembleFolder::has(std::size_t block) const {
  return fs::exists(file_of(block));
}

std::optional<run::EnsembleBlock> EnsembleFolder::read(const fs::path& path, std::size_t block) const {
  const auto bytes = input::unsealed_bytes(read_regular(path).value_or(""));
  return bytes ? std::optional<run::EnsembleBlock>(std::in_place, shape_, block, *bytes) : std::nullopt;
}

run::EnsembleBlock EnsembleFolder::begin(std::size_t block) const {
  auto left = read(file_of(block).string() + ".part", block);
  return left ? std::move(*left) : run::EnsembleBlock(shape_, block);
}

void EnsembleFolder::put(std::size_t block, const run::EnsembleBlock& runs) const {
  const fs::path file = file_of(block), part = file.string() + ".part";
  write_staged(runs.whole() ? file : part, input::sealed_bytes(runs.bytes()));
  std::error_code ignored;
  if (runs.whole()) fs::remove(part, ignored);
}

// A block that is not as it was written is removed, so that it is made again.
void EnsembleFolder::gather() {
  for (; gathered_ < shape_.blocks() && has(gathered_); ++gathered_) {
    const auto block = read(file_of(gathered_), gathered_);
    if (!block || !block->whole()) {
      fs::remove(file_of(gathered_));
      say_(fmt::format("block {} is not as written, and made again", gathered_));
      return;
    }
    into_file([&] {
      for (std::size_t k = 0; k < shape_.of_run.size(); ++k) file_->put_of_run(k, block->of_run(k));
      for (std::size_t k = 0; k < shape_.of_row.size(); ++k) file_->put_of_row(k, block->of_row(k));
    });
    file_->next(block->size());
    count(*block);
  }
}

void EnsembleFolder::into_file(const std::function<void()>& work) const {
  try {
    work();
  } catch (const formats::BadFile& bad) {
    cannot_write(unfinished_ / "data" / ensemble_file, bad.what());
  }
}

void EnsembleFolder::count(const run::EnsembleBlock& block) {
  for (std::size_t k = 0; k < moments_.size(); ++k)
    for (const double value : block.of_run(k)) moments_[k].count(value);
  for (std::size_t i = 0; i < block.size(); ++i) {
    const std::string& failure = block.failures()[i];
    if (failure.empty()) continue;
    if (++failed_ <= most_failures_told)
      failures_.push_back(run::job_of(campaign_, block.first() + i).id + ": " + failure);
  }
}

std::size_t EnsembleFolder::runs_there() const {
  std::size_t runs = 0;
  for (const auto& entry : fs::directory_iterator(unfinished_ / "blocks")) {
    const std::string name = entry.path().filename().string();
    const std::size_t block = std::strtoull(name.c_str(), nullptr, 10);
    if (is_temporary(entry.path()) || block >= shape_.blocks()) continue;
    if (name.ends_with(".part")) {
      const run::EnsembleBlock part = begin(block);
      for (std::size_t i = 0; i < part.size(); ++i) runs += part.has(part.first() + i) ? 1 : 0;
    } else {
      runs += shape_.size_of(block);
    }
  }
  return runs;
}

std::string EnsembleFolder::document() const {
  Json document = heading_json("mckibben-ensemble/1", campaign_.inputs);
  document["seed"] = campaign_.seed;
  document["tolerance"] = campaign_.rig.integrator.tolerance;
  document["campaign"] = input::campaign_json(campaign_);
  document["keep"] = keep_ == run::Keep::rows ? "rows" : "summary";
  document["runs"] = shape_.runs;
  document["failed"] = failed_;
  document["failures"] = failures_;
  document["numbers"] = Json::array();
  for (std::size_t k = 0; k < moments_.size(); ++k) {
    const Moments& all = moments_[k];
    document["numbers"].push_back({{"name", shape_.of_run[k].name},
                                   {"unit", shape_.of_run[k].unit},
                                   {"runs", all.runs},
                                   {"mean", all.mean},
                                   {"deviation", all.deviation()},
                                   {"lowest", all.lowest},
                                   {"highest", all.highest}});
  }
  return text_of(document);
}

std::string EnsembleFolder::table() const {
  Grid grid({"number", "unit", "mean", "deviation", "lowest", "highest"}, 1);
  const auto shown = [](double value) { return fmt::format("{:.6g}", value); };
  for (std::size_t k = 3; k < moments_.size(); ++k)  // after load, current, repeat
    grid.add({shape_.of_run[k].name, shape_.of_run[k].unit, shown(moments_[k].mean),
              shown(moments_[k].deviation()), shown(moments_[k].lowest), shown(moments_[k].highest)});
  std::string text = fmt::format(
      "{}: {} load{} x {} current{} x {} draws, {} runs, {} failed\n\n{}", campaign_.name,
      campaign_.loads_kg.size(), campaign_.loads_kg.size() == 1 ? "" : "s", campaign_.currents.size(),
      campaign_.currents.size() == 1 ? "" : "s", campaign_.repeats, shape_.runs, failed_, grid.text());
  if (!failures_.empty()) text += "\nfailed\n";
  for (const auto& failure : failures_) text += "  " + failure + "\n";
  if (failed_ > failures_.size()) text += fmt::format("  and {} more\n", failed_ - failures_.size());
  return text;
}

void EnsembleFolder::publish() {
  into_file([&] { file_->finish(); });
  writing(unfinished_, [&] {
    const std::string text = document(), data = "data/";
    write_staged(unfinished_ / data / document_file, text);
    ResumedFolder::publish({{"data", destination_, campaign_.job()}},
                           {{data + document_file, input::sha256_hex(text)},
                            {data + ensemble_file, digest_of(unfinished_ / data / ensemble_file)}});
  });
}

}  // namespace mckibben::output
