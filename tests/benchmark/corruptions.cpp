// See the header.
#include "corruptions.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <sim/diagnose/predict.hpp>
#include <sim/run/simulate.hpp>

namespace mckibben::diagnose {
namespace {

constexpr double length_m = 0.3;  // of the muscle: what a mm is in contraction ratio
constexpr std::size_t rows = 660;

/// The same six of the nine runs, cut to one length: every load, all kinds of current but one.
Hidden six_runs(const std::string& name, std::uint64_t seed) {
  Hidden hidden = hide(kind_titled(name), seed);
  std::vector<domain::Run> kept;
  for (const std::size_t run : {0u, 1u, 3u, 4u, 6u, 7u}) {
    kept.push_back(std::move(hidden.data.runs[run]));
    kept.back().current_mA.resize(std::min(rows, kept.back().current_mA.size()));
    kept.back().judged().values.resize(kept.back().current_mA.size());
    kept.back().id = "r0" + std::to_string(kept.size());
    kept.back().file = kept.back().id + ".csv";
  }
  hidden.data.runs = std::move(kept);
  hidden.data.path = "corrupted/dataset.yaml";
  return hidden;
}

using Series = std::vector<double>;

domain::Run& run(domain::Dataset& data, std::size_t number) {
  return data.runs[number - 1];
}

/// Readings that come some ticks late; early if negative.
void late(domain::Run& run, int ticks) {
  const Series was = run.judged().values;
  const auto last = static_cast<int>(was.size()) - 1;
  for (int k = 0; k <= last; ++k)
    run.judged().values[static_cast<std::size_t>(k)] =
        was[static_cast<std::size_t>(std::clamp(k - ticks, 0, last))];
}

double counted(const domain::Dataset& data, double ratio) {
  const double count = run::contraction_per_count(data.rig);
  return count * std::floor(ratio / count + 0.5);
}

/// A straight line added to the readings, from 0 to so much at the end.
void drift(const domain::Dataset& data, domain::Run& run, double end_mm) {
  const auto all = static_cast<double>(run.rows());
  for (std::size_t k = 0; k < run.rows(); ++k)
    run.judged().values[k] =
        counted(data, run.judged().values[k] + 1e-3 * end_mm / length_m * static_cast<double>(k) / all);
}

/// So many counts more from a row on.
void slip(const domain::Dataset& data, domain::Run& run, std::size_t row, int counts) {
  for (std::size_t k = row; k < run.rows(); ++k)
    run.judged().values[k] += counts * run::contraction_per_count(data.rig);
}

/// The run made again on the nominal rig with something wrong in it that the table does not tell.
void make_again(domain::Dataset& data, domain::Run& run, const Series& true_current_mA, double load_kg,
                const plant::Rig& truth) {
  domain::Run moved = run;
  moved.current_mA = true_current_mA;
  const Loaded hanging{truth, load_kg};
  const auto readings = predict(moved, {&hanging, 1}).front().judged();
  const double count = run::contraction_per_count(data.rig);
  for (std::size_t k = 0; k < readings.size(); ++k)
    run.judged().values[k] = count * std::floor(readings[k] / count);
}

void lose_rows(domain::Run& run, std::size_t row, std::size_t count) {
  const auto cut = [&](Series& values) {
    const auto begin = values.begin() + static_cast<std::ptrdiff_t>(row);
    values.erase(begin, begin + static_cast<std::ptrdiff_t>(count));
  };
  cut(run.judged().values);
  run.current_mA.resize(run.rows());
}

/// The change, made to every run.
template <class Change>
auto each(Change change) {
  return [change](domain::Dataset& data) {
    for (domain::Run& one : data.runs) change(data, one);
  };
}

using Data = domain::Dataset;

/// Readings that come at other times.
std::vector<Corruption> in_time() {
  return {{"late 3", "r02", {"late"}, [](Data& d) { late(run(d, 2), 3); }},
          {"late 1", "r03", {"late"}, [](Data& d) { late(run(d, 3), 1); }},
          {"early 2", "r05", {"early"}, [](Data& d) { late(run(d, 5), -2); }},
          {"late 5 twice", "r04", {"late"}, [](Data& d) { late(run(d, 1), 5), late(run(d, 4), 5); }},
          {"late 2 everywhere",
           "",
           {"late"},
           each([](Data&, domain::Run& r) { late(r, 2); }),
           {"command_delay", "reading_delay"}}};
}

/// Another rig, or another current than is written.
std::vector<Corruption> of_the_rig() {
  return {{"another rig",
           "r04",
           {"another rig"},
           [](Data& d) {
             const auto other = six_runs("bladder_elasticity large", 77);
             run(d, 4) = other.data.runs[3];
           }},
          {"another muscle",
           "r01",
           {"another rig"},
           [](Data& d) {
             plant::Rig truth;
             truth.muscle.rest_radius_m *= 1.04;
             truth.muscle.end_correction *= 1.02;
             make_again(d, run(d, 1), run(d, 1).current_mA, run(d, 1).load_kg, truth);
           }},
          {"current x 1.05",
           "r05",
           {"current"},
           [](Data& d) {
             for (double& i : run(d, 5).current_mA) i *= 1.05;
           }},
          {"current x 0.97",
           "r03",
           {"current"},
           [](Data& d) {
             for (double& i : run(d, 3).current_mA) i *= 0.97;
           }},
          {"current + 0.3 mA", "r02", {"current"}, [](Data& d) {
             for (double& i : run(d, 2).current_mA) i += 0.3;
           }}};
}

/// Readings whose zero moves.
std::vector<Corruption> of_the_zero() {
  return {{"drift 1 mm", "r06", {"drift"}, [](Data& d) { drift(d, run(d, 6), 1.0); }},
          {"drift -0.6 mm", "r01", {"drift"}, [](Data& d) { drift(d, run(d, 1), -0.6); }},
          {"drift 1 mm everywhere", "", {"drift"}, each([](Data& d, domain::Run& r) { drift(d, r, 1.0); })},
          {"zero 4 counts", "r03", {"zero"}, [](Data& d) { slip(d, run(d, 3), 0, 4); }},
          {"zero 1 to 3 counts",
           "",
           {"zero"},
           [](Data& d) {
             const int counts[] = {2, -1, 3, 1, -3, 2};
             for (std::size_t r = 0; r < d.runs.size(); ++r) slip(d, d.runs[r], 0, counts[r % 6]);
           }},
          {"zero 5 counts everywhere", "", {"zero"}, each([](Data& d, domain::Run& r) { slip(d, r, 0, 5); })},
          {"slip 8 counts", "r04", {"slip", "lost"}, [](Data& d) { slip(d, run(d, 4), 300, 8); }},
          {"slip -4 counts", "r02", {"slip", "lost"}, [](Data& d) { slip(d, run(d, 2), 400, -4); }}};
}

/// What fails while it runs.
std::vector<Corruption> while_it_ran() {
  return {{"valve stuck in half",
           "r05",
           {"stuck"},
           [](Data& d) {
             Series stuck = run(d, 5).current_mA;
             for (std::size_t k = stuck.size() / 2; k < stuck.size(); ++k) stuck[k] = stuck[stuck.size() / 2];
             make_again(d, run(d, 5), stuck, run(d, 5).load_kg, plant::Rig{});
           }},
          {"valve stuck for 2 s",
           "r01",
           {"stuck"},
           [](Data& d) {
             Series stuck = run(d, 1).current_mA;
             for (std::size_t k = 250; k < 417; ++k) stuck[k] = stuck[250];
             make_again(d, run(d, 1), stuck, run(d, 1).load_kg, plant::Rig{});
           }},
          {"saturated",
           "r01",
           {"saturated", "frozen"},
           [](Data& d) {
             auto& e = run(d, 1).judged().values;
             const double most = counted(d, 0.8 * *std::max_element(e.begin(), e.end()));
             for (double& ratio : e) ratio = std::min(ratio, most);
           }},
          {"frozen for 1 s",
           "r04",
           {"frozen"},
           [](Data& d) {
             auto& e = run(d, 4).judged().values;
             std::fill(e.begin() + 200, e.begin() + 283, e[200]);
           }},
          {"reading x 1.03",
           "r06",
           {"scale"},
           [](Data& d) {
             for (double& ratio : run(d, 6).judged().values) ratio = counted(d, 1.03 * ratio);
           }},
          {"5 rows lost", "r03", {"rows", "lost"}, [](Data& d) { lose_rows(run(d, 3), 320, 5); }}};
}

/// Tables that say something else than was.
std::vector<Corruption> of_the_table() {
  return {
      {"loads in g", "", {"g, not kg", "grams", "in g"}, each([](Data&, domain::Run& r) {
         r.load_kg *= 0.001;
       })},
      {"loads in lb", "", {"pounds", "lb"}, each([](Data&, domain::Run& r) { r.load_kg /= 0.45359237; })},
      {"loads exchanged", "r04", {"load"}, [](Data& d) { std::swap(run(d, 1).load_kg, run(d, 4).load_kg); }},
      {"load + 20 %", "r03", {"load"}, [](Data& d) { run(d, 3).load_kg *= 1.2; }},
      {"mm for a ratio", "", {"mm", "millimetres"}, each([](Data&, domain::Run& r) {
         for (double& ratio : r.judged().values) ratio *= 1e3 * length_m;
       })},
      {"ratio / 300", "", {"mm", "millimetres", "metres", "stroke"}, each([](Data&, domain::Run& r) {
         for (double& ratio : r.judged().values) ratio /= 1e3 * length_m;
       })},
      {"wrong sign",
       "r02",
       {"sign"},
       [](Data& d) {
         for (double& ratio : run(d, 2).judged().values) ratio = -ratio;
       }},
      {"the same run twice", "r06", {"copy"}, [](Data& d) {
         run(d, 6) = run(d, 1);
         run(d, 6).id = "r06";
       }}};
}

/// Of every reading, from the one before.
void filtered(domain::Run& run, double cut_off_Hz, double tick_s) {
  const double keeps = std::exp(-2.0 * std::numbers::pi * cut_off_Hz * tick_s);
  double last = run.judged().values.front();
  for (double& ratio : run.judged().values) ratio = last = std::lerp(ratio, last, keeps);
}

/// What a bench has wrong in all runs or in half of them.
std::vector<Corruption> of_the_bench() {
  const auto half = [](auto change) {
    return [change](Data& d) {
      for (std::size_t r = 4; r <= 6; ++r)
        for (double& ratio : run(d, r).judged().values) ratio = counted(d, change(ratio));
    };
  };
  return {{"loads + 1 kg", "", {"All loads"}, each([](Data&, domain::Run& r) { r.load_kg += 1.0; })},
          {"loads + 5 %", "", {"All loads"}, each([](Data&, domain::Run& r) { r.load_kg *= 1.05; })},
          {"steps of 0.5 mm", "", {"steps"}, each([](Data&, domain::Run& r) {
             const double step = 5e-4 / length_m;
             for (double& ratio : r.judged().values) ratio = step * std::round(ratio / step);
           })},
          {"zero 2 mm in half", "r05", {"zero"}, half([](double ratio) { return ratio + 2e-3 / length_m; })},
          {"gain 3 % in half", "r05", {"%", "gain"}, half([](double ratio) { return 1.03 * ratio; })},
          {"clock 1 % fast", "", {"clock"}, each([](Data& d, domain::Run& r) {
             const Series was = r.judged().values;
             const auto last = static_cast<double>(was.size() - 1);
             for (std::size_t k = 0; k < was.size(); ++k) {
               const double at = std::min(1.01 * static_cast<double>(k), last);
               const auto before = static_cast<std::size_t>(at), after = std::min(before + 1, was.size() - 1);
               const double share = at - static_cast<double>(before);
               r.judged().values[k] = counted(d, std::lerp(was[before], was[after], share));
             }
           })},
          {"filter 20 Hz",
           "",
           {"late"},
           each([](Data& d, domain::Run& r) { filtered(r, 20.0, d.rig.tick_s); }),
           {"command_delay", "reading_delay", "valve_lag"}},
          {"counts halved", "", {"halved", "counts per turn"}, each([](Data&, domain::Run& r) {
             for (double& ratio : r.judged().values) ratio *= 0.5;
           })}};
}

}  // namespace

const std::vector<Corruption>& corruptions() {
  static const std::vector<Corruption> list = [] {
    std::vector<Corruption> all;
    for (const auto& group :
         {in_time(), of_the_rig(), of_the_zero(), while_it_ran(), of_the_table(), of_the_bench()})
      all.insert(all.end(), group.begin(), group.end());
    return all;
  }();
  return list;
}

std::vector<Hidden> sound_data(std::uint64_t seed) {
  std::vector<Hidden> list;
  for (const char* name : {"nothing, ripple", "muscle_leak large", "speed_dependent_friction large"})
    list.push_back(six_runs(name, seed));
  return list;
}

}  // namespace mckibben::diagnose
