// Edges of valves; see the header.
#include <algorithm>
#include <cmath>

#include <sim/ride/past.hpp>
#include <sim/ride/switch.hpp>

namespace mckibben::ride {
namespace {

constexpr double never_s = std::numeric_limits<double>::infinity();

}  // namespace

void Switch::ask(bool want, double now_s, const plant::Valve& valve) {
  if (want != wanted) {
    wanted = want;
    at_s = want == open ? never_s : now_s + (want ? valve.opening_delay_s : valve.closing_delay_s);
  }
  if (at_s > now_s + same_instant_s) return;
  open = wanted;
  at_s = never_s;
}

void Switches::follow(const plant::Side& side, double current_mA, double now_s, plant::HeldSide& held) {
  const plant::Valve& valve = side.rig().valve;
  const bool either = valve.ports == plant::Ports::three;
  const double way = valve.way(current_mA), duty = either ? way : std::abs(2.0 * way - 1.0);
  if (valve.switching == plant::Switching::averaged) {
    held.fills = either || way > 0.5 ? duty : 0.0;
    held.vents = either ? 1.0 - duty : way < 0.5 ? duty : 0.0;
    return;
  }
  bool on = duty > (either ? 0.5 : 1.0 / 3.0);
  if (valve.switching == plant::Switching::pwm) {
    const double period_s = 1.0 / valve.pwm_frequency_Hz;
    const double begun_s = std::floor((now_s + same_instant_s) / period_s) * period_s;
    const double off_s = begun_s + duty * period_s;
    on = now_s + same_instant_s < off_s;
    edge_s = on && duty < 1.0 ? off_s : begun_s + period_s;
  }
  fill.ask(on && (either || way > 0.5), now_s, valve);
  vent.ask(on && !either && way < 0.5, now_s, valve);
  held.fills = fill.open ? 1.0 : 0.0;
  held.vents = either ? 1.0 - held.fills : vent.open ? 1.0 : 0.0;
}

double Switches::next_s() const {
  return std::min({fill.at_s, vent.at_s, edge_s});
}

}  // namespace mckibben::ride
