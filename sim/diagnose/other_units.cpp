// Measured over model; see the header.
#include <cmath>
#include <string>
#include <utility>

#include <fmt/format.h>

#include <sim/diagnose/other_units.hpp>
#include <sim/diagnose/thresholds.hpp>
#include <sim/domain/objection.hpp>
#include <sim/run/series.hpp>

namespace mckibben::diagnose {
namespace {

constexpr const CheckThresholds& like = thresholds.check;

using Series = std::vector<double>;

/// All rows of all runs, measured and of the model.
struct Compared {
  Series measured, model;
};

class Units {
 public:
  Units(const domain::Dataset& data, const std::vector<Readings>& model,
        const std::vector<std::vector<bool>>& masked)
      : data_(data), model_(model), masked_(masked) {}

  void operator()() const {
    if (data_.judged() == domain::Judged::angle) return angle();
    if (data_.judged() == domain::Judged::force) return forces();
    force_beside();
  }

 private:
  template <class Read, class Model>
  Compared rows(const Read& read, const Model& of_model) const {
    Compared all;
    for (std::size_t i = 0; i < data_.runs.size(); ++i)
      if (const Series* measured = read(data_.runs[i]))
        for (std::size_t k = 0; k < measured->size(); ++k) {
          if (masked_[i][k]) continue;
          all.measured.push_back((*measured)[k]);
          all.model.push_back(of_model(model_[i])[k]);
        }
    return all;
  }
  Compared judged() const {
    return rows([](const domain::Run& run) { return &run.judged(); },
                [](const Readings& readings) -> const Series& { return readings.judged; });
  }

  [[noreturn]] void refuse(const std::string& seen, std::string_view quantity,
                           const domain::ColumnPlace& place, std::string_view or_else = "") const {
    throw domain::UnfitData(data_, fmt::format("{}: {}; write columns: {{{}}}{}", quantity, seen,
                                               domain::line_of(quantity, place), or_else));
  }

  domain::ColumnPlace place_of(domain::ColumnPlace domain::ColumnMap::*quantity, const char* usual_column,
                               const char* usual_unit) const {
    domain::ColumnPlace place = domain::merged(data_.columns, data_.runs.front().columns).*quantity;
    if (place.absent()) place = {.column = usual_column, .unit = usual_unit};
    return place;
  }

  // Forces at given lengths go up and down with the model's.
  void forces() const {
    const Compared all = judged();
    if (all.measured.size() < 2 || run::range(all.model) == 0.0) return;
    const double slope = run::Line(all.measured, all.model).slope;
    const std::string seen = fmt::format("the readings go {:.2g} times as far as this rig's forces", slope);
    auto place = place_of(&domain::ColumnMap::force, "force_N", "N");
    if (slope < 0.0) {
      place.factor = -place.factor;
      refuse(seen + ": where it pulls more they show less", "force", place);
    }
    place.unit = "kN";
    if (std::abs(std::log(slope * 1e3)) < like.like_kilo)
      refuse(seen + ": they look like kN", "force", place);
  }

  // What hangs on the cord says how large its force is, whatever moves it.
  void force_beside() const {
    const Compared all = rows([](const domain::Run& run) { return run.beside(domain::Beside::force); },
                              [](const Readings& readings) -> const Series& { return readings.force_N; });
    double read_N = 0.0, model_N = 0.0;
    for (const double force_N : all.measured) read_N += force_N;
    for (const double force_N : all.model) model_N += force_N;
    if (read_N == 0.0 || !(model_N > 0.0)) return;
    const std::string seen = fmt::format(
        "on average the readings are {:.2g} times the force of this rig's cord", read_N / model_N);
    auto place = place_of(&domain::ColumnMap::force, "force_N", "N");
    if (read_N < -like.opposite_force * model_N) {
      place.factor = -place.factor;
      refuse(seen + ": a cord pulls", "force", place);
    }
    if (read_N < 0.0) return;  // set to 0 with the load on it
    const double logarithm = std::log(read_N / model_N);
    place.unit = "kN";
    if (std::abs(logarithm + std::log(1e3)) < like.like_kilo)
      refuse(seen + ": they look like kN", "force", place);
    place.unit = "kgf";
    if (std::abs(logarithm + std::log(plant::gravity_m_per_s2)) < like.like_kilogram)
      refuse(seen + ": they look like kg", "force", place);
  }

  // A joint that goes the other way than the rig's, or far too far, is not read as its columns say.
  void angle() const {
    const Compared all = judged();
    if (all.measured.size() < 2 || run::range(all.model) == 0.0) return;
    const run::Line line(all.measured, all.model);
    const std::string seen =
        fmt::format("the readings go {:.2g} times as far as this rig's joint", line.slope);
    auto place = place_of(&domain::ColumnMap::angle, "angle_rad", "rad");
    if (line.correlation < -like.like_turn && line.slope < -like.turns_at_all) {
      place.factor = -place.factor;
      refuse(seen + ": it turns the other way", "angle", place, ", or exchange muscle 1 and muscle 2");
    }
    if (line.correlation < like.like_turn) return;
    const double turns = std::log(line.slope), degrees = std::log(plant::degree_rad);
    if (std::abs(turns + degrees) < like.like_degrees) {
      place.unit = "deg";
      refuse(seen + ": they look like degrees", "angle", place);
    }
    if (std::abs(turns - degrees) < like.like_degrees) {
      place.unit = "rad";
      refuse(seen + ": they look like radians", "angle", place);
    }
  }

  const domain::Dataset& data_;
  const std::vector<Readings>& model_;
  const std::vector<std::vector<bool>>& masked_;
};

}  // namespace

void refuse_other_units(const domain::Dataset& data, const std::vector<Readings>& model,
                        const std::vector<std::vector<bool>>& masked) {
  Units(data, model, masked)();
}

}  // namespace mckibben::diagnose
