// The waveforms' values, and the two controllers that play a formula and a recording.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <utility>

#include <controllers/waveform.hpp>

namespace mckibben::controllers {
namespace {

constexpr double turn = 2.0 * std::numbers::pi;

template <class Shape>
class Player final : public Controller {
 public:
  explicit Player(Shape shape) : shape_(std::move(shape)) {}
  Command rest() override { return {shape_.at(0.0)}; }
  Command step(const Reading& reading) override { return {shape_.at(reading.time_s)}; }

 private:
  Shape shape_;
};

class Recorder final : public Controller {
 public:
  explicit Recorder(std::vector<double> samples_mA) : samples_mA_(std::move(samples_mA)) {}
  Command rest() override { return {samples_mA_.front()}; }
  Command step(const Reading& reading) override {
    const auto last = static_cast<std::int64_t>(samples_mA_.size()) - 1;
    return {samples_mA_[static_cast<std::size_t>(std::clamp<std::int64_t>(reading.tick, 0, last))]};
  }
  bool already_quantised() const override { return true; }

 private:
  std::vector<double> samples_mA_;
};

// Cycles gone by at a time; they stop at the last one.
double cycles_done(double time_s, double delay_s, double period_s, const std::optional<double>& cycles) {
  return std::clamp((time_s - delay_s) / period_s, 0.0,
                    cycles.value_or(std::numeric_limits<double>::infinity()));
}

}  // namespace

double SineCurrent::at(double time_s) const {
  const double phase = turn * cycles_done(time_s, delay_s, period_s, cycles);
  return low_mA + 0.5 * (high_mA - low_mA) * (1.0 - std::cos(phase));
}

double TriangleCurrent::at(double time_s) const {
  const double one_cycle_s =
      speed_mA_per_s ? 2.0 * (high_mA - low_mA) / *speed_mA_per_s : period_s.value_or(1.0);
  const double phase = std::fmod(cycles_done(time_s, delay_s, one_cycle_s, cycles), 1.0);
  return std::lerp(low_mA, high_mA, phase < 0.5 ? 2.0 * phase : 2.0 - 2.0 * phase);
}

void StepCurrent::follow(const CurrentRange& range) {
  if (!start_mA) start_mA = range.lowest_mA;
}

double StepCurrent::at(double time_s) const {
  double current_mA = start_mA.value();
  for (const CurrentMove& move : moves) {
    if (time_s < move.at_s - instant_s) break;
    current_mA = move.to_mA;
  }
  return current_mA;
}

double StairCurrent::at(double time_s) const {
  const double level = std::clamp(std::floor((time_s + instant_s) / dwell_s), 0.0, 2.0 * steps);
  const double above_low = level <= steps ? level : 2.0 * steps - level;
  return std::lerp(low_mA, high_mA, above_low / steps);
}

double ChirpCurrent::at(double time_s) const {
  const double t = std::clamp(time_s, 0.0, lasting_s);
  const double sweep_Hz_per_s = (last_frequency_Hz - first_frequency_Hz) / lasting_s;
  const double phase = turn * t * (first_frequency_Hz + 0.5 * sweep_Hz_per_s * t);
  return 0.5 * (low_mA + high_mA) + 0.5 * (high_mA - low_mA) * std::sin(phase);
}

std::unique_ptr<Controller> SineCurrent::make(const Knowledge&) const {
  return std::make_unique<Player<SineCurrent>>(*this);
}
std::unique_ptr<Controller> TriangleCurrent::make(const Knowledge&) const {
  return std::make_unique<Player<TriangleCurrent>>(*this);
}
std::unique_ptr<Controller> StepCurrent::make(const Knowledge& knowledge) const {
  StepCurrent settings = *this;
  settings.follow(working_range(knowledge));
  return std::make_unique<Player<StepCurrent>>(std::move(settings));
}
std::unique_ptr<Controller> StairCurrent::make(const Knowledge&) const {
  return std::make_unique<Player<StairCurrent>>(*this);
}
std::unique_ptr<Controller> ChirpCurrent::make(const Knowledge&) const {
  return std::make_unique<Player<ChirpCurrent>>(*this);
}
std::unique_ptr<Controller> RecordedCurrent::make(const Knowledge&) const {
  if (samples_mA.empty()) throw std::invalid_argument(name + ": no samples were read from '" + file + "'");
  return std::make_unique<Recorder>(samples_mA);
}

}  // namespace mckibben::controllers
