// A bench whose answer is known: settled points of a muscle at several lengths, pressure given, force read.
#pragma once

#include <random>

#include <fmt/format.h>

#include <sim/data/judged.hpp>
#include <sim/diagnose/predict.hpp>

namespace mckibben::diagnose {

/// Each length a run, pressures from 0.5 bar up; readings of `truth` with noise, handed over with the nominal
/// rig.
inline domain::Dataset on_a_bench(const plant::Rig& truth, double noise_N) {
  std::mt19937_64 random(11);
  std::normal_distribution<double> noise(0.0, noise_N);
  domain::Dataset data;
  data.own_clock = true;
  data.path = "bench/dataset.yaml";
  for (const double length : {0.01, 0.06, 0.11, 0.16, 0.21}) {
    domain::Run& run = data.runs.emplace_back();
    run.id = fmt::format("r{}", data.runs.size());
    run.rest_length_m = truth.muscle.rest_length_m;
    domain::Measurement& measured = run.measured.emplace();
    measured.point_s = 5.0;
    for (double k = 0.0; k < 9.0; k += 1.0) {
      measured.time_s.push_back(measured.point_s * k);
      measured.give("contraction").push_back(length);
      measured.give("muscle_pressure").push_back(5e4 * (k + 1.0));
    }
    const Loaded held{truth, 0.0};
    run.read("force");
    measured.take("force") = predict(run, {&held, 1}).front().judged();
    run.readings.clear();
    for (double& force_N : measured.take("force")) force_N = std::max(0.0, force_N + noise(random));
  }
  return data::with_rows(std::move(data));
}

}  // namespace mckibben::diagnose
