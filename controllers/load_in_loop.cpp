// One load for each look at the loop; see the header. A rest is explained half way between the branches, as
// the threads may pull either way; a motion by its branch.
#include <algorithm>

#include <controllers/load_in_loop.hpp>

namespace mckibben::controllers {
namespace {

constexpr double settled_s = 0.3;         // of a stretch, before the loop is where the target is
constexpr std::int64_t look_ticks = 8;    // from one look to the next
constexpr std::int64_t fewest_looks = 3;  // of a stretch that counts
constexpr double beyond = 1.5;  // times the calibrated range, on either side: what is still told apart
constexpr int halvings = 12;    // to 1/4000 of that

int sign(double value) {
  return (value > 0.0) - (value < 0.0);
}

}  // namespace

double balanced_mA(const Inverse& inverse, const ValveLine& valve, double contraction_ratio) {
  const auto of = [&](Branch branch) {
    return valve.current_mA(inverse(branch, contraction_ratio, 0.0).pressure_Pa);
  };
  return 0.5 * (of(Branch::contraction) + of(Branch::relaxation));
}

void LoadInLoop::see(std::int64_t tick, std::int64_t counts, double current_mA, bool free) {
  const double speed_per_s =
      (knowledge_.target_at(tick) - knowledge_.target_at(std::max<std::int64_t>(tick - 1, 0))) /
      knowledge_.tick_s;
  if (sign(speed_per_s) != direction_) {
    if (stretch_.times >= fewest_looks) {
      all_.kg += stretch_.kg;
      all_.times += stretch_.times;
    }
    direction_ = sign(speed_per_s);
    stretch_ = {};
    ticks_ = 0;
  }
  const double ratio =
      (static_cast<double>(counts) + knowledge_.middle_of_count) * knowledge_.contraction_per_count;
  const bool inside = ratio >= model_.range.lowest_ratio && ratio <= model_.range.highest_ratio;
  if (++ticks_ % look_ticks != 0 || static_cast<double>(ticks_) * knowledge_.tick_s < settled_s || !free ||
      !inside)
    return;
  stretch_.kg += explained_kg(ratio, speed_per_s, current_mA);
  ++stretch_.times;
}

std::optional<double> LoadInLoop::load_kg() const {
  if (all_.times == 0) return std::nullopt;
  return all_.kg / static_cast<double>(all_.times);
}

// The heavier the load, the more current: by halving.
double LoadInLoop::explained_kg(double ratio, double speed_per_s, double current_mA) const {
  const auto asked_mA = [&](double load_kg) {
    const Inverse inverse(model_, load_kg, knowledge_.valve, false);
    if (speed_per_s == 0.0) return balanced_mA(inverse, knowledge_.valve, ratio);
    const Branch branch = speed_per_s > 0.0 ? Branch::contraction : Branch::relaxation;
    return knowledge_.valve.current_mA(inverse(branch, ratio, speed_per_s).pressure_Pa);
  };
  double light_kg = model_.range.lowest_load_kg / beyond, heavy_kg = model_.range.highest_load_kg * beyond;
  for (int i = 0; i < halvings; ++i) {
    const double middle_kg = 0.5 * (light_kg + heavy_kg);
    (asked_mA(middle_kg) < current_mA ? light_kg : heavy_kg) = middle_kg;
  }
  return 0.5 * (light_kg + heavy_kg);
}

}  // namespace mckibben::controllers
