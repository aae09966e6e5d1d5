// One walk along the field lists writes the lines and reads them; see the header.
#include <charconv>
#include <cmath>
#include <concepts>
#include <iterator>
#include <limits>
#include <optional>
#include <stdexcept>
#include <type_traits>

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
    else if constexpr (std::same_as<T, plant::RatedCommand>)
      enter(key, [&] {
        member("value", value.value);
        member("unit", value.unit);
      });
    else if constexpr (requires { T::value_type::fields(value.front(), *this); })
      enter(key, [&] {
        std::size_t size = value.size();
        member("size", size);
        value.resize(size);
        for (std::size_t i = 0; i < size; ++i) (*this)(std::to_string(i), value[i]);
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
  template <class T>
  void member(std::string_view key, T& value) {
    double number = number_of(value);
    leaf_(path_ + std::string(key), number);
    set(value, number);
  }
  template <class T>
  static double number_of(const T& value) {
    return static_cast<double>(value);
  }
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

template <class Leaf>
void walk(domain::RigFile& rig, Leaf leaf) {
  Walk visitor(leaf);
  plant::Rig::fields(static_cast<plant::Rig&>(rig), visitor);
  visitor("integrator", rig.integrator);
  double pair = rig.pair() != nullptr ? 1.0 : 0.0;
  leaf("pair", pair);
  if (pair != 0.0 && rig.pair() == nullptr) rig.mechanics = plant::Pair{};
  if (auto* const both = std::get_if<plant::Pair>(&rig.mechanics)) visitor("mechanics", *both);
}

/// The next line without its end, taken off the text.
std::string_view next_line(std::string_view& text) {
  const std::string_view line = text.substr(0, text.find('\n'));
  text.remove_prefix(std::min(line.size() + 1, text.size()));
  return line;
}

}  // namespace

bool can_be_text(const domain::RigFile& rig) {
  const auto* const both = rig.pair();
  return rig.effects.laws.list.empty() && (both == nullptr || both->opposite.effects.laws.list.empty());
}

std::string text_of(const Contents& contents) {
  std::string text = std::string(heading) + "\ntoken " + contents.token + "\n";
  domain::RigFile rig = contents.rig;
  walk(rig, [&](const std::string& path, double& number) {
    char digits[32];
    const auto end = std::to_chars(std::begin(digits), std::end(digits), number).ptr;
    text += path + ' ' + std::string(std::begin(digits), end) + '\n';
  });
  return text;
}

Contents contents_of(std::string_view text) {
  constexpr std::string_view token = "token ";
  if (next_line(text) != heading) throw std::runtime_error("it does not begin with " + std::string(heading));
  Contents contents;
  const std::string_view second = next_line(text);
  if (!second.starts_with(token)) throw std::runtime_error("its second line has no token");
  contents.token = second.substr(token.size());
  walk(contents.rig, [&](const std::string& path, double& number) {
    const std::string_view line = next_line(text);
    const char* const end = line.data() + line.size();
    if (line.size() <= path.size() || !line.starts_with(path) || line[path.size()] != ' ' ||
        std::from_chars(line.data() + path.size() + 1, end, number).ptr != end)
      throw std::runtime_error("there is no line for " + path);
  });
  return contents;
}

}  // namespace mckibben::fmu
