// Many rides as arrays: fleets, as many as fill their lanes, on as many threads as wanted.
#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <plant/instruments.hpp>
#include <sim/python/inputs.hpp>
#include <sim/python/long_work.hpp>
#include <sim/python/turn.hpp>
#include <sim/ride/fleet.hpp>
#include <sim/run/batch.hpp>
#include <sim/run/simulate.hpp>

namespace mckibben::python {
namespace {

using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;

/// What comes of many ticks.
struct Rows {
  std::vector<double> time_s, state, contraction_ratio;
};

class Flock {
 public:
  Flock(const py::object& rigs, const Numbers& loads_kg, unsigned threads) : threads_(threads) {
    const bool many = py::isinstance<py::list>(rigs) || py::isinstance<py::tuple>(rigs);
    std::vector<domain::RigFile> files;
    if (many)
      for (const auto& rig : rigs) files.push_back(rig_of(py::reinterpret_borrow<py::object>(rig)).file);
    else
      files.push_back(rig_of(rigs).file);
    const auto loads = static_cast<std::size_t>(loads_kg.size());
    rigs_ = many ? files.size() : loads;
    if (rigs_ == 0) throw py::value_error("a flock has one rig at least");
    if (loads != 1 && loads != rigs_) throw py::value_error("loads_kg: one number, or one for each rig");
    std::vector<ride::Hanging> hanging;
    std::vector<solver::Settings> settings;
    for (std::size_t i = 0; i < rigs_; ++i) {
      const domain::RigFile& file = files[many ? i : 0];
      if (file.tick_s != files.front().tick_s) throw py::value_error("rigs of a flock have the same tick");
      if (file.pair() != nullptr) throw py::value_error("rigs of a flock have one muscle each");
      const double load_kg = loads_kg.data()[loads == 1 ? 0 : i];
      if (!(load_kg + file.joint.load_offset_kg > 0.0) || !(load_kg <= 500.0))
        throw py::value_error("loads_kg: masses above 0 and up to 500 kg");
      hanging.push_back({file, load_kg});
      settings.push_back(file.integrator);
      per_count_.push_back(run::contraction_per_count(file));
      zero_mA_.push_back(file.valve.zero_current_mA);
      settling_ticks_ = std::max(settling_ticks_, std::lround(file.settling_time_s / file.tick_s));
    }
    tick_s_ = files.front().tick_s;
    counts_.resize(rigs_);
    for (std::size_t first = 0; first < rigs_; first += engine::Convoy::places) {
      const std::size_t count = std::min(engine::Convoy::places, rigs_ - first);
      fleets_.push_back(std::make_unique<ride::Fleet>(std::span(hanging).subspan(first, count),
                                                      std::span(settings).subspan(first, count)));
    }
    start(std::nullopt);
  }

  void start(const std::optional<Numbers>& current_mA) {
    const Turn turn(busy_);
    const std::vector<double> currents = current_mA ? all(*current_mA) : zero_mA_;
    const py::gil_scoped_release released;
    counters_.clear();
    for (std::size_t i = 0; i < rigs_; ++i)
      counters_.emplace_back(fleet_of(i).rider(place_of(i)).plant().rig());
    ticks_ = -settling_ticks_;
    run::for_each_job(
        fleets_.size(), threads_,
        [&](std::size_t f) {
          const auto mine = part(currents, f);
          fleets_[f]->start(mine, time_s(-settling_ticks_));
          for (long k = -settling_ticks_; k < 0; ++k) step(f, mine, k);
        },
        [](std::size_t) {});
    ticks_ = 0;
  }

  void step(const Numbers& current_mA) {
    const Turn turn(busy_);
    const std::vector<double> currents = all(current_mA);
    const py::gil_scoped_release released;
    run::for_each_job(
        fleets_.size(), threads_, [&](std::size_t f) { step(f, part(currents, f), ticks_); },
        [](std::size_t) {});
    ++ticks_;
  }

  py::dict follow(const Numbers& current_mA, const py::object& progress) {
    const Turn turn(busy_);
    if (current_mA.ndim() != 2 || static_cast<std::size_t>(current_mA.shape(1)) != rigs_)
      throw py::value_error("current_mA has the shape (ticks, rigs)");
    const auto ticks = static_cast<std::size_t>(current_mA.shape(0));
    const std::span<const double> currents(current_mA.data(), ticks * rigs_);
    require_finite(currents);
    auto rows = std::make_unique<Rows>();
    rows->state.resize(ticks * rigs_ * plant::single_size);
    rows->contraction_ratio.resize(ticks * rigs_);
    for (std::size_t k = 0; k < ticks; ++k) rows->time_s.push_back(time_s(ticks_ + static_cast<long>(k)));
    do_long(progress, [&](const run::ProgressHook& hook) {
      run::for_each_job(
          fleets_.size(), threads_, [&](std::size_t f) { follow(f, currents, *rows); },
          [&](std::size_t done) { hook("following", done, fleets_.size()); });
    });
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
      if (const std::string& why = fleet_of(i).failure(place_of(i)); !why.empty()) all[py::int_(i)] = why;
    return all;
  }
  std::size_t rigs() const { return rigs_; }
  double now_s() const { return time_s(ticks_); }

 private:
  static void require_finite(std::span<const double> currents) {
    for (const double current_mA : currents)
      if (!std::isfinite(current_mA)) throw py::value_error("current_mA holds what is no finite number");
  }
  std::vector<double> all(const Numbers& current_mA) const {
    const auto given = static_cast<std::size_t>(current_mA.size());
    if (given != 1 && given != rigs_) throw py::value_error("current_mA: one number, or one for each rig");
    std::vector<double> currents(rigs_, current_mA.data()[0]);
    if (given == rigs_) currents.assign(current_mA.data(), current_mA.data() + rigs_);
    require_finite(currents);
    return currents;
  }
  std::span<const double> part(std::span<const double> all, std::size_t fleet) const {
    return all.subspan(fleet * engine::Convoy::places, fleets_[fleet]->rigs());
  }
  const ride::Fleet& fleet_of(std::size_t rig) const { return *fleets_[rig / engine::Convoy::places]; }
  static std::size_t place_of(std::size_t rig) { return rig % engine::Convoy::places; }
  const double* state_of(std::size_t rig) const {
    return &fleet_of(rig).rider(place_of(rig)).now.flow.state.joint.contraction_ratio;
  }
  double read_ratio(std::size_t rig) const { return static_cast<double>(counts_[rig]) * per_count_[rig]; }
  double time_s(long ticks) const { return static_cast<double>(ticks) * tick_s_; }

  void follow(std::size_t f, std::span<const double> currents, Rows& rows) {
    for (std::size_t k = 0; k < rows.time_s.size() && !run::interrupted(); ++k) {
      write(f, k, rows);
      step(f, part(currents.subspan(k * rigs_, rigs_), f), ticks_ + static_cast<long>(k));
    }
    if (run::interrupted()) throw run::Interrupted();
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

  /// The tick `k` of one fleet.
  void step(std::size_t f, std::span<const double> currents, long k) {
    ride::Fleet& fleet = *fleets_[f];
    fleet.step(currents, time_s(k + 1));
    for (std::size_t place = 0; place < fleet.rigs(); ++place) {
      const std::size_t rig = f * engine::Convoy::places + place;
      counts_[rig] = counters_[rig].count(fleet.rider(place).now.reading.wheel_m);
    }
  }

  void write(std::size_t f, std::size_t k, Rows& rows) const {
    for (std::size_t place = 0; place < fleets_[f]->rigs(); ++place) {
      const std::size_t rig = f * engine::Convoy::places + place, row = k * rigs_ + rig;
      rows.contraction_ratio[row] = read_ratio(rig);
      std::copy_n(state_of(rig), plant::single_size,
                  rows.state.begin() + static_cast<std::ptrdiff_t>(row * plant::single_size));
    }
  }

  unsigned threads_;
  std::size_t rigs_ = 0;
  std::vector<std::unique_ptr<ride::Fleet>> fleets_;
  std::vector<plant::PositionReader> counters_;
  std::vector<std::int64_t> counts_;
  std::vector<double> per_count_, zero_mA_;
  double tick_s_ = 0.0;
  long ticks_ = 0, settling_ticks_ = 0;
  Turn::Busy busy_{false};
};

}  // namespace

void add_fleets(py::module_& module) {
  py::class_<Flock>(module, "Flock",
                    "Many rigs with a load each, stepped together, each under its own current.")
      .def(py::init<const py::object&, const Numbers&, unsigned>(), py::arg("rigs"), py::arg("loads_kg"),
           py::arg("threads") = 1,
           "One Rig (or what makes one) with a load [kg] each, shape (n,), or a list of n rigs with one "
           "muscle "
           "and the same tick. Eight rigs go through the laws at once where they can; what becomes of one "
           "depends neither on the others nor on threads, to the bit. They stand settled at 0 s, the valves "
           "at "
           "the lower ends of their lines.")
      .def("start", &Flock::start, py::arg("current_mA") = py::none(),
           "Settled at 0 s under these currents [mA], one or n.")
      .def("step", py::overload_cast<const Numbers&>(&Flock::step), py::arg("current_mA"),
           "A tick with these currents [mA], one or n. A rig that cannot go on stays where it came to and is "
           "in `failures`; the others go on.")
      .def("follow", py::overload_cast<const Numbers&, const py::object&>(&Flock::follow),
           py::arg("current_mA"), py::arg("progress") = py::none(),
           "A tick for each row of currents [mA], shape (ticks, n), in one call. Gives a dict of time_s "
           "(ticks,), state (ticks, n, 5) and contraction_ratio (ticks, n) as the encoder counts it, each as "
           "it was before the tick, without copies.")
      .def_property_readonly("contraction_ratio", &Flock::contraction_ratio,
                             "As the encoders count it [1], shape (n,).")
      .def_property_readonly(
          "state", &Flock::state,
          "True states, shape (n, 5): contraction ratio [1] and its speed [1/s], valve and "
          "muscle pressure [Pa], bristles [m].")
      .def_property_readonly("failures", &Flock::failures, "Why rigs could not go on, by their index.")
      .def_property_readonly("time_s", &Flock::now_s, "Now [s].")
      .def("__len__", &Flock::rigs);
}

}  // namespace mckibben::python
