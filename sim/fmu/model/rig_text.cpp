// One walk along the field lists writes the lines and reads them; see the header.
#include <charconv>
#include <cmath>
#include <concepts>
#include <iterator>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <type_traits>
#include <utility>

#include <sim/fmu/model/rig_text.hpp>

namespace mckibben::fmu {
namespace {

constexpr std::string_view heading = "mckibben-fmu-rig/1";

/// The visitor of the field lists: `leaf(path, number)` sees each member as a number and may change it.
template <class Leaf>
class Walk {
 public:
  static constexpr bool lists_all = true;

  explicit Walk(Leaf& leaf) : leaf_(leaf) {}

  template <class T>
  void operator()(std::string_view key, T& value, const auto&...) {
    if constexpr (requires { T::fields(value, *this); })
      enter(key, [&] { T::fields(value, *this); });
    else if constexpr (requires { T::value_type::fields(value.front(), *this); })
      enter(key, [&] {
        std::size_t size = value.size();
        member("size", size);
        value.resize(size);
        for (std::size_t i = 0; i < size; ++i)
          enter(std::to_string(i), [&] {
            if constexpr (std::same_as<T, plant::Sensors>) {
              member("signal", value[i].signal);
              member("kind", value[i].kind);
            }
            T::value_type::fields(value[i], *this);
          });
      });
    else
      member(key, value);
  }
  void required(std::string_view key, auto& value, const auto&...) { (*this)(key, value); }

 private:
  void enter(std::string_view key, const auto& inside) {
    const std::size_t before = path_.size();
    path_.append(key) += '.';
    inside();
    path_.resize(before);
  }
  void member(std::string_view key, auto& value) {
    double number = number_of(value);
    leaf_(path_ + std::string(key), number);
    set(value, number);
  }
  static double number_of(const auto& value) { return static_cast<double>(value); }
  static double number_of(const std::optional<double>& value) {
    return value.value_or(std::numeric_limits<double>::quiet_NaN());
  }
  template <class T>
  static void set(T& value, double number) {
    value = static_cast<T>(number);
  }
  static void set(std::optional<double>& value, double number) {
    value = std::isnan(number) ? std::nullopt : std::optional(number);
  }

  Leaf& leaf_;
  std::string path_;
};

/// Laws of a user's own, whose members no field list has: `leaf` sees each number, and each word.
template <class Leaf>
class LawWalk {
 public:
  LawWalk(Leaf& leaf, std::string path) : leaf_(leaf), path_(std::move(path)) {}

  void operator()(plant::OwnLawsOf<double>& laws) {
    all(laws.list, [&](auto& law) {
      plant::LawText text = law.text ? *law.text : plant::LawText{};
      walk(text);
      law.text = std::make_shared<const plant::LawText>(std::move(text));
    });
  }

 private:
  void walk(plant::LawText& text) {
    leaf_(path_, text.name);
    number(text.adds);
    number(text.at);
    number(text.knows_time);
    all(text.parameters, [&](auto& parameter) {
      leaf_(path_, parameter.name);
      leaf_(path_, parameter.unit);
      number(parameter.lowest);
      number(parameter.highest);
    });
    all(text.memories, [&](auto& memory) {
      number(memory.size);
      walk(memory.program);
    });
    walk(text.program);
  }
  void walk(plant::LawProgram& program) {
    all(program, [&](plant::LawStep& step) {
      number(step.operation);
      number(step.index);
      number(step.number);
    });
  }
  void all(auto& list, const auto& of_each) {
    std::size_t size = list.size();
    number(size);
    list.resize(size);
    for (auto& each : list) of_each(each);
  }
  template <class T>
  void number(T& value) {
    double number = static_cast<double>(value);
    leaf_(path_, number);
    value = static_cast<T>(number);
  }

  Leaf& leaf_;
  std::string path_;
};

/// The kind of mechanics by its place in the variant.
void become(plant::Mechanics& mechanics, std::size_t kind) {
  if (kind == mechanics.index()) return;
  if (kind == 1)
    mechanics = plant::HeldLength{};
  else if (kind == 2)
    mechanics = plant::Pair{};
  else
    mechanics = plant::Lever{};
}

void walk(plant::Rig& rig, auto leaf) {
  Walk visitor(leaf);
  visitor("command_unit", rig.valve.command_unit);
  LawWalk(leaf, "law")(rig.effects.laws);
  plant::Rig::parts(rig, visitor);
  visitor("integrator", rig.integrator);
  double kind = static_cast<double>(rig.mechanics.index());
  leaf("mechanics", kind);
  become(rig.mechanics, static_cast<std::size_t>(kind));
  if (plant::Pair* const both = rig.pair()) {
    both->opposite.valve.command_unit = rig.valve.command_unit;
    LawWalk(leaf, "law_2")(both->opposite.effects.laws);
    visitor("mechanics", *both);
  }
  if (plant::Lever* const lever = rig.lever()) visitor("mechanics", *lever);
}

/// The next line without its end, taken off the text.
std::string_view next_line(std::string_view& text) {
  const std::string_view line = text.substr(0, text.find('\n'));
  text.remove_prefix(std::min(line.size() + 1, text.size()));
  return line;
}

/// A leaf of the walk that writes lines.
struct Written {
  std::string& text;

  void operator()(const std::string& path, double number) const {
    char digits[32];
    const auto end = std::to_chars(std::begin(digits), std::end(digits), number).ptr;
    (*this)(path, std::string(std::begin(digits), end));
  }
  void operator()(const std::string& path, const std::string& word) const {
    text += path + ' ' + word + '\n';
  }
};

/// One that reads them.
struct Read {
  std::string_view& text;

  void operator()(const std::string& path, std::string& word) const {
    const std::string_view line = next_line(text);
    if (line.size() <= path.size() || !line.starts_with(path) || line[path.size()] != ' ') fail(path);
    word = line.substr(path.size() + 1);
  }
  void operator()(const std::string& path, double& number) const {
    std::string digits;
    (*this)(path, digits);
    const char* const end = digits.data() + digits.size();
    if (std::from_chars(digits.data(), end, number).ptr != end) fail(path);
  }

 private:
  [[noreturn]] static void fail(const std::string& path) {
    throw std::runtime_error("there is no line for " + path);
  }
};

}  // namespace

std::string text_of(const Contents& contents) {
  std::string text = std::string(heading) + "\ntoken " + contents.token + "\n";
  plant::Rig rig = contents.rig;
  walk(rig, Written{text});
  return text;
}

Contents contents_of(std::string_view text) {
  constexpr std::string_view token = "token ";
  if (next_line(text) != heading) throw std::runtime_error("it does not begin with " + std::string(heading));
  Contents contents;
  const std::string_view second = next_line(text);
  if (!second.starts_with(token)) throw std::runtime_error("its second line has no token");
  contents.token = second.substr(token.size());
  walk(contents.rig, Read{text});
  return contents;
}

}  // namespace mckibben::fmu
