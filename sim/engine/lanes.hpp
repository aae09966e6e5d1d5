// Numbers of eight rigs side by side, in the lanes of vector registers: the laws of the plant, evaluated once
// for all of them. GCC's vector extension, not intrinsics: the compiler makes of it what a machine has, in
// functions compiled for that machine (`on_this_machine`), so that one program runs on any x86-64 and on
// arm64. Each lane does what a double does, operation by operation (no fused multiply-add), so that results
// are the same on all of them. Aligned as those functions take for granted, whatever the rest is compiled
// for.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include <plant/choose.hpp>

namespace mckibben::engine {

/// Which of eight rigs something is true for.
struct alignas(32) Mask {
  using Half = std::int64_t __attribute__((vector_size(32)));  // 0 or -1
  std::array<Half, 2> half;

  bool operator[](std::size_t lane) const { return half[lane / 4][lane % 4] != 0; }
  void set(std::size_t lane) { half[lane / 4][lane % 4] = -1; }
  friend Mask operator!(const Mask& a) { return {{~a.half[0], ~a.half[1]}}; }
  friend Mask operator&&(const Mask& a, const Mask& b) {
    return {{a.half[0] & b.half[0], a.half[1] & b.half[1]}};
  }
  friend bool any(const Mask& a) {
    using Quarter = std::int64_t __attribute__((vector_size(16)));
    const Half both = a.half[0] | a.half[1];
    const Quarter all = __builtin_shufflevector(both, both, 0, 1) | __builtin_shufflevector(both, both, 2, 3);
    return (all[0] | all[1]) != 0;
  }
};

struct alignas(32) Lanes {
  static constexpr std::size_t count = 8;
  using Half = double __attribute__((vector_size(32)));
  std::array<Half, 2> half;

  Lanes() = default;
  Lanes(double all) : half{Half{all, all, all, all}, Half{all, all, all, all}} {}
  Lanes(const Half& first, const Half& second) : half{first, second} {}

  double operator[](std::size_t lane) const { return half[lane / 4][lane % 4]; }
  void set(std::size_t lane, double value) { half[lane / 4][lane % 4] = value; }

  friend Lanes operator-(const Lanes& a) { return {-a.half[0], -a.half[1]}; }
  friend Lanes operator+(const Lanes& a, const Lanes& b) {
    return {a.half[0] + b.half[0], a.half[1] + b.half[1]};
  }
  friend Lanes operator-(const Lanes& a, const Lanes& b) {
    return {a.half[0] - b.half[0], a.half[1] - b.half[1]};
  }
  friend Lanes operator*(const Lanes& a, const Lanes& b) {
    return {a.half[0] * b.half[0], a.half[1] * b.half[1]};
  }
  friend Lanes operator/(const Lanes& a, const Lanes& b) {
    return {a.half[0] / b.half[0], a.half[1] / b.half[1]};
  }

  friend Mask operator<(const Lanes& a, const Lanes& b) {
    return {{a.half[0] < b.half[0], a.half[1] < b.half[1]}};
  }
  friend Mask operator<=(const Lanes& a, const Lanes& b) {
    return {{a.half[0] <= b.half[0], a.half[1] <= b.half[1]}};
  }
  friend Mask operator>(const Lanes& a, const Lanes& b) { return b < a; }
  friend Mask operator>=(const Lanes& a, const Lanes& b) { return b <= a; }
  friend Mask operator==(const Lanes& a, const Lanes& b) {
    return {{a.half[0] == b.half[0], a.half[1] == b.half[1]}};
  }
  friend Mask operator!=(const Lanes& a, const Lanes& b) { return !(a == b); }
};

inline Lanes select(const Mask& condition, const Lanes& yes, const Lanes& no) {
  const auto of = [](const Mask::Half& chosen, const Lanes::Half& a, const Lanes::Half& b) {
    return reinterpret_cast<Lanes::Half>((chosen & reinterpret_cast<Mask::Half>(a)) |
                                         (~chosen & reinterpret_cast<Mask::Half>(b)));
  };
  return {of(condition.half[0], yes.half[0], no.half[0]), of(condition.half[1], yes.half[1], no.half[1])};
}

/// Both laws only where rigs differ.
template <class Yes, class No>
Lanes choose(const Mask& condition, const Yes& yes, const No& no) {
  if (!any(condition)) return no();
  if (!any(!condition)) return yes();
  return select(condition, yes(), no());
}

/// Lane by lane: what no vector instruction does.
template <class F>
Lanes each_lane(const Lanes& x, const F& f) {
  Lanes y;
  for (std::size_t h = 0; h < 2; ++h)
    for (std::size_t i = 0; i < 4; ++i) y.half[h][i] = f(x.half[h][i]);
  return y;
}

inline Lanes abs(const Lanes& x) {
  return select(x < 0.0, -x, x);
}
inline Lanes max(const Lanes& a, const Lanes& b) {
  return select(a < b, b, a);
}
inline Mask isfinite(const Lanes& x) {
  return x - x == Lanes(0.0);
}
inline Lanes sqrt(const Lanes& x) {
  return each_lane(x, [](double v) { return __builtin_sqrt(v); });  // one instruction for all lanes
}
inline Lanes exp(const Lanes& x) {
  return each_lane(x, [](double v) { return std::exp(v); });
}
inline Lanes sin(const Lanes& x) {
  return each_lane(x, [](double v) { return std::sin(v); });
}
inline Lanes cos(const Lanes& x) {
  return each_lane(x, [](double v) { return std::cos(v); });
}
inline Lanes acos(const Lanes& x) {
  return each_lane(x, [](double v) { return std::acos(v); });
}
inline Lanes tanh(const Lanes& x) {
  return each_lane(x, [](double v) { return std::tanh(v); });
}
inline Lanes pow(const Lanes& x, const Lanes& exponent) {
  Lanes y;
  for (std::size_t lane = 0; lane < Lanes::count; ++lane) y.set(lane, std::pow(x[lane], exponent[lane]));
  return y;
}

/// Natural logarithm, within 1 unit in the last place, of positive normal numbers (others: not a number):
/// x = 2^k m with m in [sqrt(1/2), sqrt(2)), log m = 2 artanh(s), s = (m - 1)/(m + 1), by the polynomial of
/// Sun's fdlibm (e_log.c, 1993) in s^2.
inline Lanes log(const Lanes& x) {
  const auto half = [](const Lanes::Half& v) {
    using I = Mask::Half;
    constexpr std::int64_t root_half = 0x3fe6a09e667f3bcd;
    const I bits = reinterpret_cast<I>(v);
    const I k = (bits - root_half) >> 52;  // arithmetic: rounds down
    const Lanes::Half m = reinterpret_cast<Lanes::Half>(bits - (k << 52));
    // k as a double, by way of the last bits of 1.5 2^52
    constexpr std::int64_t magic_bits = 0x4338000000000000;
    const Lanes::Half n = reinterpret_cast<Lanes::Half>(k + magic_bits) - 6755399441055744.0;
    const Lanes::Half f = m - 1.0, s = f / (2.0 + f), z = s * s;
    const Lanes::Half series =
        z * (6.666666666666735130e-01 +
             z * (3.999999999940941908e-01 +
                  z * (2.857142874366239149e-01 +
                       z * (2.222219843214978396e-01 +
                            z * (1.818357216161805012e-01 +
                                 z * (1.531383769920937332e-01 + z * 1.479819860511658591e-01))))));
    const Lanes::Half square = 0.5 * f * f;
    constexpr double ln2_high = 6.93147180369123816490e-01, ln2_low = 1.90821492927058770002e-10;
    const Lanes::Half value = n * ln2_high - ((square - (s * (square + series) + n * ln2_low)) - f);
    const I normal = (bits >= 0x0010000000000000) & (bits < 0x7ff0000000000000);
    return reinterpret_cast<Lanes::Half>((normal & reinterpret_cast<I>(value)) | ~normal);
  };
  return {half(x.half[0]), half(x.half[1])};
}

// Where `f` is called it is compiled once for any machine of the kind and, on x86-64, once for those with
// AVX2; what runs is chosen when the program runs. Without fused multiply-add: see above. What is flattened
// is quicker and takes the compiler long (with sanitizers in it twenty times as long): only what most
// machines run.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define MCKIBBEN_FLATTEN
#else
#define MCKIBBEN_FLATTEN gnu::flatten
#endif
#if defined(__x86_64__)
template <class F>
void on_any_machine(const F& f) {
  f();
}
template <class F>
[[MCKIBBEN_FLATTEN]] [[gnu::target("avx2")]] void with_avx2(const F& f) {
  f();
}
inline bool has_avx2() {
  static const bool has = __builtin_cpu_supports("avx2") != 0;
  return has;
}
#else
template <class F>
[[MCKIBBEN_FLATTEN]] void on_any_machine(const F& f) {
  f();
}
#endif
template <class F>
void on_this_machine(const F& f) {
#if defined(__x86_64__)
  if (has_avx2()) return with_avx2(f);
#endif
  on_any_machine(f);
}
#undef MCKIBBEN_FLATTEN

}  // namespace mckibben::engine

/// Lanes have parameters of their own for each rig.
template <>
struct mckibben::plant::ParameterOf<mckibben::engine::Lanes> {
  using type = mckibben::engine::Lanes;
};
