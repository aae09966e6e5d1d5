// Field lists to Markdown; see the header.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <sim/input/field_table.hpp>

namespace mckibben::input {
namespace {

std::string default_text(const FieldInfo& info) {
  if (info.required) return "required";
  if (info.default_value.is_null()) return "";
  return info.default_value.is_string() ? info.default_value.get<std::string>() : info.default_value.dump();
}

std::string range_text(const FieldInfo& info) {
  switch (info.type) {
    case FieldInfo::Type::quantity:
      return fmt::format("{} to {}", show_limit(info.lowest.get<double>(), info.unit),
                         show_limit(info.highest.get<double>(), info.unit));
    case FieldInfo::Type::integer:
      return fmt::format("{} to {}", info.lowest.dump(), info.highest.dump());
    case FieldInfo::Type::choice:
      return fmt::format("{}", fmt::join(info.choices, ", "));
    case FieldInfo::Type::boolean:
      return "true, false";
    case FieldInfo::Type::height:
      return "ratio or length";
    case FieldInfo::Type::text:
      return "text";
    case FieldInfo::Type::structure:
      return "see below";
    case FieldInfo::Type::variant:
      break;
  }
  std::vector<std::string> kinds;
  for (const FieldInfo::Group& group : info.groups) kinds.push_back(group.kind);
  return fmt::format("kind: {}", fmt::join(kinds, ", "));
}

}  // namespace

std::string field_table(std::string_view title, const std::vector<FieldInfo>& fields, int level) {
  std::string text = fmt::format("{} {}\n\n", std::string(static_cast<std::size_t>(level), '#'), title);
  text += "| key | unit | default | range | meaning |\n|---|---|---|---|---|\n";
  for (const FieldInfo& info : fields)
    text +=
        fmt::format("| `{}` | {} | {} | {}{} | {} |\n", info.key, info.unit == "1" ? "" : info.unit,
                    default_text(info), info.is_list ? "list; each " : "", range_text(info), info.meaning);
  for (const FieldInfo& info : fields)
    for (const FieldInfo::Group& group : info.groups)
      text += '\n' + field_table(group.kind.empty()
                                     ? fmt::format("{}: {}", title, info.key)
                                     : fmt::format("{}: {} of kind {}", title, info.key, group.kind),
                                 group.fields, level);
  return text;
}

}  // namespace mckibben::input
