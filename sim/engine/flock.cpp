// ERKStep over all rigs as one vector of lanes; the worst of them chooses the step. See the header.
#include <algorithm>
#include <array>
#include <stdexcept>

#include <sim/engine/abreast.hpp>
#include <sim/engine/erk_method.hpp>
#include <sim/engine/flock.hpp>
#include <sim/engine/lane_problem.hpp>

namespace mckibben::engine {
namespace {

// Eight rigs in the lanes of each number; where there are fewer, the first one fills them. All go through the
// laws at once unless they differ in more than numbers.
template <bool remembers, int sides>
class ErkFlock final : public Flock {
  using Lane = LaneProblem<remembers, sides>;
  using L = typename Lane::L;
  using V = typename Lane::V;
  using One = typename Lane::One;

 public:
  ErkFlock(std::span<const plant::Plant> plants, double tolerance)
      : plants_(plants.begin(), plants.end()), together_(abreast(plants)), y_(V::make(context_, 1)) {
    for (const plant::Plant& plant : plants_) problems_.emplace_back(plant);
    memory_.reset(ERKStepCreate(right_hand_sides, 0.0, y_.get(), context_));
    if (!memory_) throw std::bad_alloc();
    set_up_erk<V>(memory_.get(), y_.get(), tolerance, this, message_);
    ERKStepSetAdaptivityFn(memory_.get(), EvenSteps::choose, &steps_);
  }

  void advance(std::span<const Bound> bound, double from_s, double to_s) override {
    refused_.fill(0);
    for (std::size_t lane = 0; lane < Lanes::count; ++lane) {
      const std::size_t from = carried(lane);
      problems_[from].held = *bound[from].held;
      put(*bound[from].held, lane, held_);
      One y;
      problems_[from].store(*bound[from].flow, y.data());
      Lane::put(y, lane, y_.get());
    }
    steps_.begin(from_s, to_s);
    void* m = memory_.get();
    message_.clear();
    steps_.reached_s = from_s;
    ERKStepReset(m, from_s, y_.get());
    ERKStepSetStopTime(m, to_s);
    double t = from_s;
    const int flag = ERKStepEvolve(m, to_s, y_.get(), &t, ARK_NORMAL);
    for (std::size_t lane = 0; lane < plants_.size(); ++lane)
      problems_[lane].load(Lane::of(lane, y_.get()).data(), *bound[lane].flow);
    if (flag >= 0) return;
    const auto& state = bound[0].flow->state;
    throw NumericalFailure(steps_.reached_s, state,
                           cause_of(erk_trouble(flag), "ERKStep", message_, problems_[0].plant(), state));
  }

  Pace pace() const override { return pace_of(memory_.get(), steps_); }
  void resume(const Pace& pace) override { resume_at(pace, memory_.get(), steps_); }

 private:
  /// The rig that a lane carries: where there are fewer than lanes, the first one fills them.
  std::size_t carried(std::size_t lane) const { return lane < plants_.size() ? lane : 0; }

  static int right_hand_sides(double, N_Vector y, N_Vector dydt, void* self) {
    auto& flock = *static_cast<ErkFlock*>(self);
    const Mask inside = flock.together_ ? Lane::rates(*flock.together_, flock.held_, 1.0, y, dydt)
                                        : flock.rates_one_by_one(y, dydt);
    for (std::size_t lane = 0; lane < Lanes::count; ++lane) {
      if (inside[lane]) continue;
      if (flock.refused_[lane] > most_refused_in_a_tick) return -1;
      One forbidding{};
      forbid(forbidding.data(), flock.refused_[lane]++);
      Lane::put(forbidding, lane, dydt);
    }
    return 0;
  }

  Mask rates_one_by_one(N_Vector y, N_Vector dydt) const {
    Mask inside{};
    for (std::size_t lane = 0; lane < Lanes::count; ++lane) {
      One rates{};
      if (!problems_[carried(lane)].rates(Lane::of(lane, y).data(), rates.data())) continue;
      inside.set(lane);
      Lane::put(rates, lane, dydt);
    }
    return inside;
  }

  std::vector<plant::Plant> plants_;
  std::optional<plant::PlantOf<Lanes>> together_;
  plant::HeldOf<Lanes> held_;
  std::array<long, Lanes::count> refused_{};
  std::vector<Problem<L>> problems_;
  Context context_;
  std::string message_;
  Vector y_;
  ErkMemory memory_;
  EvenSteps steps_;
};

}  // namespace

std::unique_ptr<Flock> make_flock(std::span<const plant::Plant> plants, double tolerance) {
  if (plants.empty() || plants.size() > Flock::most) throw std::invalid_argument("a flock has 1 to 8 rigs");
  if (std::any_of(plants.begin(), plants.end(), [](const auto& rig) { return rig.has_events(); }))
    throw std::invalid_argument("exact stick and slip (memory: coulomb) has no common steps");
  const bool remembers =
      std::any_of(plants.begin(), plants.end(), [](const auto& rig) { return rig.remembers(); });
  const bool pairs = plants.front().opposite().has_value();
  if (std::any_of(plants.begin(), plants.end(),
                  [&](const auto& rig) { return rig.opposite().has_value() != pairs; }))
    throw std::invalid_argument("a flock is of pairs, or of single muscles");
  if (pairs && remembers) return std::make_unique<ErkFlock<true, 2>>(plants, tolerance);
  if (pairs) return std::make_unique<ErkFlock<false, 2>>(plants, tolerance);
  if (remembers) return std::make_unique<ErkFlock<true, 1>>(plants, tolerance);
  return std::make_unique<ErkFlock<false, 1>>(plants, tolerance);
}

}  // namespace mckibben::engine
