// How the plant is integrated: which SUNDIALS method, and how exactly.
#pragma once

#include <array>
#include <string_view>
#include <utility>

namespace mckibben::solver {

/// `erk`: ARKODE ERKStep, explicit, order 5. `cvode`: CVODE BDF, for stiff rigs. `automatic`: the first, and
/// the second once the steps of a run show that it is stiff.
enum class Method { automatic, erk, cvode };
constexpr auto names(Method) {
  using enum Method;
  return std::array{std::pair{automatic, std::string_view{"auto"}}, std::pair{erk, std::string_view{"erk"}},
                    std::pair{cvode, std::string_view{"cvode"}}};
}

inline constexpr double tightest_tolerance = 1e-12;

struct Settings {
  Method method = Method::automatic;
  double tolerance = 1e-6;

  static void fields(auto& self, auto& visit) {
    visit("method", self.method, "erk (explicit, order 5), cvode (BDF, for stiff rigs) or auto");
    visit("tolerance", self.tolerance, "1", tightest_tolerance, 1e-3,
          "local error a step may make, relative to each state's working size");
  }
};

}  // namespace mckibben::solver
