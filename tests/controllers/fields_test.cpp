// Every field list of the room, walked as a reader would: keys differ, defaults lie within their own ranges.
#include <concepts>
#include <cstddef>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include <gtest/gtest.h>

#include <controllers/settings.hpp>
#include <controllers/target.hpp>

namespace mckibben::controllers {
namespace {

struct Walker {
  std::string owner;
  std::set<std::string> keys;

  template <class Member, class... Rest>
  void operator()(std::string_view key, const Member& member, const Rest&... rest) {
    EXPECT_TRUE(keys.emplace(key).second) << owner << " has " << key << " twice";
    if constexpr (std::same_as<Member, int>) within(key, member, rest...);
    if constexpr (std::same_as<Member, double>) in_unit(key, member, rest...);
  }
  template <class... All>
  void required(const All&... all) {
    (*this)(all...);
  }

 private:
  template <class Number>
  void within(std::string_view key, Number value, Number lowest, Number highest, std::string_view) const {
    EXPECT_LE(lowest, value) << owner << "." << key;
    EXPECT_GE(highest, value) << owner << "." << key;
  }
  void in_unit(std::string_view key, double value, std::string_view unit, double lowest, double highest,
               std::string_view meaning) const {
    EXPECT_FALSE(unit.empty()) << owner << "." << key;
    within(key, value, lowest, highest, meaning);
  }
};

template <class Variant, class Look>
void for_each_alternative(const Look& look) {
  [&]<std::size_t... i>(std::index_sequence<i...>) {
    (look(std::variant_alternative_t<i, Variant>{}), ...);
  }
  (std::make_index_sequence<std::variant_size_v<Variant>>{});
}

TEST(Fields, DefaultsLieWithinTheirRangesAndKeysDiffer) {
  const auto walk = []<class Settings>(const Settings& settings) {
    Walker walker{std::string(Settings::kind), {}};
    Settings::fields(settings, walker);
    EXPECT_GE(walker.keys.size(), 1U);
  };
  for_each_alternative<Settings>(walk);
  for_each_alternative<Target>(walk);
  for_each_alternative<AngleTarget>(walk);
  for_each_alternative<StiffnessTarget>(walk);
}

template <class Variant>
void expect_kinds_and_names() {
  std::set<std::string_view> kinds;
  for_each_alternative<Variant>([&]<class One>(const One& one) {
    EXPECT_TRUE(kinds.insert(One::kind).second) << One::kind;
    Walker walker{std::string(One::kind), {}};
    One::fields(one, walker);
    EXPECT_TRUE(walker.keys.contains("name")) << One::kind;
    EXPECT_EQ(one.name, One::kind);
  });
}

TEST(Fields, EveryControllerHasAKindOfItsOwnAndAName) {
  expect_kinds_and_names<SingleSettings>();
  expect_kinds_and_names<PairSettings>();
}

}  // namespace
}  // namespace mckibben::controllers
