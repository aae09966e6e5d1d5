// The explicit method for each layout of the state; see erk_method.hpp.
#include <sim/engine/erk.hpp>
#include <sim/engine/erk_method.hpp>

namespace mckibben::engine {

Trouble erk_trouble(int flag) {
  switch (flag) {
    case ARK_TOO_MUCH_WORK:
      return Trouble::too_many_steps;
    case ARK_TOO_MUCH_ACC:
      return Trouble::too_accurate;
    case ARK_ERR_FAILURE:
      return Trouble::error_test;
    case ARK_RHSFUNC_FAIL:
    case ARK_FIRST_RHSFUNC_ERR:
    case ARK_REPTD_RHSFUNC_ERR:
    case ARK_UNREC_RHSFUNC_ERR:
      return Trouble::outside_domain;
    default:
      return Trouble::other;
  }
}

std::unique_ptr<Integrator> make_erk(const plant::Plant& rig, double tolerance, bool keep_ledger) {
  return with_vector(rig, keep_ledger, [&]<class V>(V*) -> std::unique_ptr<Integrator> {
    return std::make_unique<Erk<V>>(rig, tolerance);
  });
}

}  // namespace mckibben::engine
