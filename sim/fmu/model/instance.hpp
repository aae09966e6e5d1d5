// What both versions of the standard have in common: an instance with its log, made from the folder that was
// unpacked, and a guard that turns exceptions into a line of the log.
#pragma once

#include <exception>
#include <filesystem>
#include <functional>
#include <stdexcept>
#include <string>
#include <string_view>

#include <sim/fmu/model/slave.hpp>

namespace mckibben::fmu {

struct Instance {
  std::function<void(const char* message)> log;
  std::string token;  ///< of the FMU
  plant::Rig rig;     ///< as it was unpacked, for a reset
  Slave slave;

  /// Does it; false if it could not, and the log says why.
  bool done(const auto& work) {
    try {
      work();
      return true;
    } catch (const std::exception& failure) {
      log(failure.what());
      return false;
    }
  }

  std::string bytes_of(const Slave& state) const { return state.bytes(token); }
  /// Throws std::runtime_error where there is no room for it.
  void write(const Slave& state, char* into, std::size_t size) const;
  /// `state`: null, or one that is given up. Throws as Slave::become.
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
