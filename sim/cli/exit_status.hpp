// Exit statuses that scripts rely on (the numbers are those of sysexits.h where it has one).
#pragma once

namespace mckibben::cli {

enum ExitStatus : int {
  done = 0,
  criterion_not_met = 1,
  usage_error = 64,
  bad_input = 65,
  missing_input = 66,
  failure = 70,  ///< the integrator gave up, or a defect of ours
  cannot_write = 74,
  interrupted = 130,
};

}  // namespace mckibben::cli
