// The loop and what it tells; see the header.
#include <algorithm>
#include <cmath>
#include <exception>
#include <utility>

#include <fmt/format.h>

#include <sim/bench/device.hpp>
#include <sim/input/fields_json.hpp>
#include <sim/live/host.hpp>
#include <sim/live/page.hpp>

namespace mckibben::live {
namespace {

using input::Json;
using std::chrono::milliseconds;

constexpr double shown_each_s = 0.008;  // finer is not seen
constexpr double kept_s = 30.0;         // for who comes later
constexpr double most_behind_s = 0.25;  // what a machine loses beyond that, it does not catch up
constexpr double breath_s = 0.004;      // shorter ticks are made several at a time
constexpr std::size_t most_rows = 1'000'000;

}  // namespace

Host::Host(const plant::Rig& rig, double load_kg, DataSets data)
    : session_(rig, load_kg),
      channels_(channels_of(rig)),
      data_(std::move(data)),
      each_(static_cast<std::uint64_t>(std::max(1.0, std::floor(shown_each_s / rig.tick_s)))),
      thread_([this] { run(); }) {}

Host::~Host() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  moved_.notify_all();
  if (thread_.joinable()) thread_.join();
}

void Host::changed_state() {
  ++state_;
  moved_.notify_all();
}

void Host::tell(std::string text) {
  message_ = std::move(text);
  ++messages_;
  changed_state();
}

void Host::end_recording(const std::string& why) {
  if (!recording_) return;
  recording_->ended = why;
  const std::size_t rows = recording_->rows.samples.size();
  if (rows < least_rows)
    tell(fmt::format("The recording ended{}, after {} rows. It takes {} to make a run; nothing was written.",
                     why.empty() ? "" : ": " + why, rows, least_rows));
  ended_.push_back(*std::move(recording_));
  recording_.reset();
  changed_state();
}

void Host::step() {
  const bool moved = session_.failure().empty();
  const Sample& now = session_.step();
  if (recording_) {
    auto& rows = recording_->rows.samples;
    if (rows.empty()) recording_->load_kg = session_.load_kg();
    if (session_.failure().empty()) {
      rows.push_back(now);  // times begin with the run
      rows.back().time_s = run::tidy_s(static_cast<double>(rows.size() - 1) * session_.tick_s());
    }
    if (recording_->rows.samples.size() == most_rows)
      end_recording(fmt::format("{} rows are the most", most_rows));
  }
  if (moved && !session_.failure().empty()) {
    end_recording("the integration failed");
    changed_state();
    return;
  }
  if (ticks_++ % each_ != 0) return;
  samples_.push_back(now);
  const double apart_s = static_cast<double>(each_) * session_.tick_s();
  while (static_cast<double>(samples_.size()) * apart_s > kept_s && samples_.size() > 2) {
    samples_.pop_front();
    ++first_sample_;
  }
}

void Host::run() {
  bench::RealClock clock;
  const double tick_s = session_.tick_s();
  double next_s = clock.now_s(), since_s = next_s;
  std::uint64_t since_ticks = 0;
  for (;;) {
    {
      std::unique_lock lock(mutex_);
      if (stop_) return;
      if (!running_ || !session_.failure().empty()) {
        moved_.wait_for(lock, milliseconds(50));
        next_s = since_s = clock.now_s();
        since_ticks = ticks_;
        continue;
      }
      const double until_s = next_s + std::max(breath_s, tick_s);
      try {
        for (; next_s < until_s && session_.failure().empty(); next_s += tick_s) step();
      } catch (const std::exception& defect) {  // shown, not the end of the program
        running_ = false;
        tell(fmt::format("Stopped by a defect of the program; please report it: {}", defect.what()));
      }
      const double now_s = clock.now_s();
      if (now_s - next_s > most_behind_s) next_s = now_s;
      if (now_s - since_s > 1.0) {
        const double pace = static_cast<double>(ticks_ - since_ticks) * tick_s / (now_s - since_s);
        if (std::abs(pace - pace_) > 0.05) changed_state();
        if (std::abs(pace - pace_) > 0.05) pace_ = pace;
        since_s = now_s;
        since_ticks = ticks_;
      }
    }
    moved_.notify_all();
    clock.wait_until(next_s);
  }
}

namespace {

template <class... Each>
struct Overloaded : Each... {
  using Each::operator()...;
};
template <class... Each>
Overloaded(Each...) -> Overloaded<Each...>;  // clang 14 needs to be told

}  // namespace

std::string Host::obey(const Command& command) {
  const std::lock_guard lock(mutex_);
  const auto done = [&](std::string why, const char* ends = nullptr) {
    if (why.empty() && ends != nullptr) end_recording(ends);
    if (why.empty()) changed_state();
    return why;
  };
  return std::visit(
      Overloaded{
          [&](const SetCommand& it) { return done(session_.set_command(it.to, it.muscle)); },
          [&](const Sweep& sweep) { return done(session_.set_sweep(sweep)); },
          [&](const SetLoad& to) { return done(session_.set_load(to.kg), "another load was hung on"); },
          [&](const SetEffect& to) {
            return done(session_.set_effect(to.name, to.on, to.size, to.shape), "effects were switched");
          },
          [&](const HideEffect& it) {
            return done(session_.hide_effect(it.name, it.size, it.shape), "effects were switched");
          },
          [&](const ShowEffect&) {
            session_.show_effect();
            return done("");
          },
          [&](const StartOver&) {
            session_.start_over();
            return done("", "it began again");
          },
          [&](const SetRunning& run) {
            running_ = run.on;
            return done("");
          },
          [&](const Record& record) -> std::string {
            if (recording_) return "a recording is under way";
            if (session_.rig().has_angle() && !record.from_rest && !session_.untouched())
              return session_.pair()
                         ? "of two muscles a recording begins from rest: their data sets cannot say otherwise"
                         : "of a lever a recording begins from rest: its data set cannot say otherwise";
            if (record.from_rest) session_.start_over();
            if (!session_.failure().empty()) return "nothing moves: the integration failed";
            recording_.emplace();
            recording_->number = ++recordings_;
            recording_->rig = session_.rig();
            recording_->known = session_.switches().known();
            recording_->load_kg = session_.load_kg();
            recording_->settled = session_.untouched();
            recording_->rows.driven.pair = session_.pair();
            running_ = true;
            return done("");
          },
          [&](const StopRecording&) -> std::string {
            if (!recording_) return "nothing is being recorded";
            return done("", "");
          }},
      command);
}

std::string Host::state_json() const {
  const auto& wanted = session_.wanted();
  Json state{{"running", running_},
             {"wanted", session_.pair() ? Json(wanted) : Json{wanted[0]}},
             {"sweep", session_.sweep() ? sweep_json(*session_.sweep()) : Json()},
             {"pace", std::round(100.0 * pace_) / 100.0},
             {"recording", recording_.has_value()},
             {"message", {{"number", messages_}, {"text", message_}}},
             {"failure", session_.failure()},
             {"effects", Json::array()},
             {"hidden", session_.switches().hidden()}};
  if (!session_.pair()) state["load_kg"] = session_.load_kg();
  for (const Switch& one : session_.switches().all()) state["effects"].push_back(effect_json(one));
  return state.dump(-1, ' ', true, Json::error_handler_t::replace);
}

std::string Host::news(Heard& heard, milliseconds longest) {
  std::unique_lock lock(mutex_);
  const auto last = [&] { return first_sample_ + samples_.size(); };
  moved_.wait_for(lock, longest, [&] { return stop_ || heard.samples < last() || heard.state != state_; });
  std::string text;
  if (heard.samples < last()) {
    const std::uint64_t from = std::max(heard.samples, first_sample_);
    text += fmt::format("\"from\":{},\"samples\":[", from);
    for (std::uint64_t i = from; i < last(); ++i) {
      if (i > from) text += ',';
      append(text, channels_, samples_[i - first_sample_]);
    }
    text += ']';
    heard.samples = last();
  }
  if (heard.state != state_) {
    text += (text.empty() ? "\"state\":" : ",\"state\":") + state_json();
    heard.state = state_;
  }
  return text.empty() ? "" : "{" + text + "}";
}

void Host::write_recordings(const output::Say& say) {
  std::deque<Recording> ended;
  std::optional<Recording> goes_on;
  {
    std::unique_lock lock(mutex_);
    moved_.wait_for(lock, milliseconds(50), [&] { return stop_ || !ended_.empty(); });
    ended.swap(ended_);
    if (recording_) goes_on = recording_->from(data_.rows_of(recording_->number));
  }
  for (Recording& each : ended) {
    if (each.rows.samples.size() < least_rows) {
      data_.drop(each.number);
      continue;
    }
    std::string text;
    const std::string why = each.ended.empty() ? "" : " (it ended: " + each.ended + ")";
    const double lasting_s = static_cast<double>(each.rows.samples.size()) * each.rig.tick_s;
    const std::string under = each.rig.pair() != nullptr ? "" : fmt::format(" under {:g} kg", each.load_kg);
    try {
      const auto folder = data_.put(std::move(each));
      text = fmt::format("Recorded {:.1f} s{} into {}, run {}{}.", lasting_s, under, folder.string(),
                         data_.runs(), why);
    } catch (const output::CannotWrite& cannot) {
      text = fmt::format("The recording is kept, and will be written with the next one: {}", cannot.what());
    }
    say(text);
    const std::lock_guard lock(mutex_);
    tell(text);
  }
  if (goes_on) data_.follow(*goes_on);
}

void Host::finish(const output::Say& say) {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
    end_recording("the program ended");
  }
  moved_.notify_all();
  thread_.join();
  write_recordings(say);
  data_.flush();
}

}  // namespace mckibben::live
