// See the header.
#include <cmath>

#include <fmt/format.h>

#include <sim/data/amount.hpp>

namespace mckibben::data {

std::string amount_of(Judged judged, double value, const plant::Rig& rig, int digits) {
  switch (judged) {
    case Judged::force:
      return fmt::format("{:.{}g} N", value, digits);
    case Judged::angle:
      return fmt::format("{:.{}g} deg", value / plant::degree_rad, digits);
    case Judged::pressure:
      return std::abs(value) < 1e4 ? fmt::format("{:.{}g} mbar", 1e3 * value / plant::Pa_per_bar, digits)
                                   : fmt::format("{:.{}g} bar", value / plant::Pa_per_bar, digits);
    case Judged::contraction:
      break;
  }
  return fmt::format("{:.{}g} mm", 1e3 * value * rig.muscle.rest_length_m, digits);
}

std::string_view unit_in_words(Judged judged) {
  switch (judged) {
    case Judged::force:
      return "N";
    case Judged::angle:
      return "rad";
    case Judged::pressure:
      return "Pa";
    case Judged::contraction:
      break;
  }
  return "in contraction ratio";
}

std::pair<std::string, std::string_view> told(domain::Beside which, bool pair) {
  return {domain::channel_of(which, pair).key_in_dataset(), which == domain::Beside::force ? "N" : "Pa"};
}

}  // namespace mckibben::data
