// Laws of a user's own, read from files (docs/hypotheses.md), beside the catalogue of effects: each adds to
// one quantity of the plant, as an effect does, and is absent while its first parameter is 0.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <stdexcept>
#include <vector>

#include <plant/effects/effect.hpp>
#include <plant/law.hpp>

namespace mckibben::plant {

/// A law with its parameters.
template <class P>
struct OwnLawOf {
  std::shared_ptr<const LawText> text;
  std::array<P, most_law_parameters> values{};  ///< SI
  /// Where, among the numbers that all laws remember, its own begin; the time is in the last of all.
  std::size_t place = 0;

  auto absent() const { return values.front() == 0.0; }

  static void fields(auto& self, auto& visit) {
    for (std::size_t i = 0; self.text && i < self.text->parameters.size(); ++i) {
      const LawText::Parameter& about = self.text->parameters[i];
      visit(about.name, self.values[i], about.unit, about.lowest, about.highest, "");
    }
  }
};

template <class P>
class OwnLawsOf {
 public:
  static constexpr bool by_name = true;  ///< files may name those of others (sim/input/hypothesis_file.hpp)

  std::vector<OwnLawOf<P>> list{};

  static void fields(auto& self, auto& visit) {
    for (auto& law : self.list) visit(law.text->name, law, law.text->sentence);
  }
  void rules(auto& report) const {
    std::size_t on = 0;
    for (const auto& law : list) on += law.absent() ? 0 : 1;
    if (on > most_laws) report("", "at most 4 laws can be at work in a rig");
    if (places_taken() > most_law_memories) report("", too_many);
  }

  /// Whether a law is at work, of one of several rigs.
  bool any_on() const {
    for (const auto& law : list)
      if (any(!law.absent())) return true;
    return false;
  }
  bool absent() const { return !any_on(); }
  bool remember() const {
    return std::ranges::any_of(list,
                               [](const auto& law) { return law.text->slots() > 0 && any(!law.absent()); });
  }

  /// Gives those at work places for what they remember. Throws std::invalid_argument if there are too few.
  void take_places() {
    if (places_taken() > most_law_memories) throw std::invalid_argument(too_many);
    std::size_t next = 0;
    for (auto& law : list) {
      law.place = next;
      if (any(!law.absent())) next += law.text->memories.size();
    }
  }

  // Of memory, `from` is where their numbers begin. Not inlined: rigs without laws shall not carry them.

  template <class S, std::size_t slots>
  [[gnu::noinline]] S sum(LawTarget target, const Instant<S>& now, const std::array<S, slots>& memory,
                          std::size_t from) const {
    S all = S(0.0);
    for (const auto& law : list)
      if (law.text->adds == target) add(law, now, memory, from, all);
    return all;
  }
  template <class S, std::size_t slots>
  [[gnu::noinline]] Pull<S> pull(const Instant<S>& now, const std::array<S, slots>& memory,
                                 std::size_t from) const {
    Pull<S> all{S(0.0), S(0.0)};
    for (const auto& law : list) {
      if (law.text->adds != LawTarget::force) continue;
      add(law, now, memory, from, all.all_N);
      if (law.text->at == LawPlace::joint) add(law, now, memory, from, all.on_load_N);
    }
    return all;
  }
  template <class S, std::size_t slots>
  [[gnu::noinline]] std::array<S, law_slots> memory_rates(const Instant<S>& now,
                                                          const std::array<S, slots>& memory,
                                                          std::size_t from) const {
    std::array<S, law_slots> rates;
    rates.fill(S(0.0));
    for (const auto& law : list) {
      const auto on = !law.absent();
      if (!any(on)) continue;
      const LawText& text = *law.text;
      const LawNumbers<S, P> known = numbers(law, now, memory, from);
      for (std::size_t i = 0; i < text.memories.size(); ++i) {
        S& rate = rates[law.place + i];
        rate = select(on, S(value_of(text.memories[i].program, known) / text.memories[i].size), rate);
      }
      if (text.knows_time) rates.back() = select(on, S(1.0), rates.back());
    }
    return rates;
  }

  /// The name of a law that is no number at this instant, as if nothing were remembered; empty if all are.
  std::string_view without_number(const Instant<double>& now) const {
    const std::array<double, law_slots> nothing{};
    for (const auto& law : list) {
      if (law.absent()) continue;
      const auto known = numbers(law, now, nothing, 0);
      const auto is_number = [&](const LawProgram& program) {
        return std::isfinite(value_of(program, known));
      };
      const auto& memories = law.text->memories;
      if (!is_number(law.text->program) ||
          !std::ranges::all_of(memories, [&](const auto& memory) { return is_number(memory.program); }))
        return law.text->name;
    }
    return {};
  }

 private:
  static constexpr const char* too_many = "laws at work in a rig remember at most 12 numbers";

  std::size_t places_taken() const {
    std::size_t taken = 0;
    for (const auto& law : list)
      if (any(!law.absent())) taken += law.text->memories.size();
    return taken;
  }
  template <class S, std::size_t slots>
  static LawNumbers<S, P> numbers(const OwnLawOf<P>& law, const Instant<S>& now,
                                  const std::array<S, slots>& memory, std::size_t from) {
    LawNumbers<S, P> known{
        {now.contraction_ratio, now.rise_m, now.speed_m_per_s, now.muscle_pressure_Pa, now.valve_pressure_Pa,
         now.braid_force_N, S(now.weight_N), now.reference_Pa, memory[from + law_slots - 1]},
        law.values,
        {}};
    const auto& memories = law.text->memories;
    for (std::size_t i = 0; i < memories.size(); ++i)
      known.memories[i] = memory[from + law.place + i] * memories[i].size;
    return known;
  }
  template <class S, std::size_t slots>
  static void add(const OwnLawOf<P>& law, const Instant<S>& now, const std::array<S, slots>& memory,
                  std::size_t from, S& sum) {
    const auto on = !law.absent();
    if (!any(on)) return;
    const S value = value_of(law.text->program, numbers(law, now, memory, from));
    sum = select(on, S(sum + value), sum);
  }
};

}  // namespace mckibben::plant
