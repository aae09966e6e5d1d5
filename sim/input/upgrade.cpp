// The keys that are gone; see the header.
#include <algorithm>
#include <array>
#include <charconv>
#include <string>
#include <utility>

#include <fmt/format.h>

#include <sim/domain/renamed.hpp>
#include <sim/input/sensors_file.hpp>
#include <sim/input/suggest.hpp>
#include <sim/input/upgrade.hpp>
#include <sim/input/utf8.hpp>

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
/// 0 where there is none.
int version_of(std::string_view schema) {
  int version = 0;
  const std::size_t slash = std::min(schema.find('/'), schema.size() - 1);
  std::from_chars(schema.data() + slash + 1, schema.data() + schema.size(), version);
  return version;
}

/// What is to be said of a schema; nothing if it is one that is read.
std::string note_on(std::string_view schema, std::span<const std::string_view> schemas) {
  const auto read = std::ranges::find(schemas, kind_of(schema), kind_of);
  if (read == schemas.end())
    return fmt::format("schema = {} is none of this program's: {}", shortened(schema), join(schemas));
  if (*read == schema) return "";
  if (version_of(schema) > version_of(*read))
    return fmt::format("schema = {}: this version reads {}; take the later one that the file was written for",
                       shortened(schema), *read);
  return fmt::format("schema = {}: this version reads {}; write that, and check the file", shortened(schema),
                     *read);
}

void look_through(const Node& node, std::string_view file, const Source& source, Problems& found) {
  if (const std::string list = in_place_of_old_sensors(node); !list.empty())
    for (const OldSensorKey& old : old_sensor_keys)
      if (const Node* one = node.find(old.key); one != nullptr && one->kind == Node::Kind::map) {
        found.warning(source, one->key_place,
                      fmt::format("{}: sensors are one list; write {}", old.key, list));
        break;
      }
  const Node* kind = node.find("kind");
  for (const Node& child : node.children) {
    if (const std::string_view now = domain::name_today(child.key); now != child.key)
      found.warning(source, child.key_place, fmt::format("{}: write {}", child.key, now));
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
  if (schema == nullptr) {
    found.warning(file.source, file.root.place,
                  fmt::format("the file does not say what it is: schema: one of {}", join(schemas)));
    return found.sorted();
  }
  if (std::string note = note_on(schema->text, schemas); !note.empty())
    found.warning(file.source, schema->place, std::move(note));
  look_through(file.root, kind_of(schema->text), file.source, found);
  return found.sorted();
}

}  // namespace mckibben::input
