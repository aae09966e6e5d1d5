// One instance of an FMU: a rig that an importer steps from one communication point to the next, and the
// state machine of the standards, which calls out of order do not get past. Nothing here knows which version
// of the standard asks (fmi2.cpp, fmi3.cpp), and nothing is shared between instances.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <plant/instruments.hpp>
#include <plant/rig.hpp>
#include <sim/fmu/model/variables.hpp>
#include <sim/ride/ride.hpp>

namespace mckibben::fmu {

/// Copying one keeps its state, to the bit. Functions throw std::runtime_error; values are in the units of
/// `variables_of`.
class Slave {
 public:
  explicit Slave(plant::Rig rig);

  double get(Reference reference);
  /// Parameters until it steps, inputs until it ends: they act from the next step on.
  void set(Reference reference, double value);

  // In this order; what comes out of it is refused and changes nothing.
  void set_up(double start_s);
  /// From here on outputs can be asked for.
  void initialise();
  /// At rest at the start, after its settling time under the inputs as they are. Where it cannot be, it has
  /// failed.
  void set_off();
  /// An instant and the way to the next. Throws engine::NumericalFailure too; it has failed then, and steps
  /// no more.
  void step(double from_s, double length_s);
  void terminate();

  /// Its state as bytes; one that is made of the same rig becomes the same by them, to the bit. `token`: of
  /// the FMU. Reading throws std::runtime_error if the bytes are of another one, or of none.
  std::string bytes(const std::string& token) const;
  void become(std::string_view bytes, const std::string& token);

 private:
  enum class Mode : std::uint8_t { instantiated, set_up, initialising, stepping, failed, terminated };

  template <class Self, class Visitor>
  static void members(Self& self, Visitor& visit);
  void make_ride();
  void settle();
  ride::Drive drive() const;
  void require_hanging(double load_kg) const;
  void hang(double load_kg);
  void look();

  plant::Rig rig_;
  std::vector<std::string> paths_;
  std::vector<plant::Channel> channels_;
  double current_mA_, opposite_current_mA_ = 0.0, length_m_;
  double outside_ = 0.0;  ///< N, or N m of a joint with an angle
  double load_kg_ = 0.0, hanging_kg_ = 0.0;
  double time_s_ = 0.0;
  Mode mode_ = Mode::instantiated;
  std::int64_t counts_ = 0;
  std::optional<plant::PositionReader> counter_;
  std::optional<ride::Ride> ride_;
  std::optional<plant::Sample> sample_;  ///< of the instant it is at, once somebody has asked
};

}  // namespace mckibben::fmu
