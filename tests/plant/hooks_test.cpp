// What is an effect, and what only looks like one.
#include <array>

#include <gtest/gtest.h>

#include <plant/effects.hpp>

namespace mckibben::plant {
namespace {

struct Drag {
  static constexpr std::array hooks{Hook::pull};
  template <class S>
  S pull_N(const Instant<S>& now, const S&) const {
    return -now.speed_m_per_s;
  }
};
struct MisspelledDrag {
  static constexpr std::array hooks{Hook::pull};
  template <class S>
  S pul_N(const Instant<S>& now, const S&) const {
    return -now.speed_m_per_s;
  }
};
struct DragWithoutMemory {
  static constexpr std::array hooks{Hook::pull};
  template <class S>
  S pull_N(const Instant<S>& now) const {
    return -now.speed_m_per_s;
  }
};
struct DragNotDeclared : Drag {
  static constexpr std::array hooks{Hook::wheel};
  double wheel_m(double rise_m, Play&) const { return rise_m; }
};
struct MemoryWithoutRate : Drag {
  static constexpr double memory_size = 1.0;
  static constexpr std::string_view memory_unit = "1";
};

TEST(Hooks, AreThoseThatAreDeclared) {
  EXPECT_TRUE(IsEffect<Drag>);
  EXPECT_FALSE(IsEffect<MisspelledDrag>);
  EXPECT_FALSE(IsEffect<DragWithoutMemory>);
  EXPECT_FALSE(IsEffect<DragNotDeclared>);
  EXPECT_FALSE(IsEffect<MemoryWithoutRate>);
}

}  // namespace
}  // namespace mckibben::plant
