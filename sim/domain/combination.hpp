// What of a run may be given and read together: one table of rules, each with its reason. Asked by whoever
// reads a data set (of its columns, before any table is opened), and by checks, replay and diagnosis (of
// what was read).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <sim/domain/dataset.hpp>

namespace mckibben::domain {

/// What cannot be, and where it is said: a key of `columns`, `load` of the run, or `start`, `hold` of the
/// data set.
struct Contradiction {
  std::string key, why;
};

/// Of what the files say of a run.
std::vector<Contradiction> contradictions(const Dataset& data, const Run& run);

/// What a judgement by `Dataset::judged` needs; a calibration with rows made of stamps needs more.
enum class Purpose { judging, calibration };
/// The first run as it was read that cannot serve it, in place of a key, and why; none if all can.
std::optional<Contradiction> why_not(Purpose purpose, const Dataset& data);

}  // namespace mckibben::domain
