// Making an instance; see the header.
#include <algorithm>
#include <charconv>
#include <fstream>
#include <iterator>
#include <memory>
#include <stdexcept>

#include <sim/fmu/model/instance.hpp>
#include <sim/fmu/model/rig_text.hpp>

namespace mckibben::fmu {

Instance* instance_in(const std::filesystem::path& resources, std::string_view token,
                      std::function<void(const char*)> log) {
  try {
    std::ifstream file(resources / rig_file, std::ios::binary);
    if (!file) throw std::runtime_error("cannot read " + (resources / rig_file).string());
    const std::string text(std::istreambuf_iterator<char>(file), {});
    Contents contents = contents_of(text);
    if (contents.token != token)
      throw std::runtime_error("the description is of another FMU: its token is not " + contents.token);
    return new Instance{std::move(log), contents.token, contents.rig, Slave(contents.rig)};
  } catch (const std::exception& failure) {
    log(failure.what());
    return nullptr;
  }
}

void Instance::write(const Slave& state, char* into, std::size_t size) const {
  const std::string bytes = bytes_of(state);
  if (size < bytes.size()) throw std::runtime_error("a state takes more bytes than that");
  std::ranges::copy(bytes, into);
}

void Instance::keep(Slave*& state) const {
  auto copy = std::make_unique<Slave>(slave);
  delete std::exchange(state, copy.release());
}

void Instance::read(std::string_view bytes, Slave*& state) const {
  auto one = std::make_unique<Slave>(rig);
  one->become(bytes, token);
  delete std::exchange(state, one.release());
}

std::filesystem::path path_in(std::string_view address) {
  constexpr std::string_view scheme = "file:";
  if (!address.starts_with(scheme)) return address;
  address.remove_prefix(scheme.size());
  if (address.starts_with("//")) address.remove_prefix(std::min(address.find('/', 2), address.size()));
  std::string path;
  for (std::size_t i = 0; i < address.size(); ++i) {
    unsigned code = 0;
    if (address[i] == '%' && i + 2 < address.size() &&
        std::from_chars(address.data() + i + 1, address.data() + i + 3, code, 16).ptr ==
            address.data() + i + 3) {
      path += static_cast<char>(code);
      i += 2;
    } else {
      path += address[i];
    }
  }
  return path;
}

}  // namespace mckibben::fmu
