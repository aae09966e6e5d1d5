// Decimation, quantisation; letters by OpenSSL.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include <openssl/evp.h>

#include <sim/report/pack.hpp>

namespace mckibben::report {
namespace {

constexpr std::size_t most_columns = 1000, least_columns = 100, all_columns = 80000;
constexpr double most_code = 65534.0;
constexpr std::uint16_t none = 65535;

/// Smallest and largest of the ticks from `begin` to `end` that have a value, the earlier one first.
std::pair<double, double> extremes(const AtTick& at, std::size_t begin, std::size_t end) {
  double least = at(begin), most = least;
  bool rising = true;
  for (std::size_t k = begin + 1; k < end; ++k) {
    const double value = at(k);
    if (std::isnan(value)) continue;
    if (std::isnan(least)) least = most = value;
    if (value < least) least = value, rising = false;
    if (value > most) most = value, rising = true;
  }
  return rising ? std::pair{least, most} : std::pair{most, least};
}

}  // namespace

std::size_t ticks_per_column(std::size_t ticks, std::size_t runs) {
  const auto columns = std::clamp(all_columns / std::max<std::size_t>(runs, 1), least_columns, most_columns);
  return ticks <= 2 * columns ? 1 : (ticks + columns - 1) / columns;
}

std::size_t points(std::size_t ticks, std::size_t per_column) {
  return per_column == 1 ? ticks : 2 * ((ticks + per_column - 1) / per_column);
}

Packed pack(const AtTick& at, std::size_t ticks, std::size_t present, std::size_t per_column) {
  std::vector<double> values;
  values.reserve(points(ticks, per_column));
  for (std::size_t k = 0; k < present; k += per_column) {
    if (per_column == 1) {
      values.push_back(at(k));
      continue;
    }
    const auto [first, second] = extremes(at, k, std::min(k + per_column, present));
    values.push_back(first);
    values.push_back(second);
  }
  values.resize(points(ticks, per_column), std::numeric_limits<double>::quiet_NaN());

  double low = std::numeric_limits<double>::infinity(), high = -low;
  bool complete = true;
  for (const double value : values) {
    if (!std::isfinite(value)) {
      complete = false;
      continue;
    }
    low = std::min(low, value);
    high = std::max(high, value);
  }
  if (low > high) low = high = 0.0;
  const double step = (high - low) / most_code;
  std::vector<unsigned char> bytes;
  if (step > 0.0 || !complete) {
    bytes.reserve(2 * values.size());
    for (const double value : values) {
      std::uint16_t code = none;
      if (std::isfinite(value))
        code = step > 0.0 ? static_cast<std::uint16_t>(std::lround((value - low) / step)) : std::uint16_t{0};
      bytes.push_back(static_cast<unsigned char>(code & 0xff));
      bytes.push_back(static_cast<unsigned char>(code >> 8));
    }
  }
  return {low, step, base64(bytes)};
}

std::string base64(const std::vector<unsigned char>& bytes) {
  std::string text((bytes.size() + 2) / 3 * 4 + 1, '\0');  // a last byte of zero is written, too
  const int length = EVP_EncodeBlock(reinterpret_cast<unsigned char*>(text.data()), bytes.data(),
                                     static_cast<int>(bytes.size()));
  text.resize(static_cast<std::size_t>(length));
  return text;
}

}  // namespace mckibben::report
