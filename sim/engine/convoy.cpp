// ERKStep over all places as one vector, whose time is counted in steps: s -> s + 1 takes each rig h further,
// its own h, since dy/ds = h dy/dt. The library sees a norm that always passes; here each rig's own error
// accepts or takes back what it did, before the library goes on.
#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <sim/engine/abreast.hpp>
#include <sim/engine/convoy.hpp>
#include <sim/engine/erk_method.hpp>
#include <sim/engine/lane_problem.hpp>

namespace mckibben::engine {
namespace {

template <bool remembers>
class ErkConvoy final : public Convoy {
  using Lane = LaneProblem<remembers>;
  using L = typename Lane::L;
  using V = typename Lane::V;
  using One = typename Lane::One;
  static constexpr std::size_t blocks = places / Lanes::count;

 public:
  explicit ErkConvoy(double tolerance)
      : y_(V::make(context_, blocks, &errors_)), reached_(N_VClone(y_.get())) {
    memory_.reset(ERKStepCreate(right_hand_sides, 0.0, y_.get(), context_));
    if (!memory_) throw std::bad_alloc();
    void* m = memory_.get();
    set_up_erk<V>(m, y_.get(), tolerance, this, message_);
    ERKStepSetSafetyFactor(m, safety);
    ERKStepSetAdaptivityFn(
        m,
        [](N_Vector, double, double, double, double, double, double, double, int, int, double* next, void*) {
          *next = 1.0 / safety;
          return 0;
        },
        nullptr);
    ERKStepSetPostprocessStepFn(m, after_step);
  }

  void board(std::size_t place, const plant::Plant& plant) override {
    if (plants_.empty()) {  // places that stay empty need a rig too
      plants_.assign(places, plant);
      One y;
      Problem<L>::store({.state = plant.at_rest({})}, y.data());
      for (std::size_t i = 0; i < places; ++i) {
        Lane::put(y, i, y_.get());
        Lane::put(y, i, reached_.get());
      }
    }
    plants_[place] = plant;
    together_[place / Lanes::count].reset();
    ways_[place] = {};
  }

  void set_off(std::size_t place, Bound bound, double from_s, double to_s) override {
    Way& way = ways_[place];
    way.bound = bound;
    way.at_s = from_s;
    way.from_s = from_s;
    way.to_s = to_s;
    way.refused = way.steps = 0;
    if (way.pace.step_s == 0.0) way.pace.step_s = first_step * (to_s - from_s);
    // The rule has divided the tick that was; this one may be longer or shorter.
    const double parts = std::ceil((to_s - from_s) / way.pace.step_s * (1.0 - PiRule::nothing));
    way.pace.step_s = (to_s - from_s) / std::max(1.0, parts);
    put(*bound.held, place % Lanes::count, held_[place / Lanes::count]);
    One y;
    Problem<L>::store(*bound.flow, y.data());
    Lane::put(y, place, current_);
    Lane::put(y, place, reached_.get());
    h_[place / Lanes::count].set(place % Lanes::count, way.pace.step_s);
    if (!way.under_way) ++under_way_;
    way.under_way = true;
  }

  void go(const Arrived& arrived) override {
    arrived_ = &arrived;
    gather();
    void* m = memory_.get();
    double s = 0.0;
    ERKStepReset(m, s, y_.get());
    ERKStepSetInitStep(m, 1.0);
    while (under_way_ > 0) {
      const int flag = ERKStepEvolve(m, s + 1.0, y_.get(), &s, ARK_ONE_STEP);
      if (thrown_) std::rethrow_exception(std::exchange(thrown_, nullptr));
      if (flag < 0) throw std::logic_error("ERKStep in a convoy: " + message_);
    }
    current_ = y_.get();
  }

  Counters counters(std::size_t place) const override { return ways_[place].counters; }
  Pace pace(std::size_t place) const override { return ways_[place].pace; }

 private:
  /// What a rig is about.
  struct Way {
    Bound bound{};
    double at_s = 0.0, from_s = 0.0, to_s = 0.0;
    Pace pace{};
    Counters counters{};
    long refused = 0, steps = 0;  ///< on this way
    bool under_way = false;
  };

  static constexpr double safety = 0.5;       // so much the library takes of what it is told; it refuses 1
  static constexpr double first_step = 0.05;  // of a tick; the error decides soon
  static constexpr long stages = 6;

  static int right_hand_sides(double, N_Vector y, N_Vector dyds, void* self) {
    static_cast<ErkConvoy*>(self)->rates(y, dyds);
    return 0;
  }

  void rates(N_Vector y, N_Vector dyds) {
    for (std::size_t block = 0; block < blocks; ++block) {
      const std::size_t first = block * Lanes::count;
      if (std::none_of(&ways_[first], &ways_[first] + Lanes::count,
                       [](const Way& w) { return w.under_way; })) {
        for (std::size_t i = 0; i < L::size; ++i) Lane::at(dyds, i, block) = Lanes(0.0);
        continue;
      }
      const Mask inside = Lane::rates(*together_[block], held_[block], y, dyds, block);
      on_this_machine([&] {
        for (std::size_t i = 0; i < L::size; ++i)
          Lane::at(dyds, i, block) = Lane::at(dyds, i, block) * h_[block];
      });
      for (std::size_t lane = 0; lane < Lanes::count; ++lane) {
        if (inside[lane]) continue;
        Way& way = ways_[first + lane];
        One forbidding{};
        if (way.under_way) forbid(forbidding.data(), way.refused++);
        Lane::put(forbidding, first + lane, dyds);
      }
    }
  }

  static int after_step(double, N_Vector y, void* self) {
    auto& convoy = *static_cast<ErkConvoy*>(self);
    try {
      convoy.judge(y);
      return 0;
    } catch (...) {  // not through the library
      convoy.thrown_ = std::current_exception();
      return -1;
    }
  }

  /// Takes back what is not good enough; then tells who arrived.
  void judge(N_Vector y) {
    on_this_machine([&] {
      for (std::size_t block = 0; block < blocks; ++block) {
        const Mask good = errors_[block] <= Lanes(1.0);
        for (std::size_t i = 0; i < L::size; ++i) {
          Lanes& reached = Lane::at(reached_.get(), i, block);
          reached = Lane::at(y, i, block) = select(good, Lane::at(y, i, block), reached);
        }
      }
    });
    current_ = y;
    for (std::size_t place = 0; place < places; ++place)
      if (ways_[place].under_way) judge(place, y);
    gather();
  }

  /// The rigs of blocks in which one has boarded, as one.
  void gather() {
    for (std::size_t block = 0; block < blocks && !plants_.empty(); ++block) {
      if (together_[block]) continue;
      together_[block] = abreast(std::span(plants_).subspan(block * Lanes::count, Lanes::count));
      if (!together_[block]) throw std::logic_error("rigs of a convoy must be of one kind");
    }
  }

  void judge(std::size_t place, N_Vector y) {
    Way& way = ways_[place];
    double error = errors_[place / Lanes::count][place % Lanes::count];
    if (!std::isfinite(error)) error = hopeless;
    const double tick_s = way.to_s - way.from_s, h = way.pace.step_s;
    way.counters.right_hand_sides += stages;
    ++way.steps;
    if (error <= 1.0) {
      ++way.counters.steps;
      way.at_s += h;
    } else {
      ++way.counters.rejected_steps;
    }
    PiRule rule{way.pace.log_of_last_error};
    const double left_s = way.to_s - way.at_s;
    way.pace.step_s = rule.next(h, error, left_s, tick_s);
    way.pace.log_of_last_error = rule.log_of_last_error;
    const bool over = left_s <= PiRule::nothing * tick_s;
    const bool stuck = way.steps > most_steps_in_a_tick || way.refused > most_refused_in_a_tick ||
                       way.at_s + way.pace.step_s == way.at_s;
    if (!over && !stuck) {
      h_[place / Lanes::count].set(place % Lanes::count, way.pace.step_s);
      return;
    }
    if (over) {
      Problem<L>::load(Lane::of(place, y).data(), *way.bound.flow);
      ++way.pace.ticks;
    }
    way.under_way = false;
    --under_way_;
    h_[place / Lanes::count].set(place % Lanes::count, 0.0);
    (*arrived_)(place, over);
  }

  static constexpr double hopeless = 1e10;  // error of a step into what is no number

  std::array<Way, places> ways_{};
  std::vector<plant::Plant> plants_;
  std::array<std::optional<plant::PlantOf<Lanes>>, blocks> together_;  // of the plants
  std::array<plant::HeldOf<Lanes>, blocks> held_;
  std::vector<Lanes> errors_ = std::vector<Lanes>(blocks, Lanes(0.0));  // of the last step, 1 = tolerance
  std::array<Lanes, blocks> h_ = all_zero();
  std::size_t under_way_ = 0;
  const Arrived* arrived_ = nullptr;
  std::exception_ptr thrown_;
  Context context_;
  std::string message_;
  Vector y_, reached_;           // where all are, and where they were before the step
  N_Vector current_ = y_.get();  // what the library works on
  ErkMemory memory_;

  static std::array<Lanes, blocks> all_zero() {
    std::array<Lanes, blocks> zero;
    zero.fill(Lanes(0.0));
    return zero;
  }
};

}  // namespace

std::unique_ptr<Convoy> make_convoy(bool remembers, double tolerance) {
  if (remembers) return std::make_unique<ErkConvoy<true>>(tolerance);
  return std::make_unique<ErkConvoy<false>>(tolerance);
}

bool can_join_a_convoy(const plant::Rig& rig) {
  return rig.friction.memory == plant::FrictionMemory::lugre;
}

}  // namespace mckibben::engine
