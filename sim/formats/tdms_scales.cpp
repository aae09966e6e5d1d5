// See the header.
#include <string>
#include <vector>

#include <fmt/format.h>

#include <sim/formats/table.hpp>
#include <sim/formats/tdms_scales.hpp>

namespace mckibben::formats {
namespace {

class Scales {
 public:
  Scales(const Properties& said, const std::string& channel) : said_(said), channel_(channel) {
    constexpr double most_scales = 100.0;
    const double count = said.number("NI_Number_Of_Scales");
    if (!(count >= 1.0 && count <= most_scales) || said.text("NI_Scaling_Status") == "scaled") return;
    for (auto k = static_cast<std::size_t>(count); k-- > 0 && steps_.empty();)
      if (!type(k).empty()) add(k);
  }
  /// From the counts to the unit.
  void apply(std::vector<double>& values) const {
    for (const std::vector<double>& coefficients : steps_)
      for (double& value : values) {
        double scaled = 0.0;
        for (std::size_t k = coefficients.size(); k-- > 0;) scaled = scaled * value + coefficients[k];
        value = scaled;
      }
  }

 private:
  static std::string name(std::size_t scale, std::string_view key) {
    return fmt::format("NI_Scale[{}]_{}", scale, key);
  }
  std::string type(std::size_t scale) const { return said_.text(name(scale, "Scale_Type")); }

  void add(std::size_t scale) {
    constexpr double most_coefficients = 100.0, usual_coefficients = 4.0;
    const std::string kind = type(scale);
    const bool linear = kind == "Linear";
    if (!linear && kind != "Polynomial")
      throw BadFile(fmt::format(
          "its channel {} holds counts with a scale of the kind {}, which is not read; save it scaled, or "
          "export it as text",
          channel_, kind));
    const double input = said_.number(name(scale, kind + "_Input_Source"), -1.0);
    if (input >= 0.0 && input < static_cast<double>(scale) && !type(static_cast<std::size_t>(input)).empty())
      add(static_cast<std::size_t>(input));
    std::vector<double>& coefficients = steps_.emplace_back();
    if (linear)
      coefficients = {said_.number(name(scale, "Linear_Y_Intercept")),
                      said_.number(name(scale, "Linear_Slope"), 1.0)};
    const double size =
        linear ? 0.0 : said_.number(name(scale, "Polynomial_Coefficients_Size"), usual_coefficients);
    if (!(size >= 0.0 && size <= most_coefficients))
      throw BadFile(fmt::format("its channel {} has a scale of {} coefficients", channel_, size));
    for (std::size_t k = 0; k < static_cast<std::size_t>(size); ++k)
      coefficients.push_back(said_.number(name(scale, fmt::format("Polynomial_Coefficients[{}]", k))));
  }

  const Properties& said_;
  const std::string& channel_;
  std::vector<std::vector<double>> steps_;  ///< polynomials, the first of the counts
};

}  // namespace

void apply_scales(const Properties& said, const std::string& channel, std::vector<double>& values) {
  Scales(said, channel).apply(values);
}

}  // namespace mckibben::formats
