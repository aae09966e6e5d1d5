// Many rigs as arrays, as Python steps them: vector rides with their encoders, on as many threads as wanted.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <plant/instruments.hpp>
#include <sim/python/inputs.hpp>
#include <sim/python/turn.hpp>
#include <sim/ride/vector_ride.hpp>

namespace mckibben::python {

class Batch {
 public:
  /// Settled at 0 s, no pressure asked for. Throws py::value_error for rigs that do not go together.
  Batch(const py::object& rigs, const Numbers& loads_kg, unsigned threads,
        const std::optional<Numbers>& jitter);

  void start(const std::optional<Numbers>& command);
  /// These begin again, others go on.
  void restart(const std::vector<std::size_t>& which, const py::object& rigs,
               const std::optional<Numbers>& loads_kg, const std::optional<Numbers>& command,
               const std::optional<Numbers>& jitter);
  void step(const Numbers& command);
  /// Ctrl-C ends it; its rigs are then at different instants, and must be started again.
  py::dict follow(const Numbers& command, const py::object& progress);

  /// One that goes on to the same bits.
  py::tuple pickled() const;
  static std::unique_ptr<Batch> unpickled(const py::tuple& state);

  py::array_t<double> contraction_ratio() const;
  /// As Ride's, one for each rig. Throws py::value_error where these are not as many.
  void set_jitter(const Numbers& ratios);
  std::vector<double> jitter() const;
  py::array_t<double> state() const;
  py::dict failures() const;
  std::size_t rigs() const { return members_.size(); }
  plant::CommandUnit command_unit() const { return rig_at(0).command_unit(); }
  double now_s() const { return time_s(ticks_); }

 private:
  static constexpr auto nobody = static_cast<std::size_t>(-1);

  struct Member {
    ride::Loaded hung;
    std::size_t part = 0, place = 0;
    std::optional<plant::PositionReader> counter{};
    std::int64_t counts = 0;
    double jitter = 0.0;  ///< of the position that is counted after a step, as a contraction ratio
  };
  /// As many rigs as fill a batch's lanes.
  struct Part {
    std::unique_ptr<ride::VectorRide> rides;
    std::vector<std::size_t> rigs;  ///< of the batch; nobody: has begun again elsewhere
  };
  /// What comes of many ticks.
  struct Rows {
    std::vector<double> time_s, state, contraction_ratio;
  };

  explicit Batch(unsigned threads) : threads_(threads) {}

  void require_alike(const plant::Rig& rig) const;
  void require_whole() const;
  const plant::Rig& rig_at(std::size_t i) const { return members_[i].hung.rig; }
  std::vector<double> zeros() const;
  /// One number for all rigs, or as many as there are rigs. Throws py::value_error.
  std::vector<double> each(const Numbers& given, std::string_view name) const;
  std::vector<double> all(const Numbers& command) const;
  std::vector<std::size_t> everybody() const;

  void begin(const std::vector<std::size_t>& which, std::span<const double> commands);
  void divide(const std::vector<std::size_t>& which);
  void drop_empty_parts();
  std::vector<double> of_part(const Part& part, std::span<const double> commands) const;
  void for_each_part(
      std::size_t first, const std::function<void(std::size_t)>& job,
      const std::function<void(std::size_t)>& done = [](std::size_t) {}) const;

  const double* state_of(std::size_t rig) const;
  double read_ratio(std::size_t rig) const;
  double time_s(long ticks) const { return static_cast<double>(ticks) * rig_at(0).tick_s; }

  /// How many threads one tick is worth.
  unsigned threads_of_a_tick() const;
  void step(Part& part, std::span<const double> commands, long k);
  void follow(Part& part, std::span<const double> commands, Rows& rows);
  py::dict as_dict(std::unique_ptr<Rows> made) const;

  unsigned threads_;
  std::vector<Member> members_;
  std::vector<Part> parts_;
  long ticks_ = 0;
  std::int64_t tick_ns_ = 0;  ///< of a processor, what the tick before took
  bool whole_ = true;
  mutable Turn::Busy busy_{false};
};

}  // namespace mckibben::python
