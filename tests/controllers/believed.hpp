// A rig simple enough to be solved by hand, behind the interface through which controllers plan: a lag of
// first order to a height that the current and the load set, and a play that stands for threads.
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>

#include <controllers/rig_model.hpp>

namespace mckibben::controllers {

struct Laws {
  double per_mA = 0.02;   ///< height, as contraction ratio, for each mA above 4
  double per_kg = 0.004;  ///< and less for each kg
  double lag_ticks = 3.0;
  double play = 0.0;      ///< half of what the height may change before the load follows
  int* copies = nullptr;  ///< counts them
};

class Believed final : public RigModel {
 public:
  Believed(const Laws& laws, double load_kg, double rest_mA) : laws_(laws), load_kg_(load_kg) {
    now_.lagging = height(rest_mA);
    now_.ratio = now_.lagging;
  }
  std::unique_ptr<RigModel> copy() const override {
    if (laws_.copies) ++*laws_.copies;
    auto other = std::make_unique<Believed>(laws_, load_kg_, 4.0);
    other->now_ = now_;
    return other;
  }
  double given_mA(double wanted_mA) const override { return std::round(wanted_mA * 256.0) / 256.0; }
  void step(const Command& command, int ticks) override {
    for (; ticks > 0; --ticks) step(command.current_mA);
  }
  void step(double current_mA) {
    now_.lagging += (height(current_mA) - now_.lagging) * -std::expm1(-1.0 / laws_.lag_ticks);
    now_.ratio = std::clamp(now_.ratio, now_.lagging - laws_.play, now_.lagging + laws_.play);
  }
  double contraction_ratio() const override { return now_.ratio; }
  double shown_ratio() const override { return now_.ratio; }
  void keep() override { kept_ = now_; }
  void go_back() override { now_ = kept_; }

 private:
  struct State {
    double lagging = 0.0, ratio = 0.0;
  };
  double height(double current_mA) const {
    return std::max(0.0, laws_.per_mA * (current_mA - 4.0) - laws_.per_kg * load_kg_);
  }

  Laws laws_;
  double load_kg_;
  State now_, kept_;
};

inline ModelMaker believed(const Laws& laws) {
  return [laws](double load_kg, const Command& rest) {
    return std::make_unique<Believed>(laws, load_kg, rest.current_mA);
  };
}

}  // namespace mckibben::controllers
