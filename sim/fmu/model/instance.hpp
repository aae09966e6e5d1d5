// What both versions of the standard have in common: an instance with its log, made from the folder that was
// unpacked, and a guard that turns exceptions into a line of the log.
#pragma once

#include <cstddef>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <functional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include <sim/fmu/model/slave.hpp>

namespace mckibben::fmu {

/// As both versions number them; `pending` is of version 2 alone.
enum Status { ok, warning, discard, error, fatal, pending };
using Reference = std::uint32_t;

struct Instance {
  std::function<void(const char* message)> log;
  std::string token;  ///< of the FMU
  plant::Rig rig;     ///< as it was unpacked, for a reset
  Slave slave;

  /// Does it; where it cannot, the log says why.
  Status done(const auto& work) {
    try {
      work();
      return ok;
    } catch (const std::exception& failure) {
      log(failure.what());
      return error;
    }
  }
  Status get(const Reference* references, std::size_t count, auto* values) {
    return done([&] {
      for (std::size_t i = 0; i < count; ++i)
        values[i] = static_cast<std::remove_pointer_t<decltype(values)>>(slave.get(references[i]));
    });
  }
  Status set(const Reference* references, std::size_t count, const double* values) {
    return done([&] {
      for (std::size_t i = 0; i < count; ++i) slave.set(references[i], values[i]);
    });
  }

  std::string bytes_of(const Slave& state) const { return state.bytes(token); }
  /// Throws std::runtime_error where there is no room for it.
  void write(const Slave& state, char* into, std::size_t size) const;
  // `state`: null, or one that is given up.
  void keep(Slave*& state) const;
  /// Throws as Slave::become.
  void read(std::string_view bytes, Slave*& state) const;
};

/// What an importer has as a state. Throws std::invalid_argument where it has none.
inline const Slave& saved(const Slave* state) {
  if (state == nullptr) throw std::invalid_argument("no state was saved");
  return *state;
}

/// Null if the token is another's or the folder lacks what it must hold, and the log says why.
Instance* instance_in(const std::filesystem::path& resources, std::string_view token,
                      std::function<void(const char*)> log);

/// The path in an address such as file:///tmp/a%20b.
std::filesystem::path path_in(std::string_view address);

/// The file in the folder of resources that holds the rig.
inline constexpr const char* rig_file = "rig.txt";

}  // namespace mckibben::fmu
