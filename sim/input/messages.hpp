// A log of messages, as `ros2 topic echo` and `rostopic echo` print them: YAML documents between lines of
// `---`, each with the same keys.
#pragma once

#include <optional>

#include <sim/input/source.hpp>

namespace mckibben::input {

/// As CSV, a row for each message: keys with points between them (`header.stamp.sec`, `position.0`) as
/// headings. A last message that was cut, and what is no YAML between messages, is left out; a row stands for
/// the line where its message begins. None where the text is no such log. Throws BadInput for one that is too
/// large for all of its lines.
std::optional<Source> as_rows(const Source& source);

}  // namespace mckibben::input
