// Many rigs as arrays: a vector ride for as many as fill a batch's lanes, on as many threads as wanted.
#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <plant/instruments.hpp>
#include <sim/python/inputs.hpp>
#include <sim/python/long_work.hpp>
#include <sim/python/turn.hpp>
#include <sim/ride/vector_ride.hpp>
#include <sim/run/batch.hpp>
#include <sim/run/simulate.hpp>

namespace mckibben::python {
namespace {

using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;

/// What comes of many ticks.
struct Rows {
  std::vector<double> time_s, state, contraction_ratio;
};

class Batch {
 public:
  Batch(const py::object& rigs, const Numbers& loads_kg, unsigned threads) : threads_(threads) {
    const bool many = py::isinstance<py::list>(rigs) || py::isinstance<py::tuple>(rigs);
    std::vector<plant::Rig> files;
    if (many)
      for (const auto& rig : rigs) files.push_back(rig_of(py::reinterpret_borrow<py::object>(rig)).file);
    else
      files.push_back(rig_of(rigs).file);
    const auto loads = static_cast<std::size_t>(loads_kg.size());
    rigs_ = many ? files.size() : loads;
    if (loads_kg.ndim() > 1) throw py::value_error("loads_kg has the shape (n,)");
    if (rigs_ == 0) throw py::value_error("a batch has one rig at least");
    if (loads != 1 && loads != rigs_) throw py::value_error("loads_kg: one number, or one for each rig");
    std::vector<ride::Loaded> hanging;
    std::vector<solver::Settings> settings;
    for (std::size_t i = 0; i < rigs_; ++i) {
      const plant::Rig& file = files[many ? i : 0];
      if (file.tick_s != files.front().tick_s) throw py::value_error("rigs of a batch have the same tick");
      if (file.command_unit() != files.front().command_unit())
        throw py::value_error("rigs of a batch are commanded in the same unit");
      if (file.pair() != nullptr) throw py::value_error("rigs of a batch have one muscle each");
      if (file.valve.seals()) throw py::value_error("rigs of a batch are commanded, no sealed muscle is");
      if (file.lever() != nullptr)
        throw py::value_error("a batch counts heights of loads, not the angle of a lever");
      const double load_kg = loads_kg.data()[loads == 1 ? 0 : i];
      if (!file.can_hang(load_kg) || !(load_kg <= 500.0))
        throw py::value_error("loads_kg: masses of 0 to 500 kg, and something that moves");
      hanging.push_back({file, load_kg});
      settings.push_back(file.integrator);
      per_count_.push_back(run::contraction_per_count(file));
      zero_.push_back(file.valve.zero_command);
      settling_ticks_ = std::max(settling_ticks_, std::lround(file.settling_time_s / file.tick_s));
    }
    tick_s_ = files.front().tick_s;
    unit_ = files.front().command_unit();
    counts_.resize(rigs_);
    for (std::size_t first = 0; first < rigs_; first += most) {
      const std::size_t count = std::min(most, rigs_ - first);
      parts_.push_back(std::make_unique<ride::VectorRide>(std::span(hanging).subspan(first, count),
                                                          std::span(settings).subspan(first, count)));
    }
    start(std::nullopt);
  }

  void start(const std::optional<Numbers>& command) {
    const Turn turn(busy_);
    const std::vector<double> commands = command ? all(*command) : zero_;
    const py::gil_scoped_release released;
    counters_.clear();
    for (std::size_t i = 0; i < rigs_; ++i) counters_.emplace_back(rider(i).plant().rig());
    whole_ = true;
    ticks_ = -settling_ticks_;
    for_each_part([&](std::size_t p) {
      const auto mine = of_part(commands, p);
      parts_[p]->start(mine, time_s(ticks_));
      for (long k = ticks_; k < 0; ++k) step(p, mine, k);
    });
    ticks_ = 0;
  }

  void step(const Numbers& command) {
    const Turn turn(busy_);
    require_whole();
    const std::vector<double> commands = all(command);
    const py::gil_scoped_release released;
    for_each_part([&](std::size_t p) { step(p, of_part(commands, p), ticks_); });
    ++ticks_;
  }

  py::dict follow(const Numbers& command, const py::object& progress) {
    const Turn turn(busy_);
    require_whole();
    if (command.ndim() != 2 || static_cast<std::size_t>(command.shape(1)) != rigs_)
      throw py::value_error("command has the shape (ticks, rigs)");
    const auto ticks = static_cast<std::size_t>(command.shape(0));
    const std::span<const double> commands(command.data(), ticks * rigs_);
    for (std::size_t i = 0; i < commands.size(); ++i)
      if (const plant::Rig& rig = rider(i % rigs_).plant().rig(); !is_command(commands[i], rig))
        command_within(commands[i], rig, fmt::format("command[{}, {}]", i / rigs_, i % rigs_));
    auto rows = std::make_unique<Rows>();
    rows->state.resize(ticks * rigs_ * plant::single_size);
    rows->contraction_ratio.resize(ticks * rigs_);
    for (std::size_t k = 0; k < ticks; ++k) rows->time_s.push_back(time_s(ticks_ + static_cast<long>(k)));
    whole_ = false;  // where it ends on the way, parts have come to different instants
    do_long(progress, [&](const run::ProgressHook& hook) {
      for_each_part([&](std::size_t p) { follow(p, commands, *rows); },
                    [&](std::size_t done) { hook("following", done, parts_.size()); });
    });
    whole_ = true;
    ticks_ += static_cast<long>(ticks);
    return as_dict(std::move(rows));
  }

  py::array_t<double> contraction_ratio() const {
    py::array_t<double> read(static_cast<py::ssize_t>(rigs_));
    for (std::size_t i = 0; i < rigs_; ++i) read.mutable_data()[i] = read_ratio(i);
    return read;
  }
  py::array_t<double> state() const {
    py::array_t<double> states({static_cast<py::ssize_t>(rigs_), py::ssize_t{plant::single_size}});
    for (std::size_t i = 0; i < rigs_; ++i)
      std::copy_n(state_of(i), plant::single_size, states.mutable_data() + i * plant::single_size);
    return states;
  }
  py::dict failures() const {
    py::dict all;
    for (std::size_t i = 0; i < rigs_; ++i)
      if (const std::string& why = parts_[i / most]->failure(i % most); !why.empty()) all[py::int_(i)] = why;
    return all;
  }
  std::size_t rigs() const { return rigs_; }
  plant::CommandUnit command_unit() const { return unit_; }
  double now_s() const { return time_s(ticks_); }

 private:
  static constexpr std::size_t most = engine::Batch::most_lanes;  // rigs of a part

  void require_whole() const {
    if (!whole_) throw std::runtime_error("it was interrupted on the way; start it again");
  }
  std::vector<double> all(const Numbers& command) const {
    const auto given = static_cast<std::size_t>(command.size());
    if (command.ndim() > 1 || (given != 1 && given != rigs_))
      throw py::value_error("command: one number, or one for each rig");
    std::vector<double> commands(rigs_, command.data()[0]);
    if (given == rigs_) commands.assign(command.data(), command.data() + rigs_);
    for (std::size_t i = 0; i < rigs_; ++i)
      if (const plant::Rig& rig = rider(i).plant().rig(); !is_command(commands[i], rig))
        command_within(commands[i], rig, fmt::format("command[{}]", i));
    return commands;
  }
  std::span<const double> of_part(std::span<const double> all, std::size_t part) const {
    return all.subspan(part * most, parts_[part]->rigs());
  }
  void for_each_part(
      const std::function<void(std::size_t)>& job,
      const std::function<void(std::size_t)>& done = [](std::size_t) {}) const {
    run::for_each_job(parts_.size(), threads_, job, done);
  }
  const ride::Rider& rider(std::size_t rig) const { return parts_[rig / most]->rider(rig % most); }
  const double* state_of(std::size_t rig) const { return &rider(rig).now.flow.state.joint.contraction_ratio; }
  double read_ratio(std::size_t rig) const { return static_cast<double>(counts_[rig]) * per_count_[rig]; }
  double time_s(long ticks) const { return static_cast<double>(ticks) * tick_s_; }

  void follow(std::size_t part, std::span<const double> commands, Rows& rows) {
    for (std::size_t k = 0; k < rows.time_s.size(); ++k) {
      if (run::interrupted()) throw run::Interrupted();
      const std::size_t first = k * rigs_ + part * most;
      for (std::size_t i = 0; i < parts_[part]->rigs(); ++i) {
        rows.contraction_ratio[first + i] = read_ratio(part * most + i);
        std::copy_n(state_of(part * most + i), plant::single_size,
                    &rows.state[(first + i) * plant::single_size]);
      }
      step(part, of_part(commands.subspan(k * rigs_, rigs_), part), ticks_ + static_cast<long>(k));
    }
  }

  py::dict as_dict(std::unique_ptr<Rows> made) const {
    const Rows& rows = *made;
    const py::capsule owner(made.release(), [](void* kept) { delete static_cast<Rows*>(kept); });
    const auto ticks = static_cast<py::ssize_t>(rows.time_s.size()), n = static_cast<py::ssize_t>(rigs_);
    constexpr py::ssize_t size = sizeof(double), states = plant::single_size;
    py::dict all;
    all["time_s"] = view(rows.time_s.data(), {ticks}, {size}, owner);
    all["state"] =
        view(rows.state.data(), {ticks, n, states}, {n * states * size, states * size, size}, owner);
    all["contraction_ratio"] = view(rows.contraction_ratio.data(), {ticks, n}, {n * size, size}, owner);
    return all;
  }

  /// The tick `k` of a part.
  void step(std::size_t part, std::span<const double> commands, long k) {
    ride::VectorRide& rides = *parts_[part];
    rides.step(commands, time_s(k + 1));
    for (std::size_t i = 0; i < rides.rigs(); ++i)
      counts_[part * most + i] = counters_[part * most + i].count(rides.rider(i).now.reading.wheel_m);
  }

  unsigned threads_;
  std::size_t rigs_ = 0;
  std::vector<std::unique_ptr<ride::VectorRide>> parts_;
  std::vector<plant::PositionReader> counters_;
  std::vector<std::int64_t> counts_;
  std::vector<double> per_count_, zero_;
  plant::CommandUnit unit_{};
  double tick_s_ = 0.0;
  long ticks_ = 0, settling_ticks_ = 0;
  bool whole_ = true;
  Turn::Busy busy_{false};
};

}  // namespace

void add_batch(py::module_& module) {
  using Some = std::optional<Numbers>;
  const auto given = [](const Batch& batch, Some command, Some current_mA) {
    command = either(command, current_mA, batch.command_unit());
    if (!command) throw py::type_error("command is missing");
    return *command;
  };
  py::class_<Batch>(module, "Batch",
                    "Many rigs with a load each, stepped together, each under its own command.")
      .def(py::init<const py::object&, const Numbers&, unsigned>(), py::arg("rigs"), py::arg("loads_kg"),
           py::arg("threads") = 1,
           "One Rig (or what makes one) with a load [kg] each, shape (n,), or a list of n rigs with one "
           "muscle "
           "and the same tick. Eight rigs go through the laws at once where they can; what becomes of one "
           "depends neither on the others nor on threads, to the bit. They stand settled at 0 s, the valves "
           "at "
           "the lower ends of their lines.")
      .def(
          "start",
          [](Batch& batch, Some command, Some current_mA) {
            batch.start(either(command, current_mA, batch.command_unit()));
          },
          py::arg("command") = py::none(), py::kw_only(), py::arg("current_mA") = py::none(),
          "Settled at 0 s under these commands, one or n, in what the rigs' valves take.")
      .def(
          "step",
          [given](Batch& batch, Some command, Some current_mA) {
            batch.step(given(batch, command, current_mA));
          },
          py::arg("command") = py::none(), py::kw_only(), py::arg("current_mA") = py::none(),
          "A tick with these commands, one or n. A rig that cannot go on stays where it came to and is "
          "in `failures`; the others go on.")
      .def(
          "follow",
          [given](Batch& batch, Some command, const py::object& progress, Some current_mA) {
            return batch.follow(given(batch, command, current_mA), progress);
          },
          py::arg("command") = py::none(), py::arg("progress") = py::none(), py::kw_only(),
          py::arg("current_mA") = py::none(),
          "A tick for each row of commands, shape (ticks, n), in one call. Gives a dict of time_s "
          "(ticks,), state (ticks, n, 5) and contraction_ratio (ticks, n) as the encoder counts it, each as "
          "it was before the tick, without copies.")
      .def_property_readonly("contraction_ratio", &Batch::contraction_ratio,
                             "As the encoders count it [1], shape (n,).")
      .def_property_readonly(
          "state", &Batch::state,
          "True states, shape (n, 5): contraction ratio [1] and its speed [1/s], valve and "
          "muscle pressure [Pa], bristles [m].")
      .def_property_readonly("failures", &Batch::failures, "Why rigs could not go on, by their index.")
      .def_property_readonly("time_s", &Batch::now_s, "Now [s].")
      .def("__len__", &Batch::rigs);
}

}  // namespace mckibben::python
