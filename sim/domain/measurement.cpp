// Columns by their signals; see the header.
#include <algorithm>
#include <cmath>

#include <sim/domain/measurement.hpp>

namespace mckibben::domain {
namespace {

const std::vector<double> nothing;

auto find(auto& columns, std::string_view key, std::size_t muscle) {
  return std::ranges::find_if(columns, [&](const auto& column) { return column.channel.is(key, muscle); });
}

std::vector<double>& column_of(Measurement& measured, std::string_view key, std::size_t muscle, bool given) {
  auto at = find(measured.columns, key, muscle);
  if (at == measured.columns.end())
    at = measured.columns.insert(at, {{quantity_of(key).channel.signal, muscle}, given});
  return at->values;
}

}  // namespace

bool is_read(const std::vector<double>& values) {
  return std::ranges::any_of(values, [](double value) { return !std::isnan(value); });
}

bool Measurement::gives(std::string_view key, std::size_t muscle) const {
  const auto at = find(columns, key, muscle);
  return at != columns.end() && at->given;
}

const std::vector<double>& Measurement::given(std::string_view key, std::size_t muscle) const {
  return gives(key, muscle) ? values(key, muscle) : nothing;
}

const std::vector<double>& Measurement::read(std::string_view key, std::size_t muscle) const {
  return gives(key, muscle) ? nothing : values(key, muscle);
}

const std::vector<double>& Measurement::values(std::string_view key, std::size_t muscle) const {
  const auto at = find(columns, key, muscle);
  return at != columns.end() ? at->values : nothing;
}

bool Measurement::has_row(std::size_t stamp) const {
  return !own_clocks || std::ranges::any_of(columns, [&](const MeasuredColumn& column) {
    return !column.is_command() && (column.given || !std::isnan(column.values[stamp]));
  });
}

bool Measurement::reads_only_pressures() const {
  bool any = false;
  for (const MeasuredColumn& column : columns)
    if (!column.given && is_read(column.values)) {
      if (!column.channel.is_pressure()) return false;
      any = true;
    }
  return any;
}

std::vector<double>& Measurement::give(std::string_view key, std::size_t muscle) {
  return column_of(*this, key, muscle, true);
}

std::vector<double>& Measurement::take(std::string_view key, std::size_t muscle) {
  return column_of(*this, key, muscle, false);
}

plant::GivenPressure Measurement::given_pressure(std::size_t muscle) const {
  if (gives("muscle_pressure", muscle)) return plant::GivenPressure::muscle;
  return gives("valve_pressure", muscle) ? plant::GivenPressure::valve : plant::GivenPressure::none;
}

}  // namespace mckibben::domain
