// Rigs that follow what drives them from stamp to stamp, whatever it is and however unequal the stamps:
// commands, given pressures, a given length or force; one muscle or two; ticks as well.
//
//   settle: the first drive is held for the settling time, in steps of a tick; or a rig that is on its way
//           runs in under a moving command, and the load is put where it was seen
//   row k = (t_k, x-); then a command is held until t_(k+1), a given pressure or length runs straight to its
//           next
#pragma once

#include <functional>
#include <span>
#include <vector>

#include <plant/instruments.hpp>
#include <plant/rig.hpp>
#include <sim/ride/batch.hpp>
#include <sim/run/course.hpp>
#include <sim/run/recording.hpp>

namespace mckibben::run {

/// What is otherwise for one rider than the course says.
struct Disturbance {
  /// Changes what drives it between two instants; both are minus infinity for what it settles under. Commands
  /// and forces are those of the first, pressures and lengths those of the second.
  std::function<void(const ride::Rider& rider, std::size_t index, double from_s, double to_s,
                     ride::Drive& drive)>
      drive{};
  /// Changes how it begins on its way.
  std::function<void(std::size_t index, ride::Underway& begins)> begin{};
};

/// What follows a course, as an item of a batch.
class Follower : public ride::BatchItem {
 public:
  /// `rig`: whose ticks count.
  Follower(std::vector<ride::Rider> riders, const plant::Rig& rig, Course course,
           Disturbance disturbance = {});

  ride::BatchKey key(const solver::Settings& settings, bool keep_ledger) const {
    return ride::batch_key(riders_, course_.drives.front(), settings, keep_ledger);
  }
  std::span<ride::Rider> riders() final { return riders_; }
  bool go_on() final;

 protected:
  const Course& course() const { return course_; }
  const plant::Rig& rig() const { return rig_; }
  /// That a rig settles, or runs in, before the first stamp.
  long ticks_before() const;

 private:
  virtual void settled_a_tick() {}
  virtual void begin() {}  ///< at the first stamp
  /// At the next row, which is this stamp; the drive of the way ahead is held.
  virtual void look(std::size_t stamp) = 0;

  double before_s(long ticks) const {
    return course_.time_s.front() - static_cast<double>(ticks) * rig_.tick_s;
  }

  /// What acts next before the first stamp.
  ride::Drive before() const;
  ride::Drive settling(const ride::Drive& drive, std::size_t rider) const;
  void set_off();
  ride::Drive disturbed(ride::Drive drive, std::size_t rider, double from_s, double to_s) const;

  plant::Rig rig_;
  Course course_;
  Disturbance disturbance_;
  std::vector<ride::Rider> riders_;
  long settling_ = 0;  // ticks that are left
  std::size_t k_ = 0, row_ = 0;
};

/// One rig that leaves a recording: a row for each stamp that has one. `done` hears of it. If the integrator
/// gives up, the recording ends there and says why.
class Following final : public Follower {
 public:
  using Done = std::function<void(Recording recording)>;
  Following(const plant::Rig& rig, double load_kg, Course course, Done done);

  ride::BatchKey key() const { return Follower::key(rig().integrator, true); }
  void end(const engine::Counters& solver, const engine::NumericalFailure* failure) override;

 private:
  void settled_a_tick() override { counter_.count(riders().front().now.reading.wheel_m); }
  void begin() override { riders().front().open_ledger(); }
  void look(std::size_t stamp) override;

  plant::PositionReader counter_;
  Done done_;
  Recording recording_;
};

/// The same at once.
Recording follow(const plant::Rig& rig, double load_kg, const Course& course);

}  // namespace mckibben::run
