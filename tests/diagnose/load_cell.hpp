// A hanging load whose answer is known: pressure given, contraction read, and a load cell on the cord.
#pragma once

#include <cmath>
#include <numbers>
#include <random>

#include <fmt/format.h>

#include <sim/diagnose/predict.hpp>

namespace mckibben::diagnose {

struct CellNoise {
  double ratio = 5e-5, force_N = 2.0;
};

inline constexpr std::size_t rows_with_a_cell = 160;

/// Six runs of 1.9 s, three loads, a row each 12 ms; readings of `truth` with noise, handed over with the
/// nominal rig.
inline domain::Dataset with_a_cell(const plant::Rig& truth, CellNoise noise = {}) {
  std::mt19937_64 random(13);
  std::normal_distribution<double> normal;
  domain::Dataset data;
  data.own_clock = true;
  data.path = "cell/dataset.yaml";
  for (std::size_t i = 0; i < 6; ++i) {
    domain::Run& run = data.runs.emplace_back();
    run.id = fmt::format("r{}", i + 1);
    run.load_kg = 10.0 + 6.0 * static_cast<double>(i / 2);
    run.rest_length_m = truth.muscle.rest_length_m;
    domain::Measurement& measured = run.measured.emplace();
    for (std::size_t k = 0; k < rows_with_a_cell; ++k) {
      measured.time_s.push_back(0.012 * static_cast<double>(k));
      const double turn = 2.0 * std::numbers::pi * measured.time_s.back() / (i % 2 == 0 ? 1.2 : 0.7);
      measured.give("muscle_pressure").push_back(2.8e5 - (i % 2 == 0 ? 1.6e5 : 1e5) * std::cos(turn));
    }
    // What is not given is not predicted: the reading says that a cell is there.
    run.read("contraction");
    run.read("force");
    const Loaded hanging{truth, run.load_kg};
    auto readings = predict(run, {&hanging, 1}).front();
    run.readings.clear();
    for (double& ratio : readings.readings[0]) ratio += noise.ratio * normal(random);
    for (double& force_N : readings.readings[1]) force_N += noise.force_N * normal(random);
    measured.take("contraction") = std::move(readings.readings[0]);
    measured.take("force") = std::move(readings.readings[1]);
  }
  return data;
}

}  // namespace mckibben::diagnose
