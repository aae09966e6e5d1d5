// What is kept of an ensemble's runs; see the header.
#include <algorithm>
#include <cmath>
#include <limits>

#include <sim/run/draws.hpp>
#include <sim/run/ensemble.hpp>
#include <sim/run/packed.hpp>
#include <sim/run/simulate.hpp>

namespace mckibben::run {
namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

// A block is read and written at once, and what it was at is lost with a process that dies.
constexpr std::size_t most_in_block = 64, most_block_bytes = 4U << 20U;

struct Metric {
  const char *name, *unit, *meaning;
  double (*of)(const Recording&);
};

double ratio(const Sample& sample) {
  return sample.state.joint.contraction_ratio;
}

template <class Of>
double mean(const Recording& recording, const Of& of) {
  double sum = 0.0;
  for (const Sample& sample : recording.samples) sum += of(sample);
  return sum / static_cast<double>(recording.samples.size());
}

template <class Of>
double largest(const Recording& recording, const Of& of) {
  double most = -std::numeric_limits<double>::infinity();
  for (const Sample& sample : recording.samples) most = std::max(most, of(sample));
  return most;
}

constexpr Metric kept_metrics[] = {
    {"rows", "1", "ticks recorded", [](const Recording& r) { return static_cast<double>(r.samples.size()); }},
    {"smallest_contraction_ratio", "1", "true, at any tick",
     [](const Recording& r) { return -largest(r, [](const Sample& s) { return -ratio(s); }); }},
    {"largest_contraction_ratio", "1", "true, at any tick",
     [](const Recording& r) { return largest(r, ratio); }},
    {"mean_contraction_ratio", "1", "true, over all ticks",
     [](const Recording& r) { return mean(r, ratio); }},
    {"final_contraction_ratio", "1", "true, at the last tick",
     [](const Recording& r) { return ratio(r.samples.back()); }},
    {"largest_contraction_speed", "1/s", "magnitude, at any tick",
     [](const Recording& r) {
       return largest(r, [](const Sample& s) { return std::abs(s.state.joint.contraction_speed_per_s); });
     }},
    {"mean_muscle_pressure", "bar", "true gauge pressure, over all ticks",
     [](const Recording& r) {
       return 1e-5 * mean(r, [](const Sample& s) { return s.state.side.muscle_pressure_Pa; });
     }},
    {"right_hand_sides", "1", "evaluations of the equations that the run took",
     [](const Recording& r) { return static_cast<double>(r.solver.right_hand_sides); }}};

/// As a variable of NetCDF is called: muscle_rest_radius.
std::string variable_of(std::string path) {
  std::replace(path.begin(), path.end(), '.', '_');
  return path;
}

std::vector<Kept> kept_of_runs(const domain::Campaign& campaign) {
  std::vector<Kept> list{{"load", "kg", "mass of the load"},
                         {"current", "1", "place of the current in the campaign, from 0"},
                         {"repeat", "1", "which rig: runs of the same repeat have the same draws"}};
  for (const auto& number : campaign.vary.numbers)
    list.push_back({variable_of(number.path), number.unit, "drawn: " + number.path});
  for (const Metric& metric : kept_metrics) list.push_back({metric.name, metric.unit, metric.meaning});
  return list;
}

/// What is measured but for the time, which all runs share.
std::vector<plant::Channel> channels_of_rows(const plant::Rig& rig) {
  std::vector<plant::Channel> channels = plant::measured_channels(rig, {});
  std::erase_if(channels, [](const auto& channel) { return channel.signal->kind == plant::Kind::time; });
  return channels;
}

std::vector<Kept> kept_of_rows(const plant::Rig& rig) {
  std::vector<Kept> list;
  for (const plant::Channel& channel : channels_of_rows(rig))
    list.push_back({channel.name_in_dataset(), std::string(channel.signal->unit.name), channel.words()});
  return list;
}

}  // namespace

EnsembleShape::EnsembleShape(const domain::Campaign& campaign, Keep keep)
    : runs(count_of_jobs(campaign)), in_block(most_in_block), of_run(kept_of_runs(campaign)) {
  if (keep == Keep::summary) return;
  for (const auto& current : campaign.currents)
    rows = std::max(rows, static_cast<std::size_t>(std::llround(current.duration_s / campaign.rig.tick_s)));
  of_row = kept_of_rows(campaign.rig);
  in_block =
      std::clamp<std::size_t>(most_block_bytes / (rows * of_row.size() * sizeof(float)), 1, most_in_block);
}

EnsembleBlock::EnsembleBlock(const EnsembleShape& shape, std::size_t block)
    : first_(shape.first_of(block)),
      rows_(shape.rows),
      done_(shape.size_of(block), 0),
      of_run_(shape.of_run.size(), std::vector<double>(done_.size(), nothing)),
      of_row_(shape.of_row.size(), std::vector<float>(done_.size() * rows_, static_cast<float>(nothing))),
      failures_(done_.size()) {}

EnsembleBlock::EnsembleBlock(const EnsembleShape& shape, std::size_t block, std::string_view bytes)
    : EnsembleBlock(shape, block) {
  unpack(bytes, *this, members);
}

std::string EnsembleBlock::bytes() const {
  return packed(*this, members);
}

bool EnsembleBlock::whole() const {
  return std::find(done_.begin(), done_.end(), 0) == done_.end();
}

void EnsembleBlock::put(const domain::Campaign& campaign, std::size_t place, const Recording& recording) {
  const CampaignJob job = job_of(campaign, place);
  const std::size_t at = place - first_;
  std::size_t k = 0;
  const auto enter = [&](double value) { of_run_[k++][at] = value; };
  enter(job.load_kg);
  enter(static_cast<double>(job.current));
  enter(job.repeat);
  for (const double value : draws(campaign, job.repeat)) enter(value);
  failures_[at] = recording.failure;
  done_[at] = 1;
  if (!recording.failure.empty()) return;
  for (const Metric& metric : kept_metrics) enter(metric.of(recording));
  const double per_count = contraction_per_count(campaign.rig);
  const std::vector<plant::Channel> channels = channels_of_rows(campaign.rig);
  for (std::size_t row = 0; row < std::min(rows_, recording.samples.size()); ++row) {
    Sample sample = recording.samples[row];
    sample.read_ratio = static_cast<double>(sample.counts) * per_count;  // as its owner believes it
    for (std::size_t c = 0; c < channels.size(); ++c)
      of_row_[c][at * rows_ + row] = static_cast<float>(channels[c].value(sample));
  }
}

}  // namespace mckibben::run
