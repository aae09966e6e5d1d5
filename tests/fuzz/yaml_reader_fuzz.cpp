// Fuzz target: any bytes, read as a scenario, are accepted or refused with BadInput or MissingInput; what is
// accepted, written out and read again is the same.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

#include <sim/input/scenario.hpp>

namespace {

namespace input = mckibben::input;

input::Scenario read(const std::string& text) {
  std::vector<input::Problem> warnings;
  return input::read_scenario(input::Source("fuzz.yaml", text, "/nonexistent"), warnings);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::string once;
  try {
    once = scenario_json(read(std::string(data, data + size))).dump();
  } catch (const input::BadInput&) {
    return 0;
  } catch (const input::MissingInput&) {
    return 0;
  }
  if (scenario_json(read(once)).dump() != once) std::abort();
  return 0;
}
