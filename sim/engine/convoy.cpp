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

template <bool remembers, Books books>
class ErkConvoy final : public Convoy {
  using Lane = LaneProblem<remembers, 1, books>;
  using L = typename Lane::L;
  using V = typename Lane::V;
  using One = typename Lane::One;
  static constexpr std::size_t most_blocks = places / Lanes::count;

 public:
  ErkConvoy(double tolerance, std::size_t most)
      : blocks_((std::min(most, places) + Lanes::count - 1) / Lanes::count),
        y_(V::make(context_, blocks_, &errors_)),
        reached_(N_VClone(y_.get())) {
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

  void board(std::span<const std::size_t> seats, std::span<const plant::Plant* const> party) override {
    if (plants_.empty()) furnish(*party.front());
    for (const std::size_t place : seats) vacate(lead_[place]);
    Way& way = ways_[seats.front()];
    way = {};
    way.rigs = seats.size();
    for (std::size_t i = 0; i < seats.size(); ++i) {
      const std::size_t place = way.places[i] = seats[i];
      lead_[place] = seats.front();
      plants_[place] = *party[i];
      together_[place / Lanes::count].reset();
    }
  }

  void set_off(std::size_t lead, std::span<const Bound> party, double from_s, double to_s) override {
    Way& way = ways_[lead];
    way.at_s = from_s;
    way.from_s = from_s;
    way.to_s = to_s;
    way.refused = way.steps = 0;
    if (way.pace.step_s == 0.0) way.pace.step_s = first_step * (to_s - from_s);
    // The rule has divided the tick that was; this one may be longer or shorter.
    const double parts = std::ceil((to_s - from_s) / way.pace.step_s * (1.0 - PiRule::nothing));
    way.pace.step_s = (to_s - from_s) / std::max(1.0, parts);
    for (std::size_t i = 0; i < way.rigs; ++i) {
      const std::size_t place = way.places[i];
      way.bound[i] = party[i];
      put(*party[i].held, place % Lanes::count, held_[place / Lanes::count]);
      One y;
      Problem<L>::store(*party[i].flow, y.data());
      Lane::put(y, place, current_);
      Lane::put(y, place, reached_.get());
    }
    set_step(way, way.pace.step_s);
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
  /// What a party is about.
  struct Way {
    std::size_t rigs = 0;
    std::array<std::size_t, wing> places{};
    std::array<Bound, wing> bound{};
    double at_s = 0.0, from_s = 0.0, to_s = 0.0;
    Pace pace{};
    Counters counters{};
    long refused = 0, steps = 0;  ///< on this way
    bool under_way = false;

    bool is_over() const { return to_s - at_s <= PiRule::nothing * (to_s - from_s); }
  };

  static constexpr double safety = 0.5;       // so much the library takes of what it is told; it refuses 1
  static constexpr double first_step = 0.05;  // of a tick; the error decides soon
  static constexpr long stages = 6;
  static constexpr std::size_t nobody = places;

  /// Places that stay empty need a rig too.
  void furnish(const plant::Plant& plant) {
    plants_.assign(blocks_ * Lanes::count, plant);
    lead_.fill(nobody);
    One y;
    Problem<L>::store({.state = plant.at_rest({})}, y.data());
    for (std::size_t i = 0; i < plants_.size(); ++i) {
      Lane::put(y, i, y_.get());
      Lane::put(y, i, reached_.get());
    }
  }

  /// The party of this lead has got off.
  void vacate(std::size_t lead) {
    if (lead == nobody) return;
    for (std::size_t& of : lead_)
      if (of == lead) of = nobody;
  }

  bool goes(std::size_t place) const { return lead_[place] != nobody && ways_[lead_[place]].under_way; }

  void set_step(const Way& way, double step_s) {
    for (std::size_t i = 0; i < way.rigs; ++i)
      h_[way.places[i] / Lanes::count].set(way.places[i] % Lanes::count, step_s);
  }

  static int right_hand_sides(double, N_Vector y, N_Vector dyds, void* self) {
    static_cast<ErkConvoy*>(self)->rates(y, dyds);
    return 0;
  }

  void rates(N_Vector y, N_Vector dyds) {
    for (std::size_t block = 0; block < blocks_; ++block) {
      const std::size_t first = block * Lanes::count;
      if (!any(h_[block] > 0.0)) {  // nobody is under way
        for (std::size_t i = 0; i < L::size; ++i) Lane::at(dyds, i, block) = Lanes(0.0);
        continue;
      }
      const Mask inside = Lane::rates(*together_[block], held_[block], h_[block], y, dyds, block);
      if (!any(!inside)) continue;
      for (std::size_t lane = 0; lane < Lanes::count; ++lane) {
        if (inside[lane]) continue;
        One forbidding{};
        if (goes(first + lane)) forbid(forbidding.data(), ways_[lead_[first + lane]].refused++);
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
    for (const Way& way : ways_)
      if (way.under_way && way.rigs > 1) share_error(way);
    on_this_machine([&] {
      for (std::size_t block = 0; block < blocks_; ++block) {
        const Mask good = errors_[block] <= Lanes(1.0);
        for (std::size_t i = 0; i < L::size; ++i) {
          Lanes& reached = Lane::at(reached_.get(), i, block);
          reached = Lane::at(y, i, block) = select(good, Lane::at(y, i, block), reached);
        }
      }
    });
    current_ = y;
    std::array<std::size_t, places> through{};
    std::size_t count = 0;
    for (std::size_t lead = 0; lead < blocks_ * Lanes::count; ++lead)
      if (ways_[lead].under_way && judge(lead, y)) through[count++] = lead;
    // Only now: who boards has not been under way.
    for (std::size_t i = 0; i < count; ++i) {
      const Way& way = ways_[through[i]];
      (*arrived_)(through[i], way.is_over());
    }
    gather();
  }

  /// The error of the worst is that of all.
  void share_error(const Way& way) {
    double worst = 0.0;
    for (std::size_t i = 0; i < way.rigs; ++i) {
      const double error = errors_[way.places[i] / Lanes::count][way.places[i] % Lanes::count];
      worst = error <= worst ? worst : error;  // nor is it lost where it is no number
      if (!std::isfinite(error)) break;
    }
    for (std::size_t i = 0; i < way.rigs; ++i)
      errors_[way.places[i] / Lanes::count].set(way.places[i] % Lanes::count, worst);
  }

  /// The rigs of blocks in which one has boarded, as one.
  void gather() {
    for (std::size_t block = 0; block < blocks_ && !plants_.empty(); ++block) {
      if (together_[block]) continue;
      together_[block] = abreast(std::span(plants_).subspan(block * Lanes::count, Lanes::count));
      if (!together_[block]) throw std::logic_error("rigs of a convoy must be of one kind");
    }
  }

  /// Whether a party need not be under way any more.
  bool judge(std::size_t lead, N_Vector y) {
    Way& way = ways_[lead];
    double error = errors_[lead / Lanes::count][lead % Lanes::count];
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
    const bool over = way.is_over();
    const bool stuck = way.steps > most_steps_in_a_tick || way.refused > most_refused_in_a_tick ||
                       way.at_s + way.pace.step_s == way.at_s;
    if (!over && !stuck) {
      set_step(way, way.pace.step_s);
      return false;
    }
    if (over) {
      for (std::size_t i = 0; i < way.rigs; ++i)
        Problem<L>::load(Lane::of(way.places[i], y).data(), *way.bound[i].flow);
      ++way.pace.ticks;
    }
    way.under_way = false;
    --under_way_;
    set_step(way, 0.0);
    return true;
  }

  static constexpr double hopeless = 1e10;  // error of a step into what is no number

  std::size_t blocks_;
  std::array<Way, places> ways_{};          // of the party whose first place it is
  std::array<std::size_t, places> lead_{};  // first place of the party that each belongs to
  std::vector<plant::Plant> plants_;
  std::array<std::optional<plant::PlantOf<Lanes>>, most_blocks> together_;  // of the plants
  std::array<plant::HeldOf<Lanes>, most_blocks> held_;
  std::vector<Lanes> errors_ =
      std::vector<Lanes>(most_blocks, Lanes(0.0));  // of the last step, 1 = tolerance
  std::array<Lanes, most_blocks> h_ = all_zero();
  std::size_t under_way_ = 0;
  const Arrived* arrived_ = nullptr;
  std::exception_ptr thrown_;
  Context context_;
  std::string message_;
  Vector y_, reached_;           // where all are, and where they were before the step
  N_Vector current_ = y_.get();  // what the library works on
  ErkMemory memory_;

  static std::array<Lanes, most_blocks> all_zero() {
    std::array<Lanes, most_blocks> zero;
    zero.fill(Lanes(0.0));
    return zero;
  }
};

}  // namespace

std::unique_ptr<Convoy> make_convoy(bool remembers, bool keep_ledger, double tolerance, std::size_t most) {
  const auto make = [&]<bool memory, Books books>() -> std::unique_ptr<Convoy> {
    return std::make_unique<ErkConvoy<memory, books>>(tolerance, most);
  };
  if (keep_ledger)
    return remembers ? make.template operator()<true, Books::isothermal>()
                     : make.template operator()<false, Books::isothermal>();
  return remembers ? make.template operator()<true, Books::none>()
                   : make.template operator()<false, Books::none>();
}

bool can_join_a_convoy(const plant::Rig& rig, bool keep_ledger) {
  const bool isothermal = !rig.effects.warm();
  return rig.friction.memory == plant::FrictionMemory::lugre && (isothermal || !keep_ledger);
}

}  // namespace mckibben::engine
