// What holds of every effect of the table, whatever its law: what it says of itself, that absent it is not
// there, and that no value of its parameters breaks it.
#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <tuple>

#include <gtest/gtest.h>

#include "chance.hpp"
#include "switched_on.hpp"

namespace mckibben::plant {
namespace {

template <class E>
class EachEffect : public testing::Test {};
template <class T>
struct TypesOf;
template <class... E>
struct TypesOf<std::tuple<E...>> {
  using type = testing::Types<E...>;
};
TYPED_TEST_SUITE(EachEffect, typename TypesOf<Effects::Table>::type);

TYPED_TEST(EachEffect, SaysWhatItIs) {
  for (const std::string_view text :
       {TypeParam::name, TypeParam::law, TypeParam::sentence, TypeParam::source}) {
    EXPECT_FALSE(text.empty());
    EXPECT_EQ(text.find('\n'), std::string_view::npos) << text;
  }
  EXPECT_EQ(TypeParam::name.find_first_not_of("abcdefghijklmnopqrstuvwxyz_"), std::string_view::npos);
  EXPECT_TRUE(TypeParam{}.absent());
}

TYPED_TEST(EachEffect, VariantsNameRealKeysAndKeepToTheirRanges) {
  for (const Variant& variant : TypeParam::variants) {
    SCOPED_TRACE(std::string(variant.amplitude));
    TypeParam effect;
    auto parameters = parameters_of(effect, variant.name);
    const auto* amplitude = find(parameters, variant.amplitude);
    ASSERT_NE(amplitude, nullptr);
    EXPECT_EQ(*amplitude->value, variant.absent);  // the default
    for (const double deviation : {variant.typical, variant.step}) {
      *amplitude->value = variant.absent + deviation;
      EXPECT_FALSE(effect.absent());
      for (const double sign : {1.0, -1.0})
        if (sign > 0.0 || variant.sign == Sign::either) {
          EXPECT_GE(variant.absent + sign * deviation, amplitude->lowest);
          EXPECT_LE(variant.absent + sign * deviation, amplitude->highest);
        }
    }
    if (variant.sign == Sign::positive) {
      EXPECT_EQ(amplitude->lowest, variant.absent);
    }
    EXPECT_LE(std::abs(variant.step), std::abs(variant.typical));
    *amplitude->value = variant.absent;
    EXPECT_TRUE(effect.absent());
    if (variant.shape.empty()) continue;
    const auto* shape = find(parameters, variant.shape);
    ASSERT_NE(shape, nullptr);
    EXPECT_LT(variant.low, variant.middle);
    EXPECT_LT(variant.middle, variant.high);
    EXPECT_GE(variant.low, shape->lowest);
    EXPECT_LE(variant.high, shape->highest);
  }
}

TYPED_TEST(EachEffect, DefaultsLieWithinTheirRanges) {
  TypeParam effect;
  for (const auto& parameter : parameters_of(effect)) {
    EXPECT_GE(*parameter.value, parameter.lowest) << parameter.key;
    EXPECT_LE(*parameter.value, parameter.highest) << parameter.key;
  }
}

TYPED_TEST(EachEffect, AbsentItIsNotThereWhateverItsShape) {
  Chance chance;
  for (const Variant& variant : TypeParam::variants) {
    Rig odd;
    auto& effect = odd.effects.template get<TypeParam>();
    for (const auto& parameter : parameters_of(effect, variant.name))
      if (const Variant* const law = sized_by<TypeParam>(variant, parameter.key))
        *parameter.value = law->absent;
      else
        *parameter.value = chance.between(parameter.lowest, parameter.highest);
    ASSERT_TRUE(odd.effects.absent());
    // Another effect beside it, so that the table is walked at all.
    Rig other, both = odd;
    for (auto* rig : {&other, &both})
      rig->effects.template get<ResidualForce>().terms = {{Basis::speed, 3.0}};
    for (int i = 0; i < 20; ++i) {
      const auto state = chance.state();
      const auto memory = chance.memory();
      EXPECT_EQ(all_of(Plant(odd, 12.0), state, memory), all_of(Plant(Rig{}, 12.0), state, memory));
      EXPECT_EQ(all_of(Plant(both, 12.0), state, memory), all_of(Plant(other, 12.0), state, memory));
    }
  }
}

TYPED_TEST(EachEffect, IsFiniteOverItsWholeRange) {
  Chance chance;
  const Plant nominal(Rig{}, 12.0);
  for (const Variant& variant : TypeParam::variants)
    for (int i = 0; i < 400; ++i) {
      Rig rig;
      auto& effect = rig.effects.template get<TypeParam>();
      for (const auto& [key, value, lowest, highest] : parameters_of(effect, variant.name)) {
        const double share = chance.between(0.0, 1.0);
        if (share < 0.2)
          *value = lowest;
        else if (share < 0.4)
          *value = highest;
        else if (share < 0.6)
          *value = std::nextafter(variant.absent, highest);  // next to nothing, where a quotient may burst
        else
          *value = chance.between(lowest, highest);
        *value = std::clamp(*value, lowest, highest);
      }
      const auto state = chance.state();
      ASSERT_TRUE(nominal.in_domain(state));
      for (const double value : all_of(Plant(rig, 12.0), state, chance.memory()))
        ASSERT_TRUE(std::isfinite(value)) << i;
      Effects::Plays plays{};
      EXPECT_TRUE(std::isfinite(rig.effects.wheel_m(0.1, plays) + rig.effects.reference_Pa(1e5, plays)));
    }
}

}  // namespace
}  // namespace mckibben::plant
