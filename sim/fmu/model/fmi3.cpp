// The interface of FMI 3.0 for co-simulation (fmi-standard.org, sections 2 and 4), over an Instance: what a
// rig needs of it, and all other functions of the standard, which say that they are not offered. Types are
// those of the standard's headers by their size.
#include <cstddef>
#include <cstdint>

#include <sim/fmu/model/instance.hpp>

#define EXPORTED extern "C" [[gnu::visibility("default")]]

namespace mckibben::fmu::three {

using Log = void (*)(void* environment, Status status, const char* category, const char* message);

EXPORTED const char* fmi3GetVersion() {
  return "3.0";
}
EXPORTED Status fmi3SetDebugLogging(Instance*, bool, std::size_t, const char* const*) {
  return ok;
}

EXPORTED Instance* fmi3InstantiateCoSimulation(const char*, const char* token, const char* resources, bool,
                                               bool, bool, bool, const Reference*, std::size_t,
                                               void* environment, Log log_message, void*) {
  const auto log = [environment, log_message](const char* message) {
    if (log_message != nullptr) log_message(environment, error, "logStatusError", message);
  };
  if (token == nullptr || resources == nullptr) {
    log("this FMU needs its token and the folder of its resources");
    return nullptr;
  }
  return instance_in(resources, token, log);
}
EXPORTED void fmi3FreeInstance(Instance* instance) {
  delete instance;
}

EXPORTED Status fmi3EnterInitializationMode(Instance* instance, bool, double, double start_s, bool, double) {
  return instance->done([&] {
    instance->slave.set_up(start_s);
    instance->slave.initialise();
  });
}
EXPORTED Status fmi3ExitInitializationMode(Instance* instance) {
  return instance->done([&] { instance->slave.set_off(); });
}
EXPORTED Status fmi3Terminate(Instance* instance) {
  return instance->done([&] { instance->slave.terminate(); });
}
EXPORTED Status fmi3Reset(Instance* instance) {
  return instance->done([&] { instance->slave = Slave(instance->rig); });
}

EXPORTED Status fmi3GetFloat64(Instance* c, const Reference* references, std::size_t count, double* values,
                               std::size_t) {
  return c->get(references, count, values);
}
EXPORTED Status fmi3GetInt64(Instance* c, const Reference* references, std::size_t count,
                             std::int64_t* values, std::size_t) {
  return c->get(references, count, values);
}
EXPORTED Status fmi3SetFloat64(Instance* instance, const Reference* references, std::size_t count,
                               const double* values, std::size_t) {
  return instance->set(references, count, values);
}

EXPORTED Status fmi3GetFMUState(Instance* instance, Slave** state) {
  return instance->done([&] { instance->keep(*state); });
}
EXPORTED Status fmi3SetFMUState(Instance* instance, Slave* state) {
  return instance->done([&] { instance->slave = Slave(saved(state)); });
}
EXPORTED Status fmi3FreeFMUState(Instance*, Slave** state) {
  if (state != nullptr) delete std::exchange(*state, nullptr);
  return ok;
}

EXPORTED Status fmi3SerializedFMUStateSize(Instance* instance, Slave* state, std::size_t* size) {
  return instance->done([&] { *size = instance->bytes_of(saved(state)).size(); });
}
EXPORTED Status fmi3SerializeFMUState(Instance* instance, Slave* state, char* bytes, std::size_t size) {
  return instance->done([&] { instance->write(saved(state), bytes, size); });
}
EXPORTED Status fmi3DeserializeFMUState(Instance* instance, const char* bytes, std::size_t size,
                                        Slave** state) {
  return instance->done([&] { instance->read({bytes, size}, *state); });
}

EXPORTED Status fmi3DoStep(Instance* instance, double from_s, double length_s, bool, bool* event,
                           bool* terminate, bool* early, double* reached_s) {
  for (bool* flag : {event, terminate, early})
    if (flag != nullptr) *flag = false;
  const Status done = instance->done([&] { instance->slave.step(from_s, length_s); });
  if (reached_s != nullptr) *reached_s = done == ok ? from_s + length_s : from_s;
  return done;
}

// Instances of other kinds than co-simulation.
EXPORTED void* fmi3InstantiateModelExchange() {
  return nullptr;
}
EXPORTED void* fmi3InstantiateScheduledExecution() {
  return nullptr;
}

// What a rig has no use for: variables of other types, clocks, derivatives. Whoever calls cleans up the
// arguments, so these need not name them.
#define NOT_OFFERED(function)                            \
  EXPORTED Status function(Instance* instance) {         \
    instance->log("this FMU does not offer " #function); \
    return error;                                        \
  }
NOT_OFFERED(fmi3GetFloat32)
NOT_OFFERED(fmi3GetInt8)
NOT_OFFERED(fmi3GetUInt8)
NOT_OFFERED(fmi3GetInt16)
NOT_OFFERED(fmi3GetUInt16)
NOT_OFFERED(fmi3GetInt32)
NOT_OFFERED(fmi3GetUInt32)
NOT_OFFERED(fmi3GetUInt64)
NOT_OFFERED(fmi3GetBoolean)
NOT_OFFERED(fmi3GetString)
NOT_OFFERED(fmi3GetBinary)
NOT_OFFERED(fmi3GetClock)
NOT_OFFERED(fmi3SetFloat32)
NOT_OFFERED(fmi3SetInt8)
NOT_OFFERED(fmi3SetUInt8)
NOT_OFFERED(fmi3SetInt16)
NOT_OFFERED(fmi3SetUInt16)
NOT_OFFERED(fmi3SetInt32)
NOT_OFFERED(fmi3SetUInt32)
NOT_OFFERED(fmi3SetInt64)
NOT_OFFERED(fmi3SetUInt64)
NOT_OFFERED(fmi3SetBoolean)
NOT_OFFERED(fmi3SetString)
NOT_OFFERED(fmi3SetBinary)
NOT_OFFERED(fmi3SetClock)
NOT_OFFERED(fmi3GetNumberOfVariableDependencies)
NOT_OFFERED(fmi3GetVariableDependencies)
NOT_OFFERED(fmi3GetDirectionalDerivative)
NOT_OFFERED(fmi3GetAdjointDerivative)
NOT_OFFERED(fmi3EnterConfigurationMode)
NOT_OFFERED(fmi3ExitConfigurationMode)
NOT_OFFERED(fmi3GetIntervalDecimal)
NOT_OFFERED(fmi3GetIntervalFraction)
NOT_OFFERED(fmi3GetShiftDecimal)
NOT_OFFERED(fmi3GetShiftFraction)
NOT_OFFERED(fmi3SetIntervalDecimal)
NOT_OFFERED(fmi3SetIntervalFraction)
NOT_OFFERED(fmi3SetShiftDecimal)
NOT_OFFERED(fmi3SetShiftFraction)
NOT_OFFERED(fmi3EvaluateDiscreteStates)
NOT_OFFERED(fmi3UpdateDiscreteStates)
NOT_OFFERED(fmi3EnterContinuousTimeMode)
NOT_OFFERED(fmi3CompletedIntegratorStep)
NOT_OFFERED(fmi3SetTime)
NOT_OFFERED(fmi3SetContinuousStates)
NOT_OFFERED(fmi3GetContinuousStateDerivatives)
NOT_OFFERED(fmi3GetEventIndicators)
NOT_OFFERED(fmi3GetContinuousStates)
NOT_OFFERED(fmi3GetNominalsOfContinuousStates)
NOT_OFFERED(fmi3GetNumberOfEventIndicators)
NOT_OFFERED(fmi3GetNumberOfContinuousStates)
NOT_OFFERED(fmi3EnterEventMode)
NOT_OFFERED(fmi3EnterStepMode)
NOT_OFFERED(fmi3GetOutputDerivatives)
NOT_OFFERED(fmi3ActivateModelPartition)

}  // namespace mckibben::fmu::three
