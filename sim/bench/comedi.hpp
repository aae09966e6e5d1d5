// A measuring board that Comedi drives (https://www.comedi.org): an analog output gives the command, a
// counter counts what the encoder says.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>

#include <plant/rig.hpp>
#include <sim/bench/device.hpp>

namespace mckibben::bench {

struct Wiring {
  std::optional<unsigned> output{};  ///< subdevice of the analog output; the board's first
  unsigned channel = 0;              ///< of the output
  /// At the DAC's largest_command, of an output in volts for a valve that takes none; 0 V is 0 mA or bar. 10
  /// V.
  std::optional<double> full_scale_V{};
  std::optional<unsigned> counter{};  ///< subdevice of the counter; the board's first
  /// Lines (PFI) of the encoder's signals A and B, on boards that ask which.
  std::optional<std::pair<unsigned, unsigned>> encoder{};

  bool operator==(const Wiring&) const = default;
};

/// Whether this program was built where libcomedi is.
bool has_comedi();

/// Voltages that hardly any board gives, and what to write; empty where the output needs none. Before a board
/// is opened its ranges are not known.
std::string unusual_range(const Wiring& wiring, const plant::Rig& rig);

/// The board of a device file such as /dev/comedi0; its counter begins at 0. Throws DeviceFailure: what
/// cannot be opened, has no such output or counter, or no range for the commands; without libcomedi, always.
std::unique_ptr<Device> open_comedi(const std::string& file, const Wiring& wiring, const plant::Rig& rig);

}  // namespace mckibben::bench
