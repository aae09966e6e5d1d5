// See the header.
#include <algorithm>
#include <cmath>
#include <limits>

#include <sim/ride/past.hpp>

namespace mckibben::ride {
namespace {

/// One at the same instant takes the other's place.
template <class Entry>
void append(std::vector<Entry>& entries, const Entry& entry) {
  if (!entries.empty() && entries.back().at_s == entry.at_s)
    entries.back() = entry;
  else
    entries.push_back(entry);
}

/// Throws away all but the last that was there at an instant, and those after it.
template <class Entry>
void forget_before(std::vector<Entry>& entries, double at_s) {
  const auto later =
      std::find_if(entries.begin(), entries.end(), [&](const Entry& each) { return each.at_s > at_s; });
  if (later - entries.begin() > 1) entries.erase(entries.begin(), later - 1);
}

}  // namespace

void PastCommands::begin(double current_mA) {
  given_.assign(1, {-std::numeric_limits<double>::infinity(), current_mA, 0.0});
}

void PastCommands::give(const Given& command) {
  append(given_, command);
}

const Given& PastCommands::felt(double now_s, double late_s) {
  forget_before(given_, now_s - late_s + same_instant_s);
  return given_.front();
}

double PastCommands::next_s(double now_s, double late_s) const {
  const Given* felt = &given_.front();
  for (const Given& each : given_) {
    const bool same = each.current_mA == felt->current_mA && each.speed_mA_per_s == felt->speed_mA_per_s;
    if (each.at_s <= now_s - late_s + same_instant_s)
      felt = &each;
    else if (!same)
      return each.at_s + late_s;
  }
  return std::numeric_limits<double>::infinity();
}

void PastValues::note(double at_s, double value, double slope_per_s, double oldest_s) {
  forget_before(seen_, oldest_s);
  append(seen_, {at_s, value, slope_per_s});
}

double PastValues::at(double at_s) const {
  const auto later =
      std::find_if(seen_.begin(), seen_.end(), [&](const Seen& each) { return each.at_s > at_s; });
  if (later == seen_.begin()) return later->value;
  const Seen& from = *(later - 1);
  if (later == seen_.end() || from.at_s == at_s) return from.value;
  const double length_s = later->at_s - from.at_s, share = (at_s - from.at_s) / length_s, rest = 1.0 - share;
  if (std::isnan(from.slope_per_s)) return rest * from.value + share * later->value;
  return rest * rest * ((1.0 + 2.0 * share) * from.value + share * length_s * from.slope_per_s) +
         share * share * ((1.0 + 2.0 * rest) * later->value - rest * length_s * later->slope_per_s);
}

}  // namespace mckibben::ride
