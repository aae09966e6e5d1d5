// ERKStep over all rigs as one vector of lanes; the worst of them chooses the step. See the header.
#include <algorithm>
#include <array>
#include <stdexcept>

#include <sim/engine/abreast.hpp>
#include <sim/engine/erk_method.hpp>
#include <sim/engine/flock.hpp>
#include <sim/engine/lane_vector.hpp>

namespace mckibben::engine {
namespace {

// Eight rigs in the lanes of each number; where there are fewer, the first one fills them. All go through the
// laws at once unless they differ in more than numbers.
template <bool remembers>
class ErkFlock final : public Flock {
  using L = Layout<1, remembers, Books::none>;
  struct V : LaneVector<L::size> {
    using layout = L;
  };
  using Values = typename V::Values;

 public:
  ErkFlock(std::span<const plant::Plant> plants, double tolerance)
      : count_(plants.size()), together_(abreast(plants)), y_(V::make(context_)) {
    for (const plant::Plant& plant : plants) problems_.emplace_back(plant);
    memory_.reset(ERKStepCreate(right_hand_sides, 0.0, y_.get(), context_));
    if (!memory_) throw std::bad_alloc();
    set_up_erk<V>(memory_.get(), context_, tolerance, this, steps_, message_);
  }

  void advance(std::span<Flow> flows, std::span<const plant::Held> held, double from_s,
               double to_s) override {
    held_ = abreast(held);
    refused_.fill(0);
    for (std::size_t lane = 0; lane < Lanes::count; ++lane) {
      const std::size_t from = lane < count_ ? lane : 0;
      problems_[from].held = held[from];
      std::array<double, L::size> y;
      problems_[from].store(flows[from], y.data());
      put(y, lane, V::values(y_.get()));
    }
    steps_.begin(from_s, to_s);
    void* m = memory_.get();
    message_.clear();
    steps_.reached_s = from_s;
    ERKStepReset(m, from_s, y_.get());
    ERKStepSetStopTime(m, to_s);
    double t = from_s;
    const int flag = ERKStepEvolve(m, to_s, y_.get(), &t, ARK_NORMAL);
    for (std::size_t lane = 0; lane < count_; ++lane)
      problems_[lane].load(of(lane, V::values(y_.get())).data(), flows[lane]);
    if (flag >= 0) return;
    const auto& state = flows[0].state;
    throw NumericalFailure(steps_.reached_s, state,
                           cause_of(erk_trouble(flag), "ERKStep", message_, problems_[0].plant(), state));
  }

  Pace pace() const override { return pace_of(memory_.get(), steps_); }
  void resume(const Pace& pace) override { resume_at(pace, memory_.get(), steps_); }

 private:
  struct Free {
    void operator()(void* memory) const { ERKStepFree(&memory); }
  };

  static void put(const std::array<double, L::size>& one, std::size_t lane, Values& all) {
    for (std::size_t i = 0; i < one.size(); ++i) all[i].set(lane, one[i]);
  }
  static std::array<double, L::size> of(std::size_t lane, const Values& all) {
    std::array<double, L::size> one;
    for (std::size_t i = 0; i < one.size(); ++i) one[i] = all[i][lane];
    return one;
  }

  static int right_hand_sides(double, N_Vector y, N_Vector dydt, void* self) {
    auto& flock = *static_cast<ErkFlock*>(self);
    const Values& from = V::values(y);
    Values& to = V::values(dydt);
    const auto inside = flock.together_ ? flock.rates(from, to) : flock.rates_one_by_one(from, to);
    for (std::size_t lane = 0; lane < Lanes::count; ++lane) {
      if (inside[lane]) continue;
      if (flock.refused_[lane] > most_refused_in_a_tick) return -1;
      std::array<double, L::size> forbidding{};
      forbid(forbidding.data(), flock.refused_[lane]++);
      put(forbidding, lane, to);
    }
    return 0;
  }

  /// Of all lanes; false for those outside the domain of the laws.
  Mask rates(const Values& y, Values& dydt) const {
    Mask inside;
    on_this_machine([&, &plant = *together_] {
      // Each by itself: for a block this long the compiler would take a slow instruction.
      plant::State<Lanes> state;
      state.joint = {y[0], y[1]};
      state.side = {y[2], y[3], y[4]};
      plant::Memory<Lanes> memory;
      for (std::size_t i = 0; i < memory.side.size(); ++i)
        memory.side[i] = remembers ? y[(L::states + i) % L::size] : Lanes(0.0);
      inside = plant.template in_domain<1>(state);
      const auto now = plant.template moment<1>(state, memory, held_);
      const auto slopes = plant.template rates<1>(state, now);
      dydt[0] = slopes.joint.contraction_ratio;
      dydt[1] = slopes.joint.contraction_speed_per_s;
      dydt[2] = slopes.side.valve_pressure_Pa;
      dydt[3] = slopes.side.muscle_pressure_Pa;
      dydt[4] = slopes.side.bristle_m;
      if constexpr (remembers)
        for (std::size_t i = 0; i < memory.side.size(); ++i) dydt[L::states + i] = now.memory_rates[i];
    });
    return inside;
  }

  Mask rates_one_by_one(const Values& y, Values& dydt) const {
    Mask inside{};
    for (std::size_t lane = 0; lane < Lanes::count; ++lane) {
      std::array<double, L::size> rates{};
      if (!problems_[lane < count_ ? lane : 0].rates(of(lane, y).data(), rates.data())) continue;
      inside.set(lane);
      put(rates, lane, dydt);
    }
    return inside;
  }

  std::size_t count_;
  std::optional<plant::PlantOf<Lanes>> together_;
  plant::HeldOf<Lanes> held_;
  std::array<long, Lanes::count> refused_{};
  std::vector<Problem<L>> problems_;
  Context context_;
  std::string message_;
  Vector y_;
  std::unique_ptr<void, Free> memory_;
  EvenSteps steps_;
};

}  // namespace

std::unique_ptr<Flock> make_flock(std::span<const plant::Plant> plants, double tolerance) {
  if (plants.empty() || plants.size() > Flock::most) throw std::invalid_argument("a flock has 1 to 8 rigs");
  if (std::any_of(plants.begin(), plants.end(), [](const auto& rig) { return rig.has_events(); }))
    throw std::invalid_argument("exact stick and slip (memory: coulomb) has no common steps");
  if (std::any_of(plants.begin(), plants.end(), [](const auto& rig) { return rig.opposite().has_value(); }))
    throw std::invalid_argument("pairs of muscles have no common steps");
  const bool remembers =
      std::any_of(plants.begin(), plants.end(), [](const auto& rig) { return rig.remembers(); });
  if (remembers) return std::make_unique<ErkFlock<true>>(plants, tolerance);
  return std::make_unique<ErkFlock<false>>(plants, tolerance);
}

}  // namespace mckibben::engine
