// The rig as a thing that is stepped, by whatever drives it. The order of an instant, which stands in
// ride.cpp and nowhere else:
//
//   x-         state that was reached; what the instruments see of it
//   hold       held = { play(P_ref(i)) + stray, nu = change of i / length of the step } of each side, or the
//              slope of a pressure that is given; w of a length that is given
//              Coulomb friction: a load that sticks is judged anew
//   moment     forces and flows at (x-, held)
//   advance    x+ = integrate(x-, held); what the instruments see of it
//
// Times are the caller's. A ride carries one rig, or several under the same drive: in common steps where they
// can be had, for differences between rigs that are free of the noise of steps.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <plant/plant.hpp>
#include <sim/engine/flock.hpp>
#include <sim/engine/integrator.hpp>

namespace mckibben::ride {

/// A rig with a load [kg] on it.
struct Hanging {
  plant::Rig rig;
  double load_kg;
};

/// Two muscles on one wheel (T 2.7); the joint and its encoder are those of the first rig.
struct Paired {
  plant::Rig rig, opposite;
  plant::Link link{};
};

/// What acts on a muscle from outside, from one instant to the next: a command, or in its place the pressure
/// that the muscle has at the end, and runs straight to.
struct Command {
  double current_mA = 0.0;         ///< as a DAC gives it
  double stray_current_mA = 0.0;   ///< reaches the valve besides, and is in no table
  double stray_pressure_Pa = 0.0;  ///< on the reference that the valve follows, in the end
  std::optional<double> muscle_pressure_Pa{};
};

/// What acts on a rig: on its muscle, on the opposite one of a pair, on the joint a bench that gives the
/// (first) muscle the length that it has at the end, straight.
struct Drive : Command {
  std::optional<double> contraction_ratio{};
  Command opposite{};
};

/// What instruments see at an instant, before they count or round.
struct Reading {
  double wheel_m = 0.0;  ///< rise that the encoder's wheel shows; of a pair, from theta = 0
  double muscle_pressure_Pa = 0.0, opposite_pressure_Pa = 0.0;
};

/// Whether rigs can ride in common steps: none with exact stick and slip, and not with CVODE.
bool can_share_steps(std::span<const Hanging> rigs, solver::Method method);

class Ride {
 public:
  /// All that changes on the way, one entry for each rig.
  struct Saved {
    std::vector<engine::Flow> flows;
    std::vector<plant::Held> held;
    std::vector<plant::Effects::Plays> plays, opposite_plays;
    std::vector<Reading> readings;
    std::vector<engine::Pace> paces;  ///< one for each integrator
    double time_s = 0.0, until_s = 0.0;
    Drive drive{};  ///< that was held last
  };

  /// 1 to engine::Flock::most rigs. In common steps they have no ledger. Throws std::invalid_argument.
  Ride(std::span<const Hanging> rigs, const solver::Settings& settings, bool keep_ledger = false);
  Ride(const Hanging& rig, const solver::Settings& settings, bool keep_ledger = false)
      : Ride(std::span(&rig, 1), settings, keep_ledger) {}
  Ride(const Paired& pair, const solver::Settings& settings, bool keep_ledger = false);
  Ride(const Ride& other);
  Ride(Ride&&) = default;
  Ride& operator=(Ride&&) = default;
  ~Ride() = default;

  /// At rest, pressures as the drive asks for, the encoder at zero. A load may still sink onto the braid
  /// stop, a link swing to where the muscles hold it: the steps of the rig's settling time follow.
  void start(const Drive& drive, double at_s);

  /// An instant and the way to the next [s]; touches no heap. Throws NumericalFailure; the ride is then where
  /// it last came to.
  std::span<const Reading> step(const Drive& drive, double until_s) {
    hold(drive, until_s);
    return advance();
  }

  // A step's two halves, for those who look at the moment between them. Throws std::invalid_argument where
  // `until_s` is not later than the present instant.
  void hold(const Drive& drive, double until_s);
  std::span<const Reading> advance();

  const plant::Plant& plant(std::size_t rig = 0) const { return plants_[rig]; }
  const engine::Flow& flow(std::size_t rig = 0) const { return now_.flows[rig]; }
  const Reading& reading(std::size_t rig = 0) const { return now_.readings[rig]; }
  plant::Moment<double> moment(std::size_t rig = 0) const {
    return plants_[rig].moment(now_.flows[rig].state, now_.flows[rig].memory, now_.held[rig]);
  }
  double time_s() const { return now_.time_s; }
  /// What the solver of the first rig did. Not of rigs in common steps.
  engine::Counters counters() const;

  /// Nothing has come or gone from here on.
  void open_ledger();

  /// A ride that goes on from what was saved goes the same way, to the bit. `saved` is of a ride of as many
  /// rigs with the same settings.
  Saved save() const;
  void restore(const Saved& saved);

 private:
  void add(const plant::Plant& plant);
  void make_integrators();
  /// What the valve of a side is to follow. Pushes the plays on the way.
  static double reference_Pa(const plant::Side& side, const Command& command, plant::Effects::Plays& plays);
  /// What is held of a side until the next instant, `length_s` away.
  static void hold_side(const plant::Side& side, const Command& before, const Command& now,
                        double pressure_Pa, double length_s, plant::Effects::Plays& plays,
                        plant::HeldSide& held);
  /// The joint at the length and the muscles at the pressures that were given, to the last bit.
  void arrive();
  void read();

  std::vector<plant::Plant> plants_;
  solver::Settings settings_;
  bool together_, keep_ledger_;
  std::unique_ptr<engine::Flock> flock_;                          // either this
  std::vector<std::unique_ptr<engine::Integrator>> integrators_;  // or one for each rig
  Saved now_;
};

}  // namespace mckibben::ride
