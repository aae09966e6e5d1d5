// A measuring board that Comedi drives (https://www.comedi.org): an analog output gives the current, a
// counter counts what the encoder says.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>

#include <sim/bench/device.hpp>

namespace mckibben::bench {

struct Wiring {
  std::optional<unsigned> output{};   ///< subdevice of the analog output; the board's first
  unsigned channel = 0;               ///< of the output
  double full_scale_V = 10.0;         ///< at the DAC's largest current, of an output in volts; 0 V is 0 mA
  std::optional<unsigned> counter{};  ///< subdevice of the counter; the board's first
  /// Lines (PFI) of the encoder's signals A and B, on boards that ask which.
  std::optional<std::pair<unsigned, unsigned>> encoder{};

  bool operator==(const Wiring&) const = default;
};

/// Whether this program was built where libcomedi is.
bool has_comedi();

/// The board of a device file such as /dev/comedi0; its counter begins at 0. Throws DeviceFailure: what
/// cannot be opened, has no such output or counter, or no range for the current; without libcomedi, always.
std::unique_ptr<Device> open_comedi(const std::string& file, const Wiring& wiring, double largest_current_mA);

}  // namespace mckibben::bench
