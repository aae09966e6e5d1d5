// See the header.
#include <sim/study/counting.hpp>
#include <sim/study/figures.hpp>
#include <sim/study/lag.hpp>
#include <sim/study/study.hpp>

namespace mckibben::study {

Study make(std::string_view name, const Evidence& evidence) {
  if (name == "lag") return study_lag(evidence);
  if (name == "counting") return study_counting(evidence);
  return study_figures(evidence);
}

}  // namespace mckibben::study
