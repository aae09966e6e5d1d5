// What is missing, by one likelihood, in five stages:
//
//   rows      what was read, and what wander of the input does to it         rows, simulator
//   fit       the rig as described, and with its parameters free             model, error
//   screen    which sets of effects and bench faults would explain more      screen
//   descend   the best of them, to their most probable numbers               model
//   decide    the simplest that predicts unseen runs as well                 decide
//
// Screen and descend go on from the best set as long as that gains.
#pragma once

#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <sim/diagnose/search.hpp>
#include <sim/identify/decide.hpp>
#include <sim/identify/model.hpp>
#include <sim/identify/usable.hpp>

namespace mckibben::identify {

using diagnose::Ended;

struct Settings {
  unsigned threads = 0;
  std::function<void(const std::string&)> say{};     ///< hears of each step, for who works on the search
  std::function<void(const std::string&)> trying{};  ///< hears what begins, for users
  /// Of the search: simulations of the set, which every machine counts alike, and a time that only stops it.
  long most_passes = 10000;
  double time_limit_s = std::numeric_limits<double>::infinity();
  /// Of an earlier search on these data that was ended; null: nothing is kept to go on from.
  const Simulated* known = nullptr;
};

/// What a search stands on, and its models with it.
struct Study {
  Study(domain::Dataset measured, const Settings& settings)
      : data(std::move(measured)),
        usable(identify::usable(data, settings.threads)),
        rows(data, usable.masked, usable.runs),
        dictionary(data, rows.count > rows.sensor_count ? rows.count : 0.0),
        simulator(rows, settings.threads),
        problem{rows, dictionary, simulator, settings.say} {}
  Study(const Study&) = delete;
  Study& operator=(const Study&) = delete;

  domain::Dataset data;
  Usable usable;
  Rows rows;
  Dictionary dictionary;
  Simulator simulator;
  Problem problem;
};

struct Identified {
  std::shared_ptr<const Study> study;
  std::vector<Scored> table{};  ///< of models, and the models themselves, in the same order
  std::vector<Model> models{};
  Decision decision{};
  std::map<std::string, double> promised{};  ///< nats that a look saw in a name
  Ended ended = Ended::no;                   ///< before the search was through,
  std::vector<std::string> not_done{};       ///< without these
  Simulated simulated{};                     ///< by then, to go on from
  long passes = 0;

  const Model& chosen() const { return models[decision.chosen]; }
  /// The model of the rig as described, or of its parameters alone; null if there is none.
  const Model* of(bool described) const {
    for (std::size_t i = 0; i < table.size(); ++i)
      if (table[i].names.empty() && table[i].described == described) return &models[i];
    return nullptr;
  }
};

/// Of data with rows (data::with_rows). Throws data::UnfitData; run::Interrupted before there is anything to
/// hand over.
Identified identify(domain::Dataset data, const Settings& settings);

}  // namespace mckibben::identify
