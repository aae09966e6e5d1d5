// Python's lock is given back while rigs move; see the header.
#include <algorithm>
#include <atomic>
#include <cmath>
#include <ctime>
#include <map>
#include <numeric>
#include <string>
#include <thread>
#include <utility>

#include <fmt/format.h>

#include <sim/python/batch.hpp>
#include <sim/python/long_work.hpp>
#include <sim/python/pickles.hpp>
#include <sim/run/batch.hpp>
#include <sim/run/simulate.hpp>

namespace mckibben::python {
namespace {

/// A rig that a batch may have, with its load. Throws what Python shows as ValueError.
ride::Loaded hung(const plant::Rig& rig, double load_kg, const std::string& name) {
  if (rig.pair() != nullptr) throw py::value_error("rigs: those of a batch have one muscle each");
  if (rig.valve.seals()) throw py::value_error("rigs: those of a batch are commanded, no sealed muscle is");
  if (rig.lever() != nullptr)
    throw py::value_error("rigs: a batch counts heights of loads, not the angle of a lever");
  return {rig, load_within(load_kg, rig, name)};
}

/// One rig for all, or a list of them.
std::vector<plant::Rig> rigs_of(const py::object& rigs, std::size_t count) {
  if (!py::isinstance<py::list>(rigs) && !py::isinstance<py::tuple>(rigs)) return {count, rig_of(rigs).file};
  std::vector<plant::Rig> all;
  for (const auto& rig : rigs) all.push_back(rig_of(py::reinterpret_borrow<py::object>(rig)).file);
  return all;
}

/// What this thread has computed; others that wait for a processor do not count.
std::int64_t processor_ns() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return now.tv_sec * 1'000'000'000 + now.tv_nsec;
}

}  // namespace

Batch::Batch(const py::object& rigs, const Numbers& loads_kg, unsigned threads,
             const std::optional<Numbers>& jitter)
    : threads_(threads) {
  if (loads_kg.ndim() > 1) throw py::value_error("loads_kg has the shape (n,)");
  const auto loads = static_cast<std::size_t>(loads_kg.size());
  const std::vector<plant::Rig> files = rigs_of(rigs, loads);
  if (files.empty()) throw py::value_error("a batch has one rig at least");
  if (loads != 1 && loads != files.size())
    throw py::value_error(fmt::format("loads_kg has {} masses for {} rigs: give one, or one for each rig",
                                      loads, files.size()));
  for (std::size_t i = 0; i < files.size(); ++i) {
    const std::size_t of = loads == 1 ? 0 : i;
    members_.push_back({hung(files[i], loads_kg.data()[of], fmt::format("loads_kg[{}]", of))});
    require_alike(files[i]);
  }
  if (jitter) set_jitter(*jitter);
  start(std::nullopt);
}

void Batch::start(const std::optional<Numbers>& command) {
  const Turn turn(busy_);
  const std::vector<double> commands = command ? all(*command) : zeros();
  const py::gil_scoped_release released;
  whole_ = true;
  ticks_ = 0;
  parts_.clear();
  begin(everybody(), commands);
}

void Batch::restart(const std::vector<std::size_t>& which, const py::object& rigs,
                    const std::optional<Numbers>& loads_kg, const std::optional<Numbers>& command,
                    const std::optional<Numbers>& jitter) {
  const Turn turn(busy_);
  require_whole();
  const std::vector<double> commands = command ? all(*command) : zeros();
  if (loads_kg && static_cast<std::size_t>(loads_kg->size()) != which.size())
    throw py::value_error("loads_kg: one for each rig that begins again");
  if (jitter && static_cast<std::size_t>(jitter->size()) != which.size())
    throw py::value_error("jitter: one for each rig that begins again");
  std::vector<plant::Rig> files;
  if (!rigs.is_none()) files = rigs_of(rigs, which.size());
  if (!files.empty() && files.size() != which.size())
    throw py::value_error("rigs: one, or one for each that begins again");
  std::vector<Member> others;
  std::vector<bool> seen(members_.size());
  for (std::size_t i = 0; i < which.size(); ++i) {
    if (which[i] >= members_.size())
      throw py::index_error(fmt::format("which[{}] = {}: must be below {}", i, which[i], members_.size()));
    if (seen[which[i]]) throw py::value_error("which: each rig once");
    seen[which[i]] = true;
    const Member& now = members_[which[i]];
    const plant::Rig& rig = files.empty() ? now.hung.rig : files[i];
    require_alike(rig);
    others.push_back(
        {hung(rig, loads_kg ? loads_kg->data()[i] : now.hung.load_kg, fmt::format("loads_kg[{}]", i))});
    others.back().jitter = jitter ? jitter->data()[i] : now.jitter;
  }
  const py::gil_scoped_release released;
  for (std::size_t i = 0; i < which.size(); ++i) {
    const Member& before = members_[which[i]];
    parts_[before.part].rides->retire(before.place);
    parts_[before.part].rigs[before.place] = nobody;
    members_[which[i]] = others[i];
  }
  drop_empty_parts();
  begin(which, commands);
}

void Batch::step(const Numbers& command) {
  const Turn turn(busy_);
  require_whole();
  const std::vector<double> commands = all(command);
  const py::gil_scoped_release released;
  std::atomic<std::int64_t> spent_ns{0};
  const auto job = [&](std::size_t p) {
    const std::int64_t begin_ns = processor_ns();
    step(parts_[p], commands, ticks_);
    spent_ns += processor_ns() - begin_ns;
  };
  run::for_each_job(parts_.size(), threads_of_a_tick(), job, [](std::size_t) {});
  tick_ns_ = spent_ns;
  ++ticks_;
}

py::dict Batch::follow(const Numbers& command, const py::object& progress) {
  const Turn turn(busy_);
  require_whole();
  const std::size_t n = members_.size();
  if (command.ndim() != 2 || static_cast<std::size_t>(command.shape(1)) != n)
    throw py::value_error("command has the shape (ticks, rigs)");
  const auto ticks = static_cast<std::size_t>(command.shape(0));
  const std::span<const double> commands(command.data(), ticks * n);
  for (std::size_t i = 0; i < commands.size(); ++i)
    if (const plant::Rig& rig = rig_at(i % n); !is_command(commands[i], rig))
      command_within(commands[i], rig, fmt::format("command[{}, {}]", i / n, i % n));
  auto rows = std::make_unique<Rows>();
  rows->state.resize(ticks * n * plant::single_size);
  rows->contraction_ratio.resize(ticks * n);
  for (std::size_t k = 0; k < ticks; ++k) rows->time_s.push_back(time_s(ticks_ + static_cast<long>(k)));
  whole_ = false;  // where it ends on the way, parts have come to different instants
  do_long(progress, [&](const run::ProgressHook& hook) {
    for_each_part(
        0, [&](std::size_t p) { follow(parts_[p], commands, *rows); },
        [&](std::size_t done) { hook("following", done, parts_.size()); });
  });
  whole_ = true;
  ticks_ += static_cast<long>(ticks);
  return as_dict(std::move(rows));
}

py::tuple Batch::pickled() const {
  const Turn turn(busy_);
  py::list all;
  std::map<std::string, py::object> rigs;  // each once, however many loads hang on it
  for (const Member& member : members_) {
    py::object& rig = rigs[fields_of(member.hung.rig)];
    if (!rig) rig = py::cast(Rig{member.hung.rig});
    const ride::VectorRide::Saved saved = parts_[member.part].rides->save(member.place);
    all.append(py::make_tuple(rig, member.hung.load_kg,
                              bytes_of(saved, *member.counter, member.counts, member.jitter)));
  }
  return py::make_tuple(all, bytes_of(threads_, ticks_, whole_));
}

std::unique_ptr<Batch> Batch::unpickled(const py::tuple& state) {
  std::unique_ptr<Batch> batch(new Batch(1));
  read_bytes(state[1], batch->threads_, batch->ticks_, batch->whole_);
  const auto all = state[0].cast<std::vector<py::tuple>>();
  for (const py::tuple& one : all)
    batch->members_.push_back({hung(one[0].cast<const Rig&>().file, one[1].cast<double>(), "loads_kg")});
  batch->divide(batch->everybody());
  for (const Part& part : batch->parts_) {
    std::vector<ride::VectorRide::Saved> saved(part.rigs.size());
    for (std::size_t place = 0; place < part.rigs.size(); ++place) {
      Member& member = batch->members_[part.rigs[place]];
      read_bytes(all[part.rigs[place]][2], saved[place], *member.counter, member.counts, member.jitter);
    }
    part.rides->resume(saved, batch->now_s());
  }
  return batch;
}

py::array_t<double> Batch::contraction_ratio() const {
  py::array_t<double> read(static_cast<py::ssize_t>(rigs()));
  for (std::size_t i = 0; i < rigs(); ++i) read.mutable_data()[i] = read_ratio(i);
  return read;
}
py::array_t<double> Batch::state() const {
  py::array_t<double> states({static_cast<py::ssize_t>(rigs()), py::ssize_t{plant::single_size}});
  for (std::size_t i = 0; i < rigs(); ++i)
    std::copy_n(state_of(i), plant::single_size, states.mutable_data() + i * plant::single_size);
  return states;
}
py::dict Batch::failures() const {
  py::dict all;
  for (std::size_t i = 0; i < rigs(); ++i)
    if (const std::string& why = parts_[members_[i].part].rides->failure(members_[i].place); !why.empty())
      all[py::int_(i)] = why;
  return all;
}

void Batch::require_alike(const plant::Rig& rig) const {
  if (rig.tick_s != rig_at(0).tick_s) throw py::value_error("rigs of a batch have the same tick");
  if (rig.command_unit() != command_unit())
    throw py::value_error("rigs of a batch are commanded in the same unit");
}
void Batch::require_whole() const {
  if (!whole_) throw std::runtime_error("it was interrupted on the way; start it again");
}
std::vector<double> Batch::zeros() const {
  std::vector<double> commands;
  for (const Member& member : members_) commands.push_back(member.hung.rig.valve.zero_command);
  return commands;
}
std::vector<double> Batch::each(const Numbers& given, std::string_view name) const {
  const auto count = static_cast<std::size_t>(given.size());
  if (given.ndim() > 1 || (count != 1 && count != rigs()))
    throw py::value_error(fmt::format("{}: one number, or one for each rig", name));
  if (count == rigs()) return {given.data(), given.data() + rigs()};
  return std::vector<double>(rigs(), given.data()[0]);
}

std::vector<double> Batch::all(const Numbers& command) const {
  const std::vector<double> commands = each(command, "command");
  for (std::size_t i = 0; i < rigs(); ++i)
    if (!is_command(commands[i], rig_at(i)))
      command_within(commands[i], rig_at(i), fmt::format("command[{}]", i));
  return commands;
}

std::vector<std::size_t> Batch::everybody() const {
  std::vector<std::size_t> all(members_.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  return all;
}

/// These settle under their commands, up to the present instant, in parts of their own.
void Batch::begin(const std::vector<std::size_t>& which, std::span<const double> commands) {
  const std::size_t before = parts_.size();
  divide(which);
  long settling = 0;
  for (const std::size_t i : which)
    settling = std::max(settling, std::lround(rig_at(i).settling_time_s / rig_at(i).tick_s));
  for_each_part(before, [&](std::size_t p) {
    parts_[p].rides->start(of_part(parts_[p], commands), time_s(ticks_ - settling));
    for (long k = ticks_ - settling; k < ticks_; ++k) step(parts_[p], commands, k);
  });
}

/// Makes new parts of these.
void Batch::divide(const std::vector<std::size_t>& which) {
  constexpr std::size_t most = engine::Batch::most_lanes;
  for (std::size_t first = 0; first < which.size(); first += most) {
    const std::size_t count = std::min(most, which.size() - first);
    Part& part = parts_.emplace_back();
    std::vector<ride::Loaded> hanging;
    std::vector<solver::Settings> settings;
    for (std::size_t place = 0; place < count; ++place) {
      const std::size_t i = which[first + place];
      Member& member = members_[i];
      member.part = parts_.size() - 1;
      member.place = place;
      member.counter.emplace(member.hung.rig);
      part.rigs.push_back(i);
      hanging.push_back(member.hung);
      settings.push_back(member.hung.rig.integrator);
    }
    part.rides = std::make_unique<ride::VectorRide>(hanging, settings);
  }
}

void Batch::drop_empty_parts() {
  std::erase_if(parts_, [](const Part& part) {
    return std::ranges::all_of(part.rigs, [](std::size_t rig) { return rig == nobody; });
  });
  for (std::size_t p = 0; p < parts_.size(); ++p)
    for (const std::size_t rig : parts_[p].rigs)
      if (rig != nobody) members_[rig].part = p;
}

std::vector<double> Batch::of_part(const Part& part, std::span<const double> commands) const {
  std::vector<double> mine;
  for (const std::size_t rig : part.rigs) mine.push_back(rig == nobody ? 0.0 : commands[rig]);
  return mine;
}
void Batch::for_each_part(std::size_t first, const std::function<void(std::size_t)>& job,
                          const std::function<void(std::size_t)>& done) const {
  run::for_each_job(
      parts_.size() - first, threads_, [&](std::size_t p) { job(first + p); }, done);
}
const double* Batch::state_of(std::size_t rig) const {
  const Member& member = members_[rig];
  return &parts_[member.part].rides->rider(member.place).now.flow.state.joint.contraction_ratio;
}
double Batch::read_ratio(std::size_t rig) const {
  return static_cast<double>(members_[rig].counts) * run::contraction_per_count(rig_at(rig));
}

void Batch::set_jitter(const Numbers& ratios) {
  const std::vector<double> of_each = each(ratios, "jitter");
  for (std::size_t i = 0; i < rigs(); ++i) members_[i].jitter = of_each[i];
}
std::vector<double> Batch::jitter() const {
  std::vector<double> ratios;
  for (const Member& member : members_) ratios.push_back(member.jitter);
  return ratios;
}

void Batch::follow(Part& part, std::span<const double> commands, Rows& rows) {
  for (std::size_t k = 0; k < rows.time_s.size(); ++k) {
    if (run::interrupted()) throw run::Interrupted();
    for (const std::size_t rig : part.rigs) {
      if (rig == nobody) continue;
      const std::size_t at = k * rigs() + rig;
      rows.contraction_ratio[at] = read_ratio(rig);
      std::copy_n(state_of(rig), plant::single_size, &rows.state[at * plant::single_size]);
    }
    step(part, commands.subspan(k * rigs(), rigs()), ticks_ + static_cast<long>(k));
  }
}

py::dict Batch::as_dict(std::unique_ptr<Rows> made) const {
  const Rows& rows = *made;
  const py::capsule owner(made.release(), [](void* kept) { delete static_cast<Rows*>(kept); });
  const auto ticks = static_cast<py::ssize_t>(rows.time_s.size()), n = static_cast<py::ssize_t>(rigs());
  constexpr py::ssize_t size = sizeof(double), states = plant::single_size;
  py::dict all;
  all["time_s"] = view(rows.time_s.data(), {ticks}, {size}, owner);
  all["state"] = view(rows.state.data(), {ticks, n, states}, {n * states * size, states * size, size}, owner);
  all["contraction_ratio"] = view(rows.contraction_ratio.data(), {ticks, n}, {n * size, size}, owner);
  return all;
}

unsigned Batch::threads_of_a_tick() const {
  constexpr std::int64_t worth_ns = 200'000;  // one begins in some 50 us, where a processor is free
  const auto wanted = threads_ == 0 ? std::thread::hardware_concurrency() : threads_;
  return std::clamp(static_cast<unsigned>(tick_ns_ / worth_ns), 1U, std::max(wanted, 1U));
}

/// The tick `k` of a part.
void Batch::step(Part& part, std::span<const double> commands, long k) {
  part.rides->step(of_part(part, commands), time_s(k + 1));
  for (std::size_t place = 0; place < part.rigs.size(); ++place) {
    if (part.rigs[place] == nobody) continue;
    Member& member = members_[part.rigs[place]];
    const plant::Sensor& sensor = member.hung.rig.sensors.position();
    // What a slow sensor shows goes on, with its jitter; the first reading is one that settles.
    if (k >= ticks_ && sensor.taken_s(time_s(k + 1)) == sensor.taken_s(time_s(k))) continue;
    member.counts = member.counter->count(part.rides->rider(place).now.reading.wheel_m +
                                          member.jitter * member.hung.rig.muscle.rest_length_m);
  }
}

}  // namespace mckibben::python
