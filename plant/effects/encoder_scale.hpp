// The encoder reads too much or too little: a wheel of another radius than thought.
#pragma once

#include <array>

#include <plant/effects/effect.hpp>

namespace mckibben::plant {

template <class P>
struct EncoderScaleOf {
  static constexpr std::string_view name = "encoder_scale", law = "reads (1 + s) x",
                                    sentence = "the encoder reads too much or too little, in proportion",
                                    source = "wheel radius out of tolerance";
  static constexpr std::array hooks{Hook::reading_factor};
  static constexpr std::array variants{Variant{"", "error", 0.0, 0.01, Sign::either, 1e-5}};

  P error = 0.0;

  static void fields(auto& self, auto& visit) { visit("error", self.error, "1", -0.3, 0.3, "s; 0: absent"); }
  auto absent() const { return error == 0.0; }
  P reading_factor() const { return 1.0 + error; }
};
using EncoderScale = EncoderScaleOf<double>;

}  // namespace mckibben::plant
