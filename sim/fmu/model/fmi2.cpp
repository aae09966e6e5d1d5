// The interface of FMI 2.0 for co-simulation (fmi-standard.org, sections 2 and 4): every function of it, over
// an Instance. Types are those of the standard's headers by their size.
#include <cstddef>
#include <string>

#include <sim/fmu/model/instance.hpp>

#define EXPORTED extern "C" [[gnu::visibility("default")]]

namespace mckibben::fmu::two {

using Component = Instance*;
using State = Slave*;

/// What an importer hands over; only the log is needed.
struct Callbacks {
  void (*logger)(void* environment, const char* instance, Status status, const char* category,
                 const char* message, ...);
  void* (*allocate)(std::size_t, std::size_t);
  void (*release)(void*);
  void (*step_finished)(void*, Status);
  void* environment;
};

constexpr int co_simulation = 1;

/// What a variable of another type, or another way to step, would ask for; there is none.
Status not_offered(Component instance, std::size_t wanted = 1) {
  if (wanted == 0) return ok;
  instance->log("this FMU does not offer that function");
  return error;
}

EXPORTED const char* fmi2GetTypesPlatform() {
  return "default";
}
EXPORTED const char* fmi2GetVersion() {
  return "2.0";
}
EXPORTED Status fmi2SetDebugLogging(Component, int, std::size_t, const char* const*) {
  return ok;
}

EXPORTED Component fmi2Instantiate(const char* name, int type, const char* token, const char* resources,
                                   const Callbacks* callbacks, int, int) {
  const auto log = [name = std::string(name != nullptr ? name : ""), callbacks](const char* message) {
    if (callbacks != nullptr && callbacks->logger != nullptr)
      callbacks->logger(callbacks->environment, name.c_str(), error, "logStatusError", "%s", message);
  };
  if (type != co_simulation || token == nullptr || resources == nullptr) {
    log("this FMU is for co-simulation, and needs its token and the folder of its resources");
    return nullptr;
  }
  return instance_in(path_in(resources), token, log);
}
EXPORTED void fmi2FreeInstance(Component instance) {
  delete instance;
}

EXPORTED Status fmi2SetupExperiment(Component instance, int, double, double start_s, int, double) {
  return instance->done([&] { instance->slave.set_up(start_s); });
}
EXPORTED Status fmi2EnterInitializationMode(Component instance) {
  return instance->done([&] { instance->slave.initialise(); });
}
EXPORTED Status fmi2ExitInitializationMode(Component instance) {
  return instance->done([&] { instance->slave.set_off(); });
}
EXPORTED Status fmi2Terminate(Component instance) {
  return instance->done([&] { instance->slave.terminate(); });
}
EXPORTED Status fmi2Reset(Component instance) {
  return instance->done([&] { instance->slave = Slave(instance->rig); });
}

EXPORTED Status fmi2GetReal(Component c, const Reference* references, std::size_t count, double* values) {
  return c->get(references, count, values);
}
EXPORTED Status fmi2GetInteger(Component c, const Reference* references, std::size_t count, int* values) {
  return c->get(references, count, values);
}
EXPORTED Status fmi2GetBoolean(Component c, const Reference*, std::size_t count, int*) {
  return not_offered(c, count);
}
EXPORTED Status fmi2GetString(Component c, const Reference*, std::size_t count, const char**) {
  return not_offered(c, count);
}
EXPORTED Status fmi2SetReal(Component c, const Reference* references, std::size_t count,
                            const double* values) {
  return c->set(references, count, values);
}
EXPORTED Status fmi2SetInteger(Component c, const Reference*, std::size_t count, const int*) {
  return not_offered(c, count);
}
EXPORTED Status fmi2SetBoolean(Component c, const Reference*, std::size_t count, const int*) {
  return not_offered(c, count);
}
EXPORTED Status fmi2SetString(Component c, const Reference*, std::size_t count, const char* const*) {
  return not_offered(c, count);
}

EXPORTED Status fmi2GetFMUstate(Component instance, State* state) {
  return instance->done([&] { instance->keep(*state); });
}
EXPORTED Status fmi2SetFMUstate(Component instance, State state) {
  return instance->done([&] { instance->slave = Slave(saved(state)); });
}
EXPORTED Status fmi2FreeFMUstate(Component, State* state) {
  if (state != nullptr) delete std::exchange(*state, nullptr);
  return ok;
}
EXPORTED Status fmi2SerializedFMUstateSize(Component instance, State state, std::size_t* size) {
  return instance->done([&] { *size = instance->bytes_of(saved(state)).size(); });
}
EXPORTED Status fmi2SerializeFMUstate(Component instance, State state, char* bytes, std::size_t size) {
  return instance->done([&] { instance->write(saved(state), bytes, size); });
}
EXPORTED Status fmi2DeSerializeFMUstate(Component instance, const char* bytes, std::size_t size,
                                        State* state) {
  return instance->done([&] { instance->read({bytes, size}, *state); });
}
EXPORTED Status fmi2GetDirectionalDerivative(Component c, const Reference*, std::size_t, const Reference*,
                                             std::size_t, const double*, double*) {
  return not_offered(c);
}
EXPORTED Status fmi2SetRealInputDerivatives(Component c, const Reference*, std::size_t, const int*,
                                            const double*) {
  return not_offered(c);
}
EXPORTED Status fmi2GetRealOutputDerivatives(Component c, const Reference*, std::size_t, const int*,
                                             double*) {
  return not_offered(c);
}

EXPORTED Status fmi2DoStep(Component instance, double from_s, double length_s, int) {
  return instance->done([&] { instance->slave.step(from_s, length_s); });
}
EXPORTED Status fmi2CancelStep(Component c) {
  return not_offered(c);
}
// Steps are over when they return, so nothing is ever pending.
EXPORTED Status fmi2GetStatus(Component, int, Status*) {
  return discard;
}
EXPORTED Status fmi2GetRealStatus(Component instance, int kind, double* value) {
  constexpr int last_successful_time = 2;
  if (kind != last_successful_time) return discard;
  return instance->done([&] { *value = instance->slave.get(time_of_ride); });
}
EXPORTED Status fmi2GetIntegerStatus(Component, int, int*) {
  return discard;
}
EXPORTED Status fmi2GetBooleanStatus(Component, int, int*) {
  return discard;
}
EXPORTED Status fmi2GetStringStatus(Component, int, const char**) {
  return discard;
}

}  // namespace mckibben::fmu::two
