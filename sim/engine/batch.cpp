// ERKStep over all lanes as one vector, whose time is counted in steps: s -> s + 1 takes each group its own h
// further, since dy/ds = h dy/dt. The library sees a norm that always passes; here each group's own error
// accepts or rejects its step, before the library goes on.
#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <stdexcept>
#include <string>
#include <utility>

#include <sim/engine/batch.hpp>
#include <sim/engine/erk_method.hpp>
#include <sim/engine/lane_problem.hpp>
#include <sim/engine/vectorised.hpp>

namespace mckibben::engine {
namespace {

template <plant::Memories memories, int sides, Books books>
class ErkBatch final : public Batch {
  using Lane = LaneProblem<memories, sides, books>;
  using L = typename Lane::L;
  using V = typename Lane::V;
  using One = typename Lane::One;
  static constexpr std::size_t most_blocks = most_lanes / Lanes::count;

 public:
  ErkBatch(bool mixed, double tolerance, std::size_t lanes)
      : mixed_(mixed),
        blocks_((std::min(lanes, most_lanes) + Lanes::count - 1) / Lanes::count),
        y_(V::make(context_, blocks_, errors_)),
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
    h_.fill(Lanes(0.0));
  }

  std::optional<std::size_t> submit(std::span<const plant::Plant* const> rigs) override {
    if (plants_.empty()) furnish(*rigs.front());
    std::array<std::size_t, width> free{};
    std::size_t count = 0;
    for (std::size_t lane = 0; lane < plants_.size() && count < rigs.size(); ++lane)
      if (group_of_[lane] == nullptr) free[count++] = lane;
    if (count < rigs.size()) return std::nullopt;
    Group& group = groups_[free.front()] = {.rigs = count, .lanes = free};
    for (std::size_t i = 0; i < count; ++i) {
      group_of_[free[i]] = &group;
      plants_[free[i]] = *rigs[i];
      together_[free[i] / Lanes::count].reset();
    }
    return free.front();
  }

  void evict(std::size_t slot) override { std::ranges::replace(group_of_, &groups_[slot], nullptr); }

  void advance(std::size_t slot, std::span<const Bound> bound, double from_s, double to_s) override {
    Group& group = groups_[slot];
    group.at_s = from_s;
    group.from_s = from_s;
    group.to_s = to_s;
    group.refused = group.steps = 0;
    double& step_s = group.pace.step_s;
    if (step_s == 0.0) step_s = first_step * (to_s - from_s);
    // The rule has divided the tick that was; this one may be longer or shorter.
    const double parts = std::ceil((to_s - from_s) / step_s * (1.0 - PiRule::nothing));
    step_s = (to_s - from_s) / std::max(1.0, parts);
    for (std::size_t i = 0; i < group.rigs; ++i) {
      const std::size_t lane = group.lanes[i];
      bound_[lane] = bound[i];
      put(*bound[i].held, lane % Lanes::count, held_[lane / Lanes::count]);
      One y;
      Problem<L>::store(*bound[i].flow, y.data());
      Lane::put(y, lane, current_);
      Lane::put(y, lane, reached_.get());
    }
    set_step(group, step_s);
    if (!group.under_way) ++under_way_;
    group.under_way = true;
  }

  void run(const Arrived& arrived) override {
    arrived_ = &arrived;
    gather();
    void* m = memory_.get();
    double s = 0.0;
    ERKStepReset(m, s, y_.get());
    ERKStepSetInitStep(m, 1.0);
    while (under_way_ > 0) {
      const int flag = ERKStepEvolve(m, s + 1.0, y_.get(), &s, ARK_ONE_STEP);
      if (thrown_) std::rethrow_exception(std::exchange(thrown_, nullptr));
      if (flag < 0) throw std::logic_error("ERKStep in a batch: " + message_);
    }
    current_ = y_.get();
  }

  Counters counters(std::size_t slot) const override { return groups_[slot].counters; }
  Pace pace(std::size_t slot) const override {
    const Group& group = groups_[slot];
    Pace pace = group.pace;
    pace.cost = group.counters.right_hand_sides - group.cost_before;
    return pace;
  }
  void resume(std::size_t slot, const Pace& pace) override {
    Group& group = groups_[slot];
    group.pace = pace;
    group.cost_before = group.counters.right_hand_sides - pace.cost;
  }
  bool is_stiff(std::size_t slot) override {
    Group& group = groups_[slot];
    if (group.pace.ticks % window_ticks != 0) return false;
    const long cost = group.counters.right_hand_sides;
    return cost - std::exchange(group.cost_before, cost) > stiff_cost_per_tick * window_ticks;
  }

 private:
  struct Group {
    std::size_t rigs = 0;
    std::array<std::size_t, width> lanes{};
    double at_s = 0.0, from_s = 0.0, to_s = 0.0;
    Pace pace{};
    Counters counters{};
    long cost_before = 0;         ///< at the last look whether it is stiff
    long refused = 0, steps = 0;  ///< of this advance
    bool under_way = false;

    bool is_over() const { return to_s - at_s <= PiRule::nothing * (to_s - from_s); }
  };

  static constexpr double safety = 0.5;       // so much the library takes of what it is told; it refuses 1
  static constexpr double first_step = 0.05;  // of a tick; the error decides soon
  static constexpr long stages = 6;
  static constexpr double hopeless = 1e10;  // error of a step into what is no number

  /// Lanes that stay empty need a rig too.
  void furnish(const plant::Plant& plant) {
    plants_.assign(blocks_ * Lanes::count, plant);
    One y;
    Problem<L>::store({.state = plant.at_rest({})}, y.data());
    for (std::size_t i = 0; i < plants_.size(); ++i) {
      Lane::put(y, i, y_.get());
      Lane::put(y, i, reached_.get());
    }
  }

  void set_step(const Group& group, double step_s) {
    for (std::size_t i = 0; i < group.rigs; ++i)
      h_[group.lanes[i] / Lanes::count].set(group.lanes[i] % Lanes::count, step_s);
  }

  static int right_hand_sides(double, N_Vector y, N_Vector dyds, void* self) {
    static_cast<ErkBatch*>(self)->rates(y, dyds);
    return 0;
  }

  void rates(N_Vector y, N_Vector dyds) {
    for (std::size_t block = 0; block < blocks_; ++block) {
      const std::size_t first = block * Lanes::count;
      if (!any(h_[block] > 0.0)) {  // nobody is under way
        for (std::size_t i = 0; i < L::size; ++i) Lane::at(dyds, i, block) = Lanes(0.0);
        continue;
      }
      const Mask inside = mixed_ ? rates_one_by_one(y, dyds, block)
                                 : Lane::rates(*together_[block], held_[block], h_[block], y, dyds, block);
      if (!any(!inside)) continue;
      for (std::size_t lane = 0; lane < Lanes::count; ++lane) {
        if (inside[lane]) continue;
        One forbidding{};
        if (Group* group = group_of_[first + lane]; group != nullptr && group->under_way)
          forbid(forbidding.data(), group->refused++);
        Lane::put(forbidding, first + lane, dyds);
      }
    }
  }

  /// Where neighbours are of different kinds.
  Mask rates_one_by_one(N_Vector y, N_Vector dyds, std::size_t block) const {
    Mask inside{};
    for (std::size_t lane = 0; lane < Lanes::count; ++lane) {
      const std::size_t at = block * Lanes::count + lane;
      const Group* group = group_of_[at];
      const bool idle = group == nullptr || !group->under_way;
      Problem<L> problem(plants_[at]);
      One rates{};
      if (!idle) problem.held = *bound_[at].held;
      if (idle || problem.rates(Lane::of(at, y).data(), rates.data())) inside.set(lane);
      for (double& rate : rates) rate *= h_[block][lane];
      Lane::put(rates, at, dyds);
    }
    return inside;
  }

  static int after_step(double, N_Vector y, void* self) {
    auto& batch = *static_cast<ErkBatch*>(self);
    try {
      batch.judge(y);
      return 0;
    } catch (...) {  // not through the library
      batch.thrown_ = std::current_exception();
      return -1;
    }
  }

  /// Rejects steps that are not good enough; then reports which groups arrived.
  void judge(N_Vector y) {
    for (const Group& group : groups_)
      if (group.under_way && group.rigs > 1) share_error(group);
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
    std::array<std::size_t, most_lanes> through{};
    std::size_t count = 0;
    for (std::size_t slot = 0; slot < plants_.size(); ++slot)
      if (groups_[slot].under_way && judge(groups_[slot], slot, y)) through[count++] = slot;
    // Only now: what is submitted has not taken this step.
    for (std::size_t i = 0; i < count; ++i) (*arrived_)(through[i], groups_[through[i]].is_over());
    gather();
  }

  /// The error of the worst is that of all.
  void share_error(const Group& group) {
    double worst = 0.0;
    for (std::size_t i = 0; i < group.rigs; ++i) {
      const double error = errors_[group.lanes[i] / Lanes::count][group.lanes[i] % Lanes::count];
      worst = error <= worst ? worst : error;  // nor is it lost where it is no number
      if (!std::isfinite(error)) break;
    }
    for (std::size_t i = 0; i < group.rigs; ++i)
      errors_[group.lanes[i] / Lanes::count].set(group.lanes[i] % Lanes::count, worst);
  }

  /// The rigs of blocks in which one is new, as one.
  void gather() {
    for (std::size_t block = 0; block < blocks_ && !plants_.empty() && !mixed_; ++block) {
      if (together_[block]) continue;
      together_[block] = vectorised(std::span(plants_).subspan(block * Lanes::count, Lanes::count));
      if (!together_[block]) throw std::logic_error("rigs of a batch must be of one kind");
    }
  }

  /// Whether a group need not be carried any more.
  bool judge(Group& group, std::size_t slot, N_Vector y) {
    double error = errors_[slot / Lanes::count][slot % Lanes::count];
    if (!std::isfinite(error)) error = hopeless;
    const double h = group.pace.step_s;
    group.counters.right_hand_sides += stages;
    ++group.steps;
    if (error <= 1.0) {
      ++group.counters.steps;
      group.at_s += h;
    } else {
      ++group.counters.rejected_steps;
    }
    PiRule rule{group.pace.log_of_last_error};
    group.pace.step_s = rule.next(h, error, group.to_s - group.at_s, group.to_s - group.from_s);
    group.pace.log_of_last_error = rule.log_of_last_error;
    const bool over = group.is_over();
    const bool stuck = group.steps > most_steps_in_a_tick || group.refused > most_refused_in_a_tick ||
                       group.at_s + group.pace.step_s == group.at_s;
    if (!over && !stuck) {
      set_step(group, group.pace.step_s);
      return false;
    }
    if (over) {
      for (std::size_t i = 0; i < group.rigs; ++i)
        Problem<L>::load(Lane::of(group.lanes[i], y).data(), *bound_[group.lanes[i]].flow);
      ++group.pace.ticks;
    }
    group.under_way = false;
    --under_way_;
    set_step(group, 0.0);
    return true;
  }

  bool mixed_;
  std::size_t blocks_;
  std::array<Group, most_lanes> groups_{};     // by slot: its first lane
  std::array<Group*, most_lanes> group_of_{};  // by lane; null: it is free
  std::array<Bound, most_lanes> bound_{};      // by lane
  std::vector<plant::Plant> plants_;
  std::array<std::optional<plant::PlantOf<Lanes>>, most_blocks> together_;  // of the plants
  std::array<plant::HeldOf<Lanes>, most_blocks> held_;
  std::vector<Lanes> errors_ =
      std::vector<Lanes>(most_blocks, Lanes(0.0));  // of the last step, 1 = tolerance
  std::array<Lanes, most_blocks> h_;
  std::size_t under_way_ = 0;
  const Arrived* arrived_ = nullptr;
  std::exception_ptr thrown_;
  Context context_;
  std::string message_;
  Vector y_, reached_;           // where all are, and where they were before the step
  N_Vector current_ = y_.get();  // what the library works on
  ErkMemory memory_;
};

}  // namespace

std::unique_ptr<Batch> make_batch(const BatchShape& shape, double tolerance, std::size_t lanes) {
  using plant::Memories;
  const auto make = [&]<Memories memories, int sides, Books books>() -> std::unique_ptr<Batch> {
    return std::make_unique<ErkBatch<memories, sides, books>>(shape.mixed, tolerance, lanes);
  };
  if (shape.memories == Memories::all) {
    if (shape.pairs || shape.keep_ledger)
      throw std::logic_error("in lanes such memories are for one muscle without a ledger");
    return make.template operator()<Memories::all, 1, Books::none>();
  }
  const auto with = [&]<Memories memories> {
    if (shape.pairs) return make.template operator()<memories, 2, Books::none>();
    return shape.keep_ledger ? make.template operator()<memories, 1, Books::isothermal>()
                             : make.template operator()<memories, 1, Books::none>();
  };
  return shape.memories == Memories::none ? with.template operator()<Memories::none>()
                                          : with.template operator()<Memories::few>();
}

}  // namespace mckibben::engine
