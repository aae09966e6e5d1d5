// The filter at each tick; see the header.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <controllers/command_filter.hpp>

namespace mckibben::controllers {
namespace {

class Filter {
 public:
  Filter(const Biquad& of, double rest) : of_(of), s0_(rest * (1.0 - of.b0)), s1_(rest * (of.b2 - of.a2)) {}

  double operator()(double u) {
    const double y = of_.b0 * u + s0_;
    s0_ = of_.b1 * u - of_.a1 * y + s1_;
    s1_ = of_.b2 * u - of_.a2 * y;
    return y;
  }

 private:
  Biquad of_;
  double s0_, s1_;
};

class Filtered final : public Controller {
 public:
  Filtered(const Biquad& of, const std::optional<CurrentRange>& limits, std::unique_ptr<Controller> inside)
      : of_(of), limits_(limits), inside_(std::move(inside)), one_(of, 0.0), two_(of, 0.0) {}

  Command rest() override {
    const Command command = inside_->rest();
    one_ = Filter(of_, command.current_mA), two_ = Filter(of_, command.opposite_mA);
    return command;
  }
  std::int64_t preparation_ticks() const override { return inside_->preparation_ticks(); }
  Command step(const Reading& reading) override {
    Command command = inside_->step(reading);
    command = {one_(command.current_mA), two_(command.opposite_mA)};
    if (limits_) command.current_mA = std::clamp(command.current_mA, limits_->lowest_mA, limits_->highest_mA);
    return command;
  }
  std::vector<Finding> findings() const override { return inside_->findings(); }

 private:
  Biquad of_;
  std::optional<CurrentRange> limits_;
  std::unique_ptr<Controller> inside_;
  Filter one_, two_;
};

}  // namespace

Biquad biquad_of(const CommandFilter& filter, double tick_s) {
  const double w = std::tan(std::numbers::pi * filter.frequency_Hz * tick_s), ww = w * w,
               a0 = 1.0 + 2.0 * filter.damping * w + ww, a1 = 2.0 * (ww - 1.0) / a0,
               a2 = (1.0 - 2.0 * filter.damping * w + ww) / a0;
  if (filter.kind == FilterKind::notch) return {(1.0 + ww) / a0, a1, (1.0 + ww) / a0, a1, a2};
  return {ww / a0, 2.0 * ww / a0, ww / a0, a1, a2};
}

std::unique_ptr<Controller> filtered(const CommandFilter& filter, const std::optional<CurrentRange>& limits,
                                     double tick_s, std::unique_ptr<Controller> inside) {
  return std::make_unique<Filtered>(biquad_of(filter, tick_s), limits, std::move(inside));
}

}  // namespace mckibben::controllers
