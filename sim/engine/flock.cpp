// ERKStep over all rigs as one long vector; the worst of them chooses the step. See the header.
#include <algorithm>
#include <array>
#include <stdexcept>

#include <sim/engine/erk_method.hpp>
#include <sim/engine/flock.hpp>

namespace mckibben::engine {
namespace {

template <bool remembers, int lanes>
class ErkFlock final : public Flock {
  using L = Layout<1, remembers, Books::none>;
  struct V : FixedVector<L::size * lanes, L::steering, lanes> {
    using layout = L;
  };

 public:
  ErkFlock(std::span<const plant::Plant> plants, double tolerance) : y_(V::make(context_)) {
    // Where there are fewer rigs than lanes, the first one fills them.
    for (int lane = 0; lane < lanes; ++lane)
      problems_.emplace_back(
          plants[static_cast<std::size_t>(lane) < plants.size() ? static_cast<std::size_t>(lane) : 0]);
    count_ = plants.size();
    memory_.reset(ERKStepCreate(right_hand_sides, 0.0, y_.get(), context_));
    if (!memory_) throw std::bad_alloc();
    set_up_erk<V>(memory_.get(), context_, tolerance, this, steps_, message_);
  }

  void advance(std::span<Flow> flows, std::span<const plant::Held> held, double from_s,
               double to_s) override {
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      const std::size_t from = lane < count_ ? lane : 0;
      problems_[lane].held = held[from];
      problems_[lane].refused = 0;
      problems_[lane].store(flows[from], values(lane));
    }
    steps_.begin(from_s, to_s);
    void* m = memory_.get();
    message_.clear();
    steps_.reached_s = from_s;
    ERKStepReset(m, from_s, y_.get());
    ERKStepSetStopTime(m, to_s);
    double t = from_s;
    const int flag = ERKStepEvolve(m, to_s, y_.get(), &t, ARK_NORMAL);
    for (std::size_t lane = 0; lane < count_; ++lane) problems_[lane].load(values(lane), flows[lane]);
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

  double* values(std::size_t lane) { return V::data(y_.get()) + lane * L::size; }

  static int right_hand_sides(double, N_Vector y, N_Vector dydt, void* self) {
    auto& flock = *static_cast<ErkFlock*>(self);
    const double* from = V::data(y);
    double* to = V::data(dydt);
    for (auto& problem : flock.problems_) {
      if (!problem.rates(from, to)) {
        if (problem.refused > most_refused_in_a_tick) return -1;
        std::fill_n(to, L::size, 0.0);
        forbid(to, problem.refused++);
      }
      from += L::size;
      to += L::size;
    }
    return 0;
  }

  Context context_;
  std::vector<Problem<L>> problems_;
  std::size_t count_ = 0;
  std::string message_;
  Vector y_;
  std::unique_ptr<void, Free> memory_;
  EvenSteps steps_;
};

template <bool remembers>
std::unique_ptr<Flock> of_size(std::span<const plant::Plant> plants, double tolerance) {
  if (plants.size() == 1) return std::make_unique<ErkFlock<remembers, 1>>(plants, tolerance);
  if (plants.size() == 2) return std::make_unique<ErkFlock<remembers, 2>>(plants, tolerance);
  if (plants.size() <= 4) return std::make_unique<ErkFlock<remembers, 4>>(plants, tolerance);
  return std::make_unique<ErkFlock<remembers, 8>>(plants, tolerance);
}

}  // namespace

std::unique_ptr<Flock> make_flock(std::span<const plant::Plant> plants, double tolerance) {
  if (plants.empty() || plants.size() > Flock::most) throw std::invalid_argument("a flock has 1 to 8 rigs");
  if (std::any_of(plants.begin(), plants.end(), [](const auto& rig) { return rig.has_events(); }))
    throw std::invalid_argument("exact stick and slip (memory: coulomb) has no common steps");
  if (std::any_of(plants.begin(), plants.end(), [](const auto& rig) { return rig.opposite().has_value(); }))
    throw std::invalid_argument("pairs of muscles have no common steps");
  const bool remembers =
      std::any_of(plants.begin(), plants.end(), [](const auto& rig) { return rig.remembers(); });
  return remembers ? of_size<true>(plants, tolerance) : of_size<false>(plants, tolerance);
}

}  // namespace mckibben::engine
