// The same plant carried by Boost.Odeint's Cash-Karp, for comparison: no library between the method and the
// laws, a state of fixed size on the stack.
#pragma once

#include <algorithm>
#include <array>
#include <stdexcept>

#include <boost/numeric/odeint/stepper/controlled_runge_kutta.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_cash_karp54.hpp>

#include <sim/engine/integrator.hpp>

namespace mckibben::engine {

class BoostCashKarp final : public Integrator {
  using L = Layout<1, plant::Memories::none, Books::none>;
  using State = std::array<double, static_cast<std::size_t>(L::size)>;
  using Stepper =
      boost::numeric::odeint::controlled_runge_kutta<boost::numeric::odeint::runge_kutta_cash_karp54<State>>;

 public:
  BoostCashKarp(const plant::Plant& rig, double tolerance)
      : problem_(rig), stepper_(Stepper::error_checker_type(tolerance, tolerance)) {}

  void advance(Flow& flow, plant::Held& held, double from_s, double to_s) override {
    problem_.held = held;
    State y;
    Problem<L>::store(flow, y.data());
    for (std::size_t i = 0; i < y.size(); ++i) y[i] /= size_of<L>(static_cast<int>(i));
    if (step_s_ == 0.0) step_s_ = 0.05 * (to_s - from_s);
    const auto rates = [this](const State& scaled, State& dydt, double) { right_hand_side(scaled, dydt); };
    for (double t = from_s; t < to_s - 1e-9 * (to_s - from_s);) {
      double step_s = std::min(step_s_, to_s - t);
      const bool is_last = step_s < step_s_;
      const bool accepted = stepper_.try_step(rates, y, t, step_s) == boost::numeric::odeint::success;
      ++(accepted ? counters_.steps : counters_.rejected_steps);
      if (!(accepted && is_last)) step_s_ = step_s;  // a step cut short says nothing about the next
    }
    for (std::size_t i = 0; i < y.size(); ++i) y[i] *= size_of<L>(static_cast<int>(i));
    Problem<L>::load(y.data(), flow);
  }

  Counters counters() const override { return counters_; }
  Pace pace() const override { return {.step_s = step_s_}; }
  void resume(const Pace& pace) override { step_s_ = pace.step_s; }

 private:
  // Its one absolute tolerance is for all components: each is told in its working size.
  void right_hand_side(const State& scaled, State& dydt) {
    ++counters_.right_hand_sides;
    State y;
    for (std::size_t i = 0; i < y.size(); ++i) y[i] = scaled[i] * size_of<L>(static_cast<int>(i));
    if (!problem_.rates(y.data(), dydt.data())) throw std::domain_error("outside the domain of the laws");
    for (std::size_t i = 0; i < y.size(); ++i) dydt[i] /= size_of<L>(static_cast<int>(i));
  }

  Problem<L> problem_;
  Stepper stepper_;
  Counters counters_;
  double step_s_ = 0.0;
};

}  // namespace mckibben::engine
