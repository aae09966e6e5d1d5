// All expressions of a law; see the header.
//
// The unit of a memory is not said. It is what the memory is added to, subtracted from or compared with;
// failing that, what its rate is times seconds. Passes over all expressions go on until no unit is found
// anew; the last one complains.
#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include <plant/names.hpp>
#include <sim/law/compile.hpp>
#include <sim/law/names.hpp>
#include <sim/law/pass.hpp>

namespace mckibben::law {
namespace {

/// All expressions, the law first.
class Compiler {
 public:
  Compiler(const Wording& wording, const Units& units, std::vector<Fault>& faults)
      : wording_(wording), units_(units), faults_(faults), memories_(wording.memories.size()) {}

  std::optional<Programs> operator()() {
    parse(wording_.law, std::nullopt);
    for (std::size_t i = 0; i < wording_.memories.size(); ++i) parse(wording_.memories[i].rate, i);
    if (!faults_.empty()) return std::nullopt;
    find_units();
    Programs programs;
    one(0, wording_.law, std::nullopt, dimension_of(wording_.adds),
        fmt::format("adds: {} wants", plant::name_of(wording_.adds)), programs.law, programs.knows_time);
    for (std::size_t i = 0; i < wording_.memories.size(); ++i) {
      const auto& memory = wording_.memories[i];
      auto& into = programs.memories.emplace_back();
      if (!memories_[i]) {
        faults_.push_back({{0, fmt::format("the unit of {} is unknown: add it to something, or compare "
                                           "it with something, whose unit is known",
                                           memory.name)},
                           i});
        continue;
      }
      into.dimension = *memories_[i];
      one(i + 1, memory.rate, i, memories_[i]->times(second, -1.0),
          fmt::format("{} is in {}, so that its rate is", memory.name, memories_[i]->unit()), into.rate,
          programs.knows_time);
    }
    if (!faults_.empty()) return std::nullopt;
    return programs;
  }

 private:
  void parse(std::string_view text, std::optional<std::size_t> memory) {
    std::vector<Problem> problems;
    pieces_.push_back(law::parse(text, problems));
    for (Problem& problem : problems) faults_.push_back({std::move(problem), memory});
  }
  void find_units() {
    std::size_t known = 0, before = 0;
    do {
      before = known;
      Pass(wording_, wording_.law, units_, memories_)(pieces_[0]);
      for (std::size_t i = 0; i < wording_.memories.size(); ++i) {
        Pass pass(wording_, wording_.memories[i].rate, units_, memories_);
        const auto rate = pass(pieces_[i + 1]);
        if (rate && !memories_[i] && rate->unit == Item::Unit::known)
          memories_[i] = rate->dimension.times(second);
      }
      known = static_cast<std::size_t>(
          std::ranges::count_if(memories_, [](const auto& m) { return m.has_value(); }));
    } while (known > before);
  }
  void one(std::size_t index, const std::string& text, std::optional<std::size_t> memory,
           const Dimension& wanted, const std::string& who, plant::LawProgram& program, bool& knows_time) {
    Pass pass(wording_, text, units_, memories_);
    const auto result = pass(pieces_[index]);
    if (result && result->unit == Item::Unit::known && !(result->dimension == wanted))
      pass.complain(result->from, fmt::format("{} is in {}; {} {}", pass.excerpt(*result),
                                              result->dimension.unit(), who, wanted.unit()));
    for (Problem& problem : pass.problems) faults_.push_back({std::move(problem), memory});
    program = std::move(pass.program);
    knows_time = knows_time || pass.knows_time;
  }

  const Wording& wording_;
  const Units& units_;
  std::vector<Fault>& faults_;
  MemoryUnits memories_;
  std::vector<std::vector<Piece>> pieces_;
};

}  // namespace

Dimension dimension_of(plant::LawTarget target) {
  switch (target) {
    case plant::LawTarget::force:
      return newton;
    case plant::LawTarget::friction_factor:
      return ratio;
    case plant::LawTarget::outflow:
      return kilogram_per_second;
    case plant::LawTarget::command:
      return pascal;
    case plant::LawTarget::reading:
      return metre;
  }
  return ratio;
}

std::vector<std::string> known_names(const Wording& wording) {
  std::vector<std::string> list;
  for (const auto& parameter : wording.parameters) list.push_back(parameter.name);
  for (const auto& memory : wording.memories) list.push_back(memory.name);
  for (const std::string_view name : reserved_names()) list.emplace_back(name);
  return list;
}

std::optional<Programs> compile(const Wording& wording, const Units& units, std::vector<Fault>& faults) {
  return Compiler(wording, units, faults)();
}

}  // namespace mckibben::law
