// The keys that are gone; see the header.
#include <array>
#include <string>

#include <fmt/format.h>

#include <sim/input/suggest.hpp>
#include <sim/input/upgrade.hpp>

namespace mckibben::input {
namespace {

struct Gone {
  std::string_view file, of_kind, key, note;  ///< `of_kind`: of a map with that `kind`
};
constexpr std::array gone{
    Gone{"mckibben-scenario", "feedforward_pid", "weighing",
         "remove it: this controller takes the load from the currents of its loop, and lifts none to weigh "
         "it"},
    Gone{"mckibben-scenario", "feedforward_pid", "extrapolate_target",
         "remove it: beyond the calibrated contraction ratios nothing is fed forward"},
};

std::string_view kind_of(std::string_view schema) {
  return schema.substr(0, schema.find('/'));
}

void look_through(const Node& node, std::string_view file, const Source& source, Problems& found) {
  const Node* kind = node.find("kind");
  for (const Node& child : node.children) {
    for (const Gone& one : gone)
      if (one.file == file && one.key == child.key && kind != nullptr && kind->text == one.of_kind)
        found.warning(source, child.key_place, fmt::format("{}: {}", one.key, one.note));
    look_through(child, file, source, found);
  }
}

}  // namespace

std::vector<Problem> to_upgrade(const YamlFile& file, std::span<const std::string_view> schemas) {
  Problems found;
  const Node* schema = file.root.find("schema");
  if (schema == nullptr) return {};
  for (const std::string_view one : schemas)
    if (kind_of(one) == kind_of(schema->text) && one != schema->text)
      found.warning(file.source, schema->place,
                    fmt::format("schema = {}: this version reads {}; write that, and check the file",
                                shortened(schema->text), one));
  look_through(file.root, kind_of(schema->text), file.source, found);
  return found.sorted();
}

}  // namespace mckibben::input
